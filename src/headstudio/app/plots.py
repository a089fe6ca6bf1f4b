"""Live figures: the last seconds of what was measured, as curves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from imgui_bundle import ImVec2, imgui, implot

from ..head.mesh import Floats
from . import theme
from .ui import Ui

KEPT = 600
WINDOW = 8.0  # seconds on show
STAGES_WIDTH = 1.7  # the plot with its names beside it needs that much more room
STAGES_SHOWN = 6
LEAST_WIDTH = 120.0


class Series:
    """The last values of one figure over time, oldest first."""

    def __init__(self) -> None:
        self._times: Floats = np.zeros(KEPT)
        self._values: Floats = np.zeros(KEPT)
        self._count = 0

    def add(self, time: float, value: float) -> None:
        """Append a value; a time before the last one (a reset) starts over."""
        if self._count and time < self._times[(self._count - 1) % KEPT]:
            self._count = 0
        self._times[self._count % KEPT] = time
        self._values[self._count % KEPT] = value
        self._count += 1

    @property
    def arrays(self) -> tuple[Floats, Floats]:
        """Times [s] and values, each of shape (n,)."""
        order = np.arange(max(self._count - KEPT, 0), self._count) % KEPT
        return self._times[order], self._values[order]

    @property
    def last(self) -> float:
        """The newest value, 0 before there is one."""
        return float(self._values[(self._count - 1) % KEPT]) if self._count else 0.0


@dataclass(frozen=True)
class Figure:
    """One plot: its title, unit, the curves by measured name, and what the values are multiplied with.

    least: the range that is shown at least, in ``unit``. limit: a line that should not be crossed.
    """

    title: str
    unit: str
    curves: dict[str, str]
    scale: float
    least: tuple[float, float]
    limit: float | None = None


FIGURES = (
    Figure("Kinetic energy", "mJ", {"kinetic_energy": "hair"}, 1e3, (0.0, 1.0)),
    Figure("Stretch", "%", {"stretch_rms": "rms", "stretch_max": "largest"}, 100.0, (0.0, 1.0)),
    Figure("Reach", "%", {"reach_max": "largest"}, 100.0, (90.0, 110.0), limit=105.0),
)


class Plots:
    """Keeps what is measured and draws it."""

    def __init__(self) -> None:
        self._measured: dict[str, Series] = {}
        self._stages: dict[str, Series] = {}
        self._time = 0.0

    def record(self, time: float, measures: dict[str, float], milliseconds: dict[str, float]) -> None:
        """Take the figures of one frame at simulated ``time`` [s]: measures by name, and the time of each stage [ms]."""
        self._time = time
        # A stage that did not run took no time.
        milliseconds = dict.fromkeys(self._stages, 0.0) | milliseconds
        for kept, figures in ((self._measured, measures), (self._stages, milliseconds)):
            for name, value in figures.items():
                kept.setdefault(name, Series()).add(time, value)

    def draw(self, ui: Ui, height: float) -> None:
        """The plots side by side over the width that is left, as many as have room."""
        gap, least, room = ui.px(20), ui.px(LEAST_WIDTH), imgui.get_content_region_avail().x
        count = min(max(int((room - STAGES_WIDTH * least) / (least + gap)), 0), len(FIGURES))
        width = (room - gap * count) / (count + STAGES_WIDTH)
        with ui.within("Plots"):
            self._draw_stages(ui, STAGES_WIDTH * width, height)
            for figure in FIGURES[:count]:
                imgui.same_line(0, gap)
                self._draw_figure(ui, figure, width, height)

    def _draw_stages(self, ui: Ui, width: float, height: float) -> None:
        names = sorted(self._stages, key=lambda name: -self._stages[name].last)[:STAGES_SHOWN]
        curves = {
            f"{_plain(name)}  {self._stages[name].last:.1f}###{name}": self._stages[name].arrays for name in names
        }
        total = sum(series.last for series in self._stages.values())
        with _Plot(ui, "Time a frame", f"{total:.1f} ms", (width, height), self._time) as plot:
            plot.draw(curves, (0.0, 10.0), beside=True)

    def _draw_figure(self, ui: Ui, figure: Figure, width: float, height: float) -> None:
        curves = {}
        text = ""
        for name, label in figure.curves.items():
            if name in self._measured:
                times, values = self._measured[name].arrays
                curves[f"{label}###{name}"] = times, values * figure.scale
                text = f"{self._measured[name].last * figure.scale:.1f} {figure.unit}"
        with _Plot(ui, figure.title, text, (width, height), self._time) as plot:
            plot.draw(curves, figure.least, figure.limit)


class _Plot:
    """A plot under a heading with its newest value."""

    def __init__(self, ui: Ui, title: str, value: str, size: tuple[float, float], now: float) -> None:
        self._ui, self._title, self._value = ui, title, value
        self._width, self._height = size
        self._now = now

    def __enter__(self) -> _Plot:
        imgui.begin_group()
        self._ui.caption(self._title)
        imgui.same_line(self._width - imgui.calc_text_size(self._value).x)
        imgui.text_unformatted(self._value)
        return self

    def __exit__(self, *_: object) -> None:
        imgui.end_group()
        self._ui.note(self._title)

    def draw(
        self,
        curves: dict[str, tuple[Floats, Floats]],
        least: tuple[float, float],
        limit: float | None = None,
        *,
        beside: bool = False,
    ) -> None:
        """The curves by label, over at least the range ``least``; their names in the plot, or ``beside`` it."""
        flags = implot.Flags_.no_title.value | implot.Flags_.no_mouse_text.value | implot.Flags_.no_inputs.value
        size = ImVec2(self._width, self._height - imgui.get_text_line_height_with_spacing())
        if not implot.begin_plot(f"##{self._title}", size, flags):
            return
        self._set_up_axes(curves, least)
        if beside:
            implot.setup_legend(implot.Location_.east.value, implot.LegendFlags_.outside.value)
        else:
            implot.setup_legend(implot.Location_.north_west.value)
        for (label, (times, values)), colour in zip(curves.items(), theme.SERIES):
            implot.plot_line(label, times, values, implot.Spec(line_color=theme.rgba(colour), line_weight=1.6))
        if limit is not None:
            line = implot.Spec(line_color=theme.rgba(theme.ERROR, 0.7), line_weight=1.0)
            line.flags = implot.InfLinesFlags_.horizontal.value | implot.ItemFlags_.no_legend.value
            implot.plot_inf_lines("##limit", np.array([limit]), line)
        implot.end_plot()

    def _set_up_axes(self, curves: dict[str, tuple[Floats, Floats]], least: tuple[float, float]) -> None:
        recent = [values[times > self._now - WINDOW] for times, values in curves.values()]
        # A single hiccup is cut off rather than flattening everything else.
        highest = max((float(np.quantile(values, 0.98)) for values in recent if len(values)), default=0.0)
        always, flags = imgui.Cond_.always.value, implot.AxisFlags_
        implot.setup_axis(implot.ImAxis_.x1.value, "", flags.no_decorations.value)
        implot.setup_axis(implot.ImAxis_.y1.value, "", flags.no_label.value | flags.no_tick_marks.value)
        implot.setup_axis_limits(implot.ImAxis_.x1.value, self._now - WINDOW, self._now + 1e-3, always)
        implot.setup_axis_limits(implot.ImAxis_.y1.value, least[0], max(least[1], 1.15 * highest), always)


def _plain(stage: str) -> str:
    return stage.removeprefix("ms_").replace("_", " ")
