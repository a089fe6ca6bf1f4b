"""How the head moves by itself: pose, velocity and acceleration as exact functions of time.

Every motion is three angles over time, and the frame with its derivatives follows from them in one place. A motion
starts from rest without a jerk: its first two derivatives are zero at time 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.spatial.transform import Rotation

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from .settings import MotionSettings

Motion = Callable[[float], HeadFrame]
# A number over time [s], with its first and second derivative.
Curve = Callable[[float], tuple[float, float, float]]

PITCH, YAW, ROLL = range(3)


def head_motion(settings: MotionSettings) -> Motion:
    """The motion that ``settings`` name, as a function of the time since its start [s].

    shake, nod and tilt swing about the vertical, the sideways and the forward axis; turn looks slowly to one side,
    holds, and looks to the other. In rest, split and wind the head stands still and other things happen.
    """
    match settings.kind:
        case "shake":
            return about_axis(YAW, swing(settings.angle, settings.rate))
        case "nod":
            return about_axis(PITCH, swing(settings.angle, settings.rate))
        case "tilt":
            return about_axis(ROLL, swing(settings.angle, settings.rate))
        case "turn":
            return about_axis(YAW, look_around(settings.angle, settings.rate))
        case _:
            return lambda time: HeadFrame()


def about_axis(axis: int, curve: Curve) -> Motion:
    """A head that turns by ``curve`` [rad] about one axis: PITCH, YAW or ROLL."""

    def motion(time: float) -> HeadFrame:
        derivatives = np.zeros((3, 3))
        derivatives[:, axis] = curve(time)
        return frame_from_angles(*derivatives)

    return motion


def swing(amplitude: float, rate: float) -> Curve:
    """A sine [rad] of ``rate`` [Hz] that reaches its full amplitude within its first period."""
    omega = 2 * math.pi * rate

    def curve(time: float) -> tuple[float, float, float]:
        grown, growing, bend = smooth_step(time, 1 / rate)
        sine, cosine = math.sin(omega * time), math.cos(omega * time)
        return (
            amplitude * grown * sine,
            amplitude * (growing * sine + grown * omega * cosine),
            amplitude * (bend * sine + 2 * growing * omega * cosine - grown * omega**2 * sine),
        )

    return curve


def look_around(amplitude: float, rate: float) -> Curve:
    """From the middle to one side [rad], a pause, to the other side, a pause, and so on.

    A turn and a pause each last two periods of ``rate`` [Hz].
    """
    turn = 2 / rate

    def curve(time: float) -> tuple[float, float, float]:
        number, within = divmod(max(time, 0.0), 2 * turn)
        start = 0.0 if number == 0 else amplitude * (-1.0) ** (number - 1)
        way = amplitude * (-1.0) ** number - start
        done, rate_of_turn, bend = smooth_step(within, turn)
        return start + way * done, way * rate_of_turn, way * bend

    return curve


def smooth_step(time: float, duration: float) -> tuple[float, float, float]:
    """From 0 at time 0 to 1 at ``duration`` [s], with two continuous derivatives; the value and these derivatives."""
    x = min(max(time / duration, 0.0), 1.0)
    return (
        x**3 * (10 + x * (6 * x - 15)),
        30 * (x * (1 - x)) ** 2 / duration,
        60 * x * (1 - x) * (1 - 2 * x) / duration**2,
    )


def frame_from_angles(
    angles: Floats,
    rates: Floats,
    accelerations: Floats,
    translation: Floats | None = None,
    velocity: Floats | None = None,
    acceleration: Floats | None = None,
) -> HeadFrame:
    """The frame of a head turned by pitch, yaw and roll, with the derivatives that follow.

    angles, rates and accelerations [rad, rad/s, rad/s^2] are about x (positive: the chin drops), y (positive: the
    head looks to its own left) and z (positive: the head leans to its own right), shape (3,). The head yaws about the
    world's y, pitches about its own x then, and rolls about its own z last: R = Ry(yaw) Rx(pitch) Rz(roll).
    translation [m], velocity and acceleration of the bust are zero when left out.
    """
    pitch, yaw, roll = angles
    sin_pitch, cos_pitch, sin_yaw, cos_yaw = math.sin(pitch), math.cos(pitch), math.sin(yaw), math.cos(yaw)
    # The axes of the three turns in the world, and how fast the turns before carry them along.
    axes = np.array(
        [
            [cos_yaw, 0.0, -sin_yaw],
            [0.0, 1.0, 0.0],
            [sin_yaw * cos_pitch, -sin_pitch, cos_yaw * cos_pitch],
        ]
    )
    carried = np.zeros((3, 3))
    carried[PITCH] = rates[YAW] * np.array([-sin_yaw, 0.0, -cos_yaw])
    carried[ROLL] = rates[YAW] * np.array([cos_yaw * cos_pitch, 0.0, -sin_yaw * cos_pitch])
    carried[ROLL] -= rates[PITCH] * np.array([sin_yaw * sin_pitch, cos_pitch, cos_yaw * sin_pitch])
    still = np.zeros(3)
    return HeadFrame(
        rotation=Rotation.from_euler("YXZ", [yaw, pitch, roll]),
        translation=still if translation is None else translation,
        velocity=still if velocity is None else velocity,
        acceleration=still if acceleration is None else acceleration,
        angular_velocity=rates @ axes,
        angular_acceleration=accelerations @ axes + rates @ carried,
    )


def combined(outer: HeadFrame, inner: HeadFrame) -> HeadFrame:
    """The head turned by ``inner`` and then by ``outer``, and moved by both."""
    turned = outer.rotation.apply([inner.angular_velocity, inner.angular_acceleration])
    return HeadFrame(
        rotation=outer.rotation * inner.rotation,
        translation=outer.translation + inner.translation,
        velocity=outer.velocity + inner.velocity,
        acceleration=outer.acceleration + inner.acceleration,
        angular_velocity=outer.angular_velocity + turned[0],
        angular_acceleration=outer.angular_acceleration + np.cross(outer.angular_velocity, turned[0]) + turned[1],
    )
