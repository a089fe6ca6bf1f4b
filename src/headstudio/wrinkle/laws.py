"""The six laws of a furrow as data: Bando's thesis, eq. 2.5.

A law is a polynomial of the magnitude m of the direction vector, m from 0 to 1: (constant, times m, times m^2). Lengths
are in units, whose size on the skin the artist chooses.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from ..head.mesh import Floats

Polynomial = tuple[float, float, float]


@dataclass(frozen=True)
class FurrowLaws:
    """How a furrow follows from the magnitude m of the field.

    segments: N, rounded down. wander: theta over r, the largest angle between a segment and the field [rad]. length: D,
    of a segment. intensity: I, the gray of the line on a white image: 1 leaves the skin alone, 0 cuts deepest. width:
    W_h, of the groove. spacing: W_o, of the strip around a furrow in which no other starts. D, W_h and W_o in units.
    """

    segments: Polynomial = (30, -20, 0)
    wander: Polynomial = (0.5, -0.4, 0)
    length: Polynomial = (4, 2, 0)
    intensity: Polynomial = (1, 0, -1)
    width: Polynomial = (0, 2, 0)
    spacing: Polynomial = (1, 12, 0)

    def at(self, magnitude: Floats) -> FurrowParameters:
        """The parameters where the field has this magnitude, 0 to 1, any shape."""
        values = {law.name: _evaluate(getattr(self, law.name), magnitude) for law in fields(self)}
        return FurrowParameters(
            segments=np.floor(values["segments"]),
            wander=values["wander"],
            length=values["length"],
            depth=1 - values["intensity"],
            width=values["width"],
            spacing=values["spacing"],
        )


@dataclass(frozen=True, eq=False)
class FurrowParameters:
    """The laws at some magnitudes, each an array of their shape. depth: 1 - I, from 0 to 1; the rest as FurrowLaws."""

    segments: Floats
    wander: Floats
    length: Floats
    depth: Floats
    width: Floats
    spacing: Floats


# The text says that furrows get longer where the field is strong; N as printed makes them shorter (but for D).
LAWS = {
    "printed": FurrowLaws(),
    "longer where strong": replace(FurrowLaws(), segments=(10, 20, 0)),
}


def _evaluate(law: Polynomial, magnitude: Floats) -> Floats:
    constant, linear, square = law
    return constant + magnitude * (linear + magnitude * square)
