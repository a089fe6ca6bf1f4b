"""What an artist decides about the scalp."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from ..params import choice, number

LENGTH_MAPS = ("even", "fringe", "long back", "bob", "short")


@dataclass(frozen=True, eq=False)
class GrayImage:
    """A gray image over the scalp square, values 0 to 1, row 0 at v = 0, shape (rows, columns). Compared by content.

    Values are rounded to the levels of a 16 bit picture, so that what is saved is what was used. Raises ValueError for
    an array that is empty, not two-dimensional or not finite.
    """

    LEVELS: ClassVar[int] = 65535

    pixels: NDArray[np.float32]

    def __post_init__(self) -> None:
        pixels = np.asarray(self.pixels, dtype=np.float64)
        if pixels.ndim != 2 or pixels.size == 0 or not np.isfinite(pixels).all():
            raise ValueError("a gray image is a table of finite numbers")
        levels = np.rint(np.clip(pixels, 0, 1) * self.LEVELS) / self.LEVELS
        object.__setattr__(self, "pixels", levels.astype(np.float32))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, GrayImage) and np.array_equal(self.pixels, other.pixels)

    def __hash__(self) -> int:
        return hash((self.pixels.shape, self.pixels.tobytes()))


@dataclass(frozen=True)
class ScalpSettings:
    """Where hair grows and how long: Bando et al. 2006, section 3.2.

    curves: control points of the four Catmull-Rom curves around the scalp [m], head frame: along the forehead from
    right to left, down the left side, along the nape from left to right, up the right side. Each ends where the next
    one starts, at a corner of the unit square. Empty: placed from landmarks.
    painted_lengths: a painted length map that takes the place of the named one.
    """

    whorl_u: float = number(
        0.5, "Whorl u", "", 0.0, 1.0, "Where the whorl lies on the scalp square, from right to left."
    )
    whorl_v: float = number(
        0.38, "Whorl v", "", 0.0, 1.0, "Where the whorl lies on the scalp square, from front to back."
    )
    length_map: str = choice("fringe", "Length map", LENGTH_MAPS, "How hair length varies over the scalp.")
    curves: tuple[tuple[tuple[float, float, float], ...], ...] = ()
    painted_lengths: GrayImage | None = field(default=None)
