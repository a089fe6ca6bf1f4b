"""Light that leaves the skin beside where it entered, by the sum of six Gaussians of d'Eon and Luebke 2007.

On a bent surface, light creeps past the edge of the shadow, red the farthest. Worked out beforehand for every curvature
and angle (Penner 2011) this costs one look into a table. The other way spreads the light in the picture, along its rows
and then along its columns. On a cylinder no integral is needed: the light that falls on it
is a clamped cosine around it, and a Gaussian of variance v on the arc shrinks its k-th harmonic by exp(-k^2 v / 2 r^2).
"""

from __future__ import annotations

import numpy as np
from scipy.special import ndtr

from ..head.mesh import Floats

VARIANCES = np.array([0.0064, 0.0484, 0.187, 0.567, 1.99, 7.41]) * 1e-6
"""Variance of every Gaussian [m^2], (6,)."""

WEIGHTS = np.array(
    [
        [0.233, 0.455, 0.649],
        [0.100, 0.336, 0.344],
        [0.118, 0.198, 0.000],
        [0.113, 0.007, 0.007],
        [0.358, 0.004, 0.000],
        [0.078, 0.000, 0.000],
    ]
)
"""Share of every Gaussian in red, green and blue, (6, 3); each colour's add up to 1."""

STEEPEST = 400.0
"""The largest curvature of the table [1/m]."""

_HARMONICS = 600


def lit_around(angle: Floats, curvature: Floats) -> Floats:
    """Light that leaves a cylinder [of what would fall on it facing the light], linear RGB.

    angle: between normal and light [rad]. curvature [1/m]. Any shapes that fit each other, (...); returns (..., 3).
    """
    k = np.arange(_HARMONICS + 1)
    even = k[2::2]
    clamped = np.zeros(_HARMONICS + 1)
    clamped[:2] = 1 / np.pi, 0.5
    clamped[2::2] = 2 * (-1.0) ** (even // 2 + 1) / (np.pi * (even**2 - 1))
    angle, curvature = np.broadcast_arrays(angle, curvature)
    shrunk = np.exp(-0.5 * (k * curvature[..., None])[..., None, :] ** 2 * VARIANCES[:, None])
    harmonics = clamped * np.cos(k * angle[..., None])
    light = np.einsum("...k,...gk,gc->...c", harmonics, shrunk, WEIGHTS)
    return np.maximum(light, 0.0)


def scattering_table(angles: int = 64, curvatures: int = 32) -> Floats:
    """``lit_around`` by curvature (rows, from 0 to STEEPEST as the square root) and cosine (columns, -1 to 1).

    Shape (curvatures, angles, 3).
    """
    cosine = np.linspace(-1.0, 1.0, angles)
    curvature = STEEPEST * np.linspace(0.0, 1.0, curvatures) ** 2
    return np.stack([lit_around(np.arccos(cosine), np.full(angles, bend)) for bend in curvature])


def scattering_taps(count: int = 6, farthest: float = 6.0e-3) -> tuple[Floats, Floats]:
    """Where to look for light that comes out elsewhere, and how much of it: distances [m], (count,), and shares, (count, 3).

    The first is the place itself; each of the others stands for both sides. They are close together where the profile is
    steep. All shares, both sides counted, add up to 1 for every colour.
    """
    distances = farthest * np.linspace(0.0, 1.0, count) ** 2
    edges = np.concatenate([[0.0], 0.5 * (distances[1:] + distances[:-1]), [np.inf]])
    reached = ndtr(edges[:, None] / np.sqrt(VARIANCES)) @ WEIGHTS
    shares = np.diff(reached, axis=0)
    shares[0] *= 2.0
    return distances, shares
