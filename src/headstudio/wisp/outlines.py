"""The outline of master strands: straight segments of equal length on 3-DOF joints (Choe, Ko 2005, figure 5)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats
from .stray import Stray


@dataclass(frozen=True, eq=False)
class Outlines:
    """W outlines of up to J segments. All segments of all wisps have one length, so that a step from the root to the tip
    is the same step for everybody (Algorithm 1).

    roots: joint centres c_1 on the scalp [m], (W, 3). segment: length of a segment [m]. counts: how many segments each
    wisp has, 1 to J, (W,); what lies beyond in the padded arrays continues the last one. frames: rotation of every
    segment, (W, J, 3, 3): its columns are two directions across and the direction along the segment, in the head frame.
    radii: deviation radius r at every joint [m], (W, J + 1). strands: how many strands each wisp stands for, (W,).
    aside: how far from its end a wisp feels the styling force [m], (W, 3), None for nobody; see ``Parting.aside``.
    stray: how wisps stray from the way that all go, None for not at all.
    """

    roots: Floats
    segment: float
    counts: NDArray[np.int64]
    frames: Floats
    radii: Floats
    strands: NDArray[np.int64]
    aside: Floats | None = None
    stray: Stray | None = None

    @property
    def directions(self) -> Floats:
        """Unit direction q of every segment, (W, J, 3)."""
        return self.frames[..., 2]

    @cached_property
    def joints(self) -> Floats:
        """Joint centres c [m], (W, J + 1, 3)."""
        steps = np.cumsum(self.segment * self.directions, axis=1)
        return np.concatenate([self.roots[:, None], self.roots[:, None] + steps], axis=1)
