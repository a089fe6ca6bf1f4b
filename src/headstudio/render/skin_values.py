"""Figures of a living skin as colours on it, for whoever tunes wrinkles: what ``look.skin_shows`` names."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from ..wrinkle.limb_skin import PosedLimb
from ..wrinkle.living_skin import LivingSkin
from .scene_block import linear
from .skin_colour import web_colour

# Ends of the scales: area doubled or halved, lengths by a quarter, and displacement of so many metres.
_SHRINKAGE = 0.25
_HEIGHT = 0.0015
# A furrow's own figures are shown this far to its sides, in widths, and run out into those of the skin around it.
_BESIDE = 3.0

# Blue below, white for nothing, red above (two ends equally dark); and from dark to light for what begins at 0.
_DIVERGING = ("#1d4f91", "#5d96c8", "#b8d3e6", "#f2f0ec", "#f0bfa4", "#d36f5b", "#8e1b34")
_RISING = ("#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725")


def shown_values(shows: str, skin: LivingSkin) -> Floats:
    """Where every vertex stands on the scale of ``Look.skin_shows``, 0 to 1, (N,). Skin as it is has its expansion, which
    moves its blood."""
    match shows:
        case "shrinkage":
            return 0.5 + 0.5 * _shrinkage(skin) / _SHRINKAGE
        case "amplitude":
            return _furrow_values(skin, skin.skin.amplitude, skin.amplitudes.mean(axis=1) * skin.surface.mapped)
        case "height":
            return 0.5 + 0.5 * skin.skin.height / _HEIGHT
        case _:
            return _expansion(skin.expansion)


def limb_values(shows: str, limb: PosedLimb) -> Floats:
    """The same of a limb, (k,), which has only fine wrinkles."""
    match shows:
        case "shrinkage":
            return 0.5 + 0.5 * _larger(limb.shrinkage) / _SHRINKAGE
        case "amplitude":
            return limb.amplitudes.mean(axis=1)
        case "height":
            return np.full(len(limb.positions), 0.5)
        case _:
            return _expansion(limb.expansion)


def scale_colours(shows: str, count: int = 256) -> Floats:
    """The colours of a scale, linear RGB, (count, 3)."""
    stops = _RISING if shows == "amplitude" else _DIVERGING
    colours = np.array([linear(web_colour(stop)) for stop in stops])
    place = np.linspace(0, len(stops) - 1, count)
    return np.stack([np.interp(place, np.arange(len(stops)), colours[:, k]) for k in range(3)], axis=1)


def scale_ends(shows: str) -> tuple[str, str, str]:
    """What the lower end, the middle and the upper end of a scale stand for."""
    match shows:
        case "shrinkage":
            return f"{-100 * _SHRINKAGE:.0f} %", "0", f"{100 * _SHRINKAGE:.0f} %"
        case "amplitude":
            return "0", "0.5", "1"
        case "height":
            return f"{-1e3 * _HEIGHT:.1f} mm", "0", f"{1e3 * _HEIGHT:.1f} mm"
        case _:
            return "half the area", "1", "twice"


def _expansion(ratio: Floats) -> Floats:
    """Half the area is 0, twice the area is 1."""
    return 0.5 + 0.5 * np.log2(np.maximum(ratio, 1e-3))


def _shrinkage(skin: LivingSkin) -> Floats:
    """Across the furrow where there is one, across the fine wrinkles elsewhere, (N,)."""
    surface = skin.surface
    everywhere = np.zeros(len(skin.posed))
    if surface.fine is not None:
        part = surface.bed.layout.part.vertices
        everywhere[part] = _larger(surface.fine.growth.shrinkage(skin.posed[part]))
    return _furrow_values(skin, skin.skin.shrinkage, surface.spread(everywhere))


def _larger(fields: Floats) -> Floats:
    """Of the shrinkage across both fields, (n, 2), the one that is larger in size, (n,)."""
    return np.where(np.abs(fields[:, 0]) > np.abs(fields[:, 1]), fields[:, 0], fields[:, 1])


def _furrow_values(skin: LivingSkin, of_entries: Floats, elsewhere: Floats) -> Floats:
    """Values of the bed's entries, (i,), at their vertices, of the nearest furrow where there are several; (N,)."""
    bed = skin.surface.bed
    widths = np.array([laid.furrow.width for laid in bed.furrows])[bed.furrow]
    near = np.clip(1.0 - bed.beside.distance / (_BESIDE * widths), 0.0, 1.0)
    nearest_last = np.argsort(near, kind="stable")
    at = bed.vertex[nearest_last]
    values = elsewhere.copy()
    mixed = elsewhere[bed.vertex] + near * (of_entries - elsewhere[bed.vertex])
    values[at] = mixed[nearest_last]
    return values
