"""Strands in a PLY: vertices, and an element ``strand`` with the count of segments of each."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from plyfile import PlyData, PlyElement, PlyParseError

from ...wisp.strands import Strands
from .contents import Contents, HairFileError

_POINT = [("x", "<f4"), ("y", "<f4"), ("z", "<f4")]
_COLOUR = [("r", "<f4"), ("g", "<f4"), ("b", "<f4"), ("a", "<f4")]
_THICKNESS = [("thickness", "<f4")]


def read(path: Path, points_per_strand: int | None) -> Contents:
    """A file of bare vertices needs ``points_per_strand``; whoever reads must ask."""
    try:
        file = PlyData.read(str(path))
        vertex = file["vertex"].data
        points = np.stack([vertex[axis] for axis in "xyz"], axis=1)
    except (PlyParseError, KeyError, ValueError, UnicodeDecodeError, EOFError):
        raise HairFileError(f"{path}: this is no PLY file with vertices x, y, z") from None
    names = vertex.dtype.names or ()
    radius = 0.5 * vertex["thickness"] if "thickness" in names else None
    colour = np.stack([vertex[channel] for channel in "rgb"], axis=1) if {"r", "g", "b"} <= set(names) else None
    if colour is not None and colour.dtype.kind == "u":
        colour = colour / np.float32(np.iinfo(colour.dtype).max)
    if "strand" in file:
        strand = file["strand"].data
        counts = strand[strand.dtype.names[0]].astype(np.int64) + 1
    elif points_per_strand is None:
        raise HairFileError(f"{path}: bare points; say how many make a strand: --points-per-strand N")
    elif len(points) % points_per_strand:
        raise HairFileError(f"{path}: {len(points)} points cannot be strands of {points_per_strand}")
    else:
        counts = np.full(len(points) // points_per_strand, points_per_strand)
    return Contents(points, counts, radius, colour)


def write(strands: Strands, path: Path) -> None:
    """Binary, little-endian."""
    fields = list(_POINT)
    fields += _COLOUR if strands.colour is not None else []
    fields += _THICKNESS if strands.radius is not None else []
    vertex = np.zeros(len(strands.points), dtype=fields)
    for k, axis in enumerate("xyz"):
        vertex[axis] = strands.points[:, k]
    if strands.colour is not None:
        for k, channel in enumerate("rgb"):
            vertex[channel] = strands.colour[:, k]
        vertex["a"] = 1.0
    if strands.radius is not None:
        vertex["thickness"] = 2 * strands.radius
    segments = strands.counts - 1
    if segments.max() > np.iinfo(np.uint16).max:
        raise HairFileError(f"{path}: PLY strands have {np.iinfo(np.uint16).max + 1} points at most")
    strand = np.zeros(strands.count, dtype=[("segments", "<u2")])
    strand["segments"] = segments
    PlyData([PlyElement.describe(vertex, "vertex"), PlyElement.describe(strand, "strand")], byte_order="<").write(
        str(path)
    )
