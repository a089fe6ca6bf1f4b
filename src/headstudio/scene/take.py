"""A take: a recorded motion of the head."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from .motion import frame_from_angles


class TakeError(ValueError):
    """A recording that gives no motion. The message is one line for the user."""


@dataclass(frozen=True, eq=False)
class Take:
    """Samples of a moving head, with a cubic spline through them.

    times [s], rising, (n,), n >= 2. angles: pitch, yaw, roll [rad] as ``frame_from_angles`` takes them, (n, 3).
    translations of the bust [m], (n, 3). The spline begins and ends at rest; before and after it the head holds still.
    Raises TakeError for samples that no motion goes through.
    """

    times: Floats
    angles: Floats
    translations: Floats

    def __post_init__(self) -> None:
        if len(self.times) < 2:
            raise TakeError("a take has two moments or more")
        if not np.all(np.diff(self.times) > 0):
            raise TakeError("the times of a take rise")

    @property
    def seconds(self) -> float:
        """How long the take lasts [s]."""
        return float(self.times[-1] - self.times[0])

    @cached_property
    def _spline(self) -> CubicSpline:
        # A recorder wraps angles at half a turn; the head does not.
        columns = np.hstack([np.unwrap(self.angles, axis=0), self.translations])
        return CubicSpline(self.times - self.times[0], columns, bc_type="clamped")

    def __call__(self, time: float) -> HeadFrame:
        """The head ``time`` seconds after the take begins."""
        inside = min(max(time, 0.0), self.seconds)
        value, rate, acceleration = (self._spline(inside, order) for order in range(3))
        if inside != time:
            rate, acceleration = np.zeros(6), np.zeros(6)
        return frame_from_angles(value[:3], rate[:3], acceleration[:3], value[3:], rate[3:], acceleration[3:])
