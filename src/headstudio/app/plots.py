"""Live figures: the last seconds of what was measured, as curves."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from imgui_bundle import ImVec2, imgui, implot
from numpy.typing import NDArray

from ..head.mesh import Floats
from . import theme
from .ui import Ui

KEPT = 600
WINDOW = 8.0  # seconds on show


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
    def arrays(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Times [s] and values, each of shape (n,)."""
        order = np.arange(max(self._count - KEPT, 0), self._count) % KEPT
        return self._times[order], self._values[order]

    @property
    def last(self) -> float:
        """The newest value, 0 before there is one."""
        return float(self._values[(self._count - 1) % KEPT]) if self._count else 0.0


@dataclass(frozen=True)
class Figure:
    """One plot: its title, unit, the measured names it shows, and what they are multiplied with."""

    title: str
    unit: str
    names: tuple[str, ...]
    scale: float = 1.0
    limit: float | None = None


FIGURES = (
    Figure("Kinetic energy", "mJ", ("kinetic_energy",), 1e3),
    Figure("Stretch", "%", ("stretch_rms", "stretch_max"), 100.0),
    Figure("Reach", "%", ("reach_max",), 100.0, limit=105.0),
)
LABELS = {"stretch_rms": "rms", "stretch_max": "largest", "reach_max": "largest", "kinetic_energy": "hair"}


@dataclass
class Plots:
    """Keeps what is measured and draws it. ``stages`` holds milliseconds by stage."""

    measured: dict[str, Series] = field(default_factory=dict)
    stages: dict[str, Series] = field(default_factory=dict)
    _time: float = 0.0

    def record(self, time: float, measures: dict[str, float], milliseconds: dict[str, float]) -> None:
        """Take the figures of one frame at simulated ``time`` [s]."""
        self._time = time
        for kept, figures in ((self.measured, measures), (self.stages, milliseconds)):
            for name, value in figures.items():
                kept.setdefault(name, Series()).add(time, value)

    def draw(self, ui: Ui, height: float) -> None:
        """All plots side by side over the width that is left."""
        gap = ui.px(10)
        width = (imgui.get_content_region_avail().x - gap * len(FIGURES)) / (len(FIGURES) + 1)
        with ui.within("Plots"):
            self._draw_stages(ui, width, height)
            for figure in FIGURES:
                imgui.same_line(0, gap)
                self._draw_figure(ui, figure, width, height)

    def _draw_stages(self, ui: Ui, width: float, height: float) -> None:
        total = sum(series.last for series in self.stages.values())
        with _Plot(ui, "Frame", f"{total:.1f} ms", width, height, self._time) as shown:
            if shown:
                names = sorted(self.stages, key=lambda name: -self.stages[name].last)
                for name, colour in zip(names, theme.SERIES):
                    series = self.stages[name]
                    label = f"{name.removeprefix('ms_')} {series.last:.1f}###{name}"
                    _line(label, *series.arrays, colour)

    def _draw_figure(self, ui: Ui, figure: Figure, width: float, height: float) -> None:
        known = [name for name in figure.names if name in self.measured]
        last = self.measured[known[-1]].last * figure.scale if known else 0.0
        with _Plot(ui, figure.title, f"{last:.4g} {figure.unit}", width, height, self._time) as shown:
            if not shown:
                return
            for name, colour in zip(known, theme.SERIES):
                times, values = self.measured[name].arrays
                _line(f"{LABELS[name]}###{name}", times, values * figure.scale, colour)
            if figure.limit is not None:
                spec = implot.Spec(line_color=theme.rgba(theme.ERROR, 0.6))
                spec.flags = implot.InfLinesFlags_.horizontal.value | implot.ItemFlags_.no_legend.value
                implot.plot_inf_lines("##limit", np.array([figure.limit]), spec)


class _Plot:
    """A plot under a heading; entering gives whether there is anything to draw on."""

    def __init__(self, ui: Ui, title: str, value: str, width: float, height: float, now: float) -> None:
        self._ui, self._title, self._value = ui, title, value
        self._size = (width, height)
        self._now = now

    def __enter__(self) -> bool:
        width, height = self._size
        imgui.begin_group()
        self._ui.caption(self._title)
        text = imgui.calc_text_size(self._value).x
        imgui.same_line(width - text)
        imgui.text_unformatted(self._value)
        left = height - imgui.get_text_line_height_with_spacing()
        flags = implot.Flags_.no_title.value | implot.Flags_.no_mouse_text.value | implot.Flags_.no_inputs.value
        flags |= implot.Flags_.no_menus.value | implot.Flags_.no_box_select.value
        self._shown = implot.begin_plot(f"##{self._title}", ImVec2(width, left), flags)
        if self._shown:
            axes = implot.AxisFlags_
            implot.setup_axis(implot.ImAxis_.x1.value, "", axes.no_decorations.value)
            implot.setup_axis(
                implot.ImAxis_.y1.value, "", axes.no_label.value | axes.no_tick_marks.value | axes.auto_fit.value
            )
            always = imgui.Cond_.always.value
            implot.setup_axis_limits(implot.ImAxis_.x1.value, self._now - WINDOW, self._now + 1e-3, always)
            implot.setup_legend(implot.Location_.north_west.value)
        return self._shown

    def __exit__(self, *_: object) -> None:
        if self._shown:
            implot.end_plot()
        imgui.end_group()
        self._ui.note(self._title)


def _line(label: str, times: Floats, values: Floats, colour: theme.Colour) -> None:
    implot.plot_line(label, times, values, implot.Spec(line_color=theme.rgba(colour), line_weight=1.5))
