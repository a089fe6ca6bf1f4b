"""What there is to draw at one instant: the meeting point of the builders, the solvers and the renderer."""

from __future__ import annotations

import operator as op
from dataclasses import dataclass, field

import numpy as np

from ..head.frame import HeadFrame
from ..head.head import Head
from ..head.mesh import Floats
from ..lcp.model import HairModel
from ..wisp.adornment import Adornment
from ..wisp.strands import Strands
from ..wrinkle.living_skin import LivingSkin


@dataclass(frozen=True, eq=False)
class HairOnStage:
    """Particles at one instant, in the head frame: positions [m] and unit directions, (n, 3)."""

    model: HairModel
    positions: Floats
    directions: Floats


@dataclass(frozen=True, eq=False)
class Overlays:
    """Things drawn on top for whoever tunes the simulation; all in world coordinates [m].

    segments: line pieces (k, 2, 3) with colours (k, 3). points: (p, 3) with colours (p, 3). triangles: (t, 3, 3), seen
    from the side that they turn counter-clockwise to, with colours and opacity of their corners (t, 3, 4).
    """

    segments: Floats = field(default_factory=lambda: np.zeros((0, 2, 3)))
    segment_colours: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    points: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    point_colours: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    triangles: Floats = field(default_factory=lambda: np.zeros((0, 3, 3)))
    triangle_colours: Floats = field(default_factory=lambda: np.zeros((0, 3, 4)))


# A head that comes to rest does so ever more slowly; what moves less than this is not seen to [m, rad].
SAME_PLACE = 1e-5

# One object, so that whoever draws sees that nothing has changed.
NO_OVERLAYS = Overlays()


@dataclass(frozen=True, eq=False)
class Stage:
    """One instant. Objects are compared by identity: what is the same object as in the last frame is not sent again.

    head: at rest. skin: in the place of the head's own skin and parts, where the face lives. adornments: what is worn in
    the hair.
    """

    head: Head
    frame: HeadFrame = field(default_factory=HeadFrame)
    hair: HairOnStage | None = None
    overlays: Overlays = NO_OVERLAYS
    strands: Strands | None = None
    skin: LivingSkin | None = None
    adornments: tuple[Adornment, ...] = ()

    def shows_what(self, other: Stage) -> bool:
        """Whether a picture of either is a picture of both: the same things, the head in the same place."""
        same = all(
            getattr(self, name) is getattr(other, name) for name in ("head", "hair", "overlays", "strands", "skin")
        )
        worn = len(self.adornments) == len(other.adornments) and all(map(op.is_, self.adornments, other.adornments))
        return same and worn and self.frame.is_near(other.frame, SAME_PLACE)
