"""Step 3: the prototype strand as a curve in space, with strands made after it beside it (Choe, Ko 2005, section 2.2)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from imgui_bundle import ImVec2Like, imgui
from scipy.interpolate import CubicSpline

from ...head.mesh import Floats
from ...params import ParameterError
from ...wisp.masters import master_controls, synthesise_details
from ...wisp.outlines import Outlines
from ...wisp.prototypes import prototype_of
from ...wisp.settings import Path3D, WispSettings
from .. import theme
from ..curve_plot import HELP
from ..parameter_rows import ParameterRows
from ..ui import Rect, Ui
from .named import Named

_HEIGHT = 236.0
_GRAB = 9.0
_SIBLINGS = 4
_SEGMENTS = 24  # of the outline of a sibling
_PERIODS, _PER_PERIOD = 3, 8  # of a shipped prototype as control points
_STRAIGHT = 0.12  # length of the straight prototype as control points [m]
_WIDEST = 3.0  # a strand may look so many times as wide as it is long, for handles to be told apart
_FROM_FRONT, _FROM_SIDE = 0, 2  # the coordinate that a view shows across


class PrototypeStep:
    """The prototype from the front and from the side, its points to be dragged, and four strands made after it."""

    def __init__(self, rows: ParameterRows) -> None:
        self.rows = rows
        self._named = Named(rows, "prototype", "prototype_curve", "own curve")
        self._held: int | None = None
        self._made: tuple[WispSettings, tuple[Floats, ...]] | None = None

    def draw(self, ui: Ui) -> None:
        """The choice of those that ship, the views, and what scales the curls."""
        self._named.row(ui)
        wisp = self.rows.studio.document.wisp
        points = np.array(wisp.prototype_curve or shipped_points(wisp))
        corner, gap = imgui.get_cursor_screen_pos(), imgui.get_style().item_spacing.x
        width = (imgui.get_content_region_avail().x - 2 * gap) / 3
        frame = _Frame.around(points, width, ui.px(_HEIGHT))
        changed = None
        for k, (label, across) in enumerate((("Front", _FROM_FRONT), ("Side", _FROM_SIDE))):
            area = Rect(corner.x + k * (width + gap), corner.y, width, ui.px(_HEIGHT))
            changed = self._draw_view(ui, label, across, area, points, frame) or changed
        self._draw_siblings(ui, Rect(corner.x + 2 * (width + gap), corner.y, width, ui.px(_HEIGHT)), wisp, frame)
        imgui.set_cursor_screen_pos((corner.x, corner.y + ui.px(_HEIGHT) + imgui.get_style().item_spacing.y))
        ui.muted(HELP)
        if changed is not None:
            self._named.put(changed)
        self.rows.rows(ui, "wisp", ("curl_size", "curl_length", "curl_variety", "straight_roots"))

    def _draw_view(self, ui: Ui, label: str, across: int, area: Rect, points: Floats, frame: _Frame) -> Path3D | None:
        imgui.set_cursor_screen_pos((area.x, area.y))
        buttons = imgui.ButtonFlags_.mouse_button_left.value | imgui.ButtonFlags_.mouse_button_right.value
        imgui.invisible_button(f"##{label}", (area.width, area.height), buttons)
        ui.note(label)
        changed = self._take_mouse(ui, across, area, points, frame)
        points = points if changed is None else changed
        _draw_ground(ui, area, label)
        canvas = imgui.get_window_draw_list()
        canvas.push_clip_rect((area.x, area.y), (area.x + area.width, area.y + area.height), True)
        line: list[ImVec2Like] = [frame.place(area, point, across) for point in _smooth(points)]
        canvas.add_polyline(line, theme.packed(theme.ACCENT), ui.px(1.8), 0)
        for k, point in enumerate(points):
            place = frame.place(area, point, across)
            colour = theme.INK if k else theme.ACCENT
            canvas.add_circle_filled(place, ui.px(4.5 if k == self._held else 3.0), theme.packed(colour))
            with ui.within(label):
                ui.note(f"Point {k + 1}", Rect(place[0] - ui.px(3), place[1] - ui.px(3), ui.px(6), ui.px(6)))
        canvas.pop_clip_rect()
        return None if changed is None else _as_path(changed)

    def _take_mouse(self, ui: Ui, across: int, area: Rect, points: Floats, frame: _Frame) -> Floats | None:
        position = imgui.get_mouse_pos()
        mouse = np.array([position.x, position.y])
        gaps = np.linalg.norm(np.array([frame.place(area, point, across) for point in points]) - mouse, axis=1)
        near = int(gaps.argmin()) if gaps.min() <= ui.px(_GRAB) else None
        if imgui.is_item_activated() and imgui.is_mouse_clicked(0):
            self._held = near
        if imgui.is_item_deactivated():
            self._held = None
        if imgui.is_item_hovered() and imgui.is_mouse_clicked(1) and near is not None and len(points) > 2:
            return np.delete(points, near, axis=0)
        if imgui.is_item_hovered() and imgui.is_mouse_double_clicked(0) and near is None:
            return self._with_another(across, area, points, frame, mouse)
        if not imgui.is_item_active() or self._held is None or not imgui.is_mouse_dragging(0, 1.0):
            return None
        moved = points.copy()
        moved[self._held] = frame.moved(area, points[self._held], across, mouse)
        return moved if np.linalg.norm(np.diff(moved, axis=0), axis=1).min() > 1e-5 else None

    def _with_another(self, across: int, area: Rect, points: Floats, frame: _Frame, mouse: Floats) -> Floats:
        """Another control point in the piece of the curve that is nearest to the mouse, or behind its tip."""
        line = _smooth(points)
        shown = np.array([frame.place(area, point, across) for point in line])
        nearest = int(np.linalg.norm(shown - mouse, axis=1).argmin())
        per_piece = (len(line) - 1) / (len(points) - 1)
        after = len(points) if nearest == len(line) - 1 else int(nearest / per_piece) + 1
        return np.insert(points, after, frame.moved(area, line[nearest], across, mouse), axis=0)

    def _draw_siblings(self, ui: Ui, area: Rect, wisp: WispSettings, frame: _Frame) -> None:
        _draw_ground(ui, area, "Made after it")
        ui.note("Siblings", area)
        try:
            strands = self._siblings(wisp, frame.length)
        except ParameterError as error:
            self.rows.studio.messages.say(str(error), "warning")
            return
        canvas = imgui.get_window_draw_list()
        canvas.push_clip_rect((area.x, area.y), (area.x + area.width, area.y + area.height), True)
        for k, strand in enumerate(strands):
            at = area.x + (k + 0.5) / _SIBLINGS * area.width
            top = area.y + 0.5 * (area.height - frame.down * frame.length)
            line: list[ImVec2Like] = [
                (at + 0.45 * frame.sideways * float(x), top + frame.down * float(y)) for x, y in strand
            ]
            canvas.add_polyline(line, theme.packed(theme.SERIES[k]), ui.px(1.5), 0)
        canvas.pop_clip_rect()

    def _siblings(self, wisp: WispSettings, length: float) -> tuple[Floats, ...]:
        """Strands after the prototype on straight outlines of ``length`` [m]: across and along each, (n, 2)."""
        wanted = replace(wisp, straight_roots=min(wisp.straight_roots, 0.2 * length))
        if self._made is None or self._made[0] != wanted:
            frames = np.broadcast_to(np.eye(3), (_SIBLINGS, _SEGMENTS, 3, 3))
            outlines = Outlines(
                roots=np.zeros((_SIBLINGS, 3)),
                segment=length / _SEGMENTS,
                counts=np.full(_SIBLINGS, _SEGMENTS),
                frames=frames,
                radii=np.zeros((_SIBLINGS, _SEGMENTS + 1)),
                strands=np.ones(_SIBLINGS, dtype=np.int64),
            )
            controls = master_controls(outlines, synthesise_details(outlines, wanted)).astype(np.float64)
            self._made = wanted, tuple(_smooth(strand)[:, [0, 2]] for strand in controls)
        return self._made[1]


@dataclass(frozen=True)
class _Frame:
    """How points in space lie in a view: their middle [m], and window units for a metre sideways and down."""

    middle: Floats
    sideways: float
    down: float
    length: float

    @classmethod
    def around(cls, points: Floats, width: float, height: float) -> _Frame:
        """The frame in which all of a strand is seen, (k, 3), from both sides in one scale."""
        low, high = points.min(axis=0), points.max(axis=0)
        length = max(float(high[1] - low[1]), 0.01)
        reach = max(float((high - low)[[0, 2]].max()), 1e-3)
        down = 0.8 * height / length
        return cls(0.5 * (low + high), min(0.55 * width / reach, _WIDEST * down), down, length)

    def place(self, area: Rect, point: Floats, across: int) -> tuple[float, float]:
        """Where a point is in the window."""
        offset = point - self.middle
        x, y = area.centre
        return x + self.sideways * float(offset[across]), y - self.down * float(offset[1])

    def moved(self, area: Rect, point: Floats, across: int, mouse: Floats) -> Floats:
        """The point moved to below the mouse; its depth stays."""
        x, y = area.centre
        result = point.copy()
        result[across] = self.middle[across] + (mouse[0] - x) / self.sideways
        result[1] = self.middle[1] - (mouse[1] - y) / self.down
        return result


def shipped_points(wisp: WispSettings) -> Path3D:
    """The named prototype as control points [m]: a few turns of it, hanging down from its root."""
    plain = replace(wisp, prototype_curve=(), curl_size=1.0, curl_length=1.0)
    prototype = prototype_of(plain)
    if prototype is None:
        return tuple((0.0, float(y), 0.0) for y in np.linspace(0.0, -_STRAIGHT, 6))
    along = np.linspace(0.0, _PERIODS * prototype.pitch, _PERIODS * _PER_PERIOD + 1)
    across, aside, further = prototype.details(along).T
    return _as_path(np.stack([across, -along - further, aside], axis=1))


def _as_path(points: Floats) -> Path3D:
    return tuple((float(x), float(y), float(z)) for x, y, z in points)


def _smooth(points: Floats) -> Floats:
    """A smooth line through points, (k, 3)."""
    chord = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    knots = np.flatnonzero(np.concatenate([[True], np.diff(chord) > 1e-9]))
    if len(knots) < 3:
        return points
    pieces = np.arange(len(knots) - 1)[:, None] + np.linspace(0, 1, 6, endpoint=False)
    at = np.append(np.interp(pieces.ravel(), np.arange(len(knots)), chord[knots]), chord[-1])
    smooth: Floats = CubicSpline(chord[knots], points[knots])(at)
    return smooth


def _draw_ground(ui: Ui, area: Rect, caption: str) -> None:
    canvas = imgui.get_window_draw_list()
    far = (area.x + area.width, area.y + area.height)
    canvas.add_rect_filled((area.x, area.y), far, theme.packed(theme.GROUND), ui.px(4))
    canvas.add_text((area.x + ui.px(6), area.y + ui.px(3)), theme.packed(theme.MUTED), caption)
