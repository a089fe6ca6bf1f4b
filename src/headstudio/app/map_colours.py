"""The colours in which maps are shown, on the head and in panels."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats

# Linear colours of map values from 0 to 1, evenly spaced: dark to bright, so that they are told apart without hues as well.
_COLOURS = np.array([[0.06, 0.0, 0.09], [0.04, 0.08, 0.26], [0.015, 0.28, 0.26], [0.11, 0.58, 0.12], [0.98, 0.8, 0.02]])


def map_colours(values: Floats) -> Floats:
    """Linear colours, (n, 3), of map values from 0 to 1, (n,)."""
    at = np.linspace(0.0, 1.0, len(_COLOURS))
    return np.column_stack([np.interp(values, at, channel) for channel in _COLOURS.T])
