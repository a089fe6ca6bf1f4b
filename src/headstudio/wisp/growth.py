"""Member strands in large numbers: where they are rooted, and how they grow, on whichever processor is free."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp
from .chords import keep_chords_outside
from .curves import LengthDistribution
from .cutting import Blade, cut_strands
from .elastics import Elastic
from .follicles import Regions, scatter_strands
from .hairline import fineness
from .headbands import Headband
from .markov import Singles
from .members import Cuts, Masters, displacements, member_points
from .settings import WispSettings
from .surroundings import Surroundings

# Random numbers go with blocks of so many strands, so that neither the number of threads nor that of strands changes one.
_BLOCK = 8192
# So many strands at most are made in one go, in an even number of goes. Threads take turns at Python: few large pieces, in
# which numpy works for long, get on side by side, and small ones wait for one another.
_PIECE = 12288
_CLEARANCE = 0.0005  # of strands from the skin [m]


@dataclass(frozen=True, eq=False)
class Sown:
    """S strands before they grow. roots [m], (S, 3). owner: the wisp of each, (S,). fineness: what part of its thickness
    each has so near to the hairline, (S,).
    """

    roots: Floats
    owner: Ints
    fineness: Singles

    @classmethod
    def on(cls, scalp: Scalp, regions: Regions, count: int, wisp: WispSettings) -> Sown:
        """``count`` strands in the ``regions`` of wisps."""
        roots, owner = scatter_strands(regions, count, wisp.seed)
        return cls(roots, owner, fineness(scalp, roots, wisp.hairline, wisp.seed))


def member_strands(
    masters: Masters,
    sown: Sown,
    wisp: WispSettings,
    surroundings: Surroundings,
    blades: Sequence[Blade],
    holds: Sequence[Elastic | Headband],
) -> Singles:
    """Points of all member strands outside the head [m], (S, points, 3), cut with the ``blades`` and held by ``holds``."""
    count = len(sown.owner)
    lengths = LengthDistribution.of(wisp).sample(np.random.default_rng([wisp.seed, 4]).random(count))
    cuts = Cuts.of(masters, wisp.points)
    early = np.random.default_rng([wisp.seed, 7]).random(count, dtype=np.float32)
    points = np.empty((count, wisp.points, 3), dtype=np.float32)
    pieces = 2 * math.ceil(count / (2 * _PIECE))
    piece = 2 * math.ceil(count / (2 * pieces)) if count else 1

    def grow(start: int) -> None:
        here = slice(start, start + piece)
        own = sown.owner[here]
        first = (sown.roots[here] - masters.controls[own, 0]).T.astype(np.float32)
        radii = masters.radii[own].T
        offsets = displacements(
            radii, first, wisp.fuzziness, _even_numbers([wisp.seed, 5], start, len(own), len(radii) - 1)
        )
        grown = member_points(masters, cuts, own, offsets, lengths[here])
        # Last of all, since what is cut is drawn anew with straight ways between fewer places.
        laid = cut_strands(grown, own, early[here], blades)
        for hold in holds:
            laid = hold.pressed(laid, own)
        outside = surroundings.keep_outside(laid.reshape(-1, 3), _CLEARANCE).reshape(laid.shape)
        points[here] = keep_chords_outside(surroundings, outside, _CLEARANCE)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(grow, range(0, count, piece)))
    return points


def _even_numbers(seed: list[int], start: int, count: int, steps: int) -> Singles:
    """Uniform random numbers below 1, (steps, 3, count): those of ``count`` strands from ``start``, an even number, on.

    Strands draw in blocks with a generator each, all of a block for every number. So a strand's numbers are the same
    however many strands there are, and whoever draws the others'.
    """
    stop = start + count + count % 2  # one draw of 64 bits makes two of these numbers
    numbers = np.empty((3 * steps, stop - start), dtype=np.float32)
    for block in range(start // _BLOCK, -(-stop // _BLOCK)):
        low, high = max(start - block * _BLOCK, 0), min(stop - block * _BLOCK, _BLOCK)
        here = slice(block * _BLOCK + low - start, block * _BLOCK + high - start)
        bits = np.random.PCG64([*seed, block])
        rng = np.random.Generator(bits)
        bits.advance(low // 2)
        for row in numbers:
            rng.random(out=row[here], dtype=np.float32)
            bits.advance((_BLOCK - high + low) // 2)
    return numbers.reshape(steps, 3, -1)[:, :, :count]
