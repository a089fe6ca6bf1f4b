"""Texture space as seen from a whole skin of which a part is mapped."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..head.locate import Locator, SurfacePoints
from ..head.mesh import Floats, Ints, TriangleMesh
from .body_part import BodyPart, extract
from .metric import vertex_metrics
from .refined_mesh import RefinedMesh
from .texture_map import TextureMap


@dataclass(frozen=True, eq=False)
class SkinLayout:
    """A skin and the texture map of a part of it.

    skin: n vertices, m triangles. part: which of it is mapped. texture_map: of the part's mesh.
    """

    skin: TriangleMesh
    part: BodyPart
    texture_map: TextureMap

    @classmethod
    def of_map(cls, texture_map: TextureMap) -> SkinLayout:
        """For a map that covers its whole skin."""
        mesh = texture_map.mesh
        return cls(mesh, extract(mesh, np.arange(len(mesh.faces))), texture_map)

    @cached_property
    def mapped(self) -> np.ndarray:
        """Which triangles of the skin are mapped, (m,)."""
        mask = np.zeros(len(self.skin.faces), dtype=bool)
        mask[self.part.faces] = True
        return mask

    @cached_property
    def corner_uv(self) -> Floats:
        """Texture coordinates of the skin's corners, (m, 3, 2); nan where it is not mapped."""
        corners = np.full((len(self.skin.faces), 3, 2), np.nan)
        corners[self.part.faces] = self.texture_map.corner_uv
        return corners

    @cached_property
    def corner_metrics(self) -> Floats:
        """G at the skin's corners, (m, 3, 2, 2), a corner of a vertex like every other; nan where it is not mapped."""
        metrics = np.full((len(self.skin.faces), 3, 2, 2), np.nan)
        metrics[self.part.faces] = vertex_metrics(self.texture_map)[self.texture_map.mesh.faces]
        return metrics

    def uv(self, refined: RefinedMesh, vertices: Ints) -> Floats:
        """Texture coordinates of vertices, (k,), of a refined skin: (k, 2)."""
        return np.einsum("ki,kij->kj", refined.weights[vertices], self.corner_uv[refined.home[vertices]])

    def metrics(self, refined: RefinedMesh, vertices: Ints) -> Floats:
        """G at vertices, (k,), of a refined skin: (k, 2, 2)."""
        return np.einsum("ki,kiab->kab", refined.weights[vertices], self.corner_metrics[refined.home[vertices]])

    def place(self, uv: Floats) -> tuple[Ints, Floats]:
        """The triangles of the skin, (k,), that hold points of texture space, (k, 2), and where in them, (k, 3)."""
        found, _ = self.locate(uv)
        return self.part.faces[found.faces], found.weights

    def locate(self, uv: Floats) -> tuple[SurfacePoints, Floats]:
        """Points of texture space, (k, 2), on the part: its faces with weights, and how far outside they lie, (k,)."""
        points = uv.copy()
        if self.texture_map.wrapped:
            points[:, 0] %= 1.0
        found, distance = self._plane.nearest(points)
        if not self.texture_map.wrapped:
            return found, distance
        # A triangle across the seam reaches beyond u = 1.
        again, other = self._plane.nearest(points + np.array([1.0, 0.0]))
        nearer = other < distance
        faces = np.where(nearer, again.faces, found.faces)
        weights = np.where(nearer[:, None], again.weights, found.weights)
        return SurfacePoints(faces, weights), np.minimum(distance, other)

    def whole(self, uv: Floats, beside: float) -> Floats:
        """Texture coordinates with whole turns added to u so that they lie near u = ``beside``."""
        if not self.texture_map.wrapped:
            return uv
        turned = uv.copy()
        turned[:, 0] += np.rint(beside - turned[:, 0])
        return turned

    @cached_property
    def _plane(self) -> Locator:
        corners = self.texture_map.corner_uv.reshape(-1, 2)
        return Locator(corners, np.arange(len(corners)).reshape(-1, 3))
