"""The hair around each particle: a short curve through it, along the directions of its neighbours.

One particle stands for thousands of strands across a centimetre. Bando et al. 2006 draw it as one flat billboard, and
name the interpolation between particles as future work. Here each particle knows the course of the hair through it,
two neighbours far towards the root and towards the tip, and the billboards bend along it.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from scipy.sparse import csr_array, diags_array
from scipy.spatial import cKDTree

from ..head.frame import HeadFrame
from ..head.mesh import Floats, Ints
from ..head.smooth import smoothstep
from ..lcp.model import HairModel
from ..scene.stage import HairOnStage
from .strays import StrayFinder, Strays, goes_round

SECTIONS = 5
"""Places on the curve: as many towards the root as towards the tip, and the particle itself."""

_MIDDLE = SECTIONS // 2
_NEIGHBOURS_ASKED = 24
# Arc lengths [m] between which hair fades in: ribbons start softly, and a few millimetres beside their own root.
_LEAVES_SCALP = (-0.002, 0.014)
_ENDS = 0.03  # before its end hair begins to thin out [m]
# A curve that winds, to and fro, by the first angle in all begins to go, by the second it has gone [rad].
_WINDING = (np.radians(70), np.radians(100))
# Hair that strays is a narrower lock by this part, and begins this far [m] before the particle it comes from.
_THINNER = 0.5
_EARLIER = 0.015


@dataclass(frozen=True, eq=False)
class HairCurves:
    """The hair through every particle at one instant, in the world.

    position [m] and unit direction of the particles, (n, 3); sideways: a vector across the hair that turns with it, of
    length 1, or less where hair strays in narrow locks, (n, 3). path [m] and tangent (unit) at the sections, root first,
    (n, SECTIONS, 3); along: their distances from the particle as a part of the curve's half length, -1 to 1,
    (n, SECTIONS). grown: 0 where the hair is still under the scalp or not drawn at all, as beyond a kink, 1 where it has
    left the scalp for good, (n, SECTIONS).
    """

    position: Floats
    direction: Floats
    sideways: Floats
    path: Floats
    tangent: Floats
    along: Floats
    grown: Floats


class CurveBuilder:
    """What can be said of the curves of a model before it moves; made once per model."""

    def __init__(self, model: HairModel) -> None:
        self.model = model
        root, tip = model.links.T
        self._rootward_mean = _mean_over(tip, root, model.alignment, model.count)
        self._tipward_mean = _mean_over(root, tip, model.alignment, model.count)
        self._hop = float(model.rest_length.mean()) if len(model.rest_length) else model.spacing
        self._strays = StrayFinder(model, self._rootward_mean)
        self._rest_sideways = _across(model.rest_directions)
        # No curve starts deeper under the scalp than the roots lie.
        self._depth = model.arc_length - model.arc_length.min(initial=0.0)
        # At its border hair may be so thin that the next particle towards the root is farther than a curve reaches.
        self._gap = np.full(model.count, np.inf)
        np.minimum.at(self._gap, tip, model.rest_length)
        self._gap[np.isinf(self._gap)] = 0.0

    def curves(self, hair: HairOnStage, frame: HeadFrame, half_length: float) -> HairCurves:
        """The curves reaching ``half_length`` [m] to both sides of each particle, but not out of the roots, and towards them
        as far as hair comes from.
        """
        turn = frame.rotation.as_matrix().T
        position = hair.positions @ turn + frame.translation
        combed = self._combed(hair)
        strays = self._strays.find(hair.positions, combed)
        combed = _along_lifelines(strays, hair.positions, combed)
        direction = combed @ turn
        rootward = self._directions(self._rootward_mean, direction)
        tipward = self._directions(self._tipward_mean, direction)
        path, tangent = np.empty((2, len(position), SECTIONS, 3))
        along = np.empty((len(position), SECTIONS))
        path[:, _MIDDLE], tangent[:, _MIDDLE], along[:, _MIDDLE] = position, direction, 0.0
        reach = np.minimum(np.maximum(half_length, self._gap), self._depth)
        for sign, directions, length in ((-1, rootward, reach), (1, tipward, np.full(len(position), half_length))):
            for k in range(1, _MIDDLE + 1):
                here, before = _MIDDLE + sign * k, _MIDDLE + sign * (k - 1)
                tangent[:, here] = _at(directions, k / _MIDDLE * length / self._hop)
                step = 0.5 * sign / _MIDDLE * length[:, None] * (tangent[:, here] + tangent[:, before])
                path[:, here] = path[:, before] + step
                along[:, here] = sign * k / _MIDDLE * np.minimum(length / half_length, 1.0)
        _follow_lifelines(strays, turn, frame.translation, path, tangent)
        from_scalp = self.model.arc_length[:, None] + half_length * along
        grown = np.clip((from_scalp - _LEAVES_SCALP[0]) / (_LEAVES_SCALP[1] - _LEAVES_SCALP[0]), 0.0, 1.0)
        grown *= 1.0 - strays.lost[:, None]
        # A few particles in a hundred, at the loose ends of the hair, come to lie behind what they hang on: a curve through
        # them would be a wiry hook. It has gone where the kink begins.
        turns = np.einsum("nsi,nsi->ns", tangent[:, 1:], tangent[:, :-1])
        wound = np.cumsum(np.arccos(np.clip(turns, -1.0, 1.0)), axis=1)
        straight = np.cumprod(goes_round(turns), axis=1) * (1.0 - smoothstep(wound, *_WINDING))
        # A lock that strays from the hair goes as a whole: nothing would be left of it but a piece that lies across the hair.
        straight[strays.which] += strays.astray[:, None] * (straight[strays.which, -1:] - straight[strays.which])
        grown *= np.concatenate([straight, straight[:, -1:]], axis=1)
        sideways = self._sideways(combed) @ turn
        sideways[strays.which] *= 1.0 - _THINNER * strays.astray[:, None]
        return HairCurves(position, direction, sideways, path, tangent, along, grown)

    def _combed(self, hair: HairOnStage) -> Floats:
        """Unit directions, (n, 3), each smoothed with its neighbours', and with the way from the ones to the others.

        A particle's own direction is that of one point. What is drawn stands for the hair over centimetres, and hair
        that is shaken stays combed: neighbours that point apart would be seen as feathers.
        """
        before, after = self._rootward_mean @ hair.directions, self._tipward_mean @ hair.directions
        way = self._tipward_mean @ hair.positions - self._rootward_mean @ hair.positions
        between = (np.diff(self._rootward_mean.indptr) > 0) & (np.diff(self._tipward_mean.indptr) > 0)
        way = np.where(between[:, None], unit(way), 0.0)
        return unit(hair.directions + before + after + way)

    def _directions(self, mean: csr_array, direction: Floats) -> list[Floats]:
        """Directions of the hair at the particle, one neighbour and two neighbours away; straight on where it ends."""
        directions = [direction]
        for _ in range(2):
            there = mean @ directions[-1]
            known = np.einsum("ni,ni->n", there, there) > 0
            directions.append(unit(np.where(known[:, None], there, directions[-1])))
        return directions

    def _sideways(self, direction: Floats) -> Floats:
        """The rest frames turned onto the hair by the smallest rotation; undefined only where hair turns by 180 degrees."""
        rest, side = self.model.rest_directions, self._rest_sideways
        cosine = np.einsum("ni,ni->n", rest, direction)
        along = np.einsum("ni,ni->n", side, direction) / np.maximum(1 + cosine, 1e-3)
        return unit(side - along[:, None] * (rest + direction))


def joined(first: HairCurves, second: HairCurves) -> HairCurves:
    """The curves of both, the first ones first."""
    names = [field.name for field in fields(HairCurves)]
    return HairCurves(*(np.concatenate([getattr(first, name), getattr(second, name)]) for name in names))


def openness(model: HairModel) -> Floats:
    """How open to the soft light each particle lies, 0 deep in the hair to 1 on its surface, (n,).

    A particle inside has neighbours all around, so that their mean is where it is itself; on the surface the mean lies
    inside.
    """
    above = model.rest_positions[~model.fixed]
    if len(above) == 0:
        return np.ones(model.count)
    distance, near = cKDTree(above).query(model.rest_positions, k=range(1, min(_NEIGHBOURS_ASKED, len(above)) + 1))
    offset = np.linalg.norm(above[near].mean(axis=1) - model.rest_positions, axis=1)
    return np.clip(offset / np.maximum(0.75 * distance.mean(axis=1), 1e-12), 0.0, 1.0)


def ending(model: HairModel) -> Floats:
    """What part of the hair at each particle ends there, from 0 where it goes on for more than _ENDS to 1 at its end, (n,).

    Where hair ends is where the last particle is that is rooted beside it.
    """
    roots = cKDTree(model.root_points)
    pairs = roots.query_pairs(model.spacing, output_type="ndarray")
    last = model.arc_length.copy()
    for one, other in (pairs.T, pairs.T[::-1]):
        np.maximum.at(last, one, model.arc_length[other])
    return np.clip(1.0 - (last - model.arc_length) / _ENDS, 0.0, 1.0)


def unit(vectors: Floats) -> Floats:
    """Vectors (..., 3) made of length 1; those of length 0 stay."""
    length = np.sqrt(np.einsum("...i,...i->...", vectors, vectors))
    return vectors / np.maximum(length, 1e-12)[..., None]


def _at(directions: list[Floats], hops: Floats) -> Floats:
    """Directions between those at 0, 1 and 2 neighbours' distance, at ``hops`` neighbours' distance, (n,)."""
    weights = (np.maximum(1 - np.abs(hops - k), 0.0) for k in range(2))
    first, second = weights
    third = 1 - first - second
    return unit(first[:, None] * directions[0] + second[:, None] * directions[1] + third[:, None] * directions[2])


def _along_lifelines(strays: Strays, positions: Floats, directions: Floats) -> Floats:
    """Directions, (n, 3): of particles that stray, the way that their lifelines come."""
    out, astray = directions.copy(), strays.astray[:, None]
    way = unit(positions[strays.which] - strays.start)
    out[strays.which] = unit((1 - astray) * directions[strays.which] + astray * way)
    return out


def _follow_lifelines(strays: Strays, turn: Floats, shift: Floats, path: Floats, tangent: Floats) -> None:
    """Lay the rootward half of the curves of particles that stray along their lifelines (cubic Hermite curves).

    turn, shift: from the head frame into the world. path, tangent: of ``HairCurves``, changed in place.
    """
    which, astray = strays.which, strays.astray[:, None]
    leaving, arriving = strays.start_direction @ turn, tangent[which, _MIDDLE]
    end = path[which, _MIDDLE]
    start = strays.start @ turn + shift - _EARLIER * leaving
    length = np.linalg.norm(end - start, axis=1, keepdims=True)
    for section in range(_MIDDLE):
        t = section / _MIDDLE
        place = (2 * t**3 - 3 * t**2 + 1) * start + (3 * t**2 - 2 * t**3) * end
        place += length * ((t**3 - 2 * t**2 + t) * leaving + (t**3 - t**2) * arriving)
        slope = (6 * t**2 - 6 * t) * (start - end)
        slope += length * ((3 * t**2 - 4 * t + 1) * leaving + (3 * t**2 - 2 * t) * arriving)
        path[which, section] += astray * (place - path[which, section])
        tangent[which, section] = unit((1 - astray) * tangent[which, section] + astray * unit(slope))


def _mean_over(rows: Ints, columns: Ints, weights: Floats, n: int) -> csr_array:
    """The operator that gives each particle the weighted mean of its neighbours; a row of zeros where it has none."""
    matrix = csr_array((weights, (rows, columns)), shape=(n, n))
    total = np.asarray(matrix.sum(axis=1)).ravel()
    return csr_array(diags_array(np.divide(1.0, total, out=np.zeros(n), where=total > 0)) @ matrix)


def _across(directions: Floats) -> Floats:
    """Some unit vector normal to each direction, (n, 3)."""
    axis = np.eye(3)[np.argmin(np.abs(directions), axis=1)]
    return unit(np.cross(directions, axis))
