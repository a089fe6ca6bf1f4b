"""Furrows for a scan: found as its valleys over the skin, then moved and sized until the skin they make lies on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from ..head.mesh import Floats, TriangleMesh
from .bezier import fit_stroke
from .cross_section import control_heights, cross_section, half_width
from .groove import Groove
from .groove_fit import GrooveFit
from .scan_heights import ScanHeights, SkinTexels
from .skin_layout import SkinLayout
from .valley_lines import ValleyLine, valley_lines
from .valleys import valley_field

# A change of shape is smooth over this [m]. When half of what is beside grooves is nearer than this [m], scan and skin count
# as one shape: grooves alone leave 0.06 to 0.11 mm there, MakeHuman's old beside his young head 0.34 mm.
_SMOOTH, _SAME_SHAPE = 0.014, 2e-4
# Texels that tell this much of it lie beside grooves; under one and its rims they tell so much.
_FREE, _UNDER = 0.5, 0.02
# Less than this part of the scan beside grooves tells nothing about it.
_TELLING = 0.05
# A groove and its rims lie within so many widths, its floor within so many.
_FOOT, _FLOOR = 4.0, 1.5
# Where grooves run into each other they seem to have no end: none is wider than this [m].
_WIDEST = 5e-3
# A valley stands out when it is so many times the noise deep, this deep [m] and this part of the deepest.
_OVER_NOISE, _SHALLOWEST, _PART = 4.0, 2.5e-4, 0.07
# What was missed counts from this part of that depth on, and of the length that it takes else.
_SMALLER = 0.6
# A first curve passes this near the valley [m]. It ends where less than this part of the depth is left.
_TOLERANCE, _ENDS = 3e-4, 0.25
# The sides of a valley are this many widths of the filter that found it away; a furrow's w is this part of that width.
_SIDES, _WIDTH = 2.2, 1.2
# Furrows that are shallower [m] or, end to end, shorter [m] than this are left out.
_FAINT, _SHORT = 5e-5, 8e-3
# What a groove costs [m^3]: the room between skin and scan is to be smaller by more, with it, than without it. Whether others
# can make good for one is tried when by itself it is worth less than so many times that.
_PRICE, _DOUBTED = 2.2e-9, 10.0
# Where sections are looked at, other grooves make at most this part of the depth; later on whatever they do.
_CLEAR, _ANYWHERE = 0.12, np.inf
# The curve of a groove is cut into pieces no longer than this [m], to follow how it wanders.
_PIECE = 0.014
# Sweeps for single shapes, for cross sections, and again with grooves that were missed.
_STEPS = (3, 10, 6)
# Steps end when all grooves together bring less than this part, and for one that brings less than this.
_SETTLED, _STILL = 4e-3, 3e-4
# The last are done again, at most so often, until a round brings less than this part.
_ROUNDS, _SETTLED_ROUND = 3, 0.012
_LAST = 6
# Where less than this part of a groove is there, it ends.
_OUT = 0.06
# The depth of a groove may be another this far along it [m].
_SWELL = 8e-3
# Differences of this size [m] have half the say in what is a smooth change of shape.
_ODD = 6e-4

Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class FurrowFit:
    """What was found.

    grooves: curves with their furrows. motion: how the scan was moved to lie better on them, (4, 4). smooth: the smooth
    change of shape at every texel that was taken off the scan [m], (k,); zero where there is none. texels: of the skin.
    left: heights that remain [m], (k,), nan where the scan is not.
    """

    grooves: tuple[Groove, ...]
    motion: Floats
    smooth: Floats
    texels: SkinTexels
    left: Floats


def fit_grooves(layout: SkinLayout, scan: TriangleMesh, progress: Progress = lambda what, part: None) -> FurrowFit:
    """Furrows that make the skin of ``layout`` look like ``scan``, given in its frame [m].

    progress: told what is being done and how much is done already, 0 to 1. The same scan gives the same furrows. A scan
    that covers nothing, or has no valley, gives none.
    """
    progress("measuring the scan", 0.0)
    raw = ScanHeights.measured(layout, scan)
    texels = raw.texels
    if not raw.covered.any():
        return FurrowFit((), np.eye(4), np.zeros_like(raw.height), texels, raw.height)
    everywhere = np.ones_like(raw.height)
    progress("looking for valleys", 0.03)
    grooves = _first_grooves(raw.without(raw.low_pass(_SMOOTH, everywhere)))
    fit = GrooveFit(raw, grooves)
    # A groove that gives more than its rims take lowers the skin on the whole: only what lies beside grooves tells.
    beside = _beside(fit)
    smooth = _notable(change_of_shape(raw, fit.height, beside), raw, beside)
    fit = GrooveFit(raw.without(smooth), grooves)
    _steps(fit, _STEPS[0], progress, "laying furrows", 0.06, 0.2)

    # Single shapes leave what grooves give besides, so that still only the rest of the skin tells.
    beside = _beside(fit)
    smooth = _notable(change_of_shape(raw, fit.height, beside), raw, beside)
    progress("matching their cross sections", 0.2)
    # Before sections are met, what single shapes leave beside grooves looks like valleys, too.
    fit = _with_sections(_pruned(GrooveFit(raw.without(smooth), fit.grooves)), _CLEAR)
    _steps(fit, _STEPS[1], progress, "moving and sizing them", 0.25, 0.45)

    for k in range(_ROUNDS):
        start, end = (0.45 + 0.52 * part / _ROUNDS for part in (k, k + 1))
        progress("looking for what was missed", start)
        missed = _first_grooves(fit.heights.without(fit.height), _SMALLER)
        # Now that others are nearly right, sections can be seen between them.
        known = [] if k == 0 else _trimmed(fit)
        tried = fit.replaced(
            [*known, *_with_sections(fit.replaced([*fit.grooves, *missed]), _ANYWHERE).grooves[len(known) :]]
        )
        # Those that are new show what they are worth once they have taken their first steps.
        tried.sweep(range(len(fit.grooves), len(tried.grooves)))
        tried = _pruned(tried)
        _steps(tried, _STEPS[2], progress, "moving and sizing them", start, end, rigid=True)
        tried = _thinned(tried)
        fell = 1.0 - _price(tried) / _price(fit)
        if fell > 0:
            fit = tried
        if fell < _SETTLED_ROUND:
            break
    fit = fit.replaced(_trimmed(fit))
    _steps(fit, _LAST, progress, "moving and sizing them", 0.97, 1.0)
    progress("done", 1.0)
    return FurrowFit(tuple(fit.grooves), fit.motion, smooth, texels, fit.left)


def _steps(
    fit: GrooveFit, most: int, progress: Progress, what: str, start: float, end: float, rigid: bool = False
) -> None:
    moving = None
    for k in range(most):
        progress(what, start + (end - start) * k / most)
        fell = fit.sweep(moving)
        if rigid:
            fit.let_scan_move()
        if fell.sum() < _SETTLED:
            break
        # Those that lie well are left alone.
        moving = np.flatnonzero(fell > _STILL)


def _first_grooves(heights: ScanHeights, part: float = 1.0) -> list[Groove]:
    """A furrow for every valley of a scan, nearly where it runs, nearly as deep and wide.

    part: of what it takes else, in depth and in length, for a valley to count.
    """
    field = valley_field(heights)
    least = part * max(_OVER_NOISE * heights.noise, _SHALLOWEST, _PART * float(field.depth.max(initial=0.0)))
    lines = valley_lines(field, least, part * _SHORT)
    grooves = [_first_groove(heights, line, part * _SHORT) for line in lines]
    return [groove for groove in grooves if groove is not None]


def _first_groove(heights: ScanHeights, line: ValleyLine, shortest: float) -> Groove | None:
    """A furrow along a valley, without the ends where it has run out."""
    texels = heights.texels
    places = ndimage.gaussian_filter1d(line.points, 1.2, axis=0, mode="nearest")
    along = np.gradient(places, axis=0)
    aside = np.stack([-along[:, 1], along[:, 0]], axis=1)
    aside *= _SIDES * line.width / texels.metres / np.maximum(np.linalg.norm(aside, axis=1, keepdims=True), 1e-12)

    def height(at: Floats) -> Floats:
        return ndimage.map_coordinates(heights.filled, (at[:, ::-1] - 0.5).T, order=1, mode="nearest")

    depth = 0.5 * (height(places + aside) + height(places - aside)) - height(places)
    deep = np.flatnonzero(depth > _ENDS * np.median(depth))
    if len(deep) < 4:
        return None
    kept = slice(deep[0], deep[-1] + 1)
    length = np.linalg.norm(np.diff(places[kept], axis=0), axis=1).sum() * texels.metres
    if length < shortest:
        return None
    chain = fit_stroke(places[kept] / texels.size, _TOLERANCE / texels.layout.texture_map.metres)
    return Groove(chain.controls, _WIDTH * line.width, max(float(np.median(depth[kept])), _FAINT))


def change_of_shape(raw: ScanHeights, model: Floats | None = None, weight: Floats | None = None) -> Floats:
    """The smooth part of what ``model`` [m], (k,), leaves of a scan [m], (k,): what it differs by besides wrinkles.

    weight: how much each texel says about it, (k,); places that stand out say little.
    """
    left = raw if model is None else raw.without(model)
    weight = np.ones_like(raw.height) if weight is None else weight
    smooth = left.low_pass(_SMOOTH, weight)
    for _ in range(3):
        off = np.nan_to_num(left.height - smooth)
        smooth = left.low_pass(_SMOOTH, weight / (1.0 + (off / _ODD) ** 2))
    return smooth


def _beside(fit: GrooveFit) -> Floats:
    """How much each texel tells about a smooth change of shape, (k,): little where a groove or its rims may be."""
    beside = np.ones(len(fit.heights.height))
    for bed in fit.beds:
        beside[bed.rows[np.abs(bed.across) < _FOOT * bed.groove.width]] = _UNDER
    return beside


def _notable(smooth: Floats, raw: ScanHeights, beside: Floats) -> Floats:
    """A smooth change of shape, (k,), or none where half of what lies ``beside`` grooves, (k,), is too near for one.

    The smooth change itself cannot tell: where grooves are close together it is what these give, on the whole. Nor can a few
    places that wide grooves leave.
    """
    free = np.abs(raw.height[raw.covered & (beside > _FREE)])
    enough = len(free) > _TELLING * raw.covered.sum()
    return smooth if enough and np.median(free) > _SAME_SHAPE else np.zeros_like(smooth)


def _pruned(fit: GrooveFit) -> GrooveFit:
    """The fit without grooves that hardly bring the skin nearer."""
    return fit.replaced([groove for groove, gain in zip(fit.grooves, fit.worth()) if gain > _PRICE])


def _price(fit: GrooveFit) -> float:
    """The room that a fit leaves between skin and scan, and what its grooves cost [m^3]."""
    return fit.area * fit.cost + _PRICE * len(fit.grooves)


def _thinned(fit: GrooveFit) -> GrooveFit:
    """The fit without grooves that others can make good for, nearly: one line of a scan is one furrow where one will do."""
    share = 0.5
    while True:
        worth = fit.worth()
        doubted = np.argsort(worth)[: int((worth < _DOUBTED * _PRICE).sum())]
        count = int(np.ceil(share * len(doubted)))
        if not count:
            return fit
        out = doubted[:count]
        kept = np.setdiff1d(np.arange(len(worth)), out)
        touched = np.isin(kept, fit.beside(out)).nonzero()[0]
        tried = fit.replaced([fit.grooves[k] for k in kept])
        for _ in range(_STEPS[0]):
            tried.sweep(touched)
        if _price(tried) < _price(fit):
            fit = tried
        elif count == 1:
            return fit
        else:
            share *= 0.5


def _trimmed(fit: GrooveFit) -> list[Groove]:
    """The grooves without ends that do not show or leave the scan: nothing holds them, and they wind about."""
    return [bed.groove.trimmed(bed.arc_at, fit.seen(bed.groove), _OUT) for bed in fit.beds]


def _with_sections(fit: GrooveFit, clear: float) -> GrooveFit:
    """Each groove with the cross section that the scan has there, and free to swell along its way.

    clear: other grooves may make so much of the depth [m] where sections are looked at.
    """
    grooves = []
    for bed in fit.beds:
        groove = bed.groove.subdivided(_PIECE / bed.length)
        own = bed.heights()[0]
        others = fit.height[bed.rows] - own
        height = fit.heights.height[bed.rows]
        seen = cross_section(bed.across, height, others, bed.wholeness(), clear * groove.floor)
        if seen.told:
            width = min(half_width(seen, _FLOOR * groove.width), _WIDEST)
            section = control_heights(seen, width) / groove.depth
            swell = groove.swell or (1.0,) * int(np.clip(bed.length / _SWELL, 3, 12))
            groove = replace(groove, width=width, section=tuple(section.tolist()), swell=swell)
        grooves.append(groove)
    return fit.replaced(grooves)
