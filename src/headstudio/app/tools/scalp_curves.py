"""Shape the scalp: drag the control points of the four curves around it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import ImVec2Like
from imgui_bundle import icons_fontawesome_6 as icons
from numpy.typing import NDArray

from ...head.frame import HeadFrame
from ...head.mesh import Floats
from ...head.scalp_curves import catmull_rom
from .. import theme
from ..picking import View
from ..ui import Ui
from .tool import Canvas, Pointer, Tool

Curves = tuple[tuple[tuple[float, float, float], ...], ...]
GRAB_RADIUS = 12.0
SAMPLES = 12  # points of the drawn line for each handle
FAINT = 0.2


class ShapeScalp(Tool):
    """Handles on the skin; neighbouring curves share their ends, so a corner moves in both."""

    label = "Scalp"
    icon = icons.ICON_FA_BEZIER_CURVE
    help = "Drag the handles of the four curves between which hair grows."

    def press(self, pointer: Pointer) -> bool:
        """Take the handle under the mouse."""
        curves = self._curves()
        if curves is None:
            return False
        handles = np.concatenate([np.array(curve) for curve in curves])
        gaps = np.linalg.norm(pointer.view.project(pointer.frame.to_world(handles)) - [pointer.x, pointer.y], axis=1)
        gaps[~_seen(pointer.view, pointer.frame, handles, handles.mean(axis=0))] = np.inf
        nearest = int(np.nanargmin(gaps))
        if not gaps[nearest] < GRAB_RADIUS:
            return False
        self._held = handles[nearest]
        self._before = curves
        self.studio.work.begin_gesture("Scalp curve")
        return True

    def drag(self, pointer: Pointer) -> None:
        """Move the handle along the skin."""
        if pointer.hit is None:
            return
        x, y, z = (float(part) for part in pointer.hit.point)
        held = tuple(self._held)
        moved = tuple(tuple((x, y, z) if point == held else point for point in curve) for curve in self._before)
        document = self.studio.document
        self.studio.work.change(replace(document, scalp=replace(document.scalp, curves=moved)), "Scalp curve")

    def release(self) -> None:
        """The handle stays; the hair grows anew between the curves."""
        self.studio.work.end_gesture()

    def options(self, ui: Ui) -> None:
        """Back to the curves placed from landmarks."""
        document = self.studio.document
        if ui.button(
            "Default curves", "Place the curves from the landmarks of the head.", enabled=bool(document.scalp.curves)
        ):
            self.studio.work.change(replace(document, scalp=replace(document.scalp, curves=())), "Default curves")

    def draw(self, canvas: Canvas) -> None:
        """The four curves, and a handle at each control point; faint where the head is in between."""
        curves = [np.array(curve) for curve in self._curves() or ()]
        if not curves:
            return
        middle = np.concatenate(curves).mean(axis=0)
        for points in curves:
            line = catmull_rom(points)(np.linspace(0, 1, SAMPLES * (len(points) - 1)))
            _draw_line(canvas, line, middle)
            for (x, y), seen in zip(_on_screen(canvas, points), _seen(canvas.view, canvas.frame, points, middle)):
                strength = 1.0 if seen else FAINT
                canvas.drawing.add_circle_filled((x, y), 6.5 * canvas.scale, theme.packed(theme.GROUND, strength))
                canvas.drawing.add_circle_filled((x, y), 4.5 * canvas.scale, theme.packed(theme.ACCENT, strength))

    def _curves(self) -> Curves | None:
        if self.studio.grown is None:
            return None
        # Those that were placed from landmarks until some are chosen.
        return self.studio.document.scalp.curves or _as_tuples(self.studio.grown.animation.scalp.controls)


def _draw_line(canvas: Canvas, line: Floats, middle: Floats) -> None:
    """A curve on the head, in runs that are seen or hidden."""
    points, seen = _on_screen(canvas, line), _seen(canvas.view, canvas.frame, line, middle)
    turns = np.flatnonzero(np.diff(seen.astype(np.int8))) + 1
    for start, end in zip([0, *turns], [*turns, len(line)]):
        run: list[ImVec2Like] = [(float(x), float(y)) for x, y in points[start : end + 1]]
        strength = 1.0 if seen[start] else FAINT
        for colour, width in (
            (theme.packed(theme.GROUND, 0.6 * strength), 4.0),
            (theme.packed(theme.ACCENT, strength), 2.0),
        ):
            canvas.drawing.add_polyline(run, colour, width * canvas.scale, 0)


def _on_screen(canvas: Canvas, points: Floats) -> Floats:
    """Where points of the head [m], (n, 3), are in the window, (n, 2); those behind the camera far away."""
    shown = canvas.view.project(canvas.frame.to_world(points)) + np.array([canvas.x, canvas.y])
    return np.nan_to_num(shown, nan=-1e4)


def _seen(view: View, frame: HeadFrame, points: Floats, middle: Floats) -> NDArray[np.bool_]:
    """Which points of the head [m], (n, 3), lie on the side that is seen; ``middle`` is inside the skull."""
    outward = frame.rotation.apply(points - middle)
    return np.einsum("ij,ij->i", outward, view.eye - frame.to_world(points)) > 0


def _as_tuples(curves: tuple[Floats, ...]) -> Curves:
    return tuple(tuple((float(x), float(y), float(z)) for x, y, z in curve) for curve in curves)
