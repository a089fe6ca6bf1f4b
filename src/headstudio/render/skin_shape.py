"""What is drawn of a living skin: what stays the same in every pose, and what a pose changes, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints, TriangleMesh
from ..wrinkle.fine_wrinkles import FineWrinkles
from ..wrinkle.living_skin import LivingSkin, SkinSurface
from .skin_paint import coarse_faces, paint

# Details below this [m] are left out of the body that casts shadows.
_SHADOW_DETAIL = 0.004
# What counts as the surroundings of a place in a furrow [m].
_BESIDE = 0.003
# So many times curvature is evened out along edges: it is that of the face, not of a triangle.
_EVENED = 8


@dataclass(frozen=True, eq=False)
class SkinShape:
    """What stays the same of a skin that is drawn: N vertices, M triangles.

    faces: (M, 3). shadow_faces: fewer, over the same vertices. rest: positions at rest [m], (N, 3). uv: texture
    coordinates, (N, 2). mapped: how far inside the map, 0 to 1, (N,). turning: how far the skin turns with the head,
    (N,). curvature: of the skin at rest, positive where it bulges [1/m], (N,). painted: hidden from the sky, lips, brows
    and flush, 0 to 1, (N, 4). fine: wrinkles of the map, or None. furrowed: vertices near furrows, (k,), and beside: the
    matrix, (k, k), that gives the mean around each.
    """

    faces: Ints
    shadow_faces: Ints
    rest: Floats
    uv: Floats
    mapped: Floats
    turning: Floats
    curvature: Floats
    painted: Floats
    fine: FineWrinkles | None
    furrowed: Ints
    beside: sparse.csr_array

    def creases(self, height: Floats) -> Floats:
        """How much of the light that comes from all around misses each vertex for the skin beside it, 0 to 1, (N,).

        height: displacement along the normals [m], (N,). A place that lies as deep below its surroundings as they are wide
        is taken for a groove with walls of 45 degrees, which hides a third of the sky.
        """
        hidden = np.zeros(len(self.rest))
        near = height[self.furrowed]
        depth = (self.beside @ near - near) / _BESIDE
        hidden[self.furrowed] = 1.0 - 1.0 / np.sqrt(1.0 + np.maximum(depth, 0.0) ** 2)
        return hidden


@dataclass(frozen=True, eq=False)
class SkinPose:
    """A skin at one instant. positions [m] and unit normals, (N, 3). amplitudes: of both fine fields, (N, 2).
    height: displacement [m], (N,). expansion: over the area at rest, (N,)."""

    positions: Floats
    normals: Floats
    amplitudes: Floats
    height: Floats
    expansion: Floats


def shape_of(surface: SkinSurface, hidden: Floats) -> SkinShape:
    """The shape of a head's living skin. hidden: of the sky, of every vertex of the head's skin, (n,)."""
    head = surface.head
    furrowed = np.unique(surface.bed.vertex)
    painted = np.column_stack([hidden, paint(head)])
    return SkinShape(
        faces=surface.faces,
        shadow_faces=coarse_faces(head.skin, _SHADOW_DETAIL),
        rest=surface.rest,
        uv=surface.uv,
        mapped=surface.mapped,
        turning=surface.spread(head.head_weight),
        curvature=surface.spread(curvature_of(head.skin)),
        painted=surface.spread(painted),
        fine=surface.fine,
        furrowed=furrowed,
        beside=surroundings(surface.rest[furrowed]),
    )


def pose_of(skin: LivingSkin) -> SkinPose:
    """A living skin as it is drawn."""
    return SkinPose(skin.skin.positions, skin.skin.normals, skin.amplitudes, skin.skin.height, skin.expansion)


def smooth_pose_of(skin: LivingSkin) -> SkinPose:
    """The same skin without a wrinkle."""
    surface = skin.surface
    normals = surface.spread(surface.head.skin.moved(skin.posed).vertex_normals)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    none = np.zeros(len(normals))
    return SkinPose(surface.spread(skin.posed), normals, np.zeros((len(normals), 2)), none, skin.expansion)


def curvature_of(mesh: TriangleMesh) -> Floats:
    """Mean curvature at every vertex, positive where the surface bulges [1/m], (n,), over some triangles around."""
    edges = np.unique(np.sort(mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    a, b = edges.T
    along = mesh.vertices[b] - mesh.vertices[a]
    turn = mesh.vertex_normals[b] - mesh.vertex_normals[a]
    bend = np.einsum("ij,ij->i", turn, along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-12)
    count = len(mesh.vertices)
    ends, ones = np.concatenate([edges, edges[:, ::-1]]), np.ones(2 * len(edges))
    neighbours = sparse.csr_array((ones, (ends[:, 0], ends[:, 1])), shape=(count, count))
    degree = np.maximum(neighbours.sum(axis=1), 1.0)
    curvature = np.bincount(ends[:, 0], np.concatenate([bend, bend]), minlength=count) / degree
    for _ in range(_EVENED):
        curvature = 0.5 * (curvature + (neighbours @ curvature) / degree)
    return curvature


def surroundings(points: Floats) -> sparse.csr_array:
    """The matrix, (k, k), that takes values at points [m], (k, 3), to their mean around each of them."""
    count = len(points)
    if count == 0:
        return sparse.csr_array((0, 0))
    pairs = cKDTree(points).query_pairs(_BESIDE, output_type="ndarray")
    near = np.concatenate([pairs, pairs[:, ::-1], np.repeat(np.arange(count)[:, None], 2, axis=1)])
    matrix = sparse.csr_array((np.ones(len(near)), (near[:, 0], near[:, 1])), shape=(count, count))
    mean: sparse.csr_array = sparse.csr_array(sparse.diags_array(1.0 / matrix.sum(axis=1)) @ matrix)
    return mean
