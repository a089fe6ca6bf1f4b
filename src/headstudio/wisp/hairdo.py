"""A hairstyle from its settings: the seven steps of Choe, Ko 2005, section 6, in one function."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp
from .adornment import Adornment, adorn
from .colour import strand_colours
from .curves import LengthDistribution
from .cutting import Blade, cut_strands
from .deform import DeformReport, deform
from .follicles import scatter_strands, spread_wisps
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
# neither the number of threads nor that of strands changes a strand.
_BLOCK = 8192
_CLEARANCE = 0.0005  # of strands from the skin [m]


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


def style_hair(
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
    announce("wisps")
    parting = Parting.of(scalp, wisp)
    regions = spread_wisps(scalp, density_map(wisp), wisp.wisps, parting, wisp.seed)
    rest, lengths = rest_outlines(scalp, regions, parting, wisp)
    details = synthesise_details(rest, wisp)

    announce("flow")
    outlines, report = deform(rest, surroundings, styling, scalp)
    controls = master_controls(outlines, details)

    announce("strands")
    count = wisp.strands if strands is None else min(strands, wisp.strands)
    roots, owner = scatter_strands(regions, count, wisp.seed)
    masters = Masters(controls, details.per_segment, outlines.radii.astype(np.float32), lengths / outlines.segment)
    uv = scalp.locate(rest.roots)
    blades = [Blade.of(cut, surroundings.proportions, uv) for cut in styling.cuts]
    points = _grow(masters, roots, owner, wisp, surroundings, blades)

    worn = adorn(styling, surroundings, float(rest.counts.max(initial=0) * rest.segment))

    announce("colour")
    colours = strand_colours(colour, owner, regions.count, wisp.points)
    shaft = np.linspace(wisp.shaft_root, wisp.shaft_tip, wisp.points, dtype=np.float32)
    radius = np.broadcast_to(shaft, points.shape[:2])
    made = Strands.of_equal_count(points, radius, colours, owner.astype(np.int32))
    return Hairdo(replace(made, stands_for=wisp.strands / count), outlines, controls, report, worn)


def _grow(
    masters: Masters, roots: Floats, owner: Ints, wisp: WispSettings, surroundings: Surroundings, blades: list[Blade]
) -> Singles:
    """Points of all member strands outside the head [m], (S, points, 3): each block on whichever processor is free."""
    distribution = LengthDistribution.of(wisp)
    lengths = distribution.sample(np.random.default_rng([wisp.seed, 4]).random(len(owner)))
    cuts = Cuts.of(masters, wisp.points)
    points = np.empty((len(owner), wisp.points, 3), dtype=np.float32)

    def grow(block: int) -> None:
        here = slice(block * _BLOCK, (block + 1) * _BLOCK)
        own = owner[here]
        first = (roots[here] - masters.controls[own, 0]).T.astype(np.float32)
        even = _even_numbers([wisp.seed, 5, block], len(own))
        offsets = displacements(masters.radii[own].T, first, wisp.fuzziness, even)
        grown = member_points(masters, cuts, own, offsets, lengths[here])
        outside = surroundings.keep_outside(grown.reshape(-1, 3), _CLEARANCE).reshape(grown.shape)
        points[here] = cut_strands(outside, own, blades)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(grow, range(-(-len(owner) // _BLOCK))))
    return points


def _even_numbers(seed: list[int], count: int) -> Iterator[Singles]:
    """Uniform random numbers below 1, (3, count), without end; the same for a strand however many come after it."""
    rng = np.random.default_rng(seed)
    while True:
        yield rng.random((3, _BLOCK), dtype=np.float32)[:, :count]
