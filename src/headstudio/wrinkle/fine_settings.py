"""What an artist decides about fine wrinkles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from ..head.scalp_settings import GrayImage
from ..params import choice, integer, number, switch
from .laws import LAWS


class DirectionVector(NamedTuple):
    """A direction vector that the artist has set: Bando's thesis, figure 2.7.

    field: 0 or 1. u, v: where in texture space; the vertex nearest to it takes the vector. du, dv: its direction there;
    its length, up to 1, is the magnitude m.
    """

    field: int
    u: float
    v: float
    du: float
    dv: float


@dataclass(frozen=True)
class FineSettings:
    """The fine furrows that cover the skin, and pores: Bando's thesis, section 2.6.

    vectors: direction vectors. A field that has any follows these alone, one that has none those placed from the shape.
    painted_strength: over texture space, scales the depth of furrows from 0 to 1.
    """

    on: bool = switch(True, "Fine wrinkles", "Cover the skin with fine furrows.")
    texture_size: int = integer(
        2048, "Texture size", 128, 4096, "Width and height of the height fields in texels.", log=True
    )
    unit: float = number(
        0.2e-3,
        "Size",
        "m",
        0.02e-3,
        1e-3,
        "Unit of the furrows' lengths: they lie 4 to 9 units apart. It is never finer than a texel.",
        shown="mm",
        log=True,
    )
    depth: float = number(
        0.4e-3, "Depth", "m", 0.0, 1e-3, "Depth of furrows where the field is strongest, m = 1.", shown="mm"
    )
    strength: float = number(
        1.0, "Strength", "", 0.0, 2.0, "Scales the field: stronger is deeper, wider, straighter and wider apart."
    )
    initial_amplitude: float = number(
        0.5, "Amplitude at rest", "", 0.05, 1.0, "r of eq. 2.4: depth at rest relative to the greatest.", live=True
    )
    crossing: float = number(
        math.radians(74),
        "Crossing angle",
        "rad",
        math.radians(40),
        math.radians(120),
        "Angle between the two directions that are placed from the shape.",
        shown="deg",
    )
    roundness: float = number(
        0.5, "Roundness", "", 0.0, 1.0, "How much the skin between furrows is raised like a cushion."
    )
    laws: str = choice("printed", "Laws", tuple(LAWS), "How furrows follow from the strength of the field (eq. 2.5).")
    pores: float = number(1.0, "Pores", "", 0.0, 1.0, "How many pores there are on nose, cheeks and forehead.")
    pore_size: float = number(
        0.4e-3, "Pore size", "m", 0.05e-3, 1e-3, "Diameter of the largest pores.", shown="mm", log=True
    )
    pore_depth: float = number(0.12e-3, "Pore depth", "m", 0.0, 0.3e-3, "Depth of the largest pores.", shown="mm")
    seed: int = integer(1, "Seed", 0, 2**31 - 1, "Start of the random numbers: the same seed gives the same furrows.")
    vectors: tuple[DirectionVector, ...] = ()
    painted_strength: GrayImage | None = None
