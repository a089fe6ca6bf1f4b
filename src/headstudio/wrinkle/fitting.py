"""Furrows for a scan: found as its valleys over the skin, then moved and sized until the skin they make lies on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from ..head.mesh import Floats, TriangleMesh
from .bezier import fit_stroke
from .cross_section import cross_section, strands_for
from .groove import Groove, Strand
from .groove_fit import GrooveFit, uprightness
from .scan_heights import ScanHeights, SkinTexels
from .skin_layout import SkinLayout
from .valley_lines import ValleyLine, valley_lines
from .valleys import DENTS, valley_field

# A change of shape is smooth over this [m]. Below this much of it beside the grooves [m], scan and skin count as one shape.
_SMOOTH, _SAME_SHAPE = 0.014, 2.5e-4
# A valley stands out when it is so many times the noise deep, this deep [m] and this part of the deepest.
_OVER_NOISE, _SHALLOWEST, _PART = 4.0, 2.5e-4, 0.07
# A first curve passes this near the valley [m]. It ends where less than this part of the depth is left.
_TOLERANCE, _ENDS = 3e-4, 0.25
# The sides of a valley are this many widths of the filter that found it away; a furrow's w is this part of that width.
_SIDES, _WIDTH = 2.2, 1.2
# Furrows that are shallower [m] or, end to end, shorter [m] than this are left out.
_FAINT, _SHORT = 5e-5, 8e-3
# Dents beside grooves are smooth over this [m], at least this deep [m] and no more than this many at a time.
_DENT, _DENT_DEPTH, _DENTS = 4e-3, 1e-4, 6
# A groove that brings the skin nearer by less than this part is left out; a furrow that is wider than this [m] is a dent.
_WORTH, _BROAD = 0.004, 5e-3
# Where sections are looked at, other grooves make at most this part of the depth; later on whatever they do.
_CLEAR, _ANYWHERE = 0.12, np.inf
# The curve of a groove is cut into pieces no longer than this [m], to follow how it wanders.
_PIECE = 0.014
# Sweeps for single furrows, again with those that were missed, and twice for furrows side by side.
_STEPS = (3, 2, 5, 10)
_SETTLED = 4e-3
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
    texels = SkinTexels.of(layout)
    progress("measuring the scan", 0.0)
    raw = ScanHeights.measured(texels, scan)
    if not raw.covered.any():
        return FurrowFit((), np.eye(4), np.zeros_like(raw.height), texels, raw.height)
    everywhere = np.ones_like(raw.height)
    progress("looking for valleys", 0.03)
    grooves = _first_grooves(raw.without(raw.low_pass(_SMOOTH, everywhere)))
    # As long as grooves are not fitted, the skin beside them tells.
    model = GrooveFit(raw, grooves).height
    beside = np.where(np.abs(model) > _FAINT, 0.02, 1.0)
    smooth = _notable(change_of_shape(raw, model, beside), raw, beside)
    fit = GrooveFit(raw.without(smooth), grooves)
    _steps(fit, _STEPS[0], progress, "laying furrows", 0.06, 0.2)

    smooth = _notable(change_of_shape(raw, fit.height), raw, beside)
    fit = _pruned(GrooveFit(raw.without(smooth), fit.grooves))
    fit = fit.replaced([*fit.grooves, *_first_grooves(fit.heights.without(fit.height))])
    _steps(fit, _STEPS[1], progress, "laying those that were missed", 0.2, 0.35)

    progress("matching their cross sections", 0.35)
    fit = _side_by_side(_pruned(fit), _CLEAR)
    fit = fit.replaced([*fit.grooves, *_dents(fit)])
    _steps(fit, _STEPS[2], progress, "moving and sizing them", 0.4, 0.65)
    progress("matching their cross sections", 0.65)
    # Now that others are nearly right, sections can be seen between them.
    fit = _side_by_side(_pruned(fit), _ANYWHERE)
    fit = fit.replaced([*fit.grooves, *_dents(fit)])
    _steps(fit, _STEPS[3], progress, "moving and sizing them", 0.7, 1.0, rigid=True)
    fit = _pruned(fit)
    progress("done", 1.0)
    return FurrowFit(tuple(fit.grooves), fit.motion, smooth, texels, fit.left)


def _steps(
    fit: GrooveFit, most: int, progress: Progress, what: str, start: float, end: float, rigid: bool = False
) -> None:
    for k in range(most):
        progress(what, start + (end - start) * k / most)
        fell = fit.sweep()
        if rigid:
            fit.let_scan_move()
        if fell < _SETTLED:
            break


def _first_grooves(heights: ScanHeights) -> list[Groove]:
    """A furrow for every valley of a scan, nearly where it runs, nearly as deep and wide."""
    field = valley_field(heights)
    least = max(_OVER_NOISE * heights.noise, _SHALLOWEST, _PART * float(field.depth.max(initial=0.0)))
    grooves = [_first_groove(heights, line) for line in valley_lines(field, least)]
    return [groove for groove in grooves if groove is not None]


def _dents(fit: GrooveFit) -> list[Groove]:
    """Broad shallow furrows where the skin beside grooves lies lower than these leave it."""
    left = fit.heights.without(fit.height)
    off = np.nan_to_num(left.height)
    smooth = left.low_pass(_DENT, 1.0 / (1.0 + (off / _ODD) ** 2))
    field = valley_field(replace(left, height=np.where(left.covered, smooth, np.nan)), DENTS)
    lines = valley_lines(field, _DENT_DEPTH)[:_DENTS]
    grooves = [_first_groove(replace(left, height=smooth), line) for line in lines]
    return [groove for groove in grooves if groove is not None]


def _first_groove(heights: ScanHeights, line: ValleyLine) -> Groove | None:
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
    if length < _SHORT:
        return None
    chain = fit_stroke(places[kept] / texels.size, _TOLERANCE / texels.layout.texture_map.metres)
    return Groove(chain.controls, (Strand(0.0, max(float(np.median(depth[kept])), _FAINT), _WIDTH * line.width),))


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


def _notable(smooth: Floats, raw: ScanHeights, beside: Floats) -> Floats:
    """A smooth change of shape, (k,), or none where it is too little ``beside`` grooves, (k,), to be one."""
    size = np.sqrt(np.average(smooth[raw.covered] ** 2, weights=beside[raw.covered]))
    return smooth if size > _SAME_SHAPE else np.zeros_like(smooth)


def _pruned(fit: GrooveFit) -> GrooveFit:
    """The fit without furrows that hardly show and grooves that hardly bring it nearer."""
    worth = fit.worth()
    kept = []
    for groove, gain in zip(fit.grooves, worth):
        strands = tuple(strand for strand in groove.strands if strand.depth > _FAINT)
        if strands and gain > _WORTH:
            kept.append(replace(groove, strands=strands))
    return fit.replaced(kept)


def _side_by_side(fit: GrooveFit, clear: float) -> GrooveFit:
    """Each lone furrow of a groove joined by as many along it as its cross section asks for.

    clear: other grooves may make so much of the depth [m] where sections are looked at.
    """
    upright = uprightness(fit.heights)
    grooves = []
    for bed in fit.beds:
        strand = bed.groove.strands[0]
        groove = bed.groove if strand.width > _BROAD else bed.groove.subdivided(_PIECE / bed.length)
        if len(groove.strands) > 1 or strand.width > _BROAD:
            grooves.append(groove)
            continue
        own = bed.heights()[0][0]
        section = cross_section(
            bed.across,
            fit.heights.height[bed.rows],
            fit.height[bed.rows] - own,
            bed.wholeness(strand.width),
            clear * strand.depth,
            strand,
            upright[bed.rows],
        )
        grooves.append(replace(groove, strands=strands_for(section, strand)))
    return fit.replaced(grooves)
