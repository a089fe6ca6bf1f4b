"""Laying out what an overhang hides: lips, nostrils, the underside of a jaw.

A surface that is projected past its own overhangs lies folded in the plane, and a place in the fold is three places of the
surface. Here it is drawn out of the fold into a narrow strip. What is not hidden stays where it was projected but for
some tenths of a millimetre, to make room.

Every triangle's map to the plane has two stretches, and the lesser one is negative where it is turned over. Maps are
brought to stretches that are not, each by itself, and joined by least squares, in turns, until all hold (the local and
the global step of Liu et al. 2008, with the bounds of Aigerman and Lipman 2013).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.rows import row_dot, row_length
from .projection import border_cycles

# The least stretch that a triangle is brought to, and with which it counts as unfolded.
_BROUGHT, _UNFOLDED = 0.12, 0.02
_ROUNDS = 60
# So many rings of triangles around what is hidden make room. What they are worth where they are, against their shape, over
# a length of [m]; the outermost are held.
_RINGS, _STAYS, _LENGTH, _HELD, _FREE = 6, 0.1, 3e-3, 1e6, 1e-9


def unfolded(mesh: TriangleMesh, places: Floats, hidden: NDArray[np.bool_]) -> Floats:
    """Places in the plane [m], (n, 2), with no triangle turned over.

    places: of the vertices where they were projected [m], (n, 2). hidden: the triangles that are turned over or that others
    lie in front of, (m,). Where it does not come to that in some rounds, as at the rim of a nostril, single triangles stay
    turned over.
    """
    if not hidden.any():
        return places
    count = len(mesh.vertices)
    loose = np.zeros(count, dtype=bool)
    loose[mesh.faces[hidden]] = True
    mesh, places = _hidden_holes_covered(mesh, places, loose)
    loose = np.append(loose, np.ones(len(places) - count, dtype=bool))
    around = loose.copy()
    for _ in range(_RINGS):
        around[mesh.faces[around[mesh.faces].any(axis=1)]] = True
    region = around[mesh.faces].all(axis=1)
    used, corners = np.unique(mesh.faces[region], return_inverse=True)
    corners = corners.reshape(-1, 3)
    beyond = np.zeros(len(places), dtype=bool)
    beyond[mesh.faces[~region]] = True

    gradient, area = _gradients(mesh.vertices[used], corners)
    stays = np.select([beyond[used], loose[used]], [_HELD, _FREE], _STAYS)
    stays *= np.bincount(corners.ravel(), np.repeat(area / 3.0, 3)) / _LENGTH**2
    weighted = sparse.csr_array(gradient.T.multiply(np.tile(area, 2)))
    solve = splu((weighted @ gradient + sparse.diags_array(stays)).tocsc()).solve
    pull = stays[:, None] * places[used]
    moved = places[used]
    for _ in range(_ROUNDS):
        # Of each triangle: how the place changes along both axes of its plane, (k, 2, 2).
        maps = (gradient @ moved).reshape(2, -1, 2).transpose(1, 2, 0)
        left, stretch, right = np.linalg.svd(maps)
        turned = np.linalg.det(maps) < 0
        left[turned, :, 1] *= -1.0
        stretch[turned, 1] *= -1.0
        if stretch[:, 1].min() > _UNFOLDED:
            break
        brought = (left * np.maximum(stretch, _BROUGHT)[:, None]) @ right
        moved = solve(weighted @ brought.transpose(2, 0, 1).reshape(-1, 2) + pull)
    result = places.copy()
    result[used] = moved
    return result[:count]


def _hidden_holes_covered(mesh: TriangleMesh, places: Floats, hidden: NDArray[np.bool_]) -> tuple[TriangleMesh, Floats]:
    """The mesh with a fan over every hole whose whole border is hidden, as that of a nostril: only so it keeps its outline
    from being turned over. The middles of fans come last. hidden: of the vertices, (n,)."""
    holes = [cycle for cycle in border_cycles(mesh.faces) if hidden[cycle].all()]
    vertices = [mesh.vertices, *(mesh.vertices[cycle].mean(axis=0, keepdims=True) for cycle in holes)]
    middles = [places, *(places[cycle].mean(axis=0, keepdims=True) for cycle in holes)]
    fans = [
        np.stack([np.roll(cycle, -1), cycle, np.full(len(cycle), len(places) + k)], axis=1)
        for k, cycle in enumerate(holes)
    ]
    return TriangleMesh(np.concatenate(vertices), np.concatenate([mesh.faces, *fans])), np.concatenate(middles)


def _gradients(vertices: Floats, faces: Ints) -> tuple[sparse.csr_array, Floats]:
    """What takes values at vertices, (n,), to their slopes along two axes in the plane of every triangle, first all along
    the one and then all along the other, (2 m, n); and the area of triangles [m^2], (m,)."""
    first, second = (vertices[faces[:, k]] - vertices[faces[:, 0]] for k in (1, 2))
    length = row_length(first)
    along = first / length[:, None]
    height = row_length(np.cross(along, second))
    aside = row_dot(along, second)
    # Slopes of the corners' shares: they add up to nothing.
    of_second = np.stack([np.zeros_like(height), 1.0 / height])
    of_first = np.stack([1.0 / length, -aside / (length * height)])
    values = np.stack([-of_first - of_second, of_first, of_second], axis=2)
    rows = np.repeat(np.arange(2 * len(faces)), 3)
    columns = np.tile(faces.ravel(), 2)
    return sparse.csr_array(
        (values.ravel(), (rows, columns)), shape=(2 * len(faces), len(vertices))
    ), 0.5 * length * height
