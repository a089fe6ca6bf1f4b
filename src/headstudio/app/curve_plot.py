"""A curve over 0 to 1 that is edited by its control points."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from imgui_bundle import ImVec2Like, imgui

from ..head.mesh import Floats
from . import theme
from .ui import Rect, Ui

Points = tuple[tuple[float, float], ...]

GRAB = 10.0
HEIGHT = 108.0
_LEAST_GAP = 0.005  # between neighbours, along x
_SAMPLES = 96

HELP = "Drag points; double click adds one, right click takes one."


class CurvePlot:
    """A plot of ``curve`` through control points: drag them, double click for another, right click takes one away.

    curve: from control points, (k, 2), to a function of x. top: the largest value that fits. across, up: what the axes are.
    """

    def __init__(
        self, label: str, curve: Callable[[Floats], Callable[[Floats], Floats]], top: float, across: str, up: str
    ) -> None:
        self.label = label
        self._curve = curve
        self._top = top
        self._across, self._up = across, up
        self._held: int | None = None

    def draw(self, ui: Ui, points: Points) -> Points | None:
        """Draw the plot over the width that is left; returns other control points when the user made some."""
        corner = imgui.get_cursor_screen_pos()
        area = Rect(corner.x, corner.y, imgui.get_content_region_avail().x, ui.px(HEIGHT))
        buttons = imgui.ButtonFlags_.mouse_button_left.value | imgui.ButtonFlags_.mouse_button_right.value
        imgui.invisible_button(f"##{self.label}", (area.width, area.height), buttons)
        ui.note(self.label)
        changed = self._take_mouse(ui, area, points)
        self._draw(ui, area, changed or points)
        return changed

    def _take_mouse(self, ui: Ui, area: Rect, points: Points) -> Points | None:
        mouse = imgui.get_mouse_pos()
        near = self._near(ui, area, points, (mouse.x, mouse.y))
        x, y = self._value(area, (mouse.x, mouse.y))
        if not imgui.is_item_active():
            self._held = None
        elif imgui.is_item_activated() and imgui.is_mouse_clicked(0):
            self._held = near
        if not imgui.is_item_hovered() and self._held is None:
            return None
        if imgui.is_mouse_clicked(1) and near is not None:
            return self._checked((*points[:near], *points[near + 1 :]))
        if imgui.is_mouse_double_clicked(0) and near is None:
            return self._checked(tuple(sorted((*points, (x, y)))))
        if self._held is None or not imgui.is_mouse_dragging(0, 1.0):
            return None
        held = self._held
        low = points[held - 1][0] + _LEAST_GAP if held > 0 else 0.0
        high = points[held + 1][0] - _LEAST_GAP if held + 1 < len(points) else 1.0
        moved = (min(max(x, low), max(high, low)), y)
        return self._checked((*points[:held], moved, *points[held + 1 :]))

    @staticmethod
    def _checked(points: Points) -> Points | None:
        """Only what is a curve: two points or more, apart from each other, and not zero everywhere."""
        x = [point[0] for point in points]
        apart = all(after - before > 1e-6 for before, after in pairwise(x))
        return points if len(points) >= 2 and apart and max(point[1] for point in points) > 0 else None

    def _near(self, ui: Ui, area: Rect, points: Points, mouse: tuple[float, float]) -> int | None:
        shown = np.array([self._place(area, point) for point in points])
        distance = np.linalg.norm(shown - mouse, axis=1)
        nearest = int(distance.argmin())
        return nearest if distance[nearest] <= ui.px(GRAB) else None

    def _place(self, area: Rect, point: tuple[float, float]) -> tuple[float, float]:
        """Where a point of the curve is in the window: a margin is left for the handles at the ends."""
        margin = 0.04
        return area.at(margin + (1 - 2 * margin) * point[0], 1 - margin - (1 - 3 * margin) * point[1] / self._top)

    def _value(self, area: Rect, place: tuple[float, float]) -> tuple[float, float]:
        (left, bottom), (right, top) = self._place(area, (0.0, 0.0)), self._place(area, (1.0, self._top))
        x, y = (place[0] - left) / (right - left), self._top * (place[1] - bottom) / (top - bottom)
        return min(max(x, 0.0), 1.0), min(max(y, 0.0), self._top)

    def _draw(self, ui: Ui, area: Rect, points: Points) -> None:
        canvas = imgui.get_window_draw_list()
        far = (area.x + area.width, area.y + area.height)
        canvas.add_rect_filled((area.x, area.y), far, theme.packed(theme.GROUND), ui.px(4))
        for x in (0.0, 0.25, 0.5, 0.75, 1.0):
            canvas.add_line(self._place(area, (x, 0.0)), self._place(area, (x, self._top)), theme.packed(theme.LINE))
        canvas.add_line(self._place(area, (0.0, 0.0)), self._place(area, (1.0, 0.0)), theme.packed(theme.PRESSED))
        control = np.array(points)
        inside = np.linspace(control[0, 0], control[-1, 0], _SAMPLES)
        heights = np.clip(self._curve(control)(inside), 0.0, self._top)
        line: list[ImVec2Like] = [self._place(area, (float(x), float(y))) for x, y in zip(inside, heights)]
        fill = theme.packed(theme.ACCENT_DEEP, 0.35)
        ends = [self._place(area, (float(x), 0.0)) for x in inside[[-1, 0]]]
        canvas.add_concave_poly_filled([*line, *ends], fill)
        canvas.add_polyline(line, theme.packed(theme.ACCENT), ui.px(2), 0)
        mouse = imgui.get_mouse_pos()
        hot = self._held if self._held is not None else self._near(ui, area, points, (mouse.x, mouse.y))
        for k, point in enumerate(points):
            place = self._place(area, point)
            canvas.add_circle_filled(place, ui.px(5.5 if k == hot else 4.5), theme.packed(theme.GROUND))
            canvas.add_circle_filled(place, ui.px(4.0 if k == hot else 3.0), theme.packed(theme.INK))
            with ui.within(self.label):
                ui.note(f"Point {k + 1}", Rect(place[0] - ui.px(4), place[1] - ui.px(4), ui.px(8), ui.px(8)))
        faint = theme.packed(theme.MUTED)
        canvas.add_text((area.x + ui.px(7), area.y + ui.px(3)), faint, self._up)
        size = imgui.calc_text_size(self._across)
        canvas.add_text((far[0] - size.x - ui.px(7), area.y + ui.px(3)), faint, self._across)
