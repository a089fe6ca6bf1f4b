"""The colour of hair from its pigments: eumelanin is brown to black, pheomelanin yellow to red."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..head.mesh import Floats

# Absorption of linear RGB per unit concentration (d'Eon and others 2011).
_EUMELANIN = np.array([0.419, 0.697, 1.37])
_PHEOMELANIN = np.array([0.187, 0.4, 1.05])
# Roughness about the fibre's axis for which colour and absorption are related.
_AZIMUTHAL_ROUGHNESS = 0.3

# Concentrations (eumelanin, pheomelanin) of natural colours.
NATURAL: Mapping[str, tuple[float, float]] = {
    "black": (2.2, 0.1),
    "dark brown": (1.0, 0.12),
    "brown": (0.5, 0.12),
    "light brown": (0.26, 0.1),
    "auburn": (0.18, 0.8),
    "red": (0.005, 0.55),
    "strawberry blonde": (0.02, 0.3),
    "dark blonde": (0.14, 0.09),
    "blonde": (0.06, 0.07),
    "platinum": (0.015, 0.02),
    "white": (0.0, 0.0),
}


def melanin_colour(eumelanin: float, pheomelanin: float) -> Floats:
    """What colour hair with these concentrations looks in even light, linear RGB, (3,).

    From absorption sigma to colour C by the relation that Chiang and others (2016, eq. 9) fitted for a volume of hair,
    solved for C: sigma = (ln C / D)^2, where D is a polynomial in the azimuthal roughness.
    """
    b = _AZIMUTHAL_ROUGHNESS
    denominator = 5.969 - 0.215 * b + 2.532 * b**2 - 10.73 * b**3 + 5.574 * b**4 + 0.245 * b**5
    absorption = eumelanin * _EUMELANIN + pheomelanin * _PHEOMELANIN
    return np.exp(-denominator * np.sqrt(absorption))
