"""Cem Yuksel's .hair: a header of 128 bytes, then the arrays that its bits announce."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...wisp.strands import Strands
from .contents import Contents, HairFileError, exactly

_HEADER = np.dtype(
    [
        ("signature", "S4"),
        ("hair_count", "<u4"),
        ("point_count", "<u4"),
        ("arrays", "<u4"),
        ("segments", "<u4"),
        ("thickness", "<f4"),
        ("transparency", "<f4"),
        ("colour", "<f4", 3),
        ("info", "S88"),
    ]
)
_SEGMENTS, _POINTS, _THICKNESS, _TRANSPARENCY, _COLOURS = 1, 2, 4, 8, 16
_MOST_SEGMENTS = 65535


def read(path: Path) -> Contents:
    """Thickness is the shaft's diameter; a colour or thickness of the header counts for every point."""
    file = path.read_bytes()
    if file[:4] == b"HAIR" and len(file) < _HEADER.itemsize:
        raise HairFileError(f"{path}: damaged: it ends inside its header")
    if file[:4] != b"HAIR":
        raise HairFileError(f"{path}: this is no .hair file (it does not begin with HAIR)")
    header = np.frombuffer(file, _HEADER, 1)[0]
    arrays, points_there = int(header["arrays"]), int(header["point_count"])
    if not arrays & _POINTS:
        raise HairFileError(f"{path}: the file holds no points")
    at = _HEADER.itemsize

    def take(dtype: str, count: int) -> np.ndarray:
        nonlocal at
        values = exactly(file, dtype, count, at, path)
        at += values.nbytes
        return values

    hairs = int(header["hair_count"])
    if arrays & _SEGMENTS:
        counts = take("<u2", hairs).astype(np.int64) + 1
    else:
        counts = np.full(hairs, int(header["segments"]) + 1, dtype=np.int64)
    points = take("<f4", 3 * points_there).reshape(-1, 3)
    thickness = take("<f4", points_there) if arrays & _THICKNESS else np.full(points_there, header["thickness"])
    if arrays & _TRANSPARENCY:
        take("<f4", points_there)
    if arrays & _COLOURS:
        colours = take("<f4", 3 * points_there).reshape(-1, 3)
    else:
        colours = np.tile(header["colour"], (points_there, 1))
    radius = 0.5 * thickness if (thickness > 0).all() else None
    return Contents(points, counts, radius, colours if colours.any() else None)


def write(strands: Strands, path: Path) -> None:
    """Segments, points, and thickness and colours where they are known."""
    segments = strands.counts - 1
    if segments.max() > _MOST_SEGMENTS:
        raise HairFileError(f"{path}: .hair holds strands of {_MOST_SEGMENTS + 1} points at most")
    header = np.zeros(1, _HEADER)
    header["signature"] = b"HAIR"
    header["hair_count"], header["point_count"] = strands.count, len(strands.points)
    header["arrays"] = (
        _SEGMENTS
        | _POINTS
        | (_THICKNESS if strands.radius is not None else 0)
        | (_COLOURS if strands.colour is not None else 0)
    )
    header["info"] = b"headstudio; metres, +Y up, face +Z"
    with path.open("wb") as file:
        file.write(header.tobytes())
        file.write(segments.astype("<u2").tobytes())
        file.write(strands.points.astype("<f4").tobytes())
        if strands.radius is not None:
            file.write((2 * strands.radius).astype("<f4").tobytes())
        if strands.colour is not None:
            file.write(strands.colour.astype("<f4").tobytes())
