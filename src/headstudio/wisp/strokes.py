"""Strokes that edit the styling force field: what Choe, Ko 2005, section 6.1, leave as future work.

An artist draws how hair is to flow here and there; between and around the strokes the field is filled in harmonically. What
is filled in is the *difference* to the presets' field, and a screened Laplace equation lets it fade out with the distance:
far from all strokes hair flows as it did.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import cg

from ..head.mesh import Floats
from ..head.rows import row_unit
from ..params import number
from .grid import Grid
from .operations import Place
from .proportions import Proportions

_FADE = 4.0  # beyond so many times the reach from every stroke, nothing is left of it
_TOLERANCE = 1e-4  # of the solution, against a field of strength 1


@dataclass(frozen=True)
class Stroke:
    """Hair flows along a path of two places or more, in proportions of the head. A dropped vector is a path of two."""

    path: tuple[Place, ...]
    radius: float = number(0.03, "Radius", "m", 0.005, 0.3, "Within this distance hair follows the stroke.", shown="cm")
    strength: float = number(1.0, "Strength", "", 0.0, 5.0, "Length of the force along the stroke.")


def follow_strokes(
    vectors: Floats, grid: Grid, strokes: tuple[Stroke, ...], proportions: Proportions, reach: float
) -> Floats:
    """The field ``vectors`` at the nodes, (size, 3), made to follow ``strokes``; between them it fades over ``reach`` [m]."""
    fixed = np.zeros(grid.size, dtype=bool)
    difference = np.zeros((grid.size, 3))
    for stroke in strokes:
        nodes, wanted = _drawn(grid, stroke, proportions)
        fixed[nodes] = True
        difference[nodes] = wanted - vectors[nodes]
    return vectors + _filled(grid, fixed, difference, reach)


def _drawn(grid: Grid, stroke: Stroke, proportions: Proportions) -> tuple[NDArray[np.intp], Floats]:
    """The nodes within a stroke and what the field is there: its tangent at the nearest place of the path."""
    path = proportions.place(np.array(stroke.path))
    middle, tangent = 0.5 * (path[1:] + path[:-1]), np.diff(path, axis=0)
    start, squared = path[:-1], np.maximum(np.einsum("ij,ij->i", tangent, tangent), 1e-12)
    box = np.flatnonzero(
        np.all((grid.nodes > path.min(0) - stroke.radius) & (grid.nodes < path.max(0) + stroke.radius), axis=1)
    )
    along = np.einsum("njk,jk->nj", grid.nodes[box, None] - start, tangent) / squared
    nearest = start + np.clip(along, 0.0, 1.0)[:, :, None] * tangent
    distance = np.linalg.norm(grid.nodes[box, None] - nearest, axis=2)
    piece = distance.argmin(axis=1)
    inside = distance[np.arange(len(box)), piece] <= stroke.radius
    directions = stroke.strength * row_unit(tangent, otherwise=np.zeros_like(tangent))
    # A stroke finer than the grid still bends the node next to it.
    own = grid.cells(middle)[0][0]
    return np.concatenate([own, box[inside]]), np.concatenate([directions, directions[piece[inside]]])


def _filled(grid: Grid, fixed: NDArray[np.bool_], values: Floats, reach: float) -> Floats:
    """``values`` where ``fixed``, and elsewhere the solution of laplace f = f / reach^2 between them, (size, 3)."""
    place = np.stack(np.unravel_index(np.flatnonzero(fixed), grid.shape), axis=1)
    pad = int(np.ceil(_FADE * reach / grid.spacing))
    low = np.maximum(place.min(axis=0) - pad, 0)
    high = np.minimum(place.max(axis=0) + pad + 1, grid.shape)
    box = np.ravel_multi_index(np.meshgrid(*map(np.arange, low, high), indexing="ij"), grid.shape)
    laplacian = _laplacian(box.shape) / grid.spacing**2
    system = (sparse.eye_array(box.size) / reach**2 - laplacian).tocsr()
    known = fixed[box.ravel()]
    unknown = np.flatnonzero(~known)
    inside = values[box.ravel()]
    inner = system[unknown][:, unknown]
    right = -(system[unknown][:, np.flatnonzero(known)] @ inside[known])
    filled = np.zeros_like(values)
    for axis in range(3):
        inside[unknown, axis], _ = cg(inner, right[:, axis], rtol=_TOLERANCE)
    filled[box.ravel()] = inside
    return filled


def _laplacian(shape: tuple[int, ...]) -> sparse.csr_array:
    """The sum over neighbours of their difference to a node, on a box of nodes that nothing leaves."""
    lines = []
    for count in shape:
        ones = np.ones(count)
        line = sparse.diags_array([ones[1:], -2 * ones, ones[1:]], offsets=[-1, 0, 1]).tolil()
        line[0, 0] = line[-1, -1] = -1.0 if count > 1 else 0.0
        lines.append(line.tocsr())
    one = [sparse.eye_array(count) for count in shape]
    x = sparse.kron(sparse.kron(lines[0], one[1]), one[2])
    y = sparse.kron(sparse.kron(one[0], lines[1]), one[2])
    z = sparse.kron(sparse.kron(one[0], one[1]), lines[2])
    return (x + y + z).tocsr()
