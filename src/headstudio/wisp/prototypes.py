"""Prototype strands: the details that all strands of a head share, drawn by hand or made by code (section 2.2)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from ..head.mesh import Floats
from ..params import ParameterError
from .parting import unit
from .settings import Path3D, WispSettings

_PERIODS = 14
_SAMPLES = 400  # of a drawn curve


@dataclass(frozen=True, eq=False)
class Prototype:
    """Details along a straight outline.

    details: displacements from the outline [m], (k, 3), at places along it [m], (k,), in the outline's frame: two
    directions across, and along. extent: how long the outline is [m]. pitch: length of its regular structure [m].
    """

    details: Callable[[Floats], Floats]
    extent: float
    pitch: float

    def sampled(self, spacing: float) -> Floats:
        """Details delta* every ``spacing`` [m] of the outline, (m, 3), two or more."""
        return self.details(np.arange(max(int(self.extent / spacing) + 1, 2), dtype=np.float64) * spacing)


def prototype_of(settings: WispSettings) -> Prototype | None:
    """The prototype that the settings ask for, with its curls scaled; None if it is straight.

    Raises ParameterError for a drawn curve that is none.
    """
    if settings.prototype_curve:
        plain = from_curve(settings.prototype_curve)
    elif settings.prototype in _SHIPPED:
        plain = _SHIPPED[settings.prototype]()
    else:
        plain = None
    if plain is None or settings.curl_size == 0:
        return None
    size, length = settings.curl_size, settings.curl_length
    scale = np.array([size, size, length])
    return Prototype(lambda places: scale * plain.details(places / length), length * plain.extent, length * plain.pitch)


def from_curve(path: Path3D) -> Prototype | None:
    """A drawn or imported strand [m], root first, taken apart into outline and details; None if it is straight.

    The outline is the cubic in arc length that fits the strand best: it takes the bow of the whole strand, and leaves
    what repeats along it to the details. Raises ParameterError for less than two different points.
    """
    points = np.array(path, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
        raise ParameterError("a prototype strand is a line of points (x, y, z)")
    points = points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9])]
    if len(points) < 2:
        raise ParameterError("a prototype strand has two different points or more")
    curve = _evenly_along(points)
    at = np.linspace(-1, 1, _SAMPLES)
    outline = np.polynomial.polynomial.polyval(at, np.polynomial.polynomial.polyfit(at, curve, 3)).T.astype(np.float64)
    steps = np.linalg.norm(np.diff(outline, axis=0), axis=1)
    place = np.concatenate([[0.0], np.cumsum(np.maximum(steps, 1e-9))])
    frames = _frames_along(outline)
    details: Floats = np.einsum("kij,ki->kj", frames, curve - outline)
    if np.linalg.norm(details, axis=1).max() < 1e-3 * place[-1]:
        return None
    return Prototype(CubicSpline(place, details), float(place[-1]), _pitch(details, float(place[-1])))


def _evenly_along(points: Floats) -> Floats:
    """A smooth curve through ``points``, (k, 3), evenly sampled by arc length, (_SAMPLES, 3)."""
    chord = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    spline = (
        CubicSpline(chord, points)
        if len(points) > 2
        else lambda t: points[0] + t[:, None] / t[-1] * np.ptp(points, axis=0)
    )
    dense = spline(np.linspace(0.0, chord[-1], 4 * _SAMPLES))
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(dense, axis=0), axis=1))])
    at = np.linspace(0.0, length[-1], _SAMPLES)
    return np.stack([np.interp(at, length, column) for column in dense.T], axis=1)


def _frames_along(outline: Floats) -> Floats:
    """Frames that turn as little as they can along a line, (k, 3, 3): two directions across and the direction along."""
    along = unit(np.gradient(outline, axis=0))
    across = np.cross(along[0], np.eye(3)[np.abs(along[0]).argmin()])
    frames = np.empty((len(along), 3, 3))
    for k, direction in enumerate(along):
        across = unit(across - (across @ direction) * direction)
        frames[k] = np.stack([across, np.cross(direction, across), direction], axis=1)
    return frames


def _pitch(details: Floats, extent: float) -> float:
    """Length of the strongest wave in the details [m], of those that are at least twice in them."""
    power = (np.abs(np.fft.rfft(details - details.mean(axis=0), axis=0)) ** 2).sum(axis=1)
    return extent / (2 + int(power[2 : len(power) // 4].argmax()))


def _wander(places: Floats, wavelength: float, seed: int) -> Floats:
    """Irregularity along a strand, about -1 to 1, (k,), smooth over ``wavelength`` [m] and never quite repeating."""
    phase = np.random.default_rng(seed).uniform(0, 2 * math.pi, 3)
    waves = [
        np.sin(2 * math.pi * places / (wavelength * ratio) + phase[k]) for k, ratio in enumerate((1.0, 1.618, 2.718))
    ]
    return np.mean(waves, axis=0) * 1.5


def _helix(radius: float, pitch: float, irregularity: float, seed: int, flat: float = 1.0) -> Prototype:
    """A curl: turns of ``radius`` and ``pitch`` [m], whose size and pace wander; ``flat`` 0 is a wave in one plane."""

    def details(places: Floats) -> Floats:
        angle = 2 * math.pi * (places / pitch + irregularity * _wander(places, 2.3 * pitch, seed))
        size = radius * (1 + irregularity * _wander(places, 3.1 * pitch, seed + 1))
        along = 0.25 * irregularity * pitch * _wander(places, 1.7 * pitch, seed + 2)
        return np.stack([size * np.cos(angle), flat * size * np.sin(angle), along], axis=-1)

    return Prototype(details, _PERIODS * pitch, pitch)


def _zigzag(reach: float, pitch: float, irregularity: float, seed: int, flat: float = 0.0) -> Prototype:
    """Sharp bends to and fro in one plane, as plaits leave them; ``flat`` above 0 adds bends across it."""

    def details(places: Floats) -> Floats:
        phase = places / pitch + irregularity * _wander(places, 2.3 * pitch, seed)
        size = reach * (1 + irregularity * _wander(places, 3.1 * pitch, seed + 1))
        aside = irregularity * reach * _wander(places, 1.3 * pitch, seed + 2)
        along = 0.5 * irregularity * pitch * _wander(places, 1.7 * pitch, seed + 3)
        return np.stack([size * _to_and_fro(phase), flat * size * _to_and_fro(phase + 0.3) + aside, along], axis=-1)

    return Prototype(details, _PERIODS * pitch, pitch)


def _to_and_fro(phase: Floats) -> Floats:
    """A triangle wave between -1 and 1 of period 1."""
    return 4 * np.abs(phase - np.floor(phase + 0.5)) - 1


# Sizes [m] of curls as hairdressers class them: wavy is 2B, loose curl 3A, tight curl 3C, coil 4A, kinky 4B.
_SHIPPED: Mapping[str, Callable[[], Prototype]] = {
    "wavy": lambda: _helix(0.007, 0.055, 0.12, seed=1, flat=0.25),
    "loose curl": lambda: _helix(0.009, 0.042, 0.18, seed=2),
    "tight curl": lambda: _helix(0.0045, 0.018, 0.18, seed=3),
    "coil": lambda: _helix(0.003, 0.010, 0.08, seed=4),
    "kinky": lambda: _zigzag(0.0026, 0.009, 0.2, seed=5, flat=0.8),
    "zigzag": lambda: _zigzag(0.0035, 0.014, 0.1, seed=6),
}
