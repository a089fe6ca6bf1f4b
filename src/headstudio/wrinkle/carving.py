"""Carving the furrows of fine wrinkles: Bando's thesis, section 2.6.2.

As printed, furrows grow one after the other: from a random starting point that no furrow occupies, segment by segment
along the field and then against it, until the furrow has its N segments or meets another one. When random points fail
more and more often, every texel that is still free becomes a starting point.

Here the starting points are all texels of the mesh in random order (drawn without replacement, which makes the random
phase and the fill one and the same), and the furrows of many of them grow at once. The result is that of growing them
one by one in this order, segment for segment: what a furrow would do alone is known beforehand (``growth``), where it
is cut short or does not start follows from the furrows before it (``precedence``), and the random numbers of a furrow
belong to its starting texel. How many grow at once changes the time it takes and nothing else.

One thing is not in the printed steps: a furrow that comes back to itself ends there as it would on another.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints
from .direction_field import DirectionField
from .drawing import Images
from .growth import RANDOM_NUMBERS, Growth, Tips
from .laws import FurrowLaws
from .precedence import Encounters, settle
from .segments import TOUCH, Meetings, SegmentGrid, Segments
from .texels import Flags, TexelMap

# How many starting points are tried at once at first, and between what bounds the share of furrows that grow in vain,
# because one of the same batch takes their place, keeps that number: few are slow, and many grow in vain.
_FIRST_BATCH = 32
_LOSSES = 0.3, 0.5
# How many segments grow between two looks at older furrows.
_STRETCH = 4


@dataclass(frozen=True, eq=False)
class CarvedField:
    """One height field and what made it.

    texels: the map it lies on. height: of the skin over its surface, never positive [m], (size, size). occupied: where
    no furrow may start, which in the end is everywhere, (size, size). segments: of all furrows, by furrow, in the order
    in which they were carved. laws: how long, wide and deep they are.
    """

    texels: TexelMap
    height: NDArray[np.float32]
    occupied: Flags
    segments: Segments
    laws: FurrowLaws


def carve(
    field: DirectionField,
    laws: FurrowLaws,
    *,
    depth: float,
    roundness: float = 0.0,
    seed: int | np.random.SeedSequence,
    onward: Segments | None = None,
    batch: int | None = None,
) -> CarvedField:
    """Cover a mapped mesh with furrows along a field.

    laws: see ``LAWS``. depth: of a furrow whose intensity I is 0 [m].
    roundness: 0 leaves the skin between grooves flat, above that it is raised like a cushion (see ``Images.draw``).
    seed: the same gives the same furrows. onward: segments with which furrows of a neighbouring body part cross the
    border, one each; they grow on from there before others start. batch: how many starting points are tried at once,
    which changes nothing but the time; left out, as many as is quick.
    """
    carver = _Carver(field, laws, depth, roundness, np.random.default_rng(seed), onward)
    carver.fill(batch)
    return CarvedField(
        texels=field.texels,
        height=carver.images.height,
        occupied=carver.images.occupied,
        segments=_by_furrow(carver.carved),
        laws=laws,
    )


class _Carver:
    """The state of carving: what is drawn, and the segments that are there."""

    def __init__(
        self,
        field: DirectionField,
        laws: FurrowLaws,
        depth: float,
        roundness: float,
        rng: np.random.Generator,
        onward: Segments | None,
    ) -> None:
        self.laws, self.depth, self.roundness, self.rng = laws, depth, roundness, rng
        self.growth = Growth(field, laws, rng)
        self.texels = texels = field.texels
        self.images = Images(
            height=np.zeros((texels.size, texels.size), dtype=np.float32),
            occupied=~texels.mapped,
            period=texels.period,
        )
        # The largest lengths the laws give anywhere in the field.
        largest = laws.at(np.linspace(0.0, field.strongest, 65))
        unit = field.units.max()
        longest = unit * largest.length.max()
        if onward:
            longest = max(longest, np.hypot(*onward.steps.T).max())
        distance = max(longest, 0.5 * (longest + unit * largest.spacing.max()))
        # What is carved, and what grows together just now.
        self.older = SegmentGrid(texels.size, texels.period, distance)
        self.growing = SegmentGrid(texels.size, texels.period, distance)
        self.furrows = 0
        self.carved: list[Segments] = []
        if onward:
            self._grow_onward(onward)

    def fill(self, batch: int | None) -> None:
        """Start furrows from every texel that is free when its turn comes."""
        texels = self.rng.permutation(np.flatnonzero(self.texels.mapped))
        luck = self.rng.integers(RANDOM_NUMBERS, size=len(texels))
        centres = self.texels.centres(texels)
        points = centres + self.rng.uniform(-0.5, 0.5, (len(texels), 2))
        occupied = self.images.occupied.ravel()
        width, done = batch or _FIRST_BATCH, 0
        while done < len(texels):
            tried = np.arange(done, min(done + width, len(texels)))
            done += width
            free = tried[~occupied[texels[tried]]]
            losses = 0.0
            if len(free):
                tips = Tips.of_starts(points[free], np.arange(len(free)), luck[free])
                grown, limits = self._grow_among_older(tips, len(free))
                grows, losses = self._settle(grown, limits, centres[free])
                occupied[texels[free[grows]]] = True
            if not batch and losses < _LOSSES[0]:
                width = 2 * width
            elif not batch and losses > _LOSSES[1]:
                width = max(width // 2, 1)

    def _grow_onward(self, first: Segments) -> None:
        """Let furrows go on whose first segments a neighbour has grown."""
        furrows = np.arange(len(first))
        first = replace(first, furrows=furrows, order=np.zeros_like(furrows), reach=np.ones(len(first)))
        tips = Tips(
            points=first.starts + first.steps,
            left=first.left - 1,
            furrows=furrows,
            sides=first.sides,
            order=np.ones_like(furrows),
            luck=self.rng.integers(RANDOM_NUMBERS, size=len(first)),
        )
        grown, limits = self._grow_among_older(tips[first.left > 0], len(first))
        self._settle(Segments.joined([first, grown]), limits, np.zeros((0, 2)))

    def _grow_among_older(self, tips: Tips, count: int) -> tuple[Segments, Floats]:
        """All segments of furrows that end only on older ones, and where each of the sides does, (2 count,).

        They grow some segments at a time, since most of those that come late do not get far.
        """
        limits = np.full(2 * count, np.inf)
        pieces = []
        while len(tips):
            stretch = []
            for _ in range(_STRETCH):
                grown, tips = self.growth.grow(tips)
                stretch.append(grown)
            grown = Segments.joined(stretch)
            met = self.older.meetings(grown)
            np.minimum.at(limits, _sides(grown)[met.arriving], _ended_at(grown, met))
            pieces.append(grown[grown.order < limits[_sides(grown)]])
            tips = tips[np.isinf(limits[_sides(tips)])]
        return Segments.joined(pieces), limits

    def _settle(self, grown: Segments, limits: Floats, starts: Floats) -> tuple[Flags, float]:
        """Carve what furrows that grew together may keep.

        limits: how far each side gets among older furrows, (2 k,). starts: of each furrow; one that starts where an
        earlier one claims the place does not grow [texels], (k, 2). Empty: all grow.
        Returns which furrows grow, (k,), and what share of the segments was in vain because of the others.
        """
        grows, reach = settle(limits, self._encounters(grown, starts))
        reach = reach[_sides(grown)] - grown.order
        grown = replace(grown, reach=np.minimum(reach, 1.0))
        kept = grown[grows[grown.furrows] & (reach > 0)]
        names = np.cumsum(grows) - 1 + self.furrows
        self.furrows += int(grows.sum())
        kept = replace(kept, furrows=names[kept.furrows])
        self.older.add(kept)
        self.carved.append(kept)
        law = self.laws.at(kept.magnitudes)
        widths, spacings = kept.units * law.width, kept.units * law.spacing
        steps = kept.reach[:, None] * kept.steps
        self.images.draw(kept.starts, steps, widths, self.depth * law.depth, spacings, self.roundness)
        return grows, 1 - len(kept) / max(len(grown), 1)

    def _encounters(self, grown: Segments, starts: Floats) -> Encounters:
        """What furrows that grow together may do to each other."""
        side = _sides(grown)
        self.growing.add(grown)
        met = self.growing.meetings(grown)
        # The one that comes later ends. On its own furrow, neighbouring segments always touch.
        own = grown.furrows[met.present] == grown.furrows[met.arriving]
        by, ended = side[met.present], side[met.arriving]
        gap = grown.order[met.arriving] - grown.order[met.present]
        joint = own & (grown.order[met.arriving] == 0) & (grown.order[met.present] == 0)
        among = np.flatnonzero(np.where(by == ended, gap > 1, by < ended) & ~joint)

        claims = 0.5 * grown.units * self.laws.at(grown.magnitudes).spacing
        covering = self.growing.covering(starts, claims)
        self.growing.clear()
        later = np.flatnonzero(grown.furrows[covering.present] < covering.arriving)
        return Encounters(
            ended=ended[among],
            ended_at=_ended_at(grown, met)[among],
            by=by[among],
            by_at=(grown.order[met.present] + met.present_parts)[among],
            covered=covering.arriving[later],
            cover=side[covering.present[later]],
            cover_at=(grown.order[covering.present] + covering.present_parts)[later],
        )


def _sides(segments: Segments | Tips) -> Ints:
    """Number of the side of its furrow to which each segment or tip belongs, (k,)."""
    return np.asarray(2 * segments.furrows + segments.sides)


def _ended_at(grown: Segments, met: Meetings) -> Floats:
    """The places where furrows end that meet others: just before they do, so that they never cross."""
    return np.asarray(grown.order[met.arriving] + np.maximum(met.parts - TOUCH, 0.0))


def _by_furrow(pieces: list[Segments]) -> Segments:
    segments = Segments.joined(pieces)
    return segments[np.lexsort([segments.order, segments.sides, segments.furrows])]
