"""The left side: the tool in the hand, what the head does, the wind, and what is shown."""

from __future__ import annotations

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from . import compass
from .editors import Editor
from .parameter_rows import ParameterRows, defaults
from .tools.tool import Tool
from .ui import Ui
from .viewport import Viewport

MOTIONS = {
    "rest": icons.ICON_FA_PAUSE,
    "turn": icons.ICON_FA_ROTATE,
    "nod": icons.ICON_FA_UP_DOWN,
    "shake": icons.ICON_FA_LEFT_RIGHT,
    "tilt": icons.ICON_FA_ARROWS_SPIN,
}
COLUMNS = 2


class Sidebar:
    """Draws the left side."""

    def __init__(self, rows: ParameterRows, viewport: Viewport) -> None:
        self.rows = rows
        self.viewport = viewport

    def draw(self, ui: Ui, editor: Editor, tools: list[Tool]) -> None:
        """All of it, in the current ImGui window. ``tools`` are those of the open ``editor``."""
        self._draw_tools(ui, tools)
        self._draw_motion(ui)
        if editor.hair_as == "particles":
            self._draw_wind(ui)
        self._draw_shown(ui, editor)

    def _draw_tools(self, ui: Ui, tools: list[Tool]) -> None:
        with ui.section("Tools") as shown:
            if not shown:
                return
            for k, tool in enumerate(tools):
                _next_cell(k)
                if ui.button(
                    tool.label, tool.help, icon=tool.icon, on=tool is self.viewport.tool, width=_cell_width(k)
                ):
                    self.viewport.tool = tool
            imgui.push_text_wrap_pos(0)
            ui.muted(self.viewport.tool.help)
            imgui.pop_text_wrap_pos()
            self.viewport.tool.options(ui)

    def _draw_motion(self, ui: Ui) -> None:
        present = self.rows.studio.document.motion.kind
        with ui.section("Motion") as shown:
            if not shown:
                return
            for k, (kind, icon) in enumerate(MOTIONS.items()):
                _next_cell(k)
                if ui.button(kind.capitalize(), icon=icon, on=kind == present, width=_cell_width(k)):
                    self.rows.set("motion.kind", kind)
                    self.rows.studio.playback.playing = True
            self.rows.row(ui, "motion.angle")
            self.rows.row(ui, "motion.rate")

    def _draw_wind(self, ui: Ui) -> None:
        wind = self.rows.studio.document.wind
        with ui.section("Wind") as shown:
            if not shown:
                return
            text, help_ = "On" if wind.on else "Off", defaults()["wind.on"][0].doc
            if ui.button("Blow", help_, icon=icons.ICON_FA_WIND, text=text, on=wind.on, width=ui.px(76)):
                self.rows.set("wind.on", not wind.on)
            imgui.same_line(imgui.get_content_region_avail().x - ui.px(2 * compass.RADIUS))
            strength = wind.speed / (defaults()["wind.speed"][0].high or 1.0)
            heading = compass.draw(ui, wind.heading, strength, on=wind.on)
            if heading is not None:
                self.rows.set("wind.heading", heading)
            for name in ("speed", "gusts", "drag"):
                self.rows.row(ui, f"wind.{name}")

    def _draw_shown(self, ui: Ui, editor: Editor) -> None:
        with ui.section("Show") as shown:
            if not shown:
                return
            width = imgui.get_content_region_avail().x
            for k, name in enumerate(editor.shown):
                if k % COLUMNS:
                    imgui.same_line(imgui.get_style().window_padding.x + width / COLUMNS)
                self.rows.tick(ui, f"look.{name}")
            self.rows.rows(ui, "look", editor.views)
            if editor.hair_as == "particles":
                imgui.separator()
                self.rows.tick(ui, "lcp.interactions")


def _next_cell(k: int) -> None:
    if k % COLUMNS:
        imgui.same_line()


def _cell_width(k: int) -> float:
    """The width of a button in a grid: the first takes its share, the last what is left."""
    left = imgui.get_content_region_avail().x
    gaps = imgui.get_style().item_spacing.x * (COLUMNS - 1 - k % COLUMNS)
    return (left - gaps) / (COLUMNS - k % COLUMNS)
