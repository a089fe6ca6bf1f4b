"""Hairdressing operations as an artist writes them down: what is done to which part of the hair, and where.

Places are in proportions of the head (Proportions), lengths in metres, so that an operation can be done on any head.
The numbers are parameters like all others. What an operation means on one head is in ``hairdressing``.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..params import colour, integer, number, switch
from .selection import Selection

Place = tuple[float, float, float]

EVERYTHING = Selection()
EVERYWHERE = 2.0  # [m]


def _tolerance(default: float) -> float:
    width: float = number(
        default, "Tolerance", "m", 0.002, 0.1, "Radius within which hair is gathered or led.", shown="mm"
    )
    return width


def _weight(default: float) -> float:
    weight: float = number(
        default, "Weight", "", 0.0, 1.0, "Weight w of the constraint against the styling field (eq. 7)."
    )
    return weight


def _thickness(default: float, doc: str) -> float:
    thickness: float = number(default, "Thickness", "m", 0.003, 0.04, doc, shown="mm")
    return thickness


@dataclass(frozen=True)
class ToPoint:
    """A point constraint: draws hair to a place."""

    place: Place = (0.0, 0.45, -1.15)
    tolerance: float = _tolerance(0.014)
    weight: float = _weight(1.0)


@dataclass(frozen=True)
class AlongPath:
    """A trajectory constraint: leads hair along a path of two places or more."""

    path: tuple[Place, ...] = ((0.0, 0.45, -1.15), (0.0, -1.2, -1.2))
    tolerance: float = _tolerance(0.012)
    weight: float = _weight(1.0)


@dataclass(frozen=True)
class InDirection:
    """A direction constraint: combs hair along a path of two places or more, wherever it is near."""

    path: tuple[Place, ...] = ((0.0, 1.1, 1.0), (0.0, 1.2, 0.0), (0.0, 0.6, -1.1))
    radius: float = number(0.06, "Radius", "m", 0.005, 0.5, "How far from its path the comb acts.", shown="mm")
    weight: float = _weight(0.8)


Step = ToPoint | AlongPath | InDirection


@dataclass(frozen=True)
class Constrain:
    """A queue of constraints, one after the other: what all other operations are made of."""

    selection: Selection = EVERYTHING
    steps: tuple[Step, ...] = (ToPoint(),)


@dataclass(frozen=True)
class Tie:
    """Gathers hair at a place and lets it hang from there: a ponytail, a pigtail."""

    selection: Selection = EVERYTHING
    place: Place = (0.0, 0.45, -1.15)
    tolerance: float = _tolerance(0.014)
    lift: float = number(0.02, "Lift", "m", 0.0, 0.2, "How far the tail stands off before it falls.", shown="cm")
    weight: float = _weight(1.0)
    elastic: bool = switch(True, "Elastic", "An elastic around the knot is seen.")
    colour: tuple[float, float, float] = colour("#33272a", "Colour", "Colour of the elastic.")


@dataclass(frozen=True)
class Braid:
    """Gathers hair at a place and plaits it. path: where the braid lies; empty, it hangs down from the place."""

    selection: Selection = EVERYTHING
    place: Place = (0.0, -0.1, -1.05)
    path: tuple[Place, ...] = ()
    groups: int = integer(3, "Groups", 3, 9, "How many groups are plaited.")
    thickness: float = _thickness(0.011, "Radius of one group.")
    period: float = number(0.07, "Period", "m", 0.02, 0.3, "Length of a whole plait.", shown="mm")
    length: float = number(0.7, "Length", "", 0.1, 1.0, "What part of the longest hair is plaited; the rest is loose.")
    elastic: bool = switch(True, "Elastic", "An elastic around the end is seen.")
    colour: tuple[float, float, float] = colour("#33272a", "Colour", "Colour of the elastic.")


@dataclass(frozen=True)
class Bun:
    """Gathers hair at a place and coils it up there."""

    selection: Selection = EVERYTHING
    place: Place = (0.0, 0.9, -0.8)
    radius: float = number(0.033, "Radius", "m", 0.005, 0.08, "Radius of the outermost coil.", shown="mm")
    thickness: float = _thickness(0.016, "Radius of the coiled lock.")


@dataclass(frozen=True)
class Updo:
    """Gathers hair at a place and winds it into a ball of loops there, each on a way of its own."""

    selection: Selection = EVERYTHING
    place: Place = (0.0, 0.8, -0.8)
    loops: int = integer(7, "Loops", 1, 12, "Into how many loops the hair is divided.")
    radius: float = number(0.022, "Radius", "m", 0.008, 0.08, "Radius of a loop.", shown="mm")
    thickness: float = _thickness(0.012, "Radius of a lock.")


Operation = Constrain | Tie | Braid | Bun | Updo


@dataclass(frozen=True)
class Cut:
    """Cuts hair with a plane: what lies beyond it, on the side its normal points to, falls.

    place: a place the plane goes through. normal: where it cuts away, in metres, of any length. selection: whose hair.
    """

    selection: Selection = EVERYTHING
    place: Place = (0.0, -1.0, 0.0)
    normal: Place = (0.0, -1.0, 0.0)
    reach: float = number(
        EVERYWHERE, "Reach", "m", 0.005, EVERYWHERE, "How far from its place the blade cuts; 2 m is all hair.", log=True
    )
    ragged: float = number(
        0.0,
        "Ragged",
        "m",
        0.0,
        0.1,
        "By up to how much strands end before the plane, each by another part of it: scissors held along the hair.",
        shown="mm",
    )
