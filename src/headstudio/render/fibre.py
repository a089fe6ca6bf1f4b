"""How one hair scatters light: the reference in numpy, and the tables from it that shaders read.

A hair is a dielectric cylinder with pigment. Light is reflected at its surface (R), passes through it (TT), is reflected
once inside (TRT) or more often (TRRT and on). Each lobe is a product of a longitudinal part M (along the hair), an
azimuthal part N (around it) and an attenuation A, which together lose nothing but what the pigment absorbs. The model is
Chiang et al. 2016, "A practical and controllable hair and fur model", after Marschner et al. 2003 and d'Eon et al. 2011.
A strand is thinner than a pixel, so the offset h at which light meets it is averaged over.

Angles: theta is the inclination to the plane across the hair, phi the azimuth between light and eye around it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.special import i0e

from ..head.mesh import Floats

LOBES = 4
"""R, TT, TRT, and all that is reflected inside more often."""

AZIMUTHS, SINES, ABSORPTIONS = 64, 24, 24
"""Size of the azimuthal tables: samples of phi in 0..pi, of the sine of theta in 0..1, and of the absorption."""

DIRECTIONS = 4
"""Parts of the azimuth, of a quarter turn each way, that soft light comes from; as in common/fibre.glsl."""

_OFFSETS = 48
# Of x / (1 + x), the last absorption in the tables; coded_most in common/fibre.glsl.
_CODED_MOST = 0.98
# Of the light, by a strand of a pile; as in common/pile.glsl.
_LEAST_KEPT = 1e-4


@dataclass(frozen=True)
class Fibre:
    """The surface of a hair.

    roughness: along the hair, and radial_roughness: around it, 0 to 1, as felt (Chiang et al. 2016, eq. 7 and 8).
    tilt: angle of the scales to the surface [rad]. index: of refraction.
    """

    roughness: float = 0.3
    radial_roughness: float = 0.3
    tilt: float = np.radians(2.0)
    index: float = 1.55

    @property
    def variances(self) -> Floats:
        """Longitudinal variance of every lobe, (LOBES,)."""
        beta = self.roughness
        variance = (0.726 * beta + 0.812 * beta**2 + 3.7 * beta**20) ** 2
        return variance * np.array([1.0, 0.25, 4.0, 4.0])

    @property
    def tilts(self) -> Floats:
        """How far every lobe leans towards the root [rad], (LOBES,)."""
        return self.tilt * np.array([2.0, -1.0, -4.0, 0.0])

    @property
    def logistic_scale(self) -> float:
        """Scale of the azimuthal logistic distribution."""
        beta = self.radial_roughness
        return float(np.sqrt(np.pi / 8) * (0.265 * beta + 1.194 * beta**2 + 5.372 * beta**22))


def melanin_absorption(melanin: float, redness: float) -> Floats:
    """Absorption per radius, RGB, (3,), of hair with this much melanin, 0 to 1, of which ``redness`` is pheomelanin.

    Concentration is -log(1 - melanin); the colours of the two pigments are those of Blender's principled hair, so that
    a look can be taken from one program to the other.
    """
    amount = -np.log(max(1.0 - melanin, 1e-4))
    eumelanin, pheomelanin = np.array([0.506, 0.841, 1.653]), np.array([0.343, 0.733, 1.924])
    return amount * ((1.0 - redness) * eumelanin + redness * pheomelanin)


def colour_absorption(colour: Floats, radial_roughness: float) -> Floats:
    """Absorption per radius of hair that shows this linear colour, (..., 3), when a mass of it is lit evenly.

    Chiang et al. 2016, eq. 9. Black and white are held within what hair can be.
    """
    return (np.log(np.clip(colour, 1e-3, 0.98)) / colour_slope(radial_roughness)) ** 2


def colour_slope(radial_roughness: float) -> float:
    """The polynomial of Chiang et al. 2016, eq. 9."""
    return float(np.polyval([0.245, 5.574, -10.73, 2.532, -0.215, 5.969], radial_roughness))


def longitudinal(sin_in: Floats, sin_mirrored: Floats, variance: float) -> Floats:
    """M: spread along the hair about the mirrored inclination of the eye (d'Eon et al. 2011, eq. 7).

    Its integral times cos(theta_in) over theta_in is 1.
    """
    cosines = np.sqrt((1 - sin_in**2) * (1 - sin_mirrored**2))
    sines = sin_in * sin_mirrored
    # I0 scaled by exp(-x), so that narrow lobes do not overflow: 1 / (2 v sinh(1/v)) = exp(-1/v) / (v (1 - exp(-2/v))).
    scale = 1.0 / (variance * -np.expm1(-2.0 / variance))
    return i0e(cosines / variance) * np.exp((cosines + sines - 1.0) / variance) * scale


def attenuation(sin_out: Floats, offset: Floats, absorption: Floats, index: float) -> Floats:
    """A: what part of the light leaves by each lobe, (..., LOBES); without absorption the sum is 1.

    sin_out: of the eye's inclination; offset: where the hair is met across its width, -1 to 1; absorption: per radius.
    The three broadcast against each other.
    """
    sin_out, offset, absorption = np.broadcast_arrays(sin_out, offset, absorption)
    cos_out = np.sqrt(np.maximum(1 - sin_out**2, 1e-8))
    across = np.sqrt(np.maximum(1 - offset**2, 0.0))
    mirrored = _fresnel(cos_out * across, index)
    sin_inside = sin_out / index
    cos_inside = np.sqrt(1 - sin_inside**2)
    cos_gamma = np.sqrt(np.maximum(1 - (offset / _bravais(sin_out, index)) ** 2, 0.0))
    passed = np.exp(-2 * absorption * cos_gamma / cos_inside)
    through = (1 - mirrored) ** 2 * passed
    inside = through * passed * mirrored
    rest = inside * passed * mirrored / (1 - passed * mirrored)
    return np.stack([mirrored, through, inside, rest], axis=-1)


def azimuthal(phi: Floats, sin_out: Floats, absorption: Floats, fibre: Fibre) -> Floats:
    """A times N, averaged over the width of the hair, (p, s, a, LOBES), for every phi (p,), sin_out (s,), absorption (a,).

    The integral over phi of the sum of the lobes is the albedo.
    """
    offset = (np.arange(_OFFSETS) + 0.5) / _OFFSETS * 2 - 1
    kept = attenuation(sin_out[:, None, None], offset, absorption[:, None], fibre.index)
    gamma_out = np.arcsin(offset)
    gamma_inside = np.arcsin(np.clip(offset / _bravais(sin_out, fibre.index)[:, None], -1, 1))
    spread = np.full((len(phi), len(sin_out), _OFFSETS, LOBES), 0.5 / np.pi)
    for lobe in range(LOBES - 1):
        leaves = 2 * lobe * gamma_inside - 2 * gamma_out + lobe * np.pi
        spread[..., lobe] = _trimmed_logistic(phi[:, None, None] - leaves, fibre.logistic_scale)
    return np.einsum("sahl,pshl->psal", kept, spread, optimize=True) / _OFFSETS


def scattering(sin_in: Floats, sin_out: float, phi: Floats, absorption: float, fibre: Fibre) -> Floats:
    """Radiance towards the eye for irradiance 1 across the direction of the light, averaged over the hair's width.

    sin_in (i,), phi (p,); returns (i, p). The integral over all directions of the light (solid angle) is the albedo: 1
    without absorption.
    """
    around = azimuthal(phi, np.array([sin_out]), np.array([absorption]), fibre)[:, 0, 0]
    along = np.stack(
        [
            longitudinal(sin_in, -np.sin(np.arcsin(sin_out) + tilt), variance)
            for variance, tilt in zip(fibre.variances, fibre.tilts)
        ],
        axis=-1,
    )
    return along @ around.T


@dataclass(frozen=True, eq=False)
class FibreTables:
    """What shaders read of a fibre, sampled at texel centres.

    around: A times N, (ABSORPTIONS, SINES, AZIMUTHS, LOBES). spread: the same for light that comes from anywhere within a
    quarter turn of the light's azimuth, as it does after many hairs. turned: of the light that is met, the parts that the
    azimuth turns by so much: DIRECTIONS parts of it from straight back on, then as many from straight on,
    (ABSORPTIONS, SINES, 2 DIRECTIONS).
    """

    around: Floats
    spread: Floats
    turned: Floats


@lru_cache(maxsize=2)
def fibre_tables(fibre: Fibre) -> FibreTables:
    """The tables of a fibre, the same object for the same fibre. Absorption runs from 0 to infinity as x / (1 + x)."""
    phi = (np.arange(AZIMUTHS) + 0.5) / AZIMUTHS * np.pi
    sine = (np.arange(SINES) + 0.5) / SINES
    coded = np.linspace(0.0, _CODED_MOST, ABSORPTIONS)
    around = azimuthal(phi, sine, coded / (1 - coded), fibre).transpose(2, 1, 0, 3)
    quarter = AZIMUTHS // 2
    # The lobes are even in phi: samples beyond 0 and pi are those within.
    near = np.arange(AZIMUTHS)[:, None] + np.arange(-quarter, quarter) + (np.arange(2 * quarter) >= quarter)
    folded = np.where(near < 0, -1 - near, np.where(near >= AZIMUTHS, 2 * AZIMUTHS - 1 - near, near))
    spread = np.einsum("asjl,ij->asil", around, np.eye(AZIMUTHS)[folded].mean(axis=1), optimize=True)
    parts = around.sum(axis=3).reshape(ABSORPTIONS, SINES, 2 * DIRECTIONS, -1).sum(axis=3) * (2 * np.pi / AZIMUTHS)
    return FibreTables(
        around, spread, np.concatenate([parts[..., :DIRECTIONS], parts[..., : DIRECTIONS - 1 : -1]], axis=2)
    )


class Sent(NamedTuple):
    """What strands of a pile do with the light they meet: the parts that they send forward and back, RGB, (3,) each, and
    how far light is followed from strand to strand (``followed``); 1 to its end.
    """

    forward: Floats
    back: Floats
    followed: float = 1.0

    @property
    def less(self) -> Sent:
        """The same, sending less by ``followed`` at every strand."""
        return Sent(self.followed * self.forward, self.followed * self.back, self.followed)


def sent_on(tables: FibreTables, absorption: Floats, followed: float = 1.0) -> Sent:
    """What a strand in a pile sends forward and back of the light it meets, RGB, (3,) each, at a middling inclination.

    In a pile light comes from everywhere above, and what comes aslant is sent back more easily. In the mean over what light
    goes through a level surface, (1 - cos) / 2 of the light that a strand turns by an angle comes back.
    """
    coded = absorption / (1 + absorption)
    place = np.linspace(0.0, _CODED_MOST, ABSORPTIONS)
    parts = [np.interp(coded, place, part) for part in tables.turned[:, SINES // 2].T]
    cosines = np.cos((np.arange(DIRECTIONS) + 0.5) * np.pi / (2 * DIRECTIONS))
    all_, onward = sum(parts), np.concatenate([-cosines, cosines]) @ parts
    return Sent(0.5 * (all_ + onward), 0.5 * (all_ - onward), followed)


def pile(sent: Sent) -> tuple[Floats, Floats]:
    """By what light grows less for each strand on its way, (3,), and what strands without end send back, (3,).

    Kubelka, Munk 1931, for light that goes straight on, and is followed to its end.
    """
    kept, back = np.maximum(1 - sent.forward - sent.back, _LEAST_KEPT), np.maximum(sent.back, _LEAST_KEPT)
    rate = np.sqrt(kept * (kept + 2 * back))
    return rate, (kept + back - rate) / back


def followed(bounces: int) -> float:
    """z, where light is followed over so many bounces and no more: then of what comes after k of them is kept
    2 z^k - z^2k = 1 - (1 - z^k)^2, which falls from 1 to 0 about there.

    It takes as much from a deep white pile as if all ways ended there: what comes back from that after k bounces falls as
    k^(-3/2), and the integrals of k^(-3/2) from there on and of (1 - z^k)^2 k^(-3/2) from 0 on are the same.
    """
    return float(np.exp(-1 / (np.pi * (2 - np.sqrt(2)) ** 2 * max(bounces, 1))))


def filling(sent: Sent) -> float:
    """How fast a pile fills with the count of strands n, to x n / (1 + x n): what white hair would send back that sends as
    much of it back at each strand as this does in the mean over the colours.
    """
    return float(max(sent.back.mean(), _LEAST_KEPT))


def _bravais(sin_out: Floats, index: float) -> Floats:
    """The index of refraction seen in the plane across the hair (Marschner et al. 2003, appendix B)."""
    return np.sqrt(index**2 - sin_out**2) / np.sqrt(np.maximum(1 - sin_out**2, 1e-8))


def _fresnel(cosine: Floats, index: float) -> Floats:
    """Reflected part of unpolarised light."""
    inside = np.sqrt(1 - (1 - cosine**2) / index**2)
    parallel = (index * cosine - inside) / (index * cosine + inside)
    crossed = (cosine - index * inside) / (cosine + index * inside)
    return 0.5 * (parallel**2 + crossed**2)


def _trimmed_logistic(angle: Floats, scale: float) -> Floats:
    """Logistic density on the circle: zero beyond pi, integral 1."""
    angle = (angle + np.pi) % (2 * np.pi) - np.pi
    falling = np.exp(-np.abs(angle) / scale)
    return falling / (scale * (1 + falling) ** 2) / np.tanh(np.pi / (2 * scale))
