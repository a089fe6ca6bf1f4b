"""Say which way fine wrinkles run: direction vectors on the skin (Bando's thesis, section 2.6.1)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from ...head.locate import SurfacePoints
from ...head.mesh import Floats
from ...wrinkle.fine_guides import FIELDS, face_guides
from ...wrinkle.fine_settings import DirectionVector
from .. import theme
from ..studio import Studio
from ..ui import Ui
from .face_places import FacePlaces
from .skin_canvas import SkinCanvas, Touch, as_points
from .skin_tool import SkinTool

LONGEST = 0.025
"""How long the arrow of a vector of length 1 is [m]."""

GRAB = 9.0
SHORTEST = 0.02  # a shorter vector is a click, and no direction
COLOURS = (theme.SERIES[0], theme.SERIES[1])


@dataclass(frozen=True)
class _Hold:
    """Which of the vectors is held, and whether by its root or by its tip."""

    number: int
    by_tip: bool


class DirectionTool(SkinTool):
    """Drag on the skin: furrows run that way there. Longer arrows make deeper, wider, straighter furrows."""

    label = "Directions"
    icon = icons.ICON_FA_WIND
    help = (
        "Drag on the face: fine wrinkles run that way, stronger for a longer arrow. Drag an arrow's tip or root to change it, "
        "Ctrl+click takes it away."
    )

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self.field = 0
        self._hold: _Hold | None = None

    def press_on(self, canvas: SkinCanvas, touch: Touch) -> bool:
        """Take an arrow, or begin one."""
        vectors = self._vectors(canvas.faces)
        ends = _ends(canvas.faces, vectors)
        own = [k for k, vector in enumerate(vectors) if vector.field == self.field]
        rows = [2 * k + end for k in own for end in (0, 1)]
        found = canvas.nearest(_some(ends, rows), touch, GRAB)
        if found is not None and touch.ctrl:
            number = rows[found] // 2
            self._put((*vectors[:number], *vectors[number + 1 :]), "Remove direction")
            return True
        place = canvas.under(touch.x, touch.y)
        if place is None:
            return False
        if found is not None:
            self._hold = _Hold(rows[found] // 2, rows[found] % 2 == 1)
            self.studio.work.begin_gesture("Move direction")
            self._put(vectors, "Move direction")
        else:
            u, v = (float(part) for part in canvas.faces.uv(place)[0])
            self._hold = _Hold(len(vectors), True)
            self.studio.work.begin_gesture("Add direction")
            self._put((*vectors, DirectionVector(self.field, u, v, 0.0, 0.0)), "Add direction")
        return True

    def drag_on(self, canvas: SkinCanvas, touch: Touch) -> None:
        """Turn the arrow to the mouse, or take its root along."""
        place, vectors = canvas.under(touch.x, touch.y), list(self.studio.document.fine.vectors)
        if self._hold is None or place is None or self._hold.number >= len(vectors):
            return
        uv, vector = canvas.faces.uv(place)[0], vectors[self._hold.number]
        if self._hold.by_tip:
            way = (uv - [vector.u, vector.v]) * canvas.faces.layout.texture_map.metres / LONGEST
            way = way / max(float(np.linalg.norm(way)), 1.0)
            vector = vector._replace(du=float(way[0]), dv=float(way[1]))
        else:
            vector = vector._replace(u=float(uv[0]), v=float(uv[1]))
        vectors[self._hold.number] = vector
        self._put(tuple(vectors), "Move direction")

    def release(self) -> None:
        """What is no longer than a point goes away again."""
        hold, self._hold = self._hold, None
        vectors = self.studio.document.fine.vectors
        if hold is not None and hold.number < len(vectors):
            vector = vectors[hold.number]
            if np.hypot(vector.du, vector.dv) < SHORTEST:
                self._put((*vectors[: hold.number], *vectors[hold.number + 1 :]), "Remove direction")
        self.studio.work.end_gesture()

    def options(self, ui: Ui) -> None:
        """Which of both fields, and where its vectors come from."""
        gap = imgui.get_style().item_spacing.x / 2
        width = (imgui.get_content_region_avail().x - gap) / 2
        for k in range(FIELDS):
            if k:
                imgui.same_line(0, gap)
            help_ = "Fine wrinkles are two fields of furrows that cross; each follows vectors of its own."
            if ui.button(f"Field {k + 1}", help_, on=self.field == k, width=width):
                self.field = k
        own = any(vector.field == self.field for vector in self.studio.document.fine.vectors)
        ui.muted("Set by hand." if own else "Placed from the shape.")
        if ui.button("Regenerate", "Place the vectors of this field from the shape of the face again.", enabled=own):
            kept = tuple(vector for vector in self.studio.document.fine.vectors if vector.field != self.field)
            self._put(kept, "Regenerate directions")

    def draw_on(self, canvas: SkinCanvas, drawing: imgui.ImDrawList, touch: Touch | None) -> None:
        """Arrows of both fields, those of the other one faint."""
        vectors = self._vectors(canvas.faces, every=True)
        ends = _ends(canvas.faces, vectors)
        points, seen = canvas.on_screen(ends).reshape(-1, 2, 2), canvas.seen(ends).reshape(-1, 2)
        for vector, (root, tip), (root_seen, tip_seen) in zip(vectors, points, seen):
            if root_seen and tip_seen:
                _draw_arrow(drawing, root, tip, canvas.scale, vector.field, 1.0 if vector.field == self.field else 0.25)

    def _vectors(self, faces: FacePlaces, *, every: bool = False) -> tuple[DirectionVector, ...]:
        """The document's vectors and, for a field that has none (``every``: or both), those placed from the shape."""
        fine = self.studio.document.fine
        missing = [
            field
            for field in range(FIELDS)
            if (every or field == self.field) and not any(vector.field == field for vector in fine.vectors)
        ]
        placed = placed_vectors(faces, fine.crossing)
        return (*fine.vectors, *(vector for vector in placed if vector.field in missing))

    def _put(self, vectors: tuple[DirectionVector, ...], label: str) -> None:
        document = self.studio.document
        self.studio.work.change(replace(document, fine=replace(document.fine, vectors=vectors)), label)


