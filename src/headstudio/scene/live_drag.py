"""The head under the user's hand: it follows the mouse, but moves like a head."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from .motion import frame_from_angles


@dataclass(frozen=True)
class Reach:
    """What the head can do under the hand, for pitch, yaw, roll [rad] and the place of the bust [m], shape (6,).

    farthest: how far from rest. speed: the highest, per second. acceleration: the strongest, per second squared.
    quickness: rate of the critically damped filter [1/s]; the head is there after about 5 / quickness.
    """

    farthest: Floats
    speed: Floats
    acceleration: Floats
    quickness: float = 18.0


# A neck turns 80 degrees, nods 60 and leans 45 at most; the speeds are those of a vigorous shake.
NECK = Reach(
    farthest=np.array([math.radians(60), math.radians(80), math.radians(45), 0.4, 0.4, 0.4]),
    speed=np.array([10.0, 12.0, 8.0, 2.5, 2.5, 2.5]),
    acceleration=np.array([150.0, 200.0, 120.0, 40.0, 40.0, 40.0]),
)


class LiveDrag:
    """A motion that follows a goal through a critically damped filter with bounded speed and acceleration.

    ``aim`` is called once a frame with where the mouse wants the head; between two calls the motion is an exact
    function of time, so a solver may ask for any instant.
    """

    def __init__(self, reach: Reach = NECK) -> None:
        self._reach = reach
        self.reset()

    def reset(self) -> None:
        """The head is at rest, at time 0, and nobody pulls."""
        self._time = 0.0
        self._goal = np.zeros(6)
        self._offset = np.zeros(6)
        self._slope = np.zeros(6)

    def aim(self, time: float, angles: Floats, translation: Floats | None = None) -> None:
        """From ``time`` [s] on, go for pitch, yaw, roll [rad] and a place of the bust [m], each (3,)."""
        place, velocity, _ = self._at(time)
        wish = np.concatenate([angles, np.zeros(3) if translation is None else translation])
        wish = np.clip(wish, -self._reach.farthest, self._reach.farthest)
        self._time = time
        self._goal = self._within_reach(wish, place, velocity)
        self._offset = place - self._goal
        self._slope = velocity + self._reach.quickness * self._offset

    def __call__(self, time: float) -> HeadFrame:
        """The head at ``time`` [s]; before the last ``aim`` it is where it was then."""
        place, velocity, acceleration = self._at(time)
        return frame_from_angles(place[:3], velocity[:3], acceleration[:3], place[3:], velocity[3:], acceleration[3:])

    def _at(self, time: float) -> tuple[Floats, Floats, Floats]:
        """Place, velocity and acceleration of y'' + 2 k y' + k^2 y = 0, y being the way from the goal."""
        rate, elapsed = self._reach.quickness, max(time - self._time, 0.0)
        fade = math.exp(-rate * elapsed)
        way = self._offset + self._slope * elapsed
        return (
            self._goal + way * fade,
            (self._slope - rate * way) * fade,
            (rate**2 * way - 2 * rate * self._slope) * fade,
        )

    def _within_reach(self, wish: Floats, place: Floats, velocity: Floats) -> Floats:
        """The goal nearest to ``wish`` that asks for no more speed and acceleration than allowed."""
        reach, rate = self._reach, self._reach.quickness
        # From rest the filter's top speed is rate * distance / e; its first acceleration rate^2 * distance - 2 rate v.
        farthest = math.e * reach.speed / rate
        wish = place + np.clip(wish - place, -farthest, farthest)
        pull = rate**2 * (wish - place) - 2 * rate * velocity
        pull = np.clip(pull, -reach.acceleration, reach.acceleration)
        return place + (pull + 2 * rate * velocity) / rate**2
