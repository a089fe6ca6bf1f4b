"""The smooth skin under wrinkles: places, normals and bump directions between the vertices of a coarse mesh.

A fine vertex lies on a flat coarse triangle. It is lifted to where the surface would be that has the coarse normals
(half of a Phong tessellation, Boubekeur and Alexa 2008, which is exact for a paraboloid), by a height found at rest. Its
normal is blended from the coarse normals, so that shading knows nothing of the triangles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.rows import row_dot
from .refined_mesh import RefinedMesh
from .skin_layout import SkinLayout
from .vectors import AreaVectors, cross, scaled, unit


@dataclass(frozen=True, eq=False)
class PosedSurface:
    """One pose. coarse_normals: unit, (n, 3). positions [m], normals (unit): of the fine vertices, (k, 3).

    by_u, by_v: what a height's derivatives by u and v subtract from the normal, (k, 3): n - h_u by_u - h_v by_v is
    normal to the surface displaced by h (Blinn 1978).
    """

    coarse_normals: Floats
    positions: Floats
    normals: Floats
    by_u: Floats
    by_v: Floats


class SmoothSurface:
    """Fine vertices of a refined skin that are displaced or that the coarse skin does not have.

    vertices: which, sorted, (k,). row_of: where each fine vertex is among them, (N,); -1 where it is not.
    """

    def __init__(self, refined: RefinedMesh, layout: SkinLayout, displaced: Ints) -> None:
        skin = layout.skin
        self.vertices: Ints = np.union1d(displaced, refined.added)
        self.row_of = np.full(len(refined.home), -1)
        self.row_of[self.vertices] = np.arange(len(self.vertices))
        self._normals = NormalsOf(skin.faces, len(skin.vertices))
        self._blend = refined.interpolation(self.vertices)
        # Only the coarse vertices that fine ones are blended from.
        self._used = np.unique(self._blend.indices)
        self._blend_used = sparse.csr_array(self._blend[:, self._used])
        # Directions need no more than single precision, and half the memory goes twice as fast.
        self._blend_directions = self._blend_used.astype(np.float32)
        gradients = [matrix[self._used] for matrix in gradient_matrices(layout)]
        self._gradients = sparse.csr_array(sparse.vstack(gradients)).astype(np.float32)
        self._lift = self._lift_at_rest(refined, skin)

    def at(self, posed: Floats) -> PosedSurface:
        """The surface for posed positions of the skin [m], (n, 3)."""
        coarse_normals = self._normals.at(posed)
        n = coarse_normals[self._used]
        tangent_u, tangent_v = (self._gradients @ posed.astype(np.float32)).reshape(2, -1, 3)
        across_u, across_v = cross(tangent_v, n), cross(n, tangent_u)
        area = row_dot(tangent_u, across_u)
        # Where nothing is mapped, or a pose has crushed the skin flat, a height has no slope.
        share = np.divide(1.0, area, out=np.zeros_like(area), where=np.abs(area) > 1e-12)
        directions = np.concatenate([n, scaled(across_u, share), scaled(across_v, share)], axis=1)
        blended = self._blend_directions @ directions
        normals = unit(blended[:, :3])
        positions = self._blend_used @ posed[self._used] + scaled(normals, self._lift)
        return PosedSurface(coarse_normals, positions, normals, blended[:, 3:6], blended[:, 6:])

    def _lift_at_rest(self, refined: RefinedMesh, skin: TriangleMesh) -> Floats:
        """How far the smooth surface lies above the flat triangles [m], (k,)."""
        corners = skin.faces[refined.home[self.vertices]]
        weights = refined.weights[self.vertices]
        flat = np.einsum("ki,kid->kd", weights, skin.vertices[corners])
        coarse = self._normals.at(skin.vertices)[corners]
        above = np.einsum("kid,kid->ki", flat[:, None] - skin.vertices[corners], coarse)
        # Each corner's tangent plane is reached along that corner's normal.
        offset = -0.5 * np.einsum("ki,ki,kid->kd", weights, above, coarse)
        normals = unit(np.einsum("ki,kid->kd", weights, coarse))
        return np.einsum("kd,kd->k", offset, normals)


class NormalsOf:
    """Unit vertex normals of one set of triangles, pose after pose: the mean of the triangles by area."""

    def __init__(self, faces: Ints, count: int) -> None:
        """faces: (m, 3). count: of vertices."""
        self._areas = AreaVectors(faces)
        rows = faces.T.ravel()
        columns = np.tile(np.arange(len(faces)), 3)
        ones = np.ones(len(rows), dtype=np.float32)
        self._gather = sparse.coo_array((ones, (rows, columns)), shape=(count, len(faces))).tocsr()

    def at(self, positions: Floats) -> Floats:
        """Normals for positions [m], (n, 3): (n, 3), in single precision."""
        return unit(self._gather @ np.ascontiguousarray(self._areas.at(positions).T))


def gradient_matrices(layout: SkinLayout) -> tuple[sparse.csr_array, sparse.csr_array]:
    """Matrices that make the derivatives by u and by v at the skin's vertices, (n, n), from values at the vertices.

    The mean of the triangles around a vertex by area at rest; empty rows where the skin is not mapped.
    """
    texture_map, part, count = layout.texture_map, layout.part, len(layout.skin.vertices)
    uv, faces = texture_map.corner_uv, part.vertices[texture_map.mesh.faces]
    first, second = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    # A triangle's gradient is the sum over its corners of their value times the turned opposite edge.
    opposite = np.roll(uv, -2, axis=1) - np.roll(uv, -1, axis=1)
    weight = texture_map.mesh.face_areas
    total = np.bincount(faces.ravel(), np.repeat(weight, 3), minlength=count)
    matrices = []
    for turned in (-opposite[..., 1], opposite[..., 0]):
        values = turned / area[:, None]
        rows = np.repeat(faces, 3, axis=1).ravel()
        columns = np.tile(faces, (1, 3)).ravel()
        shares = (np.tile(values, (1, 3)) * weight[:, None]).ravel() / total[rows]
        matrices.append(sparse.coo_array((shares, (rows, columns)), shape=(count, count)).tocsr())
    return matrices[0], matrices[1]
