"""Laying hair down segment by segment: the inner part of Choe, Ko 2005, Algorithm 1."""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, replace

import numpy as np

from ..head.mesh import Floats, Ints
from .density import DensityField
from .ears import at_ears
from .field import ForceField
from .joints import bend_toward, joint_stiffness, most_aligned, turn, unit
from .outlines import Outlines

_BEND = math.radians(12)  # Delta theta of Algorithm 1
_BENDS = 4  # so many before the least dense direction is taken
_SLIDES = 2  # corrections of a segment that would run into the head

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

    frames: of all segments laid so far, as Outlines.frames. laid: how many segments each wisp has got, (W,).
    ends: current ends [m], (W, 3). stiffness: kappa of eq. 5 for segments of this length.
    """

    def __init__(self, outlines: Outlines, density: DensityField, force: ForceField, kappa: float, tau: float) -> None:
        self.outlines = outlines
        self.frames = outlines.frames.copy()
        self.laid = np.zeros(len(outlines.counts), dtype=np.int64)
        self.ends = outlines.roots.copy()
        self.tally = Tally()
        self._widest: Floats = np.full(outlines.radii.shape, np.inf)
        self._turned = np.broadcast_to(np.eye(3), (len(self.laid), 3, 3)).copy()
        self._density = density
        self._force = force
        self._tau = tau
        self.stiffness = joint_stiffness(kappa, outlines.segment)
        self._amounts = (outlines.strands * outlines.segment).astype(np.float64)

    def copy(self) -> Flow:
        """The same hair, laid as far, to go on with on its own."""
        other = copy.copy(self)
        for name in ("frames", "laid", "ends", "_widest", "_turned"):
            setattr(other, name, getattr(self, name).copy())
        other.tally = replace(self.tally)
        other._density = replace(self._density, hair=self._density.hair.copy())
        return other

    def unfinished(self, wisps: Ints) -> Ints:
        """Those of ``wisps`` that have segments left to lay."""
        return wisps[self.laid[wisps] < self.outlines.counts[wisps]]

    def pick_up(self, wisps: Ints) -> None:
        """Take whole wisps back to their roots, and their hair out of the density field."""
        longest = int(self.laid[wisps].max(initial=0))
        ends = self.outlines.roots[wisps]
        for joint in range(longest):
            there = self.laid[wisps] > joint
            frames = self.frames[wisps[there], joint]
            middles = ends[there] + 0.5 * self.outlines.segment * frames[:, :, 2]
            self._add(wisps[there], joint, middles, frames, -1.0)
            ends[there] += self.outlines.segment * frames[:, :, 2]
        self.laid[wisps] = 0
        self._widest[wisps] = np.inf
        self.ends[wisps] = self.outlines.roots[wisps]
        self._turned[wisps] = np.eye(3)

    def styling_force(self, wisps: Ints) -> Floats:
        """Phi at the ends of ``wisps``, (k, 3); beside a parting, as it is well on their side of it."""
        aside = self.outlines.aside
        felt = self.ends[wisps] if aside is None else self.ends[wisps] + aside[wisps]
        return self._force.at(felt).astype(np.float64)

    def lay(self, wisps: Ints, force: Floats, ceiling: Floats) -> None:
        """Add one segment to each of ``wisps``, (k,), under ``force``, (k, 3); it collides above ``ceiling``, (k,)."""
        joint = self.laid[wisps]
        start = self.ends[wisps]
        rest = self.outlines.frames[wisps, joint]
        carried = self._turned[wisps] @ rest
        rooted = np.flatnonzero(joint == 0)
        if len(rooted):
            carried[rooted] = self._combed(start[rooted], carried[rooted], force[rooted])
        straight = carried[:, :, 2]
        clearance = self._clearance(wisps, joint)
        wanted = most_aligned(force, straight, self.stiffness)
        direction = self._slide(start, wanted, clearance)
        # The first segment stands in the head's own density, and cannot leave it.
        free = np.where(joint == 0, np.inf, ceiling - self._density.added(self._amounts[wisps]))
        direction = self._make_room(start, direction, clearance, free)
        frames = turn(carried, straight, direction)
        self.frames[wisps, joint] = frames
        # An ear lifts hair as long as it lies on it, and does not throw it outward: what it bends springs back.
        lifted = np.flatnonzero(at_ears(self._density.surroundings.proportions.measure(start)))
        sprung = frames.copy()
        sprung[lifted] = turn(carried[lifted], straight[lifted], wanted[lifted])
        self._turned[wisps] = sprung @ rest.transpose(0, 2, 1)
        self.ends[wisps] = start + self.outlines.segment * direction
        self._add(wisps, joint, start + 0.5 * self.outlines.segment * direction, frames, 1.0)
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
        last = np.minimum(np.arange(self.frames.shape[1]), self.outlines.counts[:, None] - 1)
        frames = np.take_along_axis(self.frames, last[:, :, None, None], axis=1)
        return replace(self.outlines, frames=frames, radii=np.minimum(self.outlines.radii, self._widening()))

    def _widening(self) -> Floats:
        """Bounds of the radii [m], (W, J + 1): where hair was narrowed, and rising from there to both sides."""
        rise = _WIDEN * self.outlines.segment * np.arange(self._widest.shape[1])
        tipward = np.minimum.accumulate(self._widest - rise, axis=1) + rise
        rootward = np.minimum.accumulate((self._widest + rise)[:, ::-1], axis=1)[:, ::-1] - rise
        return np.minimum(tipward, rootward)

    def _combed(self, roots: Floats, frames: Floats, force: Floats) -> Floats:
        """``frames`` of first segments, (k, 3, 3), turned about the skin's normal toward ``force``, (k, 3).

        Hair that is combed against its growth does not first go its own way and then back in a loop.
        """
        _, outward = self._skin(roots)
        direction = frames[:, :, 2]
        rise = np.einsum("ij,ij->i", direction, outward)[:, None] * outward
        along = direction - rise
        pull = force - np.einsum("ij,ij->i", force, outward)[:, None] * outward
        nowhere = np.zeros_like(along)
        grows = unit(along, otherwise=nowhere)
        opposed = np.clip(_ACROSS - np.einsum("ij,ij->i", unit(pull, otherwise=nowhere), grows), 0.0, 1.0)
        way = unit(_HOLD * grows + opposed[:, None] * pull, otherwise=along)
        combed = unit(rise + np.linalg.norm(along, axis=1, keepdims=True) * way, otherwise=direction)
        return turn(frames, direction, combed)

    def _clearance(self, wisps: Ints, joint: Ints) -> Floats:
        """How far off the skin the end of the next segment stays [m], (k,)."""
        radius = self.outlines.radii[wisps, joint + 1]
        return np.minimum(_CLEARANCE + _RADIUS_PART * radius, _MOST_CLEARANCE)

    def _slide(self, start: Floats, direction: Floats, clearance: Floats) -> Floats:
        """Directions turned so that segments from ``start`` end no deeper than ``clearance`` [m]: hair slides along the head.

        This is the bending along the density gradient for the head's part of the field, taken to the limit of small
        angles: the steps of Delta theta would leave hair that lies on the head in zigzags.
        """
        segment = self.outlines.segment
        distance, outward = self._skin(start + segment * direction)
        direction = direction.copy()
        low, slack = np.arange(len(start)), 0.0
        for _ in range(_SLIDES):
            deep = distance < clearance[low] - slack
            low, distance, outward = low[deep], distance[deep], outward[deep]
            if len(low) == 0:
                break
            rise = np.einsum("ij,ij->i", direction[low], outward)
            wanted = np.clip(rise + (clearance[low] - distance) / segment, -1.0, 1.0)
            along = unit(direction[low] - rise[:, None] * outward, otherwise=outward)
            direction[low] = unit(
                np.sqrt(1.0 - wanted**2)[:, None] * along + wanted[:, None] * outward, otherwise=outward
            )
            distance, outward = self._skin(start[low] + segment * direction[low])
            slack = 1e-4
        return direction

    def _skin(self, points: Floats) -> tuple[Floats, Floats]:
        distance, outward = self._density.surroundings.distance_and_gradient(points)
        return distance.astype(np.float64), outward.astype(np.float64)

    def _make_room(self, start: Floats, direction: Floats, clearance: Floats, ceiling: Floats) -> Floats:
        """Directions bent along the density gradient while rho exceeds ``ceiling`` (eq. 6), and no more than _BENDS times."""
        segment = self.outlines.segment
        density, slope = self._density.at(start + 0.5 * segment * direction)
        colliding = np.flatnonzero(density > ceiling)
        self.tally.colliding += len(colliding)
        bent, best, least = direction.copy(), direction.copy(), density.copy()
        for _ in range(_BENDS):
            if len(colliding) == 0:
                break
            away = unit(-slope[colliding].astype(np.float64), otherwise=bent[colliding])
            turned = bend_toward(bent[colliding], away, _BEND)
            bent[colliding] = self._slide(start[colliding], turned, clearance[colliding])
            here, slope_here = self._density.at(start[colliding] + 0.5 * segment * bent[colliding])
            slope[colliding] = slope_here
            better = here < least[colliding]
            least[colliding[better]] = here[better]
            best[colliding[better]] = bent[colliding[better]]
            colliding = colliding[here > ceiling[colliding]]
        self.tally.unresolved += len(colliding)
        return best

    def _add(self, wisps: Ints, joint: Ints | int, middles: Floats, frames: Floats, sign: float) -> None:
        across = frames[:, :, :2].transpose(0, 2, 1)
        radii = self.outlines.radii[wisps, joint]
        self._density.add(middles, across, radii, sign * self._amounts[wisps])
