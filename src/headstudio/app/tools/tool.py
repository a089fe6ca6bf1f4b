"""What a tool of the viewport is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from imgui_bundle import ImVec2Like, imgui

from ...head.frame import HeadFrame
from ...head.head import Head
from ...head.mesh import Floats
from ...scene.stage import Stage
from ..picking import Hit, Ray, View, pick_head
from ..studio import Studio
from ..ui import Ui


@dataclass(frozen=True, eq=False)
class Pointer:
    """The mouse over the viewport: x to the right and y down from its upper left corner, in window units."""

    x: float
    y: float
    view: View
    head: Head | None
    frame: HeadFrame
    ctrl: bool = False
    shift: bool = False

    @property
    def ray(self) -> Ray:
        """The half line from the eye through the mouse."""
        return self.view.ray(self.x, self.y)

    @cached_property
    def hit(self) -> Hit | None:
        """Where that line meets the skin."""
        return pick_head(self.head, self.ray, self.frame) if self.head is not None else None


@dataclass(frozen=True)
class Canvas:
    """Where a tool draws on top of the picture: ImGui's list, the view, and where the picture begins in the window."""

    drawing: imgui.ImDrawList
    view: View
    frame: HeadFrame
    x: float
    y: float
    scale: float

    def on_screen(self, points: Floats) -> list[ImVec2Like]:
        """Where points of the head [m], (n, 3), are in the window; those behind the camera far away."""
        shown = self.view.project(self.frame.to_world(points)) + np.array([self.x, self.y])
        return [(float(x), float(y)) for x, y in np.nan_to_num(shown, nan=-1e4)]


class Tool:
    """One way to use the mouse on the scene. A press that the tool does not want turns the camera instead.

    takes_shift: Shift means something to the tool; with all others Shift pans.
    """

    label = ""
    icon = ""
    help = ""
    takes_shift = False

    def __init__(self, studio: Studio) -> None:
        self.studio = studio

    def press(self, pointer: Pointer) -> bool:
        """The left button went down; True when the tool wants what follows."""
        return False

    def drag(self, pointer: Pointer) -> None:
        """The mouse is moved with the button down; called every frame until the release."""

    def release(self) -> None:
        """The button was let go."""

    def dress(self, stage: Stage) -> Stage:
        """The stage with what the tool shows in the scene itself; the same object as long as nothing changes."""
        return stage

    def draw(self, canvas: Canvas) -> None:
        """Draw handles on top of the picture."""

    def options(self, ui: Ui) -> None:
        """Draw the tool's own buttons, in the sidebar."""
