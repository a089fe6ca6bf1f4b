"""A hairstyle from its settings: the seven steps of Choe, Ko 2005, section 6, in one function."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp
from .adornment import Adornment, adorn
from .chords import keep_chords_outside
from .colour import strand_colours
from .curves import LengthDistribution
from .cutting import Blade, cut_strands
from .deform import Deformer, DeformReport
from .follicles import Regions, scatter_strands, spread_wisps
from .hairline import fineness
from .maps import density_map
from .markov import Singles
from .masters import master_controls, synthesise_details
from .members import Cuts, Masters, displacements, member_points
from .outlines import Outlines
from .parting import Parting
from .rest import rest_outlines
from .settings import HairColourSettings, WispSettings
from .strands import Strands
from .styling_settings import StylingSettings
from .surroundings import Surroundings

# Strands that are made in one go: what they need fits the processor's cache. Random numbers go with the block, so that
# neither the number of threads nor that of strands changes a strand. A few blocks are made by halves, which are shared
# evenly among processors; more of them are not, since each takes its look at all lengths.
_BLOCK, _FEW_BLOCKS = 8192, 4
_CLEARANCE = 0.0005  # of strands from the skin [m]

MadeT = TypeVar("MadeT")


@dataclass(frozen=True, eq=False)
class Hairdo:
    """A finished hairstyle.

    strands: what is drawn and exported. outlines: of the wisps, as they lie. controls: control points of the master
    strands [m], (W, n, 3). report: what the deformation solver met. adornments: what is worn in the hair.
    """

    strands: Strands
    outlines: Outlines
    controls: Singles
    report: DeformReport
    adornments: tuple[Adornment, ...]


@dataclass(frozen=True, eq=False)
class _Spread:
    """Wisps on the scalp. rest: their outlines before they are bent. lengths: of the masters [m], (W,)."""

    regions: Regions
    rest: Outlines
    lengths: Floats


@dataclass(frozen=True, eq=False)
class _Laid:
    """Wisps as they lie. outlines: after they were bent."""

    spread: _Spread
    outlines: Outlines
    report: DeformReport


@dataclass(frozen=True, eq=False)
class _Grown:
    """Strands that have no colour yet, the wisp of each, (S,), and the control points of the masters."""

    strands: Strands
    owner: Ints
    controls: Singles


# What does not change how wisps lie: the first of these shape the curls around their outlines, the others the strands.
_CURLS = (
    "prototype", "prototype_curve", "curl_size", "curl_length", "straight_roots", "temperature", "window", "alignment",
)  # fmt: skip
_STRANDS = ("points", "length_distribution", "length_curve", "fuzziness", "shaft_root", "shaft_tip", "hairline")
_OUTLINES = tuple(field.name for field in fields(WispSettings) if field.name not in (*_CURLS, *_STRANDS))


class Stylist:
    """Styles one head of hair again and again, and makes again only what a change concerns: other curls grow on wisps that
    lie as they lay, and other colours on the same strands. Not for several threads at once.
    """

    def __init__(self) -> None:
        # The last result of every step, with what it was made from.
        self._made: dict[str, tuple[Any, Any]] = {}
        self._deformer = Deformer()

    def style(
        self,
        scalp: Scalp,
        surroundings: Surroundings,
        wisp: WispSettings,
        colour: HairColourSettings,
        styling: StylingSettings,
        strands: int | None = None,
        announce: Callable[[str], None] = lambda step: None,
    ) -> Hairdo:
        """Style hair on ``scalp``.

        strands: make only the first so many of the strands; they are a thinned picture of the whole. ``announce`` is told
        what is being done. Raises ParameterError for curves that cannot be used.
        """

        def step(name: str, wanted: Any, make: Callable[[], MadeT]) -> MadeT:
            if name not in self._made or self._made[name][0] != wanted:
                self._made[name] = (wanted, make())
            made: MadeT = self._made[name][1]
            return made

        spread = step(
            "wisps",
            (scalp, [getattr(wisp, name) for name in _OUTLINES]),
            lambda: _spread(scalp, wisp, announce),
        )
        bare = replace(styling, cuts=(), accessories=())
        laid = step(
            "laid",
            (spread, surroundings, bare),
            lambda: self._lay(spread, scalp, surroundings, bare, announce),
        )
        count = wisp.strands if strands is None else min(strands, wisp.strands)
        grown = step(
            "grown",
            (laid, wisp, styling.cuts, count),
            lambda: _grow(laid, scalp, surroundings, wisp, styling, count, announce),
        )
        worn = step(
            "worn",
            (spread, surroundings, styling.accessories, styling.operations),
            lambda: adorn(styling, surroundings, float(spread.rest.counts.max(initial=0) * spread.rest.segment)),
        )
        announce("colour")
        colours = step(
            "colours",
            (grown, colour),
            lambda: strand_colours(colour, grown.owner, laid.spread.regions.count, wisp.points).reshape(-1, 3),
        )
        coloured = replace(grown.strands, colour=colours)
        return Hairdo(coloured, laid.outlines, grown.controls, laid.report, worn)

    def _lay(
        self,
        spread: _Spread,
        scalp: Scalp,
        surroundings: Surroundings,
        styling: StylingSettings,
        announce: Callable[[str], None],
    ) -> _Laid:
        """Let the wisps lie."""
        announce("flow")
        return _Laid(spread, *self._deformer.deform(spread.rest, surroundings, styling, scalp))


def _spread(scalp: Scalp, wisp: WispSettings, announce: Callable[[str], None]) -> _Spread:
    """Spread the wisps over the scalp."""
    announce("wisps")
    parting = Parting.of(scalp, wisp)
    regions = spread_wisps(scalp, density_map(wisp), wisp.wisps, parting, wisp.seed)
    return _Spread(regions, *rest_outlines(scalp, regions, parting, wisp))


def _grow(
    laid: _Laid,
    scalp: Scalp,
    surroundings: Surroundings,
    wisp: WispSettings,
    styling: StylingSettings,
    count: int,
    announce: Callable[[str], None],
) -> _Grown:
    """Grow ``count`` strands around the masters of wisps that lie."""
    announce("strands")
    details = synthesise_details(laid.spread.rest, wisp)
    outlines = laid.outlines
    controls = master_controls(outlines, details)
    roots, owner = scatter_strands(laid.spread.regions, count, wisp.seed)
    masters = Masters(
        controls, details.per_segment, outlines.radii.astype(np.float32), laid.spread.lengths / outlines.segment
    )
    uv = scalp.locate(laid.spread.rest.roots)
    blades = [Blade.of(cut, surroundings.proportions, uv) for cut in styling.cuts]
    points = _member_strands(masters, roots, owner, wisp, surroundings, blades)
    shaft = np.linspace(wisp.shaft_root, wisp.shaft_tip, wisp.points, dtype=np.float32)
    radius = fineness(scalp, roots, wisp.hairline, wisp.seed)[:, None] * shaft
    made = Strands.of_equal_count(points, radius, None, owner.astype(np.int32))
    return _Grown(replace(made, stands_for=wisp.strands / count), owner, controls)


def _member_strands(
    masters: Masters, roots: Floats, owner: Ints, wisp: WispSettings, surroundings: Surroundings, blades: list[Blade]
) -> Singles:
    """Points of all member strands outside the head [m], (S, points, 3): each block on whichever processor is free."""
    distribution = LengthDistribution.of(wisp)
    lengths = distribution.sample(np.random.default_rng([wisp.seed, 4]).random(len(owner)))
    cuts = Cuts.of(masters, wisp.points)
    points = np.empty((len(owner), wisp.points, 3), dtype=np.float32)
    piece = _BLOCK // 2 if len(owner) <= _FEW_BLOCKS * _BLOCK else _BLOCK

    def grow(start: int) -> None:
        here = slice(start, start + piece)
        own = owner[here]
        first = (roots[here] - masters.controls[own, 0]).T.astype(np.float32)
        even = _even_numbers([wisp.seed, 5, start // _BLOCK], start % _BLOCK, len(own))
        offsets = displacements(masters.radii[own].T, first, wisp.fuzziness, even)
        grown = member_points(masters, cuts, own, offsets, lengths[here])
        # Last of all, since what is cut is drawn anew with straight ways between fewer places.
        cut = cut_strands(grown, own, blades)
        outside = surroundings.keep_outside(cut.reshape(-1, 3), _CLEARANCE).reshape(cut.shape)
        points[here] = keep_chords_outside(surroundings, outside, _CLEARANCE)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(grow, range(0, len(owner), piece)))
    return points


def _even_numbers(seed: list[int], start: int, count: int) -> Iterator[Singles]:
    """Uniform random numbers below 1, (3, count), without end: those of the strands from ``start``, an even number, on in
    their block. The same for a strand however many come after it.
    """
    bits = np.random.PCG64(seed)
    rng = np.random.Generator(bits)
    # One draw of 64 bits makes two of these numbers.
    made = count + count % 2
    while True:
        numbers = np.empty((3, made), dtype=np.float32)
        for row in numbers:
            bits.advance(start // 2)
            rng.random(out=row, dtype=np.float32)
            bits.advance((_BLOCK - start - made) // 2)
        yield numbers[:, :count]
