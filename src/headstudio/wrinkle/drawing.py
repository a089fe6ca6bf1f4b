"""Drawing furrows into the height image and the occupancy image: Bando's thesis, section 2.6.2, steps 5 and 6.

All segments are drawn at once, each in a small box of texels around it. The deepest groove wins where several lie, so
the order in which they are drawn does not matter.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints
from .texels import Flags

# A groove narrower than this [texels] is drawn as wide as this and less deep, of the same volume, so that thin furrows
# stay lines and do not break into dots.
_NARROWEST = 1.8
# Texels that are looked at in one go: their numbers fit into the cache of a processor.
_AT_ONCE = 1 << 16


class _Boxes(NamedTuple):
    """Boxes of b x b texels around grooves, k of them.

    grooves: which ones, (k,). texels: numbers of the texels, (k, b, b). squared: of their distance to the groove
    [texels], infinite outside the image, (k, b, b).
    """

    grooves: Ints
    texels: Ints
    squared: Floats


@dataclass(frozen=True, eq=False)
class Images:
    """What carving draws on, square images of one size.

    height: of the skin over its surface, negative [m]. occupied: where no furrow may start. period: see TexelMap.
    """

    height: NDArray[np.float32]
    occupied: Flags
    period: int

    def draw(
        self, starts: Floats, steps: Floats, widths: Floats, depths: Floats, spacings: Floats, roundness: float
    ) -> None:
        """Carve straight grooves and record the strips they occupy.

        starts, steps: of the grooves [texels], (k, 2); a step of no length makes a dimple. widths: W_h, of the grooves
        [texels]. depths: of their middle [m]. spacings: W_o, of the strips [texels]. All (k,). roundness: the part of the
        depth that falls over the whole strip and not within the groove, 0 to 1.
        """
        drawn_widths = np.maximum(widths, _NARROWEST)
        shoulders = np.maximum(drawn_widths, spacings)
        sharp = (1 - roundness) * depths * widths / drawn_widths
        soft = roundness * depths
        height, occupied = self.height.ravel(), self.occupied.ravel()
        for box in self._boxes(starts, steps, 0.5 * shoulders):
            strip = 0.25 * spacings[box.grooves] ** 2
            occupied[box.texels[box.squared <= strip[:, None, None]]] = True
            groove, row, column = np.nonzero(box.squared < 0.25 * shoulders[box.grooves, None, None] ** 2)
            squared, texels = box.squared[groove, row, column], box.texels[groove, row, column]
            groove = box.grooves[groove]
            depth = sharp[groove] * _valley(squared, drawn_widths[groove])
            depth += soft[groove] * _valley(squared, shoulders[groove])
            np.minimum.at(height, texels, -depth.astype(np.float32))

    def _boxes(self, starts: Floats, steps: Floats, radii: Floats) -> Iterator[_Boxes]:
        """The texels within ``radii`` [texels], (k,), of each groove, in portions of boxes of the same size."""
        sides = np.ceil(np.abs(steps).max(axis=1, initial=0.0) + 2 * radii).astype(np.int64) + 1
        for side in np.unique(sides):
            same = np.flatnonzero(sides == side)
            for portion in np.array_split(same, -(-len(same) * side**2 // _AT_ONCE)):
                yield self._box(portion, starts[portion], steps[portion], int(side))

    def _box(self, numbers: Ints, starts: Floats, steps: Floats, side: int) -> _Boxes:
        size = len(self.height)
        length = np.hypot(steps[:, 0], steps[:, 1])
        along = steps / np.where(length == 0, 1.0, length)[:, None]
        corner = np.rint(starts + 0.5 * (steps - side)).astype(np.int64)
        place = corner[:, :, None] + np.arange(side)
        offset = place + 0.5 - starts[:, :, None]
        x, y = place[:, 0], place[:, 1]
        far = np.where((y >= 0) & (y < size), offset[:, 1] ** 2, np.inf)
        if self.period:
            x = x % self.period
            squared = offset[:, 0, None, :] ** 2 + far[:, :, None]
        else:
            squared = np.where((x >= 0) & (x < size), offset[:, 0] ** 2, np.inf)[:, None, :] + far[:, :, None]
        part = (offset[:, 0] * along[:, 0, None])[:, None, :] + (offset[:, 1] * along[:, 1, None])[:, :, None]
        beyond = part - part.clip(0.0, length[:, None, None])
        squared += beyond**2 - part**2
        texels = (y * size)[:, :, None] + x[:, None, :]
        return _Boxes(numbers, texels, squared)


def _valley(squared: Floats, widths: Floats) -> Floats:
    """A round valley of depth 1, (1 - q^2)^2 from its middle at q = 0 to its rim at q = 1, where it is flat.

    squared: of the distance from the middle. widths: from rim to rim.
    """
    return np.maximum(1 - 4 * squared / widths**2, 0.0) ** 2
