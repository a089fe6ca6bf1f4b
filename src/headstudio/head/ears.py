"""Finding the ears: seen from the side, their rear edge stands off the skull like nothing else on a head."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mesh import Floats, TriangleMesh
from .profile import seen_from
from .symmetry import sample_surface

_CELL = 0.012
"""Size of the cells in which the side of the head is looked at, in heights of the head, as all lengths here."""

_SAMPLES = 20_000
_EDGE = 0.04
# Heights an ear may have, and how far in front of its rear edge the tragus lies.
_EAR_HEIGHTS = (0.15, 0.55)
_TRAGUS_BEFORE_EDGE = 0.125
# Two ears farther apart than this, seen from the side, are not both ears.
_UNEVEN = 0.12


def find_tragi(skin: TriangleMesh, expected: Floats, height: float) -> tuple[Floats, Floats]:
    """The points in front of the ear holes, left and right [m], shape (3,): half way up the ears, before their rear edge.

    skin: an upright head mirrored at x = 0. expected: (y, z) where they should be by the proportions of the head, shape
    (2,). A side whose ear cannot be made out takes the height and depth of the other; without any ear the answer is
    what was expected, brought onto the skin. height: of the head [m].
    """
    found = [_tragus(skin, side, expected, height) for side in (1.0, -1.0)]
    sure = [place for place in found if place is not None]
    if len(sure) == 2 and np.linalg.norm(sure[0] - sure[1]) > _UNEVEN * height:
        sure = [min(sure, key=lambda place: float(np.linalg.norm(place - expected)))]
        found = [None, None]
    other = sure[0] if sure else expected
    places = [other if place is None else place for place in found]
    left, right = (
        np.array([seen_from(skin, 0, side, place[None])[0], *place]) for side, place in zip((1.0, -1.0), places)
    )
    return left, right


def _tragus(skin: TriangleMesh, side: float, expected: Floats, height: float) -> Floats | None:
    """Where (y, z) the tragus of one side lies by the ear there, shape (2,), or None without an ear."""
    ear = _ear(skin, side, expected, height)
    if ear is None:
        return None
    low, high, rear = ear
    return np.array([0.5 * (low + high), rear + _TRAGUS_BEFORE_EDGE * height])


def _ear(skin: TriangleMesh, side: float, expected: Floats, height: float) -> tuple[float, float, float] | None:
    """The lower and upper end of the ear and its rear edge (y, y, z) [m], or None."""
    cell = _CELL * height
    start = expected + np.array([-0.33, -0.24]) * height
    reach = _side_view(skin, side, start, cell, (56, 28), height)
    # The rear edge: from one cell to the next but one, going forward, the surface jumps outward.
    jump = np.nan_to_num(reach[:, 2:] - reach[:, :-2], nan=0.0)
    edge = jump.argmax(axis=1)
    has_edge = jump.max(axis=1) > _EDGE * height
    rows = _longest_run(has_edge)
    low, high = (start[0] + k * cell for k in (rows.start, rows.stop))
    if not _EAR_HEIGHTS[0] * height <= high - low <= _EAR_HEIGHTS[1] * height:
        return None
    return low, high, float(start[1] + (np.percentile(edge[rows], 20) + 1.5) * cell)


def _side_view(
    skin: TriangleMesh, side: float, start: Floats, cell: float, shape: tuple[int, int], height: float
) -> Floats:
    """How far the side of the head reaches outward in a grid of cells over (y, z), nan where nothing is, ``shape``."""
    middle = skin.vertices[skin.faces].mean(axis=1)
    end = start + np.array(shape) * cell
    outward = side * middle[:, 0]
    near = ((middle[:, 1:] >= start - cell) & (middle[:, 1:] <= end + cell)).all(axis=1)
    near &= (outward > 0.1 * height) & (outward < 0.7 * height)
    grid = np.full(shape, -np.inf)
    if near.any():
        points = sample_surface(TriangleMesh(skin.vertices, skin.faces[near]), _SAMPLES)
        index = np.floor((points[:, 1:] - start) / cell).astype(np.int64)
        inside = ((index >= 0) & (index < shape)).all(axis=1)
        np.maximum.at(grid, tuple(index[inside].T), side * points[inside, 0])
    return np.where(np.isfinite(grid), grid, np.nan)


def _longest_run(flags: NDArray[np.bool_]) -> slice:
    """The longest run of true values; gaps of up to two are bridged."""
    padded = np.concatenate([[False], flags, [False]])
    bridged = padded.copy()
    for gap in (1, 2):
        bridged[gap:-gap] |= padded[: -2 * gap] & padded[2 * gap :]
    change = np.diff(bridged.astype(np.int8), prepend=0, append=0)
    starts, stops = np.nonzero(change == 1)[0], np.nonzero(change == -1)[0]
    if not len(starts):
        return slice(0, 0)
    best = (stops - starts).argmax()
    return slice(max(int(starts[best]) - 1, 0), min(int(stops[best]) - 1, len(flags)))
