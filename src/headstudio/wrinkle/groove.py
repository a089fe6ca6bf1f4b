"""A groove as it is fitted: one curve, and furrows of the shape (2.1) that run along it side by side.

Real grooves have round floors and rims of their own. The shape (2.1) has a sharp floor, so one furrow comes near such a
groove and a few parallel ones come close.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import NearestNDInterpolator
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from .bezier import BezierChain, fit_stroke
from .furrow import Controls, Furrow
from .laid_furrow import LaidFurrow, fade_length
from .metric import perpendicular
from .nearest import slid_to_nearest
from .scan_heights import SkinTexels
from .shape import REACH, bounded_shape, bounded_slope

# Limits of what a fitted furrow may be [m].
_DEPTHS, _WIDTHS, _TAPERS = (1e-5, 0.014), (1.2e-3, 0.016), (0.02, 0.5)
# In one step depth and width change by at most this factor's logarithm, places by so much [m].
_LOG_STEP, _STEP = 0.4, 1.5e-3
# Fitted furrows of a groove follow its curve within this [m].
_TOLERANCE = 1e-4
# Samples of each of its Bezier curves, to begin from where feet are looked for.
_SAMPLES = 24
_TINY = np.finfo(float).tiny


@dataclass(frozen=True)
class Strand:
    """One furrow of a groove. offset: how far to the left of the curve it runs [m]. depth, width: d and w [m]."""

    offset: float
    depth: float
    width: float


@dataclass(frozen=True, eq=False)
class Groove:
    """controls: of the curve, in texture space, (3 n + 1, 2). strands: its furrows. taper: how they end, see Furrow."""

    controls: Floats
    strands: tuple[Strand, ...]
    taper: float = 0.2

    @property
    def chain(self) -> BezierChain:
        """The curve."""
        return BezierChain(self.controls)

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

    def furrows(self, texels: SkinTexels, name: str, region: str = "") -> list[Furrow]:
        """The furrows, all there at rest, with control points in texture space; the deepest carries the name."""
        metrics = MetricField(texels)
        t, places = self.chain.sampled(24)
        left = metrics.across(places, self.chain.tangents(t))
        furrows = []
        for k, strand in enumerate(sorted(self.strands, key=lambda strand: -strand.depth)):
            path = places + strand.offset * left
            if strand.offset == 0:
                controls: Controls = tuple((float(x), float(y)) for x, y in self.controls)
            else:
                fitted = fit_stroke(path, _TOLERANCE / texels.layout.texture_map.metres)
                controls = tuple((float(x), float(y)) for x, y in fitted.controls)
            label = name if k == 0 else f"{name}, along it {k}"
            furrows.append(Furrow(label, region, strand.depth, strand.width, 1.0, controls, self.taper))
        return furrows


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
    """Where texels lie beside the curve of a groove; depends on the curve and the widest strand alone.

    rows: the texels within reach, (i,). across: distance to the left of the curve [m], (i,). arc: length along it to the
    foot of each [m], (i,). length: of the curve [m].
    """

    def __init__(self, groove: Groove, texels: SkinTexels, metrics: MetricField, near: Ints) -> None:
        """near: the texels that may be within reach."""
        widest = max(strand.width for strand in groove.strands)
        farthest = max(abs(strand.offset) for strand in groove.strands)
        laid = LaidFurrow(Furrow(controls=tuple((float(x), float(y)) for x, y in groove.controls)), texels.layout)
        self.groove = groove
        self.length = laid.length
        chain = laid.chain
        samples, places = chain.sampled(_SAMPLES)
        at_samples = metrics.at(places)
        # The nearest sample in space is close to the foot, which is then found on the curve.
        _, first = cKDTree(laid.line_at(samples)).query(texels.positions[near])
        mean = 0.5 * (texels.metrics[near] + at_samples[first])
        uv = laid.whole(texels.uv[near])
        found = slid_to_nearest(chain, uv, mean, samples[first])
        kept = np.flatnonzero((found.distance < REACH * widest + farthest) & ~found.beyond)
        self.rows: Ints = near[kept]
        t, g = found.t[kept], texels.metrics[near[kept]]
        self.across = found.side[kept] * found.distance[kept]
        self.arc = laid.arc(t)
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
        first, last = chain.controls[1] - chain.controls[0], chain.controls[-1] - chain.controls[-2]
        self._end_speed = 3.0 * metrics.lengths(chain.controls[[0, -1]], np.stack([first, last]))

    @property
    def unknowns(self) -> int:
        """Free control points, both ends, taper, and depth, width and offset of each strand."""
        return len(self.free) + 3 + 3 * len(self.groove.strands)

    def heights(self) -> list[tuple[Floats, Floats]]:
        """Height [m] and its derivatives by the unknowns, (i,) and (i, unknowns), strand by strand.

        Depth, width and taper count by their logarithms, places in metres.
        """
        result = []
        count = len(self.free)
        for k, strand in enumerate(self.groove.strands):
            offset = self.across - strand.offset
            distance = np.abs(offset)
            profile = bounded_shape(distance, strand.depth, strand.width)
            slope = bounded_slope(distance, strand.depth, strand.width)
            fade, by_start, by_end, by_width, by_taper = self._fade(strand.width)
            derivative = np.zeros((len(offset), self.unknowns))
            sideways = fade * slope * np.sign(offset)
            derivative[:, :count] = sideways[:, None] * self.by_control
            derivative[:, count], derivative[:, count + 1] = by_start * profile, by_end * profile
            derivative[:, count + 2] = by_taper * profile
            own = count + 3 + 3 * k
            derivative[:, own] = fade * profile
            derivative[:, own + 1] = -fade * distance * slope + by_width * profile
            # A lone furrow stays on the curve, which moves instead.
            derivative[:, own + 2] = -sideways if len(self.groove.strands) > 1 else 0.0
            result.append((fade * profile, derivative))
        return result

    def wholeness(self, width: float) -> Floats:
        """How much of a furrow of this width is there, (i,): 0 at the ends to 1."""
        return _faded(self.arc, self.length, width, self.groove.taper)

    def _fade(self, width: float) -> tuple[Floats, ...]:
        """How much of the depth is there, and its derivatives by a longer start, a longer end, log width and log taper."""
        fade, taper, step, part = self.wholeness(width), self.groove.taper, 1e-4, 0.01
        longer_start = _faded(self.arc + step, self.length + step, width, taper)
        longer_end = _faded(self.arc, self.length + step, width, taper)
        wider = _faded(self.arc, self.length, (1 + part) * width, taper)
        slower = _faded(self.arc, self.length, width, (1 + part) * taper)
        return (
            fade,
            (longer_start - fade) / step,
            (longer_end - fade) / step,
            (wider - fade) / part,
            (slower - fade) / part,
        )

    def moved(self, step: Floats) -> Groove:
        """The groove with its unknowns changed, (unknowns,)."""
        count = len(self.free)
        controls = self.groove.controls + self._moves @ (np.clip(step[:count], -_STEP, _STEP)[:, None] * self.free)
        start, end = np.clip(step[count : count + 2], -2 * _STEP, 2 * _STEP)
        controls = _prolonged(controls, start / self._end_speed[0])
        controls = _prolonged(controls[::-1], end / self._end_speed[1])[::-1]
        strands = []
        for strand, (depth, width, offset) in zip(self.groove.strands, step[count + 3 :].reshape(-1, 3)):
            strands.append(
                Strand(
                    strand.offset + float(np.clip(offset, -_STEP, _STEP)),
                    float(np.clip(strand.depth * np.exp(np.clip(depth, -_LOG_STEP, _LOG_STEP)), *_DEPTHS)),
                    float(np.clip(strand.width * np.exp(np.clip(width, -_LOG_STEP, _LOG_STEP)), *_WIDTHS)),
                )
            )
        taper = float(np.clip(self.groove.taper * np.exp(np.clip(step[count + 2], -_LOG_STEP, _LOG_STEP)), *_TAPERS))
        return Groove(controls, tuple(strands), taper)


def _faded(arc: Floats, length: float, width: float, taper: float) -> Floats:
    part = np.clip(np.minimum(arc, length - arc) / fade_length(length, width, taper), 0.0, 1.0)
    return part**2 * (3 - 2 * part)


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
