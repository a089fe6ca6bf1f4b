"""Where a person's hair begins: default curves around the scalp, from landmarks alone."""

from __future__ import annotations

import numpy as np

from .head import Head
from .locate import Locator
from .mesh import Floats

# Control points on the left half of a typical hairline, from the middle outward. Each is (lateral, up, forward) where
# lateral 1 is the tragus, up runs from the tragi (0) to the crown (1), and forward from the tragi (0) to the glabella
# (1). The forehead's middle comes from its landmark.
_FOREHEAD = (
    (0.30, 0.79, 0.80),
    (0.60, 0.74, 0.66),
    (0.72, 0.60, 0.58),
    (0.80, 0.43, 0.56),
    (0.87, 0.28, 0.42),
    (0.95, 0.13, 0.24),
)
_SIDEBURN_TIP = (0.98, 0.02, 0.15)
_AROUND_THE_EAR = (
    (0.97, 0.14, 0.13),
    (0.95, 0.25, 0.08),
    (0.95, 0.31, -0.08),
    (0.95, 0.26, -0.22),
    (0.93, 0.08, -0.28),
    (0.87, -0.14, -0.27),
)
_NAPE_CORNER = (0.72, -0.33, -0.36)


def default_curves(head: Head) -> tuple[Floats, ...]:
    """Control points [m] of a natural hairline on any head: front, left, back and right curve, each (k, 3).

    The front curve runs from the tip of the right sideburn over temples and forehead to the left one, the side curves
    over and behind the ears, and the back curve along the nape, so that the square's corners are the four tips.
    """
    marks = head.landmarks
    middle = (marks.left_tragus + marks.right_tragus) / 2
    half_breadth = abs(marks.left_tragus[0] - marks.right_tragus[0]) / 2
    scale = np.array([half_breadth, marks.crown[1] - middle[1], marks.glabella[2] - middle[2]])

    def placed(points: tuple[tuple[float, float, float], ...], side: int) -> Floats:
        return middle + np.array(points) * scale * np.array([side, 1, 1])

    skin = Locator(head.skin.vertices, head.skin.faces)

    def halves(side: int) -> tuple[Floats, Floats, Floats, Floats]:
        return tuple(  # type: ignore[return-value]
            _on_skin(head, placed(points, side), skin)
            for points in (_FOREHEAD, (_SIDEBURN_TIP,), _AROUND_THE_EAR, (_NAPE_CORNER,))
        )

    left_front, left_tip, left_ear, left_nape = halves(1)
    right_front, right_tip, right_ear, right_nape = halves(-1)
    front = np.concatenate([right_tip, right_front[::-1], marks.hairline[None], left_front, left_tip])
    left = np.concatenate([left_tip, left_ear, left_nape])
    back = np.concatenate([left_nape, marks.nape[None], right_nape])
    right = np.concatenate([right_nape, right_ear[::-1], right_tip])
    return front, left, back, right


def _on_skin(head: Head, points: Floats, skin: Locator) -> Floats:
    found, _ = skin.nearest(points)
    return found.blend(head.skin.vertices, head.skin.faces)
