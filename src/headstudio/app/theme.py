"""How the window looks: colours, spacing and type.

The surroundings stay neutral so that hair and skin are judged fairly; one warm accent, the colour of copper hair,
marks what is active.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from imgui_bundle import ImVec2, ImVec4, imgui, implot

Colour = tuple[float, float, float]


def _hex(text: str) -> Colour:
    return tuple(int(text[k : k + 2], 16) / 255 for k in (0, 2, 4))  # type: ignore[return-value]


INK = _hex("e8e4de")
MUTED = _hex("9b968d")
FAINT = _hex("6a675f")
ACCENT = _hex("d98f56")
ACCENT_DEEP = _hex("8f5a33")
GROUND = _hex("16171a")
PANEL = _hex("1f2024")
RAISED = _hex("2a2c31")
HOVER = _hex("373a41")
PRESSED = _hex("444851")
LINE = _hex("34363c")
GOOD = _hex("7fb685")
WARNING = _hex("e0b35a")
ERROR = _hex("e0705f")
SERIES = tuple(_hex(text) for text in ("d98f56", "6fa8c9", "8fb573", "c987b0", "d8c25f", "8d8fd6", "5fb5a5", "b9a48c"))

BODY_SIZE = 15.0


@dataclass(frozen=True)
class Fonts:
    """The typefaces in use. Icons are merged into ``body``."""

    body: imgui.ImFont
    strong: imgui.ImFont


def rgba(colour: Colour, alpha: float = 1.0) -> ImVec4:
    """A colour for ImGui."""
    return ImVec4(*colour, alpha)


def packed(colour: Colour, alpha: float = 1.0) -> int:
    """A colour for a draw list."""
    return imgui.color_convert_float4_to_u32(rgba(colour, alpha))


def apply(scale: float) -> Fonts:
    """Dress ImGui and ImPlot. ``scale``: window units for one unit of a plain screen."""
    _shapes(scale)
    _colours()
    _plots()
    return _fonts()


def rescale(before: float, after: float) -> None:
    """Change the size of everything, from one scale to another."""
    style = imgui.get_style()
    style.scale_all_sizes(after / before)
    style.font_scale_dpi = after


def _fonts() -> Fonts:
    folder = _bundled_fonts()
    atlas = imgui.get_io().fonts
    body = atlas.add_font_from_file_ttf(str(folder / "Roboto" / "Roboto-Regular.ttf"), BODY_SIZE)
    icons = imgui.ImFontConfig()
    icons.merge_mode = True
    icons.glyph_min_advance_x = BODY_SIZE
    atlas.add_font_from_file_ttf(str(folder / "Font_Awesome_6_Free-Solid-900.otf"), BODY_SIZE * 0.86, icons)
    strong = atlas.add_font_from_file_ttf(str(folder / "Roboto" / "Roboto-Bold.ttf"), BODY_SIZE)
    return Fonts(body, strong)


def _bundled_fonts() -> Path:
    """imgui-bundle ships Roboto and Font Awesome with their licences; there is no need for copies of our own."""
    spec = find_spec("imgui_bundle")
    assert spec is not None
    assert spec.origin is not None
    return Path(spec.origin).parent / "assets" / "fonts"


def _shapes(scale: float) -> None:
    style = imgui.get_style()
    style.font_size_base = BODY_SIZE
    style.window_padding = ImVec2(12, 10)
    style.frame_padding = ImVec2(8, 4)
    style.item_spacing = ImVec2(8, 6)
    style.item_inner_spacing = ImVec2(6, 4)
    style.cell_padding = ImVec2(4, 3)
    style.indent_spacing = 14
    style.scrollbar_size = 10
    style.grab_min_size = 10
    style.window_border_size = 0
    style.child_border_size = 0
    style.popup_border_size = 1
    style.frame_border_size = 0
    style.window_rounding = 0
    style.child_rounding = 6
    style.frame_rounding = 4
    style.popup_rounding = 6
    style.grab_rounding = 3
    style.scrollbar_rounding = 5
    style.tab_rounding = 4
    style.tab_bar_border_size = 0
    style.tab_bar_overline_size = 2
    style.separator_text_border_size = 1
    style.separator_text_padding = ImVec2(0, 6)
    style.scale_all_sizes(scale)
    style.font_scale_dpi = scale


def _colours() -> None:
    style = imgui.get_style()
    col = imgui.Col_
    plain = {
        col.text: INK,
        col.text_disabled: MUTED,
        col.window_bg: PANEL,
        col.popup_bg: _hex("26282d"),
        col.border: LINE,
        col.frame_bg: RAISED,
        col.frame_bg_hovered: HOVER,
        col.frame_bg_active: HOVER,
        col.title_bg: PANEL,
        col.title_bg_active: RAISED,
        col.menu_bar_bg: GROUND,
        col.scrollbar_grab: HOVER,
        col.scrollbar_grab_hovered: PRESSED,
        col.scrollbar_grab_active: ACCENT_DEEP,
        col.check_mark: ACCENT,
        col.checkbox_selected_bg: RAISED,
        col.slider_grab: ACCENT_DEEP,
        col.slider_grab_active: ACCENT,
        col.button: RAISED,
        col.button_hovered: HOVER,
        col.button_active: PRESSED,
        col.header: RAISED,
        col.header_hovered: HOVER,
        col.header_active: PRESSED,
        col.separator: LINE,
        col.separator_hovered: ACCENT_DEEP,
        col.separator_active: ACCENT,
        col.tab: GROUND,
        col.tab_hovered: HOVER,
        col.tab_selected: PANEL,
        col.tab_selected_overline: ACCENT,
        col.tab_dimmed: GROUND,
        col.tab_dimmed_selected: PANEL,
        col.plot_lines: ACCENT,
        col.plot_histogram: ACCENT,
        col.input_text_cursor: ACCENT,
        col.nav_cursor: ACCENT,
    }
    for index, colour in plain.items():
        style.set_color_(index.value, rgba(colour))
    clear = rgba(PANEL, 0.0)
    for index in (col.child_bg, col.scrollbar_bg, col.border_shadow, col.resize_grip):
        style.set_color_(index.value, clear)
    style.set_color_(col.text_selected_bg.value, rgba(ACCENT, 0.35))
    style.set_color_(col.modal_window_dim_bg.value, rgba(GROUND, 0.6))


def _plots() -> None:
    style = implot.get_style()
    style.plot_padding = ImVec2(6, 6)
    style.label_padding = ImVec2(4, 3)
    style.legend_padding = ImVec2(4, 4)
    style.legend_inner_padding = ImVec2(4, 2)
    style.plot_border_size = 0
    style.minor_alpha = 0.0
    col = implot.Col_
    for index, colour, alpha in (
        (col.frame_bg, PANEL, 0.0),
        (col.plot_bg, GROUND, 1.0),
        (col.plot_border, LINE, 1.0),
        (col.legend_bg, GROUND, 0.75),
        (col.legend_border, LINE, 0.0),
        (col.axis_text, MUTED, 1.0),
        (col.axis_grid, LINE, 0.8),
    ):
        style.set_color_(index.value, rgba(colour, alpha))
