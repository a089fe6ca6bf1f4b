"""The reflection of measured skin by the model of Lafortune et al. 1997, with the fit to Marschner et al. 1999.

f(u, v) = rho / pi + sum over lobes of [Cxy (ux vx + uy vy) + Cz uz vz]^n, with z along the normal; u and v point away from
the skin, to the light and to the eye. It is symmetric in u and v. The shader does the same with the same figures.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats

DIFFUSE = np.array([0.428425, 0.301341, 0.331054])
"""rho of red, green and blue."""

# By lobe, then by colour.
ACROSS = np.array(
    [[-1.131747, -1.016939, -0.966018], [-0.546570, -0.643533, -0.638934], [-0.998888, -1.020153, -1.027479]]
)
"""Cxy of every lobe and colour, (3, 3)."""

ALONG = np.array([[-1.209182, -1.462488, -1.222419], [0.380123, 0.410559, 0.437367], [0.857998, 0.703913, 0.573625]])
"""Cz of every lobe and colour, (3, 3)."""

EXPONENTS = np.array(
    [[6.421658, 3.699932, 3.524889], [3.685044, 4.266495, 4.539742], [64.208486, 63.919687, 43.809866]]
)
"""n of every lobe and colour, (3, 3)."""


def lobes(to_light: Floats, to_eye: Floats) -> Floats:
    """What the three lobes reflect [1/sr], (..., 3 lobes, 3 colours), for unit directions with z along the normal, (..., 3)."""
    along = (to_light[..., 2] * to_eye[..., 2])[..., None, None]
    across = (to_light[..., :2] * to_eye[..., :2]).sum(axis=-1)[..., None, None]
    base = np.maximum(ACROSS * across + ALONG * along, 0.0)
    reflected: Floats = base**EXPONENTS
    return reflected


def reflection(to_light: Floats, to_eye: Floats) -> Floats:
    """f [1/sr], linear RGB, (..., 3), for unit directions with z along the normal, (..., 3)."""
    return DIFFUSE / np.pi + lobes(to_light, to_eye).sum(axis=-2)


def albedo(to_light: Floats, rings: int = 128) -> Floats:
    """The part of the light from one direction, (3,), that is sent back to anywhere, linear RGB, (3,)."""
    cosine = (np.arange(rings) + 0.5) / rings
    turn = 2 * np.pi * (np.arange(2 * rings) + 0.5) / (2 * rings)
    level = np.sqrt(1 - cosine**2)[:, None]
    eyes = np.stack(
        [level * np.cos(turn), level * np.sin(turn), np.broadcast_to(cosine[:, None], (rings, 2 * rings))], axis=-1
    )
    sent = reflection(np.broadcast_to(to_light, eyes.shape), eyes) * cosine[:, None, None]
    total: Floats = 2 * np.pi * sent.mean(axis=(0, 1))
    return total


MEASURED_ALBEDO = albedo(np.array([0.0, 0.0, 1.0]))
"""What the measured skin sends back of light from straight above, linear RGB, (3,)."""
