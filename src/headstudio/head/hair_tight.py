"""The bust as hair can touch it: the skin with every fold closed that hair does not get into.

Behind an ear, under a nose or in an ear hole the skin faces itself across less than a lock of hair. Planes that average
both sides of such a fold (thesis, section 3.5) point anywhere, and hair that gets in never gets out. Closing the solid with
a ball (grow it by the ball's radius, then shrink it as far) fills the folds and leaves everything else where it was.
"""

from __future__ import annotations

import igl
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse

from .head import Head
from .locate import locator
from .mesh import Floats, TriangleMesh
from .sampling import sample_surface

_VOXEL = 0.004  # [m]
_BALL = 0.014  # radius of the ball that does not fit into a fold [m]
_BASE = 0.15  # how far the body is taken to go on below the bust [m]
# A closed surface this near to the skin is the skin, up to the grain of the voxels.
_ON_SKIN = 1.2 * _VOXEL


def hair_tight_surface(head: Head) -> TriangleMesh:
    """The closed surface [m], at rest."""
    solid, origin = _voxels(head)
    depth = _smooth_depth(_closed(solid))
    surface = _surface(depth, origin)
    on_skin, distance = locator(head.skin).nearest(surface.vertices)
    nearest = on_skin.blend(head.skin.vertices, head.skin.faces)
    vertices = np.where((distance < _ON_SKIN)[:, None], nearest, surface.vertices)
    return surface.moved(vertices)


def _voxels(head: Head) -> tuple[NDArray[np.bool_], Floats]:
    """The solid inside the skin as voxels, and the position of the first voxel's middle [m]."""
    body = standing_on_floor(head)
    margin = _BALL + 4 * _VOXEL
    origin = body.bounds[0] - margin
    shape = np.ceil((body.bounds[1] + margin - origin) / _VOXEL).astype(int)
    # So many that no voxel on the surface is missed: the solid would run out through it.
    points, _ = sample_surface(body, spacing=0.22 * _VOXEL)
    index = np.round((points - origin) / _VOXEL).astype(int)
    shell = np.zeros(shape, dtype=bool)
    shell[tuple(index.T)] = True
    return ndimage.binary_fill_holes(shell), origin


def standing_on_floor(head: Head) -> TriangleMesh:
    """The skin of a bust as a closed surface: a wall from every cut straight down to one floor, for below it the body goes
    on; and a lid on every hole in the face, such as a socket without an eye.

    A hole of the face is what ends above the chin. A wall from there would come out under the jaw and go through the chest.
    """
    mesh = head.skin
    border = igl.boundary_facets(mesh.faces)[0]
    count = len(mesh.vertices)
    low = mesh.vertices.copy()
    low[:, 1] = mesh.bounds[0, 1] - _BASE
    graph = sparse.coo_array((np.ones(len(border)), tuple(border.T)), shape=(count, count))
    _, label = sparse.csgraph.connected_components(graph, directed=False)
    opening, member = np.unique(label[border[:, 0]], return_inverse=True)
    lowest = np.full(len(opening), np.inf)
    np.minimum.at(lowest, member, mesh.vertices[border[:, 0], 1])
    cut = (lowest < head.landmarks.chin[1])[member]
    # Where its lid or its piece of the floor lies.
    rim = border + count * cut[:, None]
    vertices = np.concatenate([mesh.vertices, low])
    sums = np.stack([np.bincount(member, column, len(opening)) for column in vertices[rim[:, 0]].T], axis=1)
    middle = sums / np.bincount(member, minlength=len(opening))[:, None]
    a, b = border[cut].T
    wall = [np.column_stack([b, a, a + count]), np.column_stack([b, a + count, b + count])]
    ends = np.column_stack([rim[:, 1], rim[:, 0], 2 * count + member])
    return TriangleMesh(np.concatenate([vertices, middle]), np.concatenate([mesh.faces, *wall, ends]))


def _closed(solid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """``solid`` grown and shrunk again by the ball."""
    radius = _BALL / _VOXEL
    grown = ndimage.distance_transform_edt(~solid) <= radius
    return ndimage.distance_transform_edt(grown) > radius


def _smooth_depth(solid: NDArray[np.bool_]) -> Floats:
    """Signed distance to the border of ``solid`` in voxels, negative inside, without the steps of the voxels."""
    signed = ndimage.distance_transform_edt(~solid) - ndimage.distance_transform_edt(solid)
    return ndimage.gaussian_filter(signed, 1.0)


def _surface(depth: Floats, origin: Floats) -> TriangleMesh:
    """The surface of zero depth. The mean voxel of a shell sticks out by half, which the level takes back."""
    axes = [origin[k] + _VOXEL * np.arange(depth.shape[k]) for k in range(3)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    # igl counts the first axis fastest.
    points = np.ascontiguousarray(grid.transpose(2, 1, 0, 3).reshape(-1, 3))
    values = np.ascontiguousarray(depth.transpose(2, 1, 0).ravel())
    vertices, faces, _ = igl.marching_cubes(values, points, *depth.shape, -0.5)
    return _outward(TriangleMesh(vertices, faces))


def _outward(mesh: TriangleMesh) -> TriangleMesh:
    """The mesh with its faces turned so that it holds a positive volume."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c))
    return mesh if volume > 0 else TriangleMesh(mesh.vertices, mesh.faces[:, ::-1])
