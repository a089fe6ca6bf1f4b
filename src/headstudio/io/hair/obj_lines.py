"""Strands as polylines in a Wavefront OBJ: v and l."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...wisp.strands import Strands
from .contents import Contents, HairFileError, as_text


def read(path: Path) -> Contents:
    """Lines that begin where the line before ended belong to the same strand: some programs write each edge by itself."""
    try:
        lines = path.read_text("utf-8", errors="strict").replace("\\\n", " ").splitlines()
    except UnicodeDecodeError:
        raise HairFileError(f"{path}: this is no OBJ file (it is no text)") from None
    vertices = [line[2:] for line in lines if line.startswith("v ")]
    polylines = [line[2:] for line in lines if line.startswith("l ")]
    if not polylines:
        raise HairFileError(f"{path}: no lines (l) in it; a mesh without strands?")
    try:
        points = np.array([vertex.split()[:3] for vertex in vertices], dtype=np.float32).reshape(-1, 3)
        members = [[int(word.split("/")[0]) for word in polyline.split()] for polyline in polylines]
    except ValueError:
        raise HairFileError(f"{path}: damaged: a vertex or line that is no list of numbers") from None
    members = [polyline for polyline in members if polyline]
    ends = np.array([(polyline[0], polyline[-1]) for polyline in members]).reshape(-1, 2)
    goes_on = np.concatenate([[False], ends[1:, 0] == ends[:-1, 1]])
    counts = np.array([len(polyline) for polyline in members]) - goes_on
    index = np.concatenate([polyline[1:] if on else polyline for polyline, on in zip(members, goes_on)])
    index = np.where(index < 0, index + len(points), index - 1)
    if len(index) == 0 or index.min() < 0 or index.max() >= len(points):
        raise HairFileError(f"{path}: damaged: a line through a vertex that is not there")
    strand = np.cumsum(~goes_on) - 1
    return Contents(points[index], np.bincount(strand, counts).astype(np.int64))


def write(strands: Strands, path: Path) -> None:
    """One l a strand; OBJ knows neither thickness nor colour of lines."""
    index = np.arange(1, len(strands.points) + 1)
    with path.open("w", encoding="ascii") as file:
        file.write("# headstudio; metres, +Y up, face +Z\n")
        file.write(as_text(strands.points, "v %.9g %.9g %.9g\n"))
        pieces = np.split(index, strands.first[1:-1])
        file.write("\n".join("l " + " ".join(map(str, piece.tolist())) for piece in pieces) + "\n")