@lru_cache(maxsize=4)
def placed_vectors(faces: FacePlaces, crossing: float) -> tuple[DirectionVector, ...]:
    """The direction vectors that the shape of a face gives both fields, which cross at an angle [rad]."""
    texture_map = faces.layout.texture_map
    guides = face_guides(texture_map, faces.head.landmarks)
    at = texture_map.uv[guides.vertices]
    return tuple(
        DirectionVector(field, *(float(number) for number in (*place, *vector)))
        for field, vectors in enumerate(guides.vectors(texture_map, crossing))
        for place, vector in zip(at, vectors)
    )


def _ends(faces: FacePlaces, vectors: tuple[DirectionVector, ...]) -> SurfacePoints:
    """Root and tip of every arrow, one after the other, (2 k,)."""
    table = np.array([vector[1:] for vector in vectors]).reshape(-1, 4)
    reach = LONGEST / faces.layout.texture_map.metres
    uv = np.stack([table[:, :2], table[:, :2] + reach * table[:, 2:]], axis=1).reshape(-1, 2)
    return faces.of_uv(uv)[0]


def _some(places: SurfacePoints, rows: list[int]) -> SurfacePoints:
    return SurfacePoints(places.faces[rows], places.weights[rows])


def _draw_arrow(
    drawing: imgui.ImDrawList, root: Floats, tip: Floats, scale: float, field: int, strength: float
) -> None:
    way = tip - root
    length = float(np.linalg.norm(way))
    colour, dark = theme.packed(COLOURS[field], strength), theme.packed(theme.GROUND, 0.6 * strength)
    (start,) = as_points(root[None])
    drawing.add_circle_filled(start, 3.4 * scale, dark)
    drawing.add_circle_filled(start, 2.4 * scale, colour)
    if length < 1:
        return
    along = way / length
    head = min(7.0 * scale, 0.6 * length)
    side = head * 0.55 * np.array([-along[1], along[0]])
    neck = tip - head * along
    drawing.add_polyline(as_points(np.stack([root, neck])), dark, 3.6 * scale, 0)
    drawing.add_polyline(as_points(np.stack([root, neck])), colour, 1.8 * scale, 0)
    drawing.add_convex_poly_filled(as_points(np.stack([tip, neck + side, neck - side])), colour)
