"""Where the head is while the studio plays: the motion that the document names, and the user's hand on top of it."""

from __future__ import annotations

import math

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..scene.live_drag import LiveDrag
from ..scene.motion import combined, frame_from_angles, head_motion
from ..scene.settings import MotionSettings

# How fast [1/s] the head finds its way from one motion into the next.
SETTLING_RATE = 7.0


class Performance:
    """A motion that changes smoothly while it runs. Calling it gives the head at a time [s] that does not go back.

    Another motion, angle or rate is not a jump: what is left of the old pose and its speed dies out over the new.
    """

    def __init__(self, settings: MotionSettings) -> None:
        self.hand = LiveDrag()
        self._settings = settings
        self._motion = head_motion(settings)
        self._start = 0.0
        self._settling_since = 0.0
        self._offset = np.zeros(3)
        self._slope = np.zeros(3)

    def follow(self, settings: MotionSettings, time: float) -> None:
        """From ``time`` [s] on, move as ``settings`` say. Call before every step."""
        if settings == self._settings:
            return
        angles, rates, _ = self._angles(time)
        if settings.kind != self._settings.kind:
            self._start = time
        self._settings, self._motion = settings, head_motion(settings)
        self._settling_since = time
        self._offset, self._slope = np.zeros(3), np.zeros(3)
        new_angles, new_rates, _ = self._angles(time)
        self._offset = angles - new_angles
        self._slope = rates - new_rates + SETTLING_RATE * self._offset

    def __call__(self, time: float) -> HeadFrame:
        """The head at ``time`` [s]."""
        return combined(self.hand(time), frame_from_angles(*self._angles(time)))

    def _angles(self, time: float) -> tuple[Floats, Floats, Floats]:
        """Pitch, yaw, roll [rad] with two derivatives: the motion, and what remains of the one before.

        A named motion turns about one axis, so its rotation vector holds the three angles.
        """
        frame = self._motion(time - self._start)
        rate, elapsed = SETTLING_RATE, time - self._settling_since
        fade = math.exp(-rate * elapsed)
        left = self._offset + self._slope * elapsed
        return (
            frame.rotation.as_rotvec() + left * fade,
            frame.angular_velocity + (self._slope - rate * left) * fade,
            frame.angular_acceleration + (rate**2 * left - 2 * rate * self._slope) * fade,
        )
