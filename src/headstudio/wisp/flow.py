"""Laying hair down segment by segment: the inner part of Choe, Ko 2005, Algorithm 1.

Some hundreds of wisps get a segment at a time, so what is done costs little beside asking for it: inside, vectors are
columns, (3, k), and frames two of their axes, across the hair and along it.
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, replace

import numpy as np

from ..head.mesh import Floats, Ints
from .columns import cross, dot, unit
from .density import DensityField
from .ears import at_ears
from .force import ForceField
from .joints import REFERENCE_SEGMENT, bend_toward, joint_stiffness, most_aligned, turn
from .layers import Layers
from .outlines import Outlines

_BEND = math.radians(12)  # Delta theta of Algorithm 1, for a segment of 2 cm and longer ones
_BENDS = 6  # so many before the least dense direction is taken
_SLIDES = 2  # corrections of a segment that would run into the head
_SLACK = 1e-4  # so near to its clearance it needs no further correction [m]

# How firmly a root holds on to the way it grows along the skin, against a force of 1 along it that opposes its growth; a
# force across it counts for a part only, and one that goes its way not at all.
_HOLD, _ACROSS = 0.4, 0.25

# How fast a wisp that was pressed together grows wide again, on both sides [m per m].
_WIDEN = 0.3

# How far the middle of a wisp stays off the skin: a floor, and a part of its radius up to a bound [m].
_CLEARANCE, _RADIUS_PART, _MOST_CLEARANCE = 0.0015, 0.3, 0.005


@dataclass
class Tally:
    """What happened so far: segments laid, how many collided at first, how many still did after the last bend."""

    laid: int = 0
    colliding: int = 0
    unresolved: int = 0


class Flow:
    """Hair that is being laid: every wisp has a current end, which a segment is added to.

    outlines: at rest, which is straight: all segments of a wisp have the frame of its first. laid: how many segments each
    wisp has got, (W,). stiffness: kappa of eq. 5 for segments of this length.
    """

    def __init__(
        self,
        outlines: Outlines,
        density: DensityField,
        layers: Layers,
        force: ForceField,
        kappa: float,
        tau: float,
        unevenness: float = 0.0,
    ) -> None:
        count, joints = outlines.frames.shape[:2]
        self.outlines = outlines
        self.laid = np.zeros(count, dtype=np.int64)
        self.tally = Tally()
        self.stiffness = joint_stiffness(kappa, outlines.segment)
        # Of short segments many make way one after the other: each would else leap aside, and stand out as a tuft.
        self._bend = _BEND * min(outlines.segment / REFERENCE_SEGMENT, 1.0)
        self._density = density
        self._layers = layers
        self._force = force
        self._tau = tau
        self._unevenness = unevenness
        self._widest: Floats = np.full(outlines.radii.shape, np.inf)
        self._amounts = (outlines.strands * outlines.segment).astype(np.float64)
        # By joint and wisp, in one row: what the j-th joint of wisp w has is in place j W + w.
        self._radii = np.ascontiguousarray(outlines.radii.T).ravel()
        self._clearances = np.minimum(_CLEARANCE + _RADIUS_PART * self._radii, _MOST_CLEARANCE)
        self._across, self._along = np.empty((3, joints * count)), np.empty((3, joints * count))
        self._ends = np.empty((3, count))
        self._way: Floats = np.zeros(count)  # over the scalp so far [m]
        # The frame of the next segment if nothing bent it, (3, W) each.
        self._next_across, self._next_along = np.empty((3, count)), np.empty((3, count))
        self._back_to_roots(np.arange(count))

    def copy(self) -> Flow:
        """The same hair, laid as far, to go on with on its own."""
        other = copy.copy(self)
        for name in ("laid", "_way", "_widest", "_across", "_along", "_ends", "_next_across", "_next_along"):
            setattr(other, name, getattr(self, name).copy())
        other.tally = replace(self.tally)
        other._density = replace(self._density, hair=self._density.hair.copy())
        return other

    @property
    def ends(self) -> Floats:
        """Current ends [m], (W, 3)."""
        return self._ends.T

    def unfinished(self, wisps: Ints) -> Ints:
        """Those of ``wisps`` that have segments left to lay."""
        return wisps[self.laid[wisps] < self.outlines.counts[wisps]]

    def pick_up(self, wisps: Ints) -> None:
        """Take whole wisps back to their roots, and their hair out of the density field."""
        longest = int(self.laid[wisps].max(initial=0))
        ends = self.outlines.roots.T.copy()
        for joint in range(longest):
            there = wisps[self.laid[wisps] > joint]
            place = joint * len(self.laid) + there
            across, step = self._across[:, place], self.outlines.segment * self._along[:, place]
            self._add(there, place, ends[:, there] + 0.5 * step, across, self._along[:, place], -1.0)
            ends[:, there] += step
        self._back_to_roots(wisps)

    def _back_to_roots(self, wisps: Ints) -> None:
        self.laid[wisps] = 0
        self._way[wisps] = 0.0
        self._widest[wisps] = np.inf
        self._ends[:, wisps] = self.outlines.roots[wisps].T
        self._next_across[:, wisps], self._next_along[:, wisps] = (
            self.outlines.frames[wisps, 0, :, k].T for k in (0, 2)
        )

    def styling_force(self, wisps: Ints) -> Floats:
        """Phi at the ends of ``wisps``, (k, 3); beside a parting, as it is well on their side of it. Each strays from it a
        little in its own way.
        """
        felt = self._ends.take(wisps, axis=1).T
        if self.outlines.aside is not None:
            felt += self.outlines.aside.take(wisps, axis=0)
        force = self._force.at(felt).astype(np.float64)
        if self.outlines.stray is not None and self._unevenness > 0:
            way = np.float64(self.outlines.segment) * self.laid[wisps]
            size = self._unevenness * np.sqrt(np.einsum("ij,ij->i", force, force))
            force += (size * self.outlines.stray.at(wisps, way)).T
        return force

    def lay(self, wisps: Ints, force: Floats, ceiling: Floats) -> None:
        """Add one segment to each of ``wisps``, (k,), under ``force``, (k, 3); it collides above ``ceiling``, (k,)."""
        joint = self.laid.take(wisps)
        place = joint * len(self.laid) + wisps
        start, across, straight = (
            each.take(wisps, axis=1) for each in (self._ends, self._next_across, self._next_along)
        )
        pull = force.T
        rooted = (joint == 0).nonzero()[0]
        if len(rooted):
            combed = self._combed(start[:, rooted], straight[:, rooted], pull[:, rooted])
            across[:, rooted] = turn(across[:, rooted], straight[:, rooted], combed)
            straight[:, rooted] = combed
        # Where hair is pressed together so are its layers, and none are rooted on an ear.
        self._way[wisps] += self.outlines.segment * self._layers.passed(start.T)
        layer = self._layers.heights(self._way[wisps], np.float64(self.outlines.segment) * (joint + 1))
        layer *= np.sqrt(np.minimum(self._tau / ceiling, 1.0))
        lifted = at_ears(self._density.surroundings.proportions.measure(start.T)).nonzero()[0]
        layer[lifted] = 0.0
        clearance = self._clearances.take(place + len(self.laid)) + layer
        wanted = most_aligned(pull, straight, self.stiffness)
        direction = self._slide(start, wanted, clearance)
        # The first segment stands in the head's own density, and cannot leave it.
        free = np.where(joint == 0, np.inf, ceiling - self._density.added(self._amounts[wisps]))
        direction = self._make_room(start, direction, clearance, free)
        turned = turn(across, straight, direction)
        self._across[:, place], self._along[:, place] = turned, direction
        step = self.outlines.segment * direction
        self._add(wisps, place, start + 0.5 * step, turned, direction, 1.0)
        self._ends[:, wisps] = start + step
        # An ear lifts hair as long as it lies on it, and does not throw it outward: what it bends springs back.
        if len(lifted):
            direction[:, lifted] = wanted[:, lifted]
            turned[:, lifted] = turn(across[:, lifted], straight[:, lifted], wanted[:, lifted])
        self._next_across[:, wisps], self._next_along[:, wisps] = turned, direction
        self.laid[wisps] += 1
        self.tally.laid += len(wisps)

    def narrow(self, wisps: Ints, widest: Floats) -> None:
        """Press ``wisps`` at their ends to radii of at most ``widest`` [m], (k,)."""
        self._widest[wisps, self.laid[wisps]] = widest

    def density_at_ends(self, wisps: Ints) -> Floats:
        """rho at the ends of ``wisps``, (k,)."""
        return self._density.at(self.ends[wisps])[0].astype(np.float64)

    def result(self) -> Outlines:
        """The outlines as they are laid, with the padding behind every tip continuing the last segment."""
        count, joints = self.outlines.frames.shape[:2]
        last = np.minimum(np.arange(joints), self.outlines.counts[:, None] - 1)
        place = (last * count + np.arange(count)[:, None]).ravel()
        across, along = self._across[:, place], self._along[:, place]
        frames = np.stack([across, cross(along, across), along], axis=1).T.reshape(count, joints, 3, 3)
        frames = np.ascontiguousarray(frames.swapaxes(2, 3))
        return replace(self.outlines, frames=frames, radii=np.minimum(self.outlines.radii, self._widening()))

    def _widening(self) -> Floats:
        """Bounds of the radii [m], (W, J + 1): where hair was narrowed, and rising from there to both sides."""
        rise = _WIDEN * self.outlines.segment * np.arange(self._widest.shape[1])
        tipward = np.minimum.accumulate(self._widest - rise, axis=1) + rise
        rootward = np.minimum.accumulate((self._widest + rise)[:, ::-1], axis=1)[:, ::-1] - rise
        return np.minimum(tipward, rootward)

    def _combed(self, roots: Floats, direction: Floats, force: Floats) -> Floats:
        """The ``direction`` of first segments turned about the skin's normal toward ``force``, (3, k) each.

        Hair that is combed against its growth does not first go its own way and then back in a loop.
        """
        _, outward = self._skin(roots)
        rise = dot(direction, outward) * outward
        along = direction - rise
        pull = force - dot(force, outward) * outward
        nowhere = np.zeros_like(along)
        grows = unit(along, otherwise=nowhere)
        opposed = np.clip(_ACROSS - dot(unit(pull, otherwise=nowhere), grows), 0.0, 1.0)
        way = unit(_HOLD * grows + opposed * pull, otherwise=along)
        return unit(rise + np.sqrt(dot(along, along)) * way, otherwise=direction)

    def _slide(self, start: Floats, direction: Floats, clearance: Floats) -> Floats:
        """Directions turned so that segments from ``start`` end no deeper than ``clearance`` [m]: hair slides along the head.

        This is the bending along the density gradient for the head's part of the field, taken to the limit of small
        angles: the steps of Delta theta would leave hair that lies on the head in zigzags.
        """
        segment = self.outlines.segment
        distance, outward = self._skin(start + segment * direction)
        low = (distance < clearance).nonzero()[0]
        if len(low) == 0:
            return direction
        direction = direction.copy()
        start, clearance, distance, outward = start[:, low], clearance[low], distance[low], outward[:, low]
        for correction in range(_SLIDES):
            before = direction[:, low]
            rise = dot(before, outward)
            wanted = np.maximum(np.minimum(rise + (clearance - distance) / segment, 1.0), -1.0)
            along = unit(before - rise * outward, otherwise=outward)
            turned = unit(np.sqrt(1.0 - wanted**2) * along + wanted * outward, otherwise=outward)
            direction[:, low] = turned
            if correction == _SLIDES - 1:
                break
            distance, outward = self._skin(start + segment * turned)
            deep = (distance < clearance - _SLACK).nonzero()[0]
            if len(deep) == 0:
                break
            low, start, clearance = low[deep], start[:, deep], clearance[deep]
            distance, outward = distance[deep], outward[:, deep]
        return direction

    def _skin(self, points: Floats) -> tuple[Floats, Floats]:
        """Distance to the skin [m], (k,), and unit vectors away from it, (3, k)."""
        distance, outward = self._density.surroundings.distance_and_gradient(points.T)
        return distance.astype(np.float64), outward.T.astype(np.float64)

    def _make_room(self, start: Floats, direction: Floats, clearance: Floats, ceiling: Floats) -> Floats:
        """Directions bent along the density gradient while rho exceeds ``ceiling`` (eq. 6), and no more than _BENDS times."""
        half = 0.5 * self.outlines.segment
        density, slope = self._density.at((start + half * direction).T)
        colliding = (density > ceiling).nonzero()[0]
        self.tally.colliding += len(colliding)
        if len(colliding) == 0:
            return direction
        best = direction.copy()
        bent, least, slope = direction[:, colliding], density[colliding], slope[colliding]
        excess = least / np.maximum(ceiling[colliding], 1e-6) - 1.0
        for _ in range(_BENDS):
            start_here, clear = start[:, colliding], clearance[colliding]
            away = unit(-slope.T.astype(np.float64), otherwise=bent)
            # Hair that is only a little too dense makes way a little.
            angle = self._bend * np.minimum(excess, 1.0)
            bent = self._slide(start_here, bend_toward(bent, away, angle), clear)
            here, slope = self._density.at((start_here + half * bent).T)
            better = here < least
            least = np.where(better, here, least)
            best[:, colliding[better]] = bent[:, better]
            still = (here > ceiling[colliding]).nonzero()[0]
            colliding, bent, least, slope = colliding[still], bent[:, still], least[still], slope[still]
            excess = here[still] / np.maximum(ceiling[colliding], 1e-6) - 1.0
            if len(colliding) == 0:
                break
        self.tally.unresolved += len(colliding)
        return best

    def _add(self, wisps: Ints, place: Ints, middles: Floats, across: Floats, along: Floats, sign: float) -> None:
        both = np.empty((3, 2, len(wisps)))
        both[:, 0], both[:, 1] = across, cross(along, across)
        self._density.add(middles, both, self._radii.take(place), sign * self._amounts[wisps])
