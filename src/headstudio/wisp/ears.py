"""Ears in the way of hair: what is led backward is combed up before them, and they lift what falls over them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats
from ..head.smooth import smoothstep

# Where hair meets an ear from before, in proportions of the head: from nowhere to everywhere, and back to nowhere.
_BESIDE = (0.55, 0.8)
_HEIGHT = (-1.0, -0.7, -0.05, 0.15)
_DEPTH = (-0.25, -0.05, 0.3, 0.55)
# Where it is between them.
_RISES, _FROM_BEHIND = (-0.9, -0.6, 0.2, 0.5), (-0.7, -0.4, 0.15, 0.4)


# Where hair may lie on an ear, in proportions of the head.
_LOWEST, _HIGHEST = np.array([0.85, -1.0, -0.5]), np.array([1.7, 0.15, 0.35])


def at_ears(places: Floats) -> NDArray[np.bool_]:
    """Whether hair at ``places``, in proportions of the head, (k, 3), may lie on an ear, (k,)."""
    x, y, z = places.T
    inside = np.abs(x) > _LOWEST[0]
    inside &= np.abs(x) < _HIGHEST[0]
    for along, low, high in ((y, _LOWEST[1], _HIGHEST[1]), (z, _LOWEST[2], _HIGHEST[2])):
        inside &= along > low
        inside &= along < high
    return inside


def before_ears(places: Floats) -> Floats:
    """How much an ear is in the way of hair that goes back from ``places``, in proportions, (k, 3): 0 to 1, (k,)."""
    beside = smoothstep(np.abs(places[:, 0]), *_BESIDE)
    return beside * _window(places[:, 1], *_HEIGHT) * _window(places[:, 2], *_DEPTH)


def over_ears(places: Floats) -> Floats:
    """How much an ear is between the head and ``places``, in proportions, (k, 3): 0 to 1, (k,)."""
    return _window(places[:, 1], *_RISES) * _window(places[:, 2], *_FROM_BEHIND)


def _window(value: Floats, low: float, from_: float, to: float, high: float) -> Floats:
    return smoothstep(value, low, from_) * (1.0 - smoothstep(value, to, high))
