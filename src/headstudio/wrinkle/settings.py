"""What an artist decides about large wrinkles."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from ..params import choice, number, switch
from .default_furrows import default_furrows
from .furrow import Furrow
from .shrinkage import MEASURES


@dataclass(frozen=True)
class WrinkleSettings:
    """Large wrinkles: Bando's thesis, section 2.5.

    furrows: on the face chart (see face_chart.py), so that they follow a change of head. Empty: the default set at ``age``.
    proposals: furrows that were inferred and that the artist has neither accepted nor rejected; they displace nothing.
    """

    shown: bool = switch(True, "Wrinkles", "Displace the skin along its furrows.", live=True)
    strength: float = number(1.0, "Strength", "", 0.0, 2.0, "Multiplies the depth of every furrow.", live=True)
    breadth: float = number(1.0, "Breadth", "", 0.5, 2.0, "Multiplies the width of every furrow.", log=True)
    age: float = number(
        0.3, "Age of the skin", "", 0.0, 1.0, "How deep the default furrows are, and how much of them stays at rest."
    )
    shrinkage: str = choice(
        "three edges",
        "Shrinkage",
        MEASURES,
        "three edges: exact for evenly stretched skin; two edges: as printed in the thesis, equation 2.3.",
    )
    fineness: float = number(
        0.4, "Fineness", "", 0.1, 1.0, "Length of the finest triangles over the width of their furrow.", log=True
    )
    self_contact: bool = switch(True, "Self-contact", "Bulges on both sides of a fold stop where they meet.", live=True)
    furrows: tuple[Furrow, ...] = ()
    proposals: tuple[Furrow, ...] = ()

    @property
    def chosen(self) -> tuple[Furrow, ...]:
        """The artist's own furrows, or else the default set at ``age``, on the face chart."""
        return self.furrows or default_furrows(self.age)

    def furrow_set(self) -> tuple[Furrow, ...]:
        """The furrows on the face chart, with the settings' breadth."""
        widest = 0.02
        return tuple(replace(furrow, width=min(furrow.width * self.breadth, widest)) for furrow in self.chosen)

    def lines(self) -> tuple[tuple[Any, ...], ...]:
        """Where the furrows run, how wide they are, how they end: all that the skin has to be prepared for again."""
        return tuple((f.controls, f.width, f.taper, f.section, f.swell) for f in self.furrow_set())
