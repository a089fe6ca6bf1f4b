"""The foot of the window: play, pause, step, reset, record, the clock, and the live plots."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from . import theme
from .editors import TimeStrip
from .plots import Plots
from .recorder import Recorder
from .studio import Studio
from .ui import Ui

LEAST_PLOTS = 84.0  # plots lower than this could not be read
SPEEDS = {"1/8": 0.125, "1/4": 0.25, "1/2": 0.5, "1": 1.0}


class Transport:
    """Draws the foot. ``ask_record`` starts or ends a recording."""

    def __init__(self, studio: Studio, recorder: Recorder, ask_record: Callable[[], None]) -> None:
        self._studio = studio
        self._recorder = recorder
        self._ask_record = ask_record
        self.plots = Plots()

    def draw(self, ui: Ui, timeline: TimeStrip | None = None) -> None:
        """The row of buttons, the ``timeline``, and the plots below in what height is left."""
        with ui.within("Transport"):
            self._draw_buttons(ui)
            self._draw_clock(ui)
        if timeline is not None:
            timeline.draw(ui)
        left = imgui.get_content_region_avail().y
        if left > ui.px(LEAST_PLOTS):
            self.plots.draw(ui, left)

    def _draw_buttons(self, ui: Ui) -> None:
        playback = self._studio.playback
        if ui.button(
            "Reset", "Everything back to rest (Home)", icon=icons.ICON_FA_BACKWARD_STEP, text="", width=ui.px(34)
        ):
            self._studio.reset()
        imgui.same_line()
        icon = icons.ICON_FA_PAUSE if playback.playing else icons.ICON_FA_PLAY
        if ui.button("Play", "Play or pause (Space)", icon=icon, text="", on=playback.playing, width=ui.px(46)):
            playback.toggle()
        imgui.same_line()
        if ui.button("Step", "One step of 1/60 s (Right)", icon=icons.ICON_FA_FORWARD_STEP, text="", width=ui.px(34)):
            playback.step()
        imgui.same_line(0, ui.px(20))
        self._draw_record(ui)

    def _draw_record(self, ui: Ui) -> None:
        recording = self._recorder.recording
        colour = theme.ERROR if recording else theme.INK
        imgui.push_style_color(imgui.Col_.text.value, theme.rgba(colour))
        icon = icons.ICON_FA_STOP if recording else icons.ICON_FA_CIRCLE
        text = f"{self._recorder.seconds:.1f} s" if recording else None
        if ui.button("Record", "Record a film (.mp4) or a folder of pictures", icon=icon, text=text, width=ui.px(96)):
            self._ask_record()
        imgui.pop_style_color()

    def _draw_clock(self, ui: Ui) -> None:
        playback = self._studio.playback
        imgui.same_line(0, ui.px(20))
        imgui.set_next_item_width(ui.px(78))
        names = list(SPEEDS)
        present = next((k for k, speed in enumerate(SPEEDS.values()) if speed == playback.speed), len(names) - 1)
        _, chosen = imgui.combo("##Speed", present, [f"{name} x" for name in names])
        playback.speed = SPEEDS[names[chosen]]
        ui.note("Speed")
        ui.hint("How fast time runs")
        imgui.same_line(0, ui.px(20))
        imgui.align_text_to_frame_padding()
        imgui.text_unformatted(f"{self._studio.time:7.2f} s")
        ui.note("Time")
        if playback.playing:
            imgui.same_line()
            ui.muted(f"{playback.pace:.2f} x real time")
