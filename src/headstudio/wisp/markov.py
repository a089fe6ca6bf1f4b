"""New strands after a prototype: an example-based Markov chain (Choe, Ko 2005, section 2.2.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints

Singles = NDArray[np.float32]

# Fewer different windows than this leave the chain no choice.
_FEWEST_WINDOWS = 4


def amplitude(prototype: Floats) -> float:
    """How far the details of a prototype, (m, 3), reach from the outline [m]."""
    return float(np.linalg.norm(prototype, axis=1).max(initial=0.0))


def window_size(prototype: Floats, wanted: float) -> int:
    """The window h: ``wanted`` details, in whole numbers, at least one, and so that the prototype, (m, 3), holds a few."""
    return int(np.clip(round(wanted), 1, max(len(prototype) - _FEWEST_WINDOWS, 1)))


def without_loose_end(prototype: Floats, window: int) -> Floats:
    """The prototype, (m, 3), cut off where a chain that has followed it so far best goes on at an earlier part.

    That is where the break, spread over the way back to it, is least. Without this a chain runs into the end of the
    prototype, and has to leave it for whatever is nearest.
    """
    windows = _windows(prototype, window)
    count = len(windows)
    gap = np.sqrt(_squared_distances(windows, windows))
    way = np.arange(count)[:, None] - np.arange(count)
    # A window overlaps itself: what the chain goes back to lies wholly before.
    gap[way < window] = np.inf
    back = gap.argmin(axis=1)
    end = np.arange(count)
    usable = np.isfinite(gap[end, back])
    if not usable.any():
        return prototype
    cost = np.where(usable, gap[end, back] / np.maximum(way[end, back], 1), np.inf)
    return prototype[: window + int(cost.argmin())]


def reached(prototype: Floats, window: int, steps: Ints) -> Ints:
    """Which detail of the prototype, (m, 3), a chain of temperature 0 takes after so many steps from its first, (W,): from
    window to m - 1. At its end it goes on where the nearest window is.
    """
    windows = _windows(prototype, window)
    again = window + int(_squared_distances(windows[:-1], windows[-1:])[:, 0].argmin())
    beyond = window + steps - len(prototype)
    return np.where(beyond < 0, window + steps, again + beyond % (len(prototype) - again))


def synthesise(
    prototype: Floats, window: int, temperature: float, starts: Ints, count: int, rng: np.random.Generator
) -> Singles:
    """Details of W new strands that resemble ``prototype``, (m, 3) [m]: (W, count, 3), all at once.

    Each step compares the last ``window`` details of every strand with every window of the prototype (eq. 2) and takes
    the detail that follows one of them: with the probability of eq. 4, or that of the nearest (eq. 3) at a
    ``temperature`` of 0. A strand begins as if it had followed the prototype up to the detail ``starts``, (W,), of
    window to m - 1.

    Distances are divided by the amplitude of the prototype and the root of how many coordinates a window has, so that one
    temperature means the same likeness for every prototype: it is the root mean square difference of a coordinate, as a part
    of the amplitude, at which a window is e times less likely.
    """
    size = amplitude(prototype)
    strands = np.empty((len(starts), window + count, 3), dtype=np.float32)
    if size == 0:
        strands[:] = 0
        return strands[:, window:]
    scaled = (prototype / size).astype(np.float32)
    unit = np.float32(np.sqrt(3 * window))
    # The last window of the prototype has nothing after it.
    candidates = _windows(scaled, window)[:-1] / unit
    strands[:, :window] = scaled[starts[:, None] + np.arange(-window, 0)]
    for i in range(count):
        recent = strands[:, i : i + window].reshape(len(starts), -1) / unit
        # A column for every strand: what goes on along a column goes on for all strands at once.
        squared = _squared_distances(candidates, recent)
        chosen = _gibbs(np.sqrt(squared), temperature, rng) if temperature > 0 else squared.argmin(axis=0)
        strands[:, window + i] = scaled[window + chosen]
    return strands[:, window:] * np.float32(size)


def nearest_window_error(strands: Floats | Singles, prototype: Floats, window: int) -> float:
    """How little strands, (W, n, 3), resemble a prototype, (m, 3): 0 where every window is one of the prototype's.

    The mean over all windows of the root mean square distance to the nearest of the prototype, as a part of its
    amplitude (eq. 3).
    """
    wanted = _windows(np.asarray(prototype, dtype=np.float64), window)
    errors = [
        np.sqrt(_squared_distances(_windows(strand.astype(np.float64), window), wanted).min(axis=1))
        for strand in strands
    ]
    return float(np.mean(errors) / (np.sqrt(window) * amplitude(prototype)))


def _gibbs(distance: Singles, temperature: float, rng: np.random.Generator) -> Ints:
    """One index for each column of ``distance``, (M, W), with the probability of eq. 4."""
    total = np.exp((distance.min(axis=0) - distance) / np.float32(temperature))
    # Running sums of the weights, row by row: six times as fast as numpy's along this axis.
    for row in range(1, len(total)):
        total[row] += total[row - 1]
    threshold = rng.random(distance.shape[1], dtype=np.float32) * total[-1]
    return np.minimum((total <= threshold).sum(axis=0), len(distance) - 1)


def _windows(details: Floats | Singles, window: int) -> Floats | Singles:
    """All windows of consecutive details, (m, 3), each as one row: (m - window + 1, 3 window)."""
    views = np.lib.stride_tricks.sliding_window_view(details, window, axis=0)
    return np.ascontiguousarray(views.transpose(0, 2, 1)).reshape(len(views), -1)


def _squared_distances(these: Floats | Singles, those: Floats | Singles) -> Floats | Singles:
    """Squared Euclidean distance between all rows, (a, d) and (b, d): (a, b). Eq. 2 before the root."""
    product = these @ those.T
    product *= -2
    product += np.einsum("ij,ij->i", these, these)[:, None]
    product += np.einsum("ij,ij->i", those, those)
    return np.maximum(product, 0, out=product)
