"""Step 1: the maps of density, length and protrusion, and the parting (Choe, Ko 2005, section 2.3)."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from ...head.scalp_settings import GrayImage
from ...render.small_picture import SmallPicture
from .. import theme
from ..map_colours import map_colours
from ..painted_maps import DENSITY, LENGTH, PROTRUSION, PaintedMap
from ..parameter_rows import ParameterRows
from ..ui import Ui
from .hand import Hand
from .named import Named

_SIDE = 96  # pixels of a small picture of a map


class MapStep:
    """The three maps side by side as small pictures; a click takes the brush for one of them."""

    def __init__(self, rows: ParameterRows, hand: Hand) -> None:
        self.rows = rows
        self._hand = hand
        self._maps = (
            _Thumbnail(rows, hand, DENSITY, Named(rows, "density_map", "painted_density", "painted")),
            _Thumbnail(rows, hand, LENGTH, Named(rows, "length_map", "painted_lengths", "painted")),
            _Thumbnail(rows, hand, PROTRUSION, Named(rows, "protrusion_map", "painted_protrusion", "painted")),
        )
        self._parting = Named(rows, "parting", "parting_line", "drawn")

    def draw(self, ui: Ui) -> None:
        """Pictures, what scales them, and the parting."""
        gap = imgui.get_style().item_spacing.x
        width = (imgui.get_content_region_avail().x - 2 * gap) / 3
        corner = imgui.get_cursor_screen_pos()
        for k, thumbnail in enumerate(self._maps):
            imgui.set_cursor_screen_pos((corner.x + k * (width + gap), corner.y))
            thumbnail.draw(ui, width)
        self.rows.rows(ui, "wisp", ("length", "protrusion"))
        self._parting.row(ui)
        self.rows.row(ui, "wisp.parting_reach")
        self._hand.button(ui, "Parting", "Draw a parting", -1)


class _Thumbnail:
    """One map: its picture, and which of those that ship it is."""

    def __init__(self, rows: ParameterRows, hand: Hand, painted: PaintedMap, named: Named) -> None:
        self._studio = rows.studio
        self._hand = hand
        self._painted = painted
        self._named = named
        self._picture = SmallPicture(hand.viewport.renderer.context)
        self._shown: tuple[GrayImage, imgui.ImTextureRef] | None = None

    def draw(self, ui: Ui, width: float) -> None:
        imgui.begin_group()
        label = self._painted.label
        on = self._hand.holds(label)
        ui.caption(label)
        corner = imgui.get_cursor_screen_pos()
        far = (corner.x + width, corner.y + width)
        if imgui.invisible_button(f"##{label}", (width, width)):
            self._hand.take(label)
        hovered = imgui.is_item_hovered()
        ui.note(f"Paint {label.lower()}")
        ui.hint(f"{self._painted.help} Click, then paint on the head.")
        canvas = imgui.get_window_draw_list()
        canvas.add_image_rounded(self._texture(), (corner.x, corner.y), far, (0, 0), (1, 1), 0xFFFFFFFF, ui.px(4))
        if on or hovered:
            colour = theme.packed(theme.ACCENT if on else theme.INK)
            canvas.add_rect((corner.x, corner.y), far, colour, ui.px(4), ui.px(2))
        imgui.set_next_item_width(width)
        self._named.draw(ui)
        imgui.end_group()

    def _texture(self) -> imgui.ImTextureRef:
        image = self._painted.read(self._studio.document)
        if self._shown is None or self._shown[0] is not image:
            self._shown = image, imgui.ImTextureRef(self._picture.show(_pixels(image)))
        return self._shown[1]


def _pixels(image: GrayImage) -> NDArray[np.uint8]:
    """A map in colours, sRGB, no larger than a panel has room for."""
    rows, columns = (np.linspace(0, count - 1, min(count, _SIDE)).astype(int) for count in image.pixels.shape)
    values = image.pixels[np.ix_(rows, columns)].astype(np.float64)
    colours = map_colours(values.ravel()) ** (1 / 2.2)
    return (255 * colours.reshape(*values.shape, 3)).astype(np.uint8)
