"""How the depth of a furrow changes along it: a curve through a few values, evenly spaced, smooth between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..head.mesh import Floats


def swell_shares(part: Floats, count: int) -> tuple[Floats, Floats]:
    """What each of ``count`` values says at parts of the length, (k,), and how that changes per length, (k, count) each.

    Between two values the course is a cubic whose slope at each is that between its neighbours (Catmull and Rom 1974).
    """
    if count == 1:
        return np.ones((len(part), 1)), np.zeros((len(part), 1))
    place = np.clip(part, 0.0, 1.0) * (count - 1)
    first = np.minimum(place.astype(np.int64), count - 2)
    u = place - first
    shares, slopes = np.zeros((2, len(part), count))
    rows = np.arange(len(part))
    cubics = (-u + 2 * u**2 - u**3, 2 - 5 * u**2 + 3 * u**3, u + 4 * u**2 - 3 * u**3, u**3 - u**2)
    rises = (-1 + 4 * u - 3 * u**2, -10 * u + 9 * u**2, 1 + 8 * u - 9 * u**2, 3 * u**2 - 2 * u)
    for k, (cubic, rise) in enumerate(zip(cubics, rises)):
        # Beyond the ends the first and the last value go on.
        column = np.clip(first + k - 1, 0, count - 1)
        shares[rows, column] += 0.5 * cubic
        slopes[rows, column] += 0.5 * (count - 1) * rise
    return shares, slopes


def swelling(part: Floats, swell: Sequence[float]) -> tuple[Floats, Floats]:
    """How much of the depth is there at parts of the length, (k,), and its derivative by the part, (k,)."""
    if not swell:
        return np.ones_like(part), np.zeros_like(part)
    shares, slopes = swell_shares(part, len(swell))
    return shares @ np.array(swell), slopes @ np.array(swell)
