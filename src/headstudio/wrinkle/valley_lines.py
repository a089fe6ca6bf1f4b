"""From a field of valleys to the lines they run along."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints
from .valleys import ANGLES, ValleyField

# A line is followed in steps of so many texels, on for so many [m] where nothing is seen (another valley crosses it).
_STEP, _GAP = 1.5, 5e-3
# At each step the line may turn by up to so many angles and shift by up to so many texels to either side.
_TURNS = np.array([0, -1, 1, -2, 2])
_SHIFTS = np.array([0.0, -0.5, 0.5, -1.0, 1.0])
# What a turn by one angle costs, as a part of the answer.
_STIFFNESS = 0.06
# A line goes on where the field is this part of what it takes to start one.
_FOLLOW = 0.4
# Beside a line nothing is found within so many of its widths at an angle this near, unless it is this much stronger: the
# raised rims of a groove make shallow valleys along it.
_CLEAR, _PARALLEL, _STRONGER = 3.2, 3, 0.45
# No face has more.
_MOST = 60


@dataclass(frozen=True, eq=False)
class ValleyLine:
    """One valley. points: along it [texels], (k, 2). depth: median of the filters' answers [m]. width: of the filters [m].

    length: [m].
    """

    points: Floats
    depth: float
    width: float
    length: float


def valley_lines(field: ValleyField, least: float, shortest: float = 8e-3) -> list[ValleyLine]:
    """The valleys that stand out by at least ``least`` [m] and are no shorter than ``shortest`` [m], the strongest first,
    each where no other runs."""
    free = field.depth.copy()
    order = np.argsort(-free, axis=None, kind="stable")
    order = order[free.ravel()[order] >= least]
    lines: list[ValleyLine] = []
    for start in order:
        if free.flat[start] < least:
            continue
        angle, row, column = np.unravel_index(start, free.shape)
        at = np.array([column, row], dtype=float)
        ahead = _followed(free, at, int(angle), 1.0, field.metres, _FOLLOW * least)
        behind = _followed(free, at, int(angle), -1.0, field.metres, _FOLLOW * least)
        path = np.concatenate([behind[::-1], [[*at, angle]], ahead])
        cells = np.rint(path).astype(np.int64)
        answers = field.depth[cells[:, 2] % ANGLES, cells[:, 1], cells[:, 0]]
        width = float(np.median(field.width[cells[:, 2] % ANGLES, cells[:, 1], cells[:, 0]]))
        length = float(np.linalg.norm(np.diff(path[:, :2], axis=0), axis=1).sum() * field.metres)
        depth = float(np.median(answers))
        _clear(free, path, width / field.metres, depth)
        if length >= shortest:
            lines.append(
                ValleyLine(np.asarray(path[:, :2] + field.origin + 0.5, dtype=np.float64), depth, width, length)
            )
        if len(lines) == _MOST:
            break
    return lines


def _followed(free: Floats, at: Floats, angle: int, way: float, metres: float, least: float) -> Floats:
    """Places along a valley from ``at`` on, with their angle, (k, 3); way: 1 along the angle, -1 against it."""
    path: list[tuple[float, float, int]] = []
    seen = 0
    gap = round(_GAP / (_STEP * metres))
    turns, shifts = (grid.ravel() for grid in np.meshgrid(_TURNS, _SHIFTS, indexing="ij"))
    price = 1.0 - _STIFFNESS * np.abs(turns)
    size = np.array(free.shape[2:0:-1]) - 1
    while len(path) - seen <= gap and len(path) < 2000:
        angles = angle + turns
        radians = np.pi * angles / ANGLES
        along = np.stack([np.cos(radians), np.sin(radians)], axis=1)
        places = at + _STEP * way * along + shifts[:, None] * along[:, ::-1] * [-1, 1]
        cells = np.rint(places).astype(np.int64)
        inside = ((cells >= 0) & (cells <= size)).all(axis=1)
        if not inside[0]:
            break
        cells = np.where(inside[:, None], cells, 0)
        answers = np.where(inside, price * free[angles % ANGLES, cells[:, 1], cells[:, 0]], -1.0)
        best = int(answers.argmax())
        if answers[best] < least:
            # Straight on, in case the valley comes back behind another that crosses it.
            best = 0
        at, angle = places[best], int(angles[best])
        path.append((*at, angle))
        if answers[best] >= least:
            seen = len(path)
    return np.array(path[:seen]).reshape(-1, 3)


def _clear(free: Floats, path: Floats, width: float, depth: float) -> None:
    """Take a line, (k, 3), and what is weaker along it out of the field, in place."""
    reach = int(np.ceil(_CLEAR * width))
    y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    disc: Ints = np.stack([x, y], axis=-1)[x**2 + y**2 <= reach**2]
    close = (disc**2).sum(axis=1) <= (1.5 * width) ** 2
    for turn in range(-_PARALLEL, _PARALLEL + 1):
        cells = np.rint(path[:, None, :2] + disc).astype(np.int64)
        angle = np.broadcast_to((np.rint(path[:, 2]).astype(np.int64)[:, None] + turn) % ANGLES, cells.shape[:2])
        inside = ((cells >= 0) & (cells < np.array(free.shape[2:0:-1]))).all(axis=2)
        where = angle[inside], cells[..., 1][inside], cells[..., 0][inside]
        taken = np.broadcast_to(close, inside.shape)[inside] | (free[where] < _STRONGER * depth)
        free[tuple(index[taken] for index in where)] = 0.0
