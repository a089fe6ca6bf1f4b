"""A furrow on a mapped skin: its length in metres, and where points of the skin lie beside it."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats
from ..head.smooth import smoothstep
from .bezier import BezierChain
from .cross_profile import section_reach
from .furrow import Furrow
from .nearest import nearest_on_curve, slid_to_nearest
from .skin_layout import SkinLayout
from .swell import swelling

# Samples a curve, for lengths along it.
_SAMPLES = 64
# A furrow fades out toward its ends over this many widths, or its taper if that is more; where a swell says how deep it is
# along its way, so many are enough.
_FADE_WIDTHS, _SWELLING = 4.0, 1.5
# Within this many widths of the curve the two walls blend into each other for shading.
_FLOOR = 0.35
_TINY = np.finfo(float).tiny


@dataclass(frozen=True, eq=False)
class Beside:
    """Where k points lie beside a furrow.

    t: parameter of the nearest point of the curve, (k,). distance: to it on the skin [m], (k,). side: 1 left, -1 right,
    (k,). inside: whether the point lies beside the curve and not past an end, (k,). fade: how much of the depth is
    there, 0 at the ends to 1, (k,). toward: gradient of the distance in texture space [m], (k, 2), going down to zero
    on the curve. along: gradient of the fade, (k, 2).
    """

    t: Floats
    distance: Floats
    side: Floats
    inside: np.ndarray
    fade: Floats
    toward: Floats
    along: Floats


class LaidFurrow:
    """A furrow whose control points are in texture space, on a skin.

    points: samples of it on the skin [m], (k, 3). length: [m]. reach: how far from the curve it displaces the skin [m].
    """

    def __init__(self, furrow: Furrow, layout: SkinLayout) -> None:
        self.furrow = furrow
        self.layout = layout
        self.chain: BezierChain = furrow.chain
        self.reach = section_reach(furrow.section) * furrow.width
        self._t, places = self.chain.sampled(_SAMPLES)
        found, _ = layout.locate(places)
        mesh = layout.texture_map.mesh
        self.points = found.blend(mesh.vertices, mesh.faces)
        corner_metrics = layout.corner_metrics[layout.part.faces[found.faces]]
        self._metrics = np.einsum("ki,kiab->kab", found.weights, corner_metrics)
        steps = np.diff(places, axis=0)
        between = 0.5 * (self._metrics[1:] + self._metrics[:-1])
        self._arc = np.concatenate([[0.0], np.cumsum(np.sqrt(np.einsum("ki,kij,kj->k", steps, between, steps)))])

    def named(self, furrow: Furrow) -> LaidFurrow:
        """The same line as that of another furrow, of another name or depth."""
        laid = copy(self)
        laid.furrow = furrow
        return laid

    @property
    def length(self) -> float:
        """Length on the skin [m]."""
        return float(self._arc[-1])

    @property
    def fade_length(self) -> float:
        """Over how much of its length the furrow comes to full depth at either end [m]."""
        furrow = self.furrow
        return fade_length(self.length, furrow.width, furrow.taper, bool(furrow.swell))

    def line(self, spacing: float) -> Floats:
        """Points along the furrow on the skin [m], no farther apart than ``spacing`` [m], (k, 3)."""
        count = max(int(np.ceil(self.length / spacing)), 2)
        return self._along(self._arc, np.linspace(0.0, self.length, count + 1))

    def line_at(self, t: Floats) -> Floats:
        """Points of the furrow on the skin [m] at t, (k,): (k, 3)."""
        return self._along(self._t, t)

    def _along(self, places: Floats, at: Floats) -> Floats:
        return np.stack([np.interp(at, places, self.points[:, k]) for k in range(3)], axis=1)

    def arc(self, t: Floats) -> Floats:
        """Length along the furrow from its start to t [m], (k,)."""
        return np.interp(t, self._t, self._arc)

    def beside_curve(self, beside: Beside, uv: Floats, distance: float) -> Floats:
        """Points, (k, 2), that lie where ``uv`` do but at another distance from the curve [m]."""
        foot = self.chain.at(beside.t)
        return foot + (self.whole(uv) - foot) * (distance / np.maximum(beside.distance, _TINY))[:, None]

    def beside(self, uv: Floats, metrics: Floats) -> Beside:
        """Where points of texture space, (k, 2), lie beside the furrow. metrics: G there, (k, 2, 2).

        Lengths are measured with the mean of G at the point and at the curve.
        """
        places = self.whole(uv)
        first = nearest_on_curve(self.chain, places, metrics)
        mean = 0.5 * (metrics + self._metrics_at(first.t))
        found = slid_to_nearest(self.chain, places, mean, first.t)
        covector = np.einsum("kij,kj->ki", mean, places - self.chain.at(found.t))
        # On the floor both sides meet, and the slope is theirs on average: none. It comes on over the first triangles, so
        # that shading does not depend on how far from the floor their corners happen to be.
        toward = _divided(covector, np.maximum(found.distance, _FLOOR * self.furrow.width))

        tangent = self.chain.tangents(found.t)
        arc = self.arc(found.t)
        from_end = np.minimum(arc, self.length - arc)
        part = np.clip(from_end / self.fade_length, 0.0, 1.0)
        rise = 6 * part * (1 - part) / self.fade_length * np.where(arc < 0.5 * self.length, 1.0, -1.0)
        fade = smoothstep(part)
        swell, change = swelling(arc / self.length, self.furrow.swell)
        fade, rise = swell * fade, swell * rise + fade * change / self.length
        along = np.einsum("kij,kj->ki", mean, tangent)
        along = _divided(along, np.sqrt(np.einsum("ki,ki->k", along, tangent)))
        return Beside(found.t, found.distance, found.side, ~found.beyond, fade, toward, rise[:, None] * along)

    def mirrored(self, t: Floats, uv: Floats) -> Floats:
        """Points, (k, 2), as far on the other side of the curve as ``uv`` are, whose nearest points are at t, (k,)."""
        return 2 * self.chain.at(t) - self.whole(uv)

    def whole(self, uv: Floats) -> Floats:
        """Texture coordinates, (k, 2), with whole turns added so that they lie near the furrow."""
        return self.layout.whole(uv, float(self.chain.controls[:, 0].mean()))

    def _metrics_at(self, t: Floats) -> Floats:
        flat = self._metrics.reshape(-1, 4)
        return np.stack([np.interp(t, self._t, flat[:, k]) for k in range(4)], axis=1).reshape(-1, 2, 2)


def fade_length(length: float, width: float, taper: float, swells: bool = False) -> float:
    """Over how much of its length [m] a furrow comes to full depth at either end [m]. swells: whether it has a swell."""
    return min(max((_SWELLING if swells else _FADE_WIDTHS) * width, taper * length), 0.5 * length)


def _divided(vectors: Floats, lengths: Floats) -> Floats:
    return np.divide(vectors, lengths[:, None], out=np.zeros_like(vectors), where=lengths[:, None] > 0)
