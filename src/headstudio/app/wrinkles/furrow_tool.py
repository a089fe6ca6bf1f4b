"""Draw large wrinkles on the face, and take them by their handles (Bando's thesis, section 2.5.1)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from ...head.mesh import Floats
from ...wrinkle.furrow import Furrow
from ...wrinkle.furrow_editing import drawn_furrow, shifted, with_control, with_point, without_point
from .. import theme
from ..studio import Studio
from ..ui import Ui
from .furrow_lines import FurrowLines, furrow_lines, handle_places
from .furrow_set import FurrowSet
from .proposals import Proposals
from .skin_canvas import SkinCanvas, Touch, as_points, draw_dashes, draw_line
from .skin_tool import SkinTool

GRAB = 9.0  # how near a handle has to be, in units of a plain screen
GRAB_LINE = 6.0
AWAY = 0.2  # how strong lines are while the mouse is elsewhere: the wrinkles themselves are to be seen
STEP = 2.0  # the mouse moves so far for the next point of a stroke
PROPOSED = theme.SERIES[1]
SHORTEST = 3e-3  # a stroke shorter than this is a click [m]


@dataclass
class _Stroke:
    """A furrow that is being drawn: its points on the chart [m] and in the window."""

    chart: list[Floats] = field(default_factory=list)
    window: list[tuple[float, float]] = field(default_factory=list)


@dataclass(frozen=True)
class _Hold:
    """What the mouse holds: a handle of the chosen furrow, or all of it; where it was taken, on the chart [m], and where the
    mouse was then. number: of the furrow, or of the proposal that becomes one when it is dragged.
    """

    number: int
    furrow: Furrow
    handle: int | None
    taken_at: Floats
    touch: Touch
    proposed: bool = False


class FurrowTool(SkinTool):
    """A stroke on the skin is a new furrow. A click on one chooses it, and its handles show."""

    label = "Furrows"
    icon = icons.ICON_FA_PEN_NIB
    help = (
        "Draw on the face: a new furrow. Click one to choose it, drag it or its handles. Ctrl+click its line for another "
        "handle, a handle to take it away; Delete takes the furrow. Dashed lines are proposals: drag one to have it."
    )

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self.set = FurrowSet(studio)
        self.proposals = Proposals(studio)
        self._stroke: _Stroke | None = None
        self._hold: _Hold | None = None
        self._moving = False

    def press_on(self, canvas: SkinCanvas, touch: Touch) -> bool:
        """Take a handle, a furrow or a proposal, or begin a stroke."""
        return (
            self._take_handle(canvas, touch)
            or self._take_furrow(canvas, touch)
            or self._take_proposal(canvas, touch)
            or self._begin_stroke(canvas, touch)
        )

    def drag_on(self, canvas: SkinCanvas, touch: Touch) -> None:
        """Draw on, or move what is held."""
        place = canvas.under(touch.x, touch.y)
        if place is None:
            return
        on_chart = canvas.faces.on_chart(place)[0]
        if self._hold is not None:
            # A click alone chooses a furrow and changes nothing.
            self._moving |= _apart(touch, self._hold.touch) >= STEP * canvas.scale
            if self._moving:
                self._move(self._hold, on_chart)
        elif self._stroke is not None and _apart(touch, Touch(*self._stroke.window[-1])) >= STEP * canvas.scale:
            self._stroke.chart.append(on_chart)
            self._stroke.window.append((touch.x, touch.y))

    def release(self) -> None:
        """A stroke becomes a furrow; one too short to be one lets go of the furrow that was chosen."""
        stroke, self._stroke, self._hold = self._stroke, None, None
        if stroke is not None:
            points = np.array(stroke.chart)
            if np.linalg.norm(np.diff(points, axis=0), axis=1).sum() < SHORTEST:
                self.set.chosen = self.proposals.chosen = None
            else:
                with self.studio.reporting():
                    age = self.studio.document.wrinkle.age
                    self.set.add(drawn_furrow(points, age, self.set.furrows), "Draw furrow")
        self.studio.work.end_gesture()

    def options(self, ui: Ui) -> None:
        """Whether both sides are edited at once."""
        self.set.mirror = ui.checkbox(
            "Both sides", self.set.mirror, "What is done on one side happens on the other too."
        )

    def draw_on(self, canvas: SkinCanvas, drawing: imgui.ImDrawList, touch: Touch | None) -> None:
        """All furrows as lines, the handles of the chosen one, and the stroke that is being drawn."""
        if touch is not None and imgui.is_key_pressed(imgui.Key.delete):
            if self.set.chosen is not None:
                self.set.remove(self.set.chosen)
            elif self.proposals.chosen is not None:
                self.proposals.reject(self.proposals.chosen)
        self._draw_proposals(canvas, drawing, touch)
        lines = self._lines(canvas)
        points, seen = canvas.on_screen(lines.places), canvas.seen(lines.places)
        pointed = self._pointed_at(canvas, touch) if touch is not None and self._hold is None else None
        chosen, scale = self.set.chosen, canvas.scale
        for number in range(len(self.set.furrows)):
            line = lines.line(number)
            if number != chosen and line.stop > line.start:
                strength = 0.95 if number == pointed else 0.6 if touch is not None else AWAY
                colour = theme.packed(theme.INK, strength)
                edge = 0.8 * scale if touch is not None else 0.0
                draw_line(drawing, points[line], seen[line], colour, 1.5 * scale, edge=edge)
        if chosen is not None:
            line = lines.line(chosen)
            if line.stop > line.start:
                draw_line(drawing, points[line], seen[line], theme.packed(theme.ACCENT), 2.2 * scale, edge=1.2 * scale)
            self._draw_handles(canvas, drawing, self.set.furrows[chosen], touch)
        if self._stroke is not None:
            drawing.add_polyline(as_points(np.array(self._stroke.window)), theme.packed(theme.ACCENT), 2.2 * scale, 0)

    def _take_handle(self, canvas: SkinCanvas, touch: Touch) -> bool:
        number = self.set.chosen
        if number is None:
            return False
        furrow = self.set.furrows[number]
        places, which = handle_places(canvas.faces, furrow.controls)
        found = canvas.nearest(places, touch, GRAB)
        if found is None:
            return False
        handle = int(which[found])
        if touch.ctrl:
            if handle % 3:
                return False
            left = without_point(furrow, handle)
            if left is not None:
                self.set.put(number, left, "Remove handle")
            return True
        self._take(_Hold(number, furrow, handle, furrow.chain.controls[handle], touch))
        return True

    def _take_furrow(self, canvas: SkinCanvas, touch: Touch) -> bool:
        number = self._pointed_at(canvas, touch)
        if number is None:
            return False
        furrow, place = self.set.furrows[number], canvas.under(touch.x, touch.y)
        if place is None:
            return False
        on_chart = canvas.faces.on_chart(place)[0]
        if touch.ctrl and number == self.set.chosen:
            self.set.put(number, with_point(furrow, on_chart), "Add handle")
            return True
        self.set.chosen = number
        self._take(_Hold(number, furrow, None, on_chart, touch))
        return True

    def _take_proposal(self, canvas: SkinCanvas, touch: Touch) -> bool:
        """A click looks at a proposal; dragged it is accepted."""
        number, place = self._nearest_proposal(canvas, touch), canvas.under(touch.x, touch.y)
        if number is None or place is None:
            return False
        self.set.chosen, self.proposals.chosen = None, number
        furrow = self.proposals.furrows[number]
        self._take(_Hold(number, furrow, None, canvas.faces.on_chart(place)[0], touch, proposed=True))
        return True

    def _begin_stroke(self, canvas: SkinCanvas, touch: Touch) -> bool:
        place = canvas.under(touch.x, touch.y)
        if place is None:
            return False
        self._stroke = _Stroke([canvas.faces.on_chart(place)[0]], [(touch.x, touch.y)])
        return True

    def _take(self, hold: _Hold) -> None:
        self._hold, self._moving = hold, False
        if not hold.proposed:
            self.proposals.chosen = None
        self.studio.work.begin_gesture("Move proposal" if hold.proposed else "Move furrow")

    def _move(self, hold: _Hold, to: Floats) -> None:
        if hold.proposed:
            number = self.proposals.accept(hold.number, "Move proposal")
            hold = self._hold = replace(hold, number=number, proposed=False)
            self.set.chosen = number
        furrow, handle = hold.furrow, hold.handle
        moved = shifted(furrow, to - hold.taken_at) if handle is None else with_control(furrow, handle, to)
        self.set.put(hold.number, moved, "Move furrow")

    def _lines(self, canvas: SkinCanvas) -> FurrowLines:
        return furrow_lines(canvas.faces, tuple(furrow.controls for furrow in self.set.furrows))

    def _pointed_at(self, canvas: SkinCanvas, touch: Touch) -> int | None:
        lines = self._lines(canvas)
        found = canvas.nearest(lines.places, touch, GRAB_LINE)
        return int(lines.furrow[found]) if found is not None else None

    def _nearest_proposal(self, canvas: SkinCanvas, touch: Touch) -> int | None:
        lines = furrow_lines(canvas.faces, tuple(furrow.controls for furrow in self.proposals.furrows))
        found = canvas.nearest(lines.places, touch, GRAB_LINE)
        return int(lines.furrow[found]) if found is not None else None

    def _draw_proposals(self, canvas: SkinCanvas, drawing: imgui.ImDrawList, touch: Touch | None) -> None:
        """Dashed and in a colour of their own: they are not there yet."""
        if not self.proposals.furrows:
            return
        lines = furrow_lines(canvas.faces, tuple(furrow.controls for furrow in self.proposals.furrows))
        points, seen = canvas.on_screen(lines.places), canvas.seen(lines.places)
        pointed = self._nearest_proposal(canvas, touch) if touch is not None and self._hold is None else None
        for number in range(len(self.proposals.furrows)):
            line, shown = lines.line(number), number in (pointed, self.proposals.chosen)
            colour = theme.packed(theme.ACCENT) if shown else theme.packed(PROPOSED, 0.85)
            draw_dashes(drawing, points[line], seen[line], colour, (2.6 if shown else 1.6) * canvas.scale)

    def _draw_handles(self, canvas: SkinCanvas, drawing: imgui.ImDrawList, furrow: Furrow, touch: Touch | None) -> None:
        places, which = handle_places(canvas.faces, furrow.controls)
        points, seen = canvas.on_screen(places), canvas.seen(places)
        shown = {int(k): points[row] for row, k in enumerate(which) if seen[row]}
        scale = canvas.scale
        for k, point in shown.items():
            joint = k if k % 3 == 0 else k - 1 if k % 3 == 1 else k + 1
            if joint != k and joint in shown:
                drawing.add_polyline(
                    as_points(np.stack([shown[joint], point])), theme.packed(theme.ACCENT, 0.6), scale, 0
                )
        near = canvas.nearest(places, touch, GRAB) if touch is not None else None
        held = int(which[near]) if near is not None else None
        for k, point in shown.items():
            radius = (5.0 if k % 3 == 0 else 3.6) * scale * (1.25 if k == held else 1.0)
            (centre,) = as_points(point[None])
            drawing.add_circle_filled(centre, radius + 1.6 * scale, theme.packed(theme.GROUND, 0.85))
            drawing.add_circle_filled(centre, radius, theme.packed(theme.ACCENT if k % 3 == 0 else theme.INK))


def _apart(one: Touch, other: Touch) -> float:
    return float(np.hypot(one.x - other.x, one.y - other.y))
