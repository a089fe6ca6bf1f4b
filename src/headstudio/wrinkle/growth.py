"""How a furrow grows where nothing stops it: Bando's thesis, section 2.6.2, steps 1 to 4 and 7.

What a furrow would do does not depend on other furrows; they only cut it short. So many furrows grow here at once, one
segment of each at a time, and ``precedence`` decides afterwards how far each of them gets.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints
from .direction_field import DirectionField
from .laws import FurrowLaws
from .segments import Segments
from .texels import Flags

# How many random numbers there are in all. Each furrow reads them from a place of its own, so that what it does is the
# same whether it grows alone or with others.
RANDOM_NUMBERS = 1 << 16


@dataclass(frozen=True, eq=False)
class Tips:
    """Growing ends of furrows, k of them.

    points: P [texels], (k, 2). left: n, segments still to come, infinite at a starting point, (k,). furrows, sides and
    order as in Segments. luck: where each furrow starts to read the random numbers, (k,).
    """

    points: Floats
    left: Floats
    furrows: Ints
    sides: Ints
    order: Ints
    luck: Ints

    def __getitem__(self, chosen: Ints | Flags) -> Tips:
        return Tips(
            self.points[chosen],
            self.left[chosen],
            self.furrows[chosen],
            self.sides[chosen],
            self.order[chosen],
            self.luck[chosen],
        )

    def __len__(self) -> int:
        return len(self.points)

    @staticmethod
    def of_starts(points: Floats, furrows: Ints, luck: Ints) -> Tips:
        """Both sides of new furrows: 0 grows along the field, 1 against it. points: (k, 2)."""
        sides = np.tile([0, 1], len(points))
        unlimited = np.full(len(sides), np.inf)
        return Tips(
            points=np.repeat(points, 2, axis=0),
            left=unlimited,
            furrows=np.repeat(furrows, 2),
            sides=sides,
            order=np.zeros_like(sides),
            luck=np.repeat(luck, 2),
        )


class Growth:
    """Grows furrows along a field by given laws."""

    def __init__(self, field: DirectionField, laws: FurrowLaws, rng: np.random.Generator) -> None:
        """rng: for r of theta."""
        self.field = field
        self.laws = laws
        self._random = rng.uniform(-1.0, 1.0, RANDOM_NUMBERS)

    def grow(self, tips: Tips) -> tuple[Segments, Tips]:
        """One segment at every tip, and the tips that go on from there.

        A furrow ends at the edge of the mesh: what lies off it grows nothing.
        """
        # Step 1.
        sample = self.field.at(tips.points)
        on_mesh = np.flatnonzero(sample.triangles >= 0)
        tips, direction = tips[on_mesh], sample.directions[on_mesh]
        magnitude, unit = sample.magnitudes[on_mesh], sample.units[on_mesh]
        law = self.laws.at(magnitude)
        # Step 2.
        left = np.minimum(tips.left, law.segments)
        # Steps 3 and 4.
        luck = self._random[(tips.luck + 2 * tips.order + tips.sides) % RANDOM_NUMBERS]
        direction = direction * np.where(tips.sides == 0, 1.0, -1.0)[:, None]
        step = turned(direction, law.wander * luck) * (unit * law.length)[:, None]
        whole = np.ones(len(left))
        grown = Segments(
            tips.points, step, whole, tips.furrows, tips.sides, tips.order, left, direction, magnitude, unit
        )
        # Step 7.
        on = np.flatnonzero(left > 0)
        onward = Tips(
            points=tips.points[on] + step[on],
            left=left[on] - 1,
            furrows=tips.furrows[on],
            sides=tips.sides[on],
            order=tips.order[on] + 1,
            luck=tips.luck[on],
        )
        return grown, onward


def turned(vectors: Floats, angles: Floats) -> Floats:
    """Vectors of the plane, (k, 2), turned by angles [rad], (k,)."""
    cosine, sine = np.cos(angles), np.sin(angles)
    return np.stack(
        [cosine * vectors[:, 0] - sine * vectors[:, 1], sine * vectors[:, 0] + cosine * vectors[:, 1]], axis=1
    )
