"""Guessing the unit of a file from the size of the head in it."""

from __future__ import annotations

import math
from dataclasses import dataclass

_ADULT_HEIGHT = 0.21
"""Crown to chin of a standard adult [m]."""

_UNITS = (("millimetres", 0.001), ("centimetres", 0.01), ("inches", 0.0254), ("decimetres", 0.1), ("metres", 1.0))
# From a toddler to the largest adult, with a margin for stylised heads.
_SMALLEST, _LARGEST = 0.155, 0.29


@dataclass(frozen=True)
class Unit:
    """The length of a file's unit [m], and how it was guessed, in a line."""

    metres: float
    note: str


def guess_unit(height: float) -> Unit:
    """The unit in which a head of this height, crown to chin, has the size of a person.

    When no unit gives that, the head is scaled to the size of an adult.
    """
    name, metres = min(_UNITS, key=lambda unit: abs(math.log(height * unit[1] / _ADULT_HEIGHT)))
    size = height * metres
    if _SMALLEST <= size <= _LARGEST:
        return Unit(metres, f"unit guessed: {name} (the head is {size * 100:.1f} cm high)")
    return Unit(
        _ADULT_HEIGHT / height,
        f"unit unknown: a head {height:.4g} units high has no human size; scaled to {_ADULT_HEIGHT * 100:.0f} cm",
    )
