"""Places on a face, as the tools for wrinkles share them between the head, its texture space and the face chart."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ...head.head import Head
from ...head.locate import SurfacePoints, locator
from ...head.mesh import Floats, Ints
from ...wrinkle.face_chart import FaceChart
from ...wrinkle.face_creases import face_layout
from ...wrinkle.skin_layout import SkinLayout
from ..studio import Studio


class FacePlaces:
    """Everything between the skin at rest, texture space and chart of one head.

    A place is a point of the mapped part of the skin: a triangle and where in it, whatever the face does.
    layout: the skin and its map. chart: where furrows are written down. own_face: the number that each triangle of the whole
    skin has in the mapped part, -1 outside it, (m,).
    """

    def __init__(self, head: Head) -> None:
        self.head = head
        self.layout: SkinLayout = face_layout(head)
        self.chart = FaceChart(head, self.layout)
        self._mesh = self.layout.part.mesh
        self.own_face: Ints = np.full(len(head.skin.faces), -1)
        self.own_face[self.layout.part.faces] = np.arange(len(self.layout.part.faces))

    def of_skin(self, points: Floats) -> SurfacePoints:
        """The places nearest to points of the skin at rest [m], (k, 3)."""
        return locator(self._mesh).nearest(points)[0]

    def of_uv(self, uv: Floats) -> tuple[SurfacePoints, Floats]:
        """The places nearest to points of texture space, (k, 2), and how far beside them these lie, (k,)."""
        return self.layout.locate(uv)

    def of_chart(self, points: Floats) -> tuple[SurfacePoints, np.ndarray]:
        """Places for points of the chart [m], (k, 2), and which of them the face reaches, (k,)."""
        skin = self.chart.on_skin(points)
        reached = np.isfinite(skin[:, 0])
        return self.of_skin(np.where(reached[:, None], skin, 0.0)), reached

    def at_rest(self, places: SurfacePoints) -> Floats:
        """Where places lie on the head at rest [m], (k, 3)."""
        return places.blend(self._mesh.vertices, self._mesh.faces)

    def posed(self, places: SurfacePoints, positions: Floats) -> Floats:
        """Where places lie on the whole skin at ``positions`` [m], (n, 3): (k, 3)."""
        return places.blend(positions[self.layout.part.vertices], self._mesh.faces)

    def normals(self, places: SurfacePoints) -> Floats:
        """Unit normals at rest, (k, 3)."""
        normals = places.blend(self._mesh.vertex_normals, self._mesh.faces)
        return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)

    def uv(self, places: SurfacePoints) -> Floats:
        """Texture coordinates, (k, 2)."""
        uv: Floats = np.einsum("ki,kij->kj", places.weights, self.layout.texture_map.corner_uv[places.faces])
        return uv

    def on_chart(self, places: SurfacePoints) -> Floats:
        """On the chart [m], (k, 2)."""
        return self.chart.from_skin(self.at_rest(places))


@lru_cache(maxsize=2)
def places_on(head: Head) -> FacePlaces:
    """Those of a head; made once."""
    return FacePlaces(head)


def places_of(studio: Studio) -> FacePlaces | None:
    """Those of the face on show, or None while there is no living one."""
    if studio.grown is None or studio.grown.animation.skin is None:
        return None
    return places_on(studio.grown.animation.head)
