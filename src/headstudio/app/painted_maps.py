"""The maps of hair that can be painted on the scalp: density, length and protrusion (Choe, Ko 2005, section 2.3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from imgui_bundle import icons_fontawesome_6 as icons

from ..head.length_maps import preset
from ..head.scalp_settings import GrayImage
from ..scene.document import Document
from ..wisp.maps import density_map, length_map, protrusion_map
from ..wisp.settings import WispSettings


@dataclass(frozen=True)
class PaintedMap:
    """A map of the document that can be painted.

    read: the map as it is, painted or one of those that ship. write: the document with another; None takes the painted one
    away. is_painted: whether there is one to be taken away.
    """

    label: str
    icon: str
    help: str
    read: Callable[[Document], GrayImage]
    write: Callable[[Document, GrayImage | None], Document]
    is_painted: Callable[[Document], bool]


def _of_wisps(label: str, icon: str, help_: str, read: Callable[[WispSettings], GrayImage], field: str) -> PaintedMap:
    def write(document: Document, image: GrayImage | None) -> Document:
        changed: dict[str, Any] = {field: image}
        return replace(document, wisp=replace(document.wisp, **changed))

    return PaintedMap(
        label,
        icon,
        help_,
        lambda document: read(document.wisp),
        write,
        lambda document: getattr(document.wisp, field) is not None,
    )


DENSITY = _of_wisps(
    "Density",
    icons.ICON_FA_SEEDLING,
    "Paint where hair grows densely; what is black grows none.",
    density_map,
    "painted_density",
)
LENGTH = _of_wisps(
    "Length",
    icons.ICON_FA_RULER_VERTICAL,
    "Paint how long hair is, as a part of the longest.",
    length_map,
    "painted_lengths",
)
PROTRUSION = _of_wisps(
    "Protrusion",
    icons.ICON_FA_UP_LONG,
    "Paint where hair stands up (bright) and where it lies on the scalp (dark).",
    protrusion_map,
    "painted_protrusion",
)
PARTICLE_LENGTH = PaintedMap(
    "Lengths",
    icons.ICON_FA_RULER_VERTICAL,
    "Paint how long hair is, as a part of the longest.",
    lambda document: document.scalp.painted_lengths or preset(document.scalp.length_map),
    lambda document, image: replace(document, scalp=replace(document.scalp, painted_lengths=image)),
    lambda document: document.scalp.painted_lengths is not None,
)
