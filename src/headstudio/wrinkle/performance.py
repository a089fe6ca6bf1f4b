"""A performance: expressions over time, by keyframes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.interpolate import PchipInterpolator


@dataclass(frozen=True)
class Keyframe:
    """What the face shows at one time. time: [s]. weights: (name of a slider, strength from 0 to 1) each; a slider that
    is not named is at 0."""

    time: float
    weights: tuple[tuple[str, float], ...] = ()


Performance = tuple[Keyframe, ...]


def keyframe(time: float, weights: Mapping[str, float]) -> Keyframe:
    """A keyframe with its sliders in alphabetical order, so that equal ones compare equal."""
    return Keyframe(float(time), tuple(sorted((name, float(value)) for name, value in weights.items())))


SAME_TIME = 1 / 120
"""Two keyframes nearer than this are one [s]."""


def with_key(performance: Performance, key: Keyframe) -> Performance:
    """``performance`` with a keyframe, in the place of the one at the same time if there is one."""
    others = (other for other in performance if abs(other.time - key.time) >= SAME_TIME)
    return tuple(sorted((*others, key), key=lambda each: each.time))


def without_key(performance: Performance, index: int) -> Performance:
    """``performance`` without one of its keyframes."""
    return performance[:index] + performance[index + 1 :]


def moved_key(performance: Performance, index: int, time: float) -> Performance:
    """``performance`` with a keyframe at another ``time`` [s], between its neighbours and not before 0."""
    low = performance[index - 1].time + 2 * SAME_TIME if index > 0 else 0.0
    high = performance[index + 1].time - 2 * SAME_TIME if index + 1 < len(performance) else math.inf
    moved = Keyframe(float(min(max(time, low), max(high, low))), performance[index].weights)
    return (*performance[:index], moved, *performance[index + 1 :])


def check_performance(performance: Performance, sliders: tuple[str, ...]) -> Performance:
    """Return ``performance`` if times rise and every weight is a slider's from 0 to 1. Raises ValueError, a phrase."""
    times = [key.time for key in performance]
    if not all(map(math.isfinite, times)) or any(later <= earlier for earlier, later in pairwise(times)):
        raise ValueError("has keyframes whose times do not rise")
    for key in performance:
        for name, value in key.weights:
            if name not in sliders:
                raise ValueError(f"moves a slider {name!r} that does not exist")
            if not 0.0 <= value <= 1.0:
                raise ValueError(f"moves {name} out of the range from 0 to 1")
        if len({name for name, _ in key.weights}) < len(key.weights):
            raise ValueError("sets a slider twice at one time")
    return performance


def weights_at(performance: Performance, time: float) -> dict[str, float]:
    """The sliders that a performance moves, at ``time`` [s].

    Smooth between keyframes, and never beyond them: a monotone cubic spline for each slider (Fritsch, Carlson 1980).
    Before the first keyframe and after the last one they hold. An empty performance moves none.
    """
    names = sorted({name for key in performance for name, _ in key.weights})
    if not names:
        return {}
    table = np.array([[dict(key.weights).get(name, 0.0) for name in names] for key in performance])
    if len(performance) == 1:
        values = table[0]
    else:
        times = np.array([key.time for key in performance])
        # Held before and after, so that a motion starts and ends at rest.
        held_times = np.concatenate([[times[0] - 1.0], times, [times[-1] + 1.0]])
        held = PchipInterpolator(held_times, np.concatenate([table[:1], table, table[-1:]]))
        values = held(np.clip(time, times[0], times[-1]))
    return {name: float(value) for name, value in zip(names, np.clip(values, 0.0, 1.0))}
