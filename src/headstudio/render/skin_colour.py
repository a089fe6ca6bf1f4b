"""The colour of skin by its pigments: Bando's thesis, equation 2.6.

c = b - m a_m - h a_h, a plane through the base colour along the light that melanin and haemoglobin absorb. The thesis
leaves the axes open; here they are those of Tsumura et al. 2003, found in pictures of faces, and so the plane lies in
the space they were found in, the negative logarithm of RGB. There no amount of pigment leads below black. Melanin can
also go by the absorption of eumelanin (Donner, Jensen 2006), which browns the skin where Tsumura's axis yellows it.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from ..scene.settings import Look
from ..scene.skin_settings import MONK_TONES, SkinSettings
from .lafortune import MEASURED_ALBEDO
from .scene_block import linear

# Wavelengths that stand for red, green and blue [nm].
_WAVELENGTHS = np.array([610.0, 550.0, 465.0])


def _unit(axis: Floats) -> Floats:
    return axis / np.linalg.norm(axis)


MELANIN = {"pictures": np.array([0.4143, 0.3570, 0.8372]), "spectra": _unit(_WAVELENGTHS**-3.33)}
"""a_m: what a unit of melanin adds to the negative logarithm of RGB, by ``SkinSettings.pigments``."""

HAEMOGLOBIN = np.array([0.2988, 0.6838, 0.6657])
"""a_h: what a unit of haemoglobin adds."""


def base_colour(skin: SkinSettings, look: Look) -> Floats:
    """b: reflectivity of the skin before pigments are added, linear RGB, (3,)."""
    if skin.tone == "own":
        return linear(look.skin_colour)
    if skin.tone == "measured":
        return MEASURED_ALBEDO.copy()
    return linear(web_colour(MONK_TONES[int(skin.tone.removeprefix("monk ")) - 1]))


def skin_colour(skin: SkinSettings, look: Look) -> Floats:
    """c of equation 2.6: diffuse reflectivity, linear RGB in 0 to 1, (3,)."""
    densities = skin.melanin * MELANIN[skin.pigments] + skin.haemoglobin * HAEMOGLOBIN
    return denser(base_colour(skin, look), densities)


def denser(base: Floats, densities: Floats) -> Floats:
    """A reflectivity, (3,), with so much added to its negative logarithm, (3,); never above 1."""
    colour: Floats = np.exp(-np.maximum(densities - np.log(np.maximum(base, 1e-4)), 0.0))
    return colour


def web_colour(web: str) -> tuple[float, float, float]:
    """``#rrggbb`` as parts from 0 to 1."""
    red, green, blue = (int(web[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return red, green, blue
