"""Closed meshes swept along a path: tubes and ribbons."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.rows import row_unit
from .joints import turn

_AROUND = 10  # corners of a tube's cross-section


def tube(path: Floats, radii: Floats) -> TriangleMesh:
    """A tube along a path, (n, 3) [m], with a radius at every point, (n,) [m], closed by flat ends."""
    first, second = _across(path, closed=False)
    return _swept(path, _round(first, second, radii), closed=False)


def closed_tube(path: Floats, radius: float) -> TriangleMesh:
    """A ring: a tube of one ``radius`` [m] along a path, (n, 3) [m], whose last point leads to the first."""
    first, second = _across(path, closed=True)
    return _swept(path, _round(first, second, np.full(len(path), radius)), closed=True)


def ribbon_strip(path: Floats, normals: Floats, widths: Floats, thickness: float) -> TriangleMesh:
    """A flat ribbon along a path, (n, 3) [m], facing ``normals``, (n, 3), of ``widths``, (n,), and a ``thickness`` [m]."""
    tangent = row_unit(np.gradient(path, axis=0), otherwise=np.zeros_like(path))
    side = row_unit(np.cross(normals, tangent), otherwise=np.zeros_like(path))
    up = np.cross(tangent, side)
    half, thin = 0.5 * widths[:, None, None], 0.5 * thickness
    corners = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    rim = half * corners[None, :, :1] * side[:, None] + thin * corners[None, :, 1:] * up[:, None]
    return _swept(path, rim, closed=False)


def joined(meshes: list[TriangleMesh]) -> TriangleMesh:
    """Several meshes as one; their surfaces stay apart."""
    starts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
    faces = [mesh.faces + start for mesh, start in zip(meshes, starts)]
    return TriangleMesh(np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(faces))


def _across(path: Floats, closed: bool) -> tuple[Floats, Floats]:
    """Two unit directions across a path at every point, which turn no more than it does, (n, 3) each."""
    steps = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0) if closed else np.gradient(path, axis=0)
    tangent = row_unit(steps, otherwise=np.broadcast_to([0.0, 1.0, 0.0], path.shape))
    least = np.eye(3)[np.abs(tangent[0]).argmin()]
    first = row_unit(np.cross(tangent[0], least)[None], otherwise=least[None])
    turned = [first]
    for before, after in pairwise(tangent):
        turned.append(turn(turned[-1].T, before[:, None], after[:, None]).T)
    across = np.concatenate(turned)
    return across, np.cross(tangent, across)


def _round(first: Floats, second: Floats, radii: Floats) -> Floats:
    angle = 2 * np.pi * np.arange(_AROUND) / _AROUND
    around = np.cos(angle)[None, :, None] * first[:, None] + np.sin(angle)[None, :, None] * second[:, None]
    return radii[:, None, None] * around


def _swept(path: Floats, rims: Floats, closed: bool) -> TriangleMesh:
    """The surface through rims around a path: offsets from it, (n, k, 3), counter-clockwise seen against its direction."""
    count, corners = rims.shape[:2]
    vertices = (path[:, None] + rims).reshape(-1, 3)
    rows = count if closed else count - 1
    faces = _walls(rows, count, corners)
    if closed:
        return TriangleMesh(vertices, faces)
    fan = np.stack([np.zeros(corners - 2, int), np.arange(1, corners - 1), np.arange(2, corners)], axis=1)
    return TriangleMesh(vertices, np.concatenate([faces, fan[:, ::-1], fan + (count - 1) * corners]))


def _walls(rows: int, count: int, corners: int) -> Ints:
    row, corner = np.meshgrid(np.arange(rows), np.arange(corners), indexing="ij")
    after, beside = (row + 1) % count, (corner + 1) % corners
    a, b = row * corners + corner, row * corners + beside
    c, d = after * corners + beside, after * corners + corner
    return np.concatenate([np.stack([a, b, c], axis=-1).reshape(-1, 3), np.stack([a, c, d], axis=-1).reshape(-1, 3)])
