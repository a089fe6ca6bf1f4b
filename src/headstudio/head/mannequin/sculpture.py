"""The whole mannequin as one field."""

from __future__ import annotations

import numpy as np

from ..mesh import Floats
from .bust import neck, torso
from .ears import ears
from .eyes import eyes
from .fields import join
from .mouth import mouth
from .nose import nose
from .skull import skull


def sculpture(points: Floats) -> Floats:
    """Distance to the skin of the mannequin [mm], the same on the left and on the right."""
    p = points.copy()
    p[:, 0] = np.abs(p[:, 0])
    head = skull(p)
    head = eyes(p, head)
    head = nose(p, head)
    head = mouth(p, head)
    body = join(head, join(neck(p), torso(p), 34), 16)
    return ears(p, body)
