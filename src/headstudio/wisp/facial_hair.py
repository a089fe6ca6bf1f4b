"""Hair of the face as hair of the head: which patches of skin carry it, and what wisps grow there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..head.mesh import Floats
from ..head.scalp_settings import GrayImage
from ..head.smooth import smoothstep
from .settings import FacialHairSettings, WispSettings
from .styling_settings import StylingSettings

_STUBBLE = 0.002  # [m]
_EDGE = 0.005  # over which hair of the face thins out [m]: its patches are narrow
_SIZE = 256
# The upper lip carries so much of all hair, and longer or shorter hair than the chin.
_MOUSTACHE_SHARE, _MOUSTACHE_LENGTH = 0.12, 0.45


@dataclass(frozen=True)
class FacialPatch:
    """Hair on one patch: a key of ``head.facial_hair.REGIONS``, its wisps and how they are styled."""

    region: str
    wisp: WispSettings
    styling: StylingSettings


# The patches of each style: the region, its density and its length map.
_STYLES: Mapping[str, tuple[tuple[str, str, str], ...]] = {
    "none": (),
    "stubble": (("beard", "soft edge", "even"), ("moustache", "soft edge", "even")),
    "moustache": (("moustache", "soft edge", "even"),),
    "goatee": (("beard", "chin only", "chin"), ("moustache", "soft edge", "even")),
    "beard": (("beard", "soft edge", "chin"),),
    "full beard": (("beard", "soft edge", "chin"), ("moustache", "soft edge", "even")),
}


def facial_patches(settings: FacialHairSettings) -> tuple[FacialPatch, ...]:
    """The patches of hair that the style consists of."""
    parts = _STYLES[settings.style]
    length = _STUBBLE if settings.style == "stubble" else settings.length
    styling = StylingSettings(bending_stiffness=settings.stiffness, parted=0.0, parting=0.0, off_face=0.0)
    patches = []
    for region, density, lengths in parts:
        share = 1.0 if len(parts) == 1 else _MOUSTACHE_SHARE if region == "moustache" else 1 - _MOUSTACHE_SHARE
        wisp = WispSettings(
            wisps=max(int(settings.strands * share / 30), 1),
            strands=max(round(settings.strands * share), 1),
            points=12,
            segments=8,
            length=max(length * (_MOUSTACHE_LENGTH if region == "moustache" else 1.0), 0.001),
            prototype=settings.prototype,
            curl_size=settings.curl_size,
            curl_length=settings.curl_length,
            straight_roots=0.25 * length,
            length_distribution="layered",
            deviation_radius="constant",
            fuzziness=settings.fuzziness,
            shaft_root=settings.shaft,
            shaft_tip=0.5 * settings.shaft,
            hairline=_EDGE,
            seed=settings.seed,
            protrusion=settings.protrusion,
            parting="none",
            painted_density=_map(density),
            painted_lengths=_map(lengths),
            painted_protrusion=_map("even"),
        )
        patches.append(FacialPatch(region, wisp, styling))
    return tuple(patches)


@lru_cache(maxsize=8)
def _map(name: str) -> GrayImage:
    centre = (np.arange(_SIZE) + 0.5) / _SIZE
    u, v = np.meshgrid(centre, centre)
    return GrayImage(_PATTERNS[name](np.abs(2 * u - 1), v).astype(np.float32))


def _soft_edge(aside: Floats, v: Floats) -> Floats:
    # Before the ears the patch is narrow.
    narrow = 1.0 - 0.75 * smoothstep(aside, 0.6, 0.85)
    return smoothstep(v / narrow, 0.0, 0.25) * smoothstep((1 - v) / narrow, 0.0, 0.12)


# Over (how far from the middle, v).
_PATTERNS = {
    "even": lambda aside, v: np.ones_like(v),
    "soft edge": _soft_edge,
    "chin only": lambda aside, v: smoothstep(-aside, -0.42, -0.34) * _soft_edge(aside, v),
    # Longest below the chin, short in front of the ears.
    "chin": lambda aside, v: (
        (0.25 + 0.75 * smoothstep(1 - aside, 0.2, 0.85)) * (0.6 + 0.4 * smoothstep(1 - v, 0.1, 0.6))
    ),
}
