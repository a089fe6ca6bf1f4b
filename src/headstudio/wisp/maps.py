"""Density, length and protrusion maps over the scalp square (Choe, Ko 2005, section 2.3), and the ones that ship.

u runs from the person's right to the left, v from the forehead to the nape; the square's corners are the tips of the
sideburns and the corners of the nape.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache

import numpy as np

from ..head.mesh import Floats
from ..head.scalp_settings import GrayImage
from ..head.smooth import smoothstep
from .settings import WispSettings

SIZE = 256

Pattern = Callable[[Floats, Floats], Floats]


def density_map(settings: WispSettings) -> GrayImage:
    """Where hair grows densely: the painted map, or the named one."""
    return settings.painted_density or _drawn("density", settings.density_map)


def length_map(settings: WispSettings) -> GrayImage:
    """Length as a part of the longest hair: the painted map, or the named one."""
    return settings.painted_lengths or _drawn("length", settings.length_map)


def protrusion_map(settings: WispSettings) -> GrayImage:
    """Elevation of hair over the scalp as a part of a right angle: the painted map, or the named one."""
    return settings.painted_protrusion or _drawn("protrusion", settings.protrusion_map)


@lru_cache(maxsize=64)
def _drawn(kind: str, name: str) -> GrayImage:
    centre = (np.arange(SIZE) + 0.5) / SIZE
    u, v = np.meshgrid(centre, centre)
    return GrayImage(np.broadcast_to(_PATTERNS[kind][name](u, v), u.shape).astype(np.float32))


def _aside(u: Floats) -> Floats:
    """How far from the middle line: 0 in the middle, 1 at the ears."""
    return np.abs(2 * u - 1)


def _top(u: Floats, v: Floats, width: float, back: float, soft: float = 0.12) -> Floats:
    """1 on top of the head, as far aside as ``width`` and as far back as ``back``, 0 around it."""
    return smoothstep(-_aside(u), -width - soft, -width + soft) * smoothstep(-v, -back - soft, -back + soft)


def _temples(u: Floats, v: Floats) -> Floats:
    """1 in the bays beside the forehead, where a hairline recedes."""
    bay = np.exp(-(((_aside(u) - 0.42) / 0.16) ** 2) - (v / 0.2) ** 2)
    return smoothstep(bay, 0.25, 0.6)


def _crown(u: Floats, v: Floats) -> Floats:
    """1 around the whorl, 0 away from it."""
    return smoothstep(-np.hypot(1.2 * (u - 0.5), v - 0.42), -0.24, -0.12)


def _even(u: Floats, v: Floats) -> Floats:
    return np.ones_like(u)


_DENSITY: Mapping[str, Pattern] = {
    "even": _even,
    "thinning": lambda u, v: 1 - 0.75 * _top(u, v, 0.35, 0.45, 0.25),
    "receding": lambda u, v: 1 - _temples(u, v),
    "bald crown": lambda u, v: 1 - _crown(u, v),
    "undercut": lambda u, v: 0.3 + 0.7 * _top(u, v, 0.42, 0.5, 0.03),
    "mohawk": lambda u, v: _top(u, v, 0.13, 1.2, 0.03),
    "monk": lambda u, v: 1 - smoothstep(-np.hypot(u - 0.5, 0.9 * (v - 0.34)), -0.33, -0.31),
}


def _fringe(u: Floats, v: Floats) -> Floats:
    # A fringe ends at the brows: what stands further back may be longer by the way it has to go.
    over_forehead = 0.2 + 0.2 * smoothstep(v, 0.03, 0.2)
    kept = np.maximum(smoothstep(v, 0.14, 0.3), smoothstep(_aside(u), 0.42, 0.6))
    return over_forehead + (1 - over_forehead) * kept


def _bob(u: Floats, v: Floats) -> Floats:
    # Cut at one height, so that hair which starts higher on the head is longer.
    height = np.sin(np.pi * np.clip(v / 0.9, 0, 1)) ** 0.7 * (1 - 0.55 * _aside(u) ** 2)
    return 0.5 + 0.5 * height


def _round(u: Floats, v: Floats) -> Floats:
    # Cut to a ball: hair that stands at the rim of the scalp would reach out over face, ears and nape. It rounds off to
    # the nape, where a ball curves in.
    rim = np.minimum(np.minimum(v, 1 - v), 0.5 - np.abs(u - 0.5))
    return (0.42 + 0.58 * smoothstep(rim, 0.0, 0.3)) * (1 - 0.5 * smoothstep(v, 0.55, 1.0))


def _short_back_and_sides(u: Floats, v: Floats) -> Floats:
    top = _top(u, v, 0.42, 0.48, 0.22)
    return 0.14 + 0.16 * (1 - smoothstep(np.maximum(_aside(u), v), 0.45, 0.95)) + 0.7 * top


def _mohawk(u: Floats, v: Floats) -> Floats:
    # A crest is highest in the middle, and falls off to the nape.
    crest = 1 - 0.5 * smoothstep(_aside(u), 0.0, 0.16)
    return 0.02 + 0.98 * _top(u, v, 0.13, 1.2, 0.03) * crest * (1 - 0.55 * smoothstep(v, 0.35, 1.0))


_LENGTH: Mapping[str, Pattern] = {
    "even": _even,
    "fringe": _fringe,
    "bob": _bob,
    "round": _round,
    "layered": lambda u, v: 0.72 + 0.28 * smoothstep(v, 0.1, 0.75),
    "long back": lambda u, v: 0.1 + 0.9 * smoothstep(v, 0.3, 0.65),
    "short back and sides": _short_back_and_sides,
    "top knot": lambda u, v: 0.03 + 0.97 * _top(u, v, 0.5, 0.5, 0.04),
    "undercut": lambda u, v: 0.03 + 0.97 * _top(u, v, 0.42, 0.5, 0.03),
    "mohawk": _mohawk,
    "mullet": lambda u, v: 0.18 + 0.1 * _top(u, v, 0.4, 0.4) + 0.72 * smoothstep(v, 0.55, 0.8),
    "crop": lambda u, v: 0.5 + 0.5 * _top(u, v, 0.45, 0.45, 0.3),
}

_PROTRUSION: Mapping[str, Pattern] = {
    "flat": lambda u, v: 0.08 * _even(u, v),
    "natural": lambda u, v: 0.22 + 0.2 * _top(u, v, 0.45, 0.55, 0.3),
    "lifted front": lambda u, v: 0.2 + 0.6 * _top(u, v, 0.5, 0.15, 0.15),
    "full crown": lambda u, v: 0.25 + 0.5 * _crown(u, v),
    "standing": _even,
}

_PATTERNS: Mapping[str, Mapping[str, Pattern]] = {"density": _DENSITY, "length": _LENGTH, "protrusion": _PROTRUSION}
