"""Place the whorl, the point that hair grows away from."""

from __future__ import annotations

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons

from ...head.mesh import Floats
from ...params import assign
from .. import theme
from .tool import Canvas, Pointer, Tool

ON_SCALP = 0.005  # [m]


class PlaceWhorl(Tool):
    """Click or drag on the scalp: the whorl goes there."""

    label = "Whorl"
    icon = icons.ICON_FA_HURRICANE
    help = "Click on the scalp: hair grows away from this point (eq. 4)."

    def press(self, pointer: Pointer) -> bool:
        """Begin to place it, if the mouse is on the scalp."""
        if self._scalp_under(pointer) is None:
            return False
        self.studio.work.begin_gesture("Place the whorl")
        self.drag(pointer)
        return True

    def drag(self, pointer: Pointer) -> None:
        """Move it under the mouse."""
        uv = self._scalp_under(pointer)
        if uv is not None:
            u, v = (float(part) for part in np.clip(uv, 0, 1))
            document = assign(self.studio.document, {"scalp.whorl_u": u, "scalp.whorl_v": v})
            self.studio.work.change(document, "Place the whorl")

    def release(self) -> None:
        """It stays where it is; the hair grows anew."""
        self.studio.work.end_gesture()

    def draw(self, canvas: Canvas) -> None:
        """A spiral eye on the scalp."""
        grown = self.studio.grown
        if grown is None:
            return
        settings = self.studio.document.scalp
        uv = np.array([[settings.whorl_u, settings.whorl_v]])
        (point,) = canvas.view.project(canvas.frame.to_world(grown.animation.scalp.points(uv)))
        if not np.isfinite(point).all():
            return
        centre = (canvas.x + point[0], canvas.y + point[1])
        accent, dark = theme.packed(theme.ACCENT), theme.packed(theme.GROUND, 0.7)
        for radius, thickness in ((9.0, 1.5), (4.0, 2.0)):
            canvas.drawing.add_circle(centre, radius * canvas.scale, dark, 32, (thickness + 2) * canvas.scale)
            canvas.drawing.add_circle(centre, radius * canvas.scale, accent, 32, thickness * canvas.scale)

    def _scalp_under(self, pointer: Pointer) -> Floats | None:
        """(u, v) of the scalp under the mouse, (2,); None beside it."""
        if pointer.hit is None or self.studio.grown is None:
            return None
        scalp = self.studio.grown.animation.scalp
        point = pointer.hit.point[None]
        uv = scalp.locate(point)
        return uv[0] if np.linalg.norm(scalp.points(uv) - point) < ON_SCALP else None
