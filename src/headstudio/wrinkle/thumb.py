"""A thumb that reaches for something: a few angles found by least squares."""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from ..head.mesh import Floats

# The root swings about this far to each side, the other two joints bend between these angles from rest [rad].
_SWING = np.radians(60.0)
_BEND = np.radians([-25.0, 75.0])
# What a radian away from the angles that are preferred costs, as a part of the length of the thumb.
_EASE = 0.02


def reach(joints: Floats, bend_axis: Floats, preferred: Floats, target: Floats) -> Floats:
    """Rotation vectors of the three joints of a thumb that bring its tip to a point, as near as it goes: (3, 3) [rad].

    joints: root, both joints that bend, and the tip, at rest (4, 3) [m]. bend_axis: unit axis that bends the thumb,
    shape (3,). preferred: how far both joints would rather bend from rest [rad], (2,). target: shape (3,) [m].
    """
    bone = joints[1] - joints[0]
    sideways = np.cross(bone, bend_axis)
    sideways /= np.linalg.norm(sideways)
    length = float(np.linalg.norm(np.diff(joints, axis=0), axis=1).sum())

    def turns(angles: Floats) -> Floats:
        root = angles[0] * bend_axis + angles[1] * sideways
        return np.stack([root, angles[2] * bend_axis, angles[3] * bend_axis])

    def misses(angles: Floats) -> Floats:
        ease = np.concatenate([angles[:2], angles[2:] - preferred])
        return np.concatenate([(_tip(joints, turns(angles)) - target) / length, _EASE * ease])

    start = np.concatenate([np.zeros(2), np.clip(preferred, *_BEND)])
    low = np.array([-_SWING, -_SWING, _BEND[0], _BEND[0]])
    high = np.array([_SWING, _SWING, _BEND[1], _BEND[1]])
    return turns(least_squares(misses, np.clip(start, low, high), bounds=(low, high)).x)


def _tip(joints: Floats, turns: Floats) -> Floats:
    """Where the tip goes when the joints turn, the last one first."""
    tip = joints[3]
    for joint, turn in zip(joints[2::-1], turns[::-1]):
        tip = joint + Rotation.from_rotvec(turn).apply(tip - joint)
    return tip
