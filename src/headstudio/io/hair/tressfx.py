"""TressFX .tfx, version 4: equal counts of points, four floats each."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...wisp.strands import Strands
from .contents import Contents, HairFileError, exactly

_HEADER = np.dtype(
    [
        ("version", "<f4"),
        ("strands", "<u4"),
        ("points", "<u4"),
        ("positions", "<u4"),
        ("strand_uv", "<u4"),
        ("vertex_uv", "<u4"),
        ("thickness", "<u4"),
        ("colour", "<u4"),
        ("reserved", "<u4", 32),
    ]
)
_COUNTS = (4, 8, 16, 32, 64)


def read(path: Path) -> Contents:
    """Positions; thickness is the diameter of each strand, colours are for each point."""
    file = path.read_bytes()
    if len(file) < _HEADER.itemsize:
        raise HairFileError(f"{path}: this is no TressFX file (too short for its header)")
    header = np.frombuffer(file, _HEADER, 1)[0]
    if not 4.0 <= header["version"] < 5.0:
        raise HairFileError(f"{path}: this is no TressFX file of version 4 (it says {header['version']:g})")
    strands, points = int(header["strands"]), int(header["points"])
    counts = np.full(strands, points)
    positions = exactly(file, "<f4", 4 * strands * points, int(header["positions"]), path).reshape(-1, 4)[:, :3]
    radius = colour = None
    if header["thickness"]:
        radius = np.repeat(0.5 * exactly(file, "<f4", strands, int(header["thickness"]), path), points)
    if header["colour"]:
        colour = exactly(file, "<f4", 4 * strands * points, int(header["colour"]), path).reshape(-1, 4)[:, :3]
    return Contents(positions, counts, radius, colour)


def write(strands: Strands, path: Path) -> None:
    """Roots are fixed (w = 0), the rest moves (w = 1). Raises HairFileError for counts that TressFX does not have."""
    counts = strands.counts
    points = int(counts[0])
    if (counts != points).any() or points not in _COUNTS:
        raise HairFileError(f"{path}: .tfx needs strands of 4, 8, 16, 32 or 64 points, all the same: --points 32")
    positions = np.ones((strands.count, points, 4), dtype="<f4")
    positions[:, :, :3] = strands.points.reshape(strands.count, points, 3)
    positions[:, 0, 3] = 0.0
    header = np.zeros(1, _HEADER)
    header["version"], header["strands"], header["points"] = 4.0, strands.count, points
    pieces = [positions.tobytes()]
    header["positions"] = at = _HEADER.itemsize
    at += positions.nbytes
    if strands.radius is not None:
        thickness = 2 * strands.radius.reshape(strands.count, points).max(axis=1)
        pieces.append(thickness.astype("<f4").tobytes())
        header["thickness"] = at
        at += thickness.nbytes
    if strands.colour is not None:
        colour = np.ones((len(strands.points), 4), dtype="<f4")
        colour[:, :3] = strands.colour
        pieces.append(colour.tobytes())
        header["colour"] = at
    path.write_bytes(header.tobytes() + b"".join(pieces))
