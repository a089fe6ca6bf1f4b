"""Hold the hair apart, and let it go: Bando et al. 2006, figure 6."""

from __future__ import annotations

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from ...scene.simulation import Simulation
from ..ui import Ui
from .tool import Pointer, Tool


class PartHair(Tool):
    """While the button is down two hands hold the hair apart; let go and it falls together again."""

    label = "Part"
    icon = icons.ICON_FA_ARROWS_LEFT_RIGHT_TO_LINE
    help = "Press on the head: the hair at the back is held apart until you let go, then it falls together."

    def press(self, pointer: Pointer) -> bool:
        """Take the hair apart."""
        if pointer.hit is None or self._simulation is None:
            return False
        self._hold()
        return True

    def release(self) -> None:
        """Let go."""
        if self._simulation is not None:
            self._simulation.release()

    def options(self, ui: Ui) -> None:
        """Hold without keeping the button down."""
        if ui.button("Hold apart"):
            self._hold()
        imgui.same_line()
        if ui.button("Let go"):
            self.release()

    def _hold(self) -> None:
        if self._simulation is not None:
            self._simulation.hold_apart()
            self.studio.playback.playing = True

    @property
    def _simulation(self) -> Simulation | None:
        """The particles; None while there are none to hold."""
        return self.studio.grown.animation.simulation if self.studio.grown else None
