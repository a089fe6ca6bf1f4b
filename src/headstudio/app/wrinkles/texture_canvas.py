"""The face laid out flat, as a canvas for tools: the texture space of Bando's thesis, section 2.4."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...head.locate import SurfacePoints
from ...head.mesh import Floats
from ..ui import Rect
from .face_places import FacePlaces
from .skin_canvas import SkinCanvas

ON_MAP = 1e-6  # a point so near to the map lies on it


class TextureCanvas(SkinCanvas):
    """Texture space with u to the right and v upward. area: of the window. centre: what lies in its middle (u, v).
    side: edge of the unit square in window units.
    """

    def __init__(self, faces: FacePlaces, area: Rect, centre: Floats, side: float, scale: float) -> None:
        self.faces, self.scale = faces, scale
        self._middle = np.array(area.centre)
        self._centre, self._side = centre, side

    def on_screen(self, places: SurfacePoints) -> Floats:
        """Where they lie in the square."""
        return self.to_window(self.faces.uv(places))

    def seen(self, places: SurfacePoints) -> NDArray[np.bool_]:
        """All: nothing hides anything here."""
        return np.ones(len(places.faces), dtype=bool)

    def under(self, x: float, y: float) -> SurfacePoints | None:
        """Where the skin is mapped."""
        place, away = self.faces.of_uv(self.to_uv(x, y)[None])
        return place if away[0] < ON_MAP else None

    def to_window(self, uv: Floats) -> Floats:
        """Points of texture space, (..., 2), in the window."""
        return self._middle + self._side * (uv - self._centre) * [1.0, -1.0]

    def to_uv(self, x: float, y: float) -> Floats:
        """A point of the window in texture space, (2,)."""
        return self._centre + (np.array([x, y]) - self._middle) / self._side * [1.0, -1.0]
