"""A groove as it is fitted: one curve, a cross section, and how its depth swells along it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import NearestNDInterpolator
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from ..head.rows import row_dot
from ..head.smooth import smoothstep
from .bezier import BezierChain
from .cross_profile import Section, section_height, section_reach, section_shares, section_slope
from .furrow import Furrow
from .laid_furrow import LaidFurrow, fade_length
from .metric import perpendicular
from .nearest import slid_to_nearest
from .scan_heights import SkinTexels
from .swell import swell_shares, swelling

# Limits of what a fitted furrow may be [m].
_SHALLOWEST, _DEEPEST, _WIDTHS, _TAPERS = 1e-5, 0.014, (5e-4, 0.008), (0.02, 0.5)
# Nowhere does a groove swell to more than this many times its depth.
_FULLEST = 4.0
# In one step width, taper and swell change by at most this (a factor's logarithm), places and depths by so much [m].
_LOG_STEP, _STEP = 0.4, 1.5e-3
# A cross section is looked at in so many places to find its floor.
_PLACES = 801
# Distances in space are a little shorter than on the skin, and those to samples of a curve a little longer [m].
_FARTHER, _BETWEEN = 1.05, 1e-3
_TINY = np.finfo(float).tiny


SAMPLES = 24
"""Samples of each Bezier curve, to begin from where feet are looked for."""


@dataclass(frozen=True, eq=False)
class Groove:
    """controls: of the curve, in texture space, (3 n + 1, 2). width, depth: w and d [m]. section, taper, swell: see Furrow.

    Without a section, width and depth are unknowns of the fit; with one they are its units.
    """

    controls: Floats
    width: float
    depth: float
    section: Section = ()
    taper: float = 0.2
    swell: tuple[float, ...] = ()

    @property
    def chain(self) -> BezierChain:
        """The curve."""
        return BezierChain(self.controls)

    @property
    def floor(self) -> float:
        """How deep the groove is where it is deepest [m]."""
        across = np.linspace(-self.reach, self.reach, _PLACES)
        lowest = section_height(across, self.depth, self.width, self.section).min()
        return -float(lowest) * max(self.swell, default=1.0)

    @property
    def reach(self) -> float:
        """How far from its curve the groove displaces the skin [m]."""
        return section_reach(self.section) * self.width

    def subdivided(self, longest: float) -> Groove:
        """The same with every Bezier curve halved that is longer than a part ``longest`` of the whole."""
        t, places = self.chain.sampled(12)
        steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
        lengths = np.bincount(self.chain.split(0.5 * (t[1:] + t[:-1]))[0], steps)
        pieces = [self.controls[:1]]
        for k, length in enumerate(lengths):
            quad = self.controls[3 * k : 3 * k + 4]
            halves = _halved(quad) if length > longest * lengths.sum() else quad
            pieces.append(halves[1:])
        return replace(self, controls=np.concatenate(pieces))

    def trimmed(self, arc_at: Callable[[Floats], Floats], seen: NDArray[np.bool_], least: float) -> Groove:
        """Without what lies beyond the first and the last place where a part ``least`` of the full depth is there, and seen.

        arc_at: from the parameter of the curve, (k,), to the length along it [m], (k,). seen: of each of its samples,
        SAMPLES to a Bezier curve, whether anything is known of the skin there.
        """
        t, _ = self.chain.sampled(SAMPLES)
        arc = arc_at(t)
        whole = faded(self, arc, arc[-1]) * swelling(arc / arc[-1], self.swell)[0]
        shown = np.flatnonzero(seen & (whole >= least * whole.max(where=seen, initial=0.0)))
        if not len(shown):
            return self
        first, last = max(shown[0] - 1, 0), min(shown[-1] + 1, len(t) - 1)
        if last - first < 2 or last - first == len(t) - 1:
            return self
        chain = self.chain.between(float(t[first]), float(t[last]))
        if not self.swell:
            return replace(self, controls=chain.controls)
        # As much of it is there as was, though now the shorter line fades.
        length = arc[last] - arc[first]
        short = fade_length(length, self.width, self.taper, True)
        places = np.clip(np.linspace(0.0, length, len(self.swell)), 0.4 * short, length - 0.4 * short)
        swell = np.interp(arc[first] + places, arc, whole) / faded(self, places, length)
        return replace(self, controls=chain.controls, swell=tuple(np.clip(swell, 0.0, _FULLEST).tolist()))

    def furrow(self, name: str, region: str = "") -> Furrow:
        """As a furrow that is there at rest and adds to others, with control points in texture space."""
        depth = min(max(self.floor, 1e-6), _DEEPEST)
        most = max(max(self.swell, default=1.0), _TINY)
        section = tuple(height * self.depth * most / depth for height in self.section)
        swell = tuple(part / most for part in self.swell)
        controls = tuple((float(x), float(y)) for x, y in self.controls)
        return Furrow(
            name, region, depth, self.width, 1.0, controls, self.taper, adds=True, section=section, swell=swell
        )


class MetricField:
    """G anywhere on mapped skin."""

    def __init__(self, texels: SkinTexels) -> None:
        self._nearest = NearestNDInterpolator(texels.uv, texels.metrics.reshape(-1, 4))

    def at(self, uv: Floats) -> Floats:
        """G at points of texture space, (k, 2): (k, 2, 2)."""
        return np.asarray(self._nearest(uv)).reshape(-1, 2, 2)

    def across(self, uv: Floats, directions: Floats) -> Floats:
        """Directions square to the given ones, to the left, one metre long on the skin, (k, 2)."""
        metrics = self.at(uv)
        left = perpendicular(directions, metrics)
        return left / _length(left, metrics)[:, None]

    def lengths(self, uv: Floats, steps: Floats) -> Floats:
        """How long steps, (k, 2), at points, (k, 2), are on the skin [m], (k,)."""
        return _length(steps, self.at(uv))


class GrooveBed:
    """Where texels lie beside the curve of a groove; depends on the curve and how far it reaches alone.

    rows: the texels within reach, (i,). across: distance to the left of the curve [m], (i,). arc: length along it to the
    foot of each [m], (i,). length: of the curve [m].
    """

    def __init__(self, groove: Groove, texels: SkinTexels, metrics: MetricField, near: Ints) -> None:
        """near: the texels that may be within reach."""
        reach = groove.reach
        laid = LaidFurrow(Furrow(controls=tuple((float(x), float(y)) for x, y in groove.controls)), texels.layout)
        self.groove = groove
        self.length = laid.length
        chain = laid.chain
        samples, places = chain.sampled(SAMPLES)
        at_samples = metrics.at(places)
        # The nearest sample in space is close to the foot, which is then found on the curve.
        away, first = cKDTree(laid.line_at(samples)).query(
            texels.positions[near], distance_upper_bound=_FARTHER * reach + _BETWEEN
        )
        reached = np.isfinite(away)
        near, first = near[reached], first[reached]
        mean = 0.5 * (texels.metrics[near] + at_samples[first])
        uv = laid.whole(texels.uv[near])
        found = slid_to_nearest(chain, uv, mean, samples[first])
        kept = np.flatnonzero((found.distance < reach) & ~found.beyond)
        self.rows: Ints = near[kept]
        t, g = found.t[kept], texels.metrics[near[kept]]
        self.across = found.side[kept] * found.distance[kept]
        self.arc = laid.arc(t)
        self.arc_at = laid.arc
        tangent = chain.tangents(t)
        # The gradient of the distance in texture space, towards the left.
        turned = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
        ahead = turned * (np.sqrt(np.linalg.det(g)) / np.maximum(_length(tangent, g), _TINY))[:, None]
        free, weights = _free_controls(chain)
        self.free = metrics.across(chain.at(free / 3.0), chain.tangents(free / 3.0))
        self._moves = weights
        piece, u = chain.split(t)
        shares = np.zeros((len(t), len(chain.controls)))
        for k, share in enumerate(((1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u**2 * (1 - u), u**3)):
            shares[np.arange(len(t)), 3 * piece + k] = share
        # How the distance falls as each free control point moves a metre to its left, (i, f).
        self.by_control = -(shares @ weights) * (ahead @ self.free.T)
        self._metrics = metrics
        first, last = chain.controls[1] - chain.controls[0], chain.controls[-1] - chain.controls[-2]
        self._end_speed = 3.0 * metrics.lengths(chain.controls[[0, -1]], np.stack([first, last]))

    @property
    def unknowns(self) -> int:
        """Free control points, both ends, taper, width and depth or the heights of the section, and the swell."""
        return len(self.free) + 3 + (len(self.groove.section) or 2) + len(self.groove.swell)

    def scales(self, logarithm: float, place: float) -> Floats:
        """The sizes of unknowns, (unknowns,), given those of logarithms and of lengths [m]."""
        section, swell = len(self.groove.section), len(self.groove.swell)
        logarithms, heights = (1, section) if section else (2, 1)
        return np.repeat([place, logarithm, place, logarithm], [len(self.free) + 2, logarithms, heights, swell])

    def heights(self) -> tuple[Floats, Floats]:
        """Height [m] and its derivatives by the unknowns, (i,) and (i, unknowns).

        Width and taper count by their logarithms, places and heights in metres, the swell as it is.
        """
        groove, count = self.groove, len(self.free)
        shape = groove.depth, groove.width, groove.section
        profile, slope = section_height(self.across, *shape), section_slope(self.across, *shape)
        fade, *by_ends, by_width, by_taper = self._fade()
        part = self.arc / self.length
        swell = swelling(part, groove.swell)[0]
        derivative = np.zeros((len(profile), self.unknowns))
        derivative[:, :count] = (fade * swell * slope)[:, None] * self.by_control
        for k, change in enumerate((*by_ends, by_taper)):
            derivative[:, count + k] = swell * change * profile
        if groove.section:
            shares = section_shares(self.across, groove.width, len(groove.section))
            derivative[:, count + 3 : count + 3 + len(groove.section)] = (fade * swell)[:, None] * shares
        else:
            derivative[:, count + 3] = swell * (by_width * profile - fade * self.across * slope)
            derivative[:, count + 4] = fade * swell * section_height(self.across, 1.0, groove.width, ())
        if groove.swell:
            derivative[:, -len(groove.swell) :] = (fade * profile)[:, None] * swell_shares(part, len(groove.swell))[0]
        return fade * swell * profile, derivative

    def curving(self) -> tuple[Floats, Floats]:
        """How far control points lie off the middle of those beside them, square to the curve [m], (2 n,), where a cubic
        bends, and how that changes as each free control point moves a metre to its left, (2 n, f)."""
        controls = self.groove.controls
        middle = np.setdiff1d(np.arange(1, len(controls) - 1), np.arange(3, len(controls) - 1, 3))
        left = self._metrics.across(controls[middle], controls[middle + 1] - controls[middle - 1])
        g = self._metrics.at(controls[middle])
        square = np.einsum("kij,kj->ki", g, left)
        bend = controls[middle - 1] - 2.0 * controls[middle] + controls[middle + 1]
        moves = self._moves[middle - 1] - 2.0 * self._moves[middle] + self._moves[middle + 1]
        return row_dot(square, bend), moves * (square @ self.free.T)

    def wholeness(self) -> Floats:
        """How much of the groove is there, (i,): 0 at the ends to 1."""
        fade = faded(self.groove, self.arc, self.length)
        return fade * swelling(self.arc / self.length, self.groove.swell)[0]

    def _fade(self) -> tuple[Floats, ...]:
        """How much of the depth is there, and its derivatives by a longer start, a longer end, log width and log taper."""
        groove, step, part = self.groove, 1e-4, 0.01
        fade = faded(groove, self.arc, self.length)
        longer_start = faded(groove, self.arc + step, self.length + step)
        longer_end = faded(groove, self.arc, self.length + step)
        wider = faded(replace(groove, width=(1 + part) * groove.width), self.arc, self.length)
        slower = faded(replace(groove, taper=(1 + part) * groove.taper), self.arc, self.length)
        return (
            fade,
            (longer_start - fade) / step,
            (longer_end - fade) / step,
            (wider - fade) / part,
            (slower - fade) / part,
        )

    def moved(self, step: Floats) -> Groove:
        """The groove with its unknowns changed, (unknowns,)."""
        groove, count = self.groove, len(self.free)
        controls = groove.controls + self._moves @ (np.clip(step[:count], -_STEP, _STEP)[:, None] * self.free)
        start, end = np.clip(step[count : count + 2], -2 * _STEP, 2 * _STEP)
        controls = _prolonged(controls, start / self._end_speed[0])
        controls = _prolonged(controls[::-1], end / self._end_speed[1])[::-1]
        factors = np.exp(np.clip(step[count + 2 : count + 4], -_LOG_STEP, _LOG_STEP))
        taper = float(np.clip(factors[0] * groove.taper, *_TAPERS))
        last = len(step) - len(groove.swell)
        heights = np.clip(step[count + 3 : last], -_STEP, _STEP)
        more = np.clip(step[last:], -_LOG_STEP, _LOG_STEP)
        swell = tuple(float(np.clip(part + change, 0.0, _FULLEST)) for part, change in zip(groove.swell, more))
        if groove.section:
            # The swell says where there is more, the section how much: else the swell would come to its limit.
            size = float(np.sqrt(np.mean(np.square(swell)))) if any(swell) else 1.0
            swell = tuple(part / size for part in swell)
            section = tuple(float(size * (h + change / groove.depth)) for h, change in zip(groove.section, heights))
            return replace(groove, controls=controls, section=section, taper=taper, swell=swell)
        width = float(np.clip(factors[1] * groove.width, *_WIDTHS))
        depth = max(groove.depth + float(heights[1]), _SHALLOWEST)
        return replace(groove, controls=controls, width=width, depth=depth, taper=taper, swell=swell)


def faded(groove: Groove, arc: Floats, length: float) -> Floats:
    """How much of a groove is there, swell apart, at lengths along it [m], (k,): 0 at the ends to 1."""
    fade = fade_length(length, groove.width, groove.taper, bool(groove.swell))
    return smoothstep(np.minimum(arc, length - arc), end=fade)


def _free_controls(chain: BezierChain) -> tuple[Ints, Floats]:
    """Control points that move by themselves, (f,), and how far every one follows them, (3 n + 1, f).

    A joint stays between its neighbours as it is, so that the curve stays smooth.
    """
    count = len(chain.controls)
    joints = np.arange(3, count - 1, 3)
    free = np.setdiff1d(np.arange(count), joints)
    weights = np.zeros((count, len(free)))
    weights[free, np.arange(len(free))] = 1.0
    before = np.linalg.norm(chain.controls[joints] - chain.controls[joints - 1], axis=1)
    after = np.linalg.norm(chain.controls[joints + 1] - chain.controls[joints], axis=1)
    share = (before / np.maximum(before + after, _TINY))[:, None]
    weights[joints] = (1 - share) * weights[joints - 1] + share * weights[joints + 1]
    return free, weights


def _prolonged(controls: Floats, part: float) -> Floats:
    """A chain whose first curve begins ``part`` of its parameter earlier (below 0: later)."""
    u = float(np.clip(-part, -0.4, 0.4))
    a, b, c, d = controls[:4]
    if u < 0:
        # Straight on: a cubic would curl.
        return np.concatenate([[a + 3 * u * (b - a), b + 1.5 * u * (b - a)], controls[2:]])

    def between(p: Floats, q: Floats) -> Floats:
        return (1 - u) * p + u * q

    ab, bc, cd = between(a, b), between(b, c), between(c, d)
    abc, bcd = between(ab, bc), between(bc, cd)
    return np.concatenate([[between(abc, bcd), bcd, cd], controls[3:]])


def _halved(quad: Floats) -> Floats:
    """A cubic curve, (4, 2), as two, (7, 2): de Casteljau's construction."""
    edges = 0.5 * (quad[1:] + quad[:-1])
    inner = 0.5 * (edges[1:] + edges[:-1])
    return np.stack([quad[0], edges[0], inner[0], 0.5 * (inner[0] + inner[1]), inner[1], edges[2], quad[3]])


def _length(vectors: Floats, metrics: Floats) -> Floats:
    return np.sqrt(np.einsum("ki,kij,kj->k", vectors, metrics, vectors))
