"""Member strands around their master strands (Choe, Ko 2005, section 2.1)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..head.mesh import Floats, Ints
from .catmull_rom import catmull_rom_matrix
from .markov import Singles


@dataclass(frozen=True, eq=False)
class Masters:
    """W master strands as their members need them.

    controls: control points [m], (W, n, 3). per_segment: how many of them there are from joint to joint. radii: deviation
    radius at every joint [m], (W, J + 1). ends: length in segments, (W,); what lies beyond is there to be cut off.
    """

    controls: Singles
    per_segment: int
    radii: Singles
    ends: Floats

    @cached_property
    def columns(self) -> Singles:
        """The control points by coordinate, (3, n, W)."""
        return np.ascontiguousarray(self.controls.transpose(2, 1, 0))


def displacements(radii: Singles, first: Singles, fuzziness: float, even: Singles) -> Singles:
    """d_k of member strands from their master's control points [m], (3, n, S), by the recurrence of eq. 1.

    radii: r_k at the control points of each strand's master [m], (n, S). first: d_1 [m], (3, S), not beyond r_1.
    fuzziness: sigma. even: uniform random numbers below 1, (n - 1, 3, S).

    The noise e = y x has a random direction x and a length y up to sigma r_k, but not beyond the sphere of radius r_k:
    |d_k| <= r_k. Where r_{k-1} is zero so is d_{k-1}, and the next one is noise alone.
    """
    directions = _directions(2 * even[:, 0] - 1, np.float32(2 * np.pi) * even[:, 1])
    # One is where the wisp is pinched to a point: any ratio will do for a displacement of zero.
    ratios = radii[1:] / np.where(radii[:-1] > 0, radii[:-1], 1)
    result = np.empty((3, *radii.shape), dtype=np.float32)
    result[:, 0] = first
    for k, (x, ratio) in enumerate(zip(directions, ratios), start=1):
        origin = ratio * result[:, k - 1]
        along = np.einsum("ij,ij->j", origin, x)
        room = radii[k] * radii[k] - np.einsum("ij,ij->j", origin, origin)
        reach = np.sqrt(np.maximum(along * along + room, 0)) - along
        y = even[k - 1, 2] * np.clip(reach, 0, np.float32(fuzziness) * radii[k])
        np.add(origin, y * x, out=result[:, k])
    return result


def _directions(height: Singles, turn: Singles) -> Singles:
    """Unit vectors by their height on the sphere, -1 to 1, and their longitude [rad], (n, S) each: (n, 3, S)."""
    level = np.sqrt(np.maximum(1 - height * height, 0))
    result = np.empty((len(height), 3, height.shape[1]), dtype=np.float32)
    np.multiply(level, np.cos(turn), out=result[:, 0])
    np.multiply(level, np.sin(turn), out=result[:, 1])
    result[:, 2] = height
    return result


@dataclass(frozen=True, eq=False)
class Cuts:
    """Matrices from control points to the points of a strand that is cut after c / 16 of a segment, c = 0 ... C.

    fine: for the control points of masters, (C + 1, points, n). coarse: for those at joints, (C + 1, points, J + 1).
    """

    fine: Singles
    coarse: Singles

    PER_SEGMENT: ClassVar[int] = 16

    @classmethod
    def of(cls, masters: Masters, points: int) -> Cuts:
        """All matrices that members of ``masters`` can need."""
        joints = masters.radii.shape[1] - 1
        last = cls.PER_SEGMENT * joints
        ends = np.arange(last + 1) / cls.PER_SEGMENT
        at = ends[:, None] * np.linspace(0.0, 1.0, points)

        def matrices(count: int, per_segment: int) -> Singles:
            return catmull_rom_matrix(count, per_segment * at.ravel()).reshape(*at.shape, count).astype(np.float32)

        coarse = matrices(joints + 1, 1)
        if masters.per_segment == 1:
            return cls(coarse, coarse)
        return cls(matrices(masters.controls.shape[1], masters.per_segment), coarse)

    def needed(self, cut: int, count: int) -> int:
        """How many of ``count`` control points bear on a strand that is cut there."""
        joints = self.coarse.shape[2] - 1
        return min(-(-cut * (count - 1) // (self.PER_SEGMENT * joints)) + 2, count)


def member_points(masters: Masters, cuts: Cuts, wisp: Ints, offsets: Singles, lengths: Floats) -> Singles:
    """Points of member strands [m], (S, points, 3), even in the spline's parameter from root to tip.

    wisp: of each strand, (S,). offsets: displacements from the master at its joints [m], (3, J + 1, S). lengths: u,
    relative to the master, (S,).

    A spline is linear in its control points, so a strand is the master's spline plus that of its displacements, and
    strands that end near one another share one matrix. What is left of their length is made good along the tangent.
    """
    ends = Cuts.PER_SEGMENT * lengths * masters.ends[wisp]
    cut = np.clip(np.rint(ends), 1, len(cuts.coarse) - 1).astype(np.int64)
    order = np.argsort(cut, kind="stable")
    wisp, offsets = wisp[order], offsets.take(order, axis=2)
    curled = cuts.fine is not cuts.coarse
    if not curled:
        offsets += masters.columns.take(wisp, axis=2)
    sampled = np.empty((3, cuts.coarse.shape[1], len(wisp)), dtype=np.float32)
    places, starts = np.unique(cut[order], return_index=True)
    for place, start, stop in zip(places, starts, [*starts[1:], len(wisp)], strict=True):
        here = slice(start, stop)
        fine, coarse = (cuts.needed(place, count) for count in (cuts.fine.shape[2], cuts.coarse.shape[2]))
        sampled[:, :, here] = cuts.coarse[place, :, :coarse] @ offsets[:, :coarse, here]
        if curled:
            sampled[:, :, here] += cuts.fine[place, :, :fine] @ masters.columns[:, :fine].take(wisp[here], axis=2)
    longer = (ends[order] / cut[order] - 1).astype(np.float32)
    sampled += np.gradient(sampled, axis=1) * (np.arange(sampled.shape[1], dtype=np.float32)[:, None] * longer)
    result = np.empty((len(wisp), sampled.shape[1], 3), dtype=np.float32)
    for axis in range(3):
        result[order, :, axis] = sampled[axis].T
    return result
