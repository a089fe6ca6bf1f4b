"""Take the head in the hand and shake it."""

from __future__ import annotations

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons

from .. import navigation
from .tool import Pointer, Tool

TURN_RATE = 3.2  # [rad] for a drag over the height of the view


class ShakeHead(Tool):
    """Drag on the head to turn it, with Ctrl to move the whole bust; let go and it comes back to rest."""

    label = "Shake"
    icon = icons.ICON_FA_HAND
    help = "Drag the head to turn it, Ctrl+drag to move the bust. Drag beside it to look around."

    def press(self, pointer: Pointer) -> bool:
        """Take hold, if the mouse is on the head."""
        if pointer.hit is None or self.studio.grown is None:
            return False
        self._start = pointer
        self.studio.playback.playing = True
        return True

    def drag(self, pointer: Pointer) -> None:
        """Aim the head where the mouse is: what is seen follows the mouse, from whichever side it is seen."""
        across = (pointer.x - self._start.x) / pointer.view.height
        down = (pointer.y - self._start.y) / pointer.view.height
        right, up, _ = navigation.axes(pointer.view.camera)
        if self._start.ctrl:
            reach = 2 * np.tan(pointer.view.camera.field_of_view / 2) * self._depth()
            self.studio.aim_head(np.zeros(3), reach * (across * right - down * up))
            return
        turn = TURN_RATE * (down * right + across * np.array([0.0, 1.0, 0.0]))
        self.studio.aim_head(turn, np.zeros(3))

    def release(self) -> None:
        """The head goes home."""
        self.studio.aim_head(np.zeros(3), np.zeros(3))

    def _depth(self) -> float:
        return self._start.hit.distance if self._start.hit else self._start.view.camera.distance
