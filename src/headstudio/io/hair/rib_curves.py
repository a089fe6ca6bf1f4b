"""Strands as RenderMan Curves in a RIB archive: cubic Catmull-Rom, end points twice so that the curve meets them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ...wisp.strands import Strands
from .contents import Contents, HairFileError, as_text

_CURVES = re.compile(r'Curves\s+"(linear|cubic)"\s+\[([^\]]*)\]\s+"nonperiodic"(.*?)(?=\n[A-Z]|\Z)', re.DOTALL)
_ARRAY = r'"(?:[\w ]* )?{name}"\s+\[([^\]]*)\]'


def write(strands: Strands, path: Path) -> None:
    """One Curves statement; width and colour at every point where they are known."""
    twice = _with_ends_twice(strands)
    counts = " ".join(map(str, (strands.counts + 2).tolist()))
    with path.open("w", encoding="ascii") as file:
        file.write('##RenderMan RIB-Structure 1.1 Entity\nBasis "catmull-rom" 1 "catmull-rom" 1\n')
        file.write(f'Curves "cubic" [{counts}] "nonperiodic"\n')
        file.write('"P" [' + as_text(strands.points[twice], "%.9g %.9g %.9g ").rstrip() + "]\n")
        if strands.radius is not None:
            widths = as_text(2 * strands.radius[twice][:, None], "%.9g ").rstrip()
            file.write(f'"vertex float width" [{widths}]\n')
        if strands.colour is not None:
            colours = as_text(strands.colour[twice], "%.9g %.9g %.9g ").rstrip()
            file.write(f'"vertex color Cs" [{colours}]\n')


def read(path: Path) -> Contents:
    """Catmull-Rom curves lose the copies of their end points again; other cubic curves are taken as they are."""
    try:
        text = path.read_text("ascii")
    except UnicodeDecodeError:
        raise HairFileError(f"{path}: this is no RIB file of plain text") from None
    if not (found := _CURVES.search(text)):
        raise HairFileError(f'{path}: no Curves "nonperiodic" in it')
    kind, counts_text, rest = found.groups()
    try:
        counts = np.array(counts_text.split(), dtype=np.int64)
        points = _array(rest, "P", 3)
        widths, colours = _array(rest, "width", 1), _array(rest, "Cs", 3)
    except ValueError:
        raise HairFileError(f"{path}: damaged: a list with something that is no number") from None
    if points is None or counts.sum() != len(points):
        raise HairFileError(f"{path}: damaged: its points are not those of its curves")
    radius = widths[:, 0] / 2 if widths is not None and len(widths) == len(points) else None
    colour = colours if colours is not None and len(colours) == len(points) else None
    if kind == "cubic" and '"catmull-rom"' in text and (counts > 3).all() and len(counts):
        first = np.concatenate([[0], np.cumsum(counts)])
        start, end = first[:-1], first[1:] - 1
        if np.array_equal(points[start], points[start + 1]) and np.array_equal(points[end], points[end - 1]):
            kept = np.ones(len(points), dtype=bool)
            kept[start] = kept[end] = False
            points, counts = points[kept], counts - 2
            radius = None if radius is None else radius[kept]
            colour = None if colour is None else colour[kept]
    return Contents(points, counts, radius, colour)


def _with_ends_twice(strands: Strands) -> np.ndarray:
    """Index of the points with the first and the last of every strand once more."""
    repeats = np.ones(len(strands.points), dtype=np.int64)
    repeats[strands.first[:-1]] += 1
    repeats[strands.first[1:] - 1] += 1
    return np.repeat(np.arange(len(strands.points)), repeats)


def _array(text: str, name: str, columns: int) -> np.ndarray | None:
    found = re.search(_ARRAY.format(name=name), text)
    return None if found is None else np.array(found[1].split(), dtype=np.float32).reshape(-1, columns)
