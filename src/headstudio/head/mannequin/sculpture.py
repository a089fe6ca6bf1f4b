"""The whole mannequin as one field."""

from __future__ import annotations

import numpy as np

from ..mesh import Floats
from .bust import bust
from .ears import ears
from .eyes import eyes
from .fields import FAR, shaped
from .mouth import mouth
from .nose import nose
from .skull import skull


def _head(p: Floats, _: Floats) -> Floats:
    return mouth(p, nose(p, eyes(p, skull(p))))


def sculpture(points: Floats) -> Floats:
    """Distance to the skin of the mannequin [mm] at ``points`` [mm], shape (n, 3).

    To first order near the skin. The same on the left and on the right: only the left half is modelled.
    """
    p = np.ascontiguousarray(points.T)
    p[0] = np.abs(p[0])
    head = shaped(p, np.full(len(points), FAR), (-1, -120, -400), (400, 400, 400), _head)
    return ears(p, bust(p, head))
