"""The rim of the brush on a surface, as it is seen while painting."""

from __future__ import annotations

import numpy as np
from imgui_bundle import ImVec2Like, imgui

from ..head.mesh import Floats
from . import theme

_POINTS = 48


def rim_points(place: Floats, normal: Floats, radius: float) -> Floats:
    """A circle of ``radius`` [m] around ``place``, (3,), square to the unit ``normal``, (3,): (k, 3)."""
    across = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    across /= max(float(np.linalg.norm(across)), 1e-9)
    turn = np.linspace(0, 2 * np.pi, _POINTS, endpoint=False)[:, None]
    rim: Floats = place + radius * (np.cos(turn) * across + np.sin(turn) * np.cross(normal, across))
    return rim


def draw_rim(drawing: imgui.ImDrawList, shown: list[ImVec2Like], strength: float, scale: float) -> None:
    """Draw a rim whose points lie at ``shown`` in the window; ``strength`` 1 for the brush, less for its mirror image."""
    for colour, width in ((theme.packed(theme.GROUND, 0.7 * strength), 3.5), (theme.packed(theme.INK, strength), 1.5)):
        drawing.add_polyline(shown, colour, width * scale, imgui.ImDrawFlags_.closed.value)
