"""Hands: named poses and sliders on any hand's skeleton.

A pose says how far each joint is bent, counted from a straight finger. What a hand bends at rest is measured on its
skeleton, so that a fist is a fist on every hand.
"""

from __future__ import annotations

import numpy as np

from ..head.head import HeadError
from ..head.mesh import Floats
from ..head.rig import FINGERS, BodyPart, bones_of, hand_frame
from .hand_poses import POSES, HandPose, Touch
from .hand_settings import HandSettings
from .skeleton import joint_motions, skinned
from .thumb import reach

# A curl of 1 bends knuckle, middle and last joint of a finger, and both joints of a thumb, by so much [rad].
_FULL_CURL = np.radians([75.0, 95.0, 60.0])
_FULL_THUMB = np.radians([45.0, 65.0])
# How far fingers go toward the thumb when they are spread, in parts of the angle [rad].
_FULL_SPREAD = np.radians(14.0)
_SPREAD_SHARES = (1.0, 0.25, -0.5, -1.2)


class Hand:
    """A hand whose joints bend; made once for a body part with a skeleton. Raises HeadError for one that is no hand."""

    def __init__(self, part: BodyPart) -> None:
        if part.rig is None:
            raise HeadError(f"{part.name} has no skeleton")
        self.part = part
        self._rig = rig = part.rig
        for finger in FINGERS:
            for bone in self._bones(finger):
                rig.index(bone)
        across, along, back = hand_frame(rig.names, rig.positions)
        self._palm = -back
        self._palm_length = float(np.linalg.norm(rig.at("middle proximal") - rig.at("wrist")))
        toward_thumb = across * np.sign((rig.at("index proximal") - rig.at("little proximal")) @ across)
        self._spread_axis = np.cross(along, toward_thumb)
        self._wrist_axis = np.cross(along, self._palm)
        self._axes = {finger: self._bend_axis(finger) for finger in FINGERS}
        self._bent = {finger: self._bend_at_rest(finger) for finger in FINGERS}
        self._pose_turns = {name: self._turns_of(pose) for name, pose in POSES.items()}

    def pose(self, settings: HandSettings) -> Floats:
        """The skin as ``settings`` holds the hand [m], (n, 3)."""
        return skinned(self._rig, self.part.skin.vertices, joint_motions(self._rig, self.turns(settings)))

    def turns(self, settings: HandSettings) -> Floats:
        """What every joint turns by from rest, as rotation vectors [rad], (j, 3)."""
        turns = np.zeros((len(self._rig.names), 3))
        if settings.pose in self._pose_turns:
            turns += settings.strength * self._pose_turns[settings.pose]
        for finger in FINGERS:
            full = _FULL_THUMB if finger == "thumb" else _FULL_CURL
            self._bend(turns, finger, getattr(settings, f"curl_{finger}") * full)
        self._spread(turns, settings.spread)
        turns[self._rig.index("wrist")] += settings.wrist * self._wrist_axis
        return turns

    def _turns_of(self, pose: HandPose) -> Floats:
        turns = np.zeros((len(self._rig.names), 3))
        for finger, bend in pose.fingers.items():
            self._bend(turns, finger, np.radians(bend) - self._bent[finger])
        self._spread(turns, pose.spread)
        thumb = np.radians(pose.thumb) - self._bent["thumb"]
        if pose.touch is None:
            self._bend(turns, "thumb", thumb)
        else:
            joints = [self._rig.index(bone) for bone in self._bones("thumb")]
            turns[joints[:-1]] = reach(
                self._rig.positions[joints], self._axes["thumb"], thumb, self._touched(turns, pose.touch)
            )
        return turns

    def _touched(self, turns: Floats, touch: Touch) -> Floats:
        """Where a finger that is bent by ``turns`` offers itself to the thumb, shape (3,) [m]."""
        motions = joint_motions(self._rig, turns)
        at = [self._rig.index(f"{touch.finger} {bone}") for bone in touch.between]
        ends = [motions[k, :, :3] @ self._rig.positions[k] + motions[k, :, 3] for k in at]
        bone = self._rig.at(f"{touch.finger} tip") - self._rig.at(f"{touch.finger} distal")
        pad = motions[at[0], :, :3] @ np.cross(self._axes[touch.finger], bone / np.linalg.norm(bone))
        target: Floats = 0.5 * (ends[0] + ends[1]) + touch.lift * self._palm_length * pad
        return target

    def _bend(self, turns: Floats, finger: str, angles: Floats) -> None:
        """Bend the joints of a finger from its knuckle on, in place."""
        for name, angle in zip(self._bones(finger)[1:-1], angles):
            turns[self._rig.index(name)] += angle * self._axes[finger]

    def _spread(self, turns: Floats, amount: float) -> None:
        for finger, share in zip(FINGERS[1:], _SPREAD_SHARES):
            turns[self._rig.index(f"{finger} proximal")] += amount * share * _FULL_SPREAD * self._spread_axis

    def _bones(self, finger: str) -> tuple[str, ...]:
        """The joints of a finger with what its first bone starts at: a thumb's own root, the wrist for the others."""
        bones = bones_of(finger)
        return bones if finger == "thumb" else ("wrist", *bones[1:])

    def _bend_axis(self, finger: str) -> Floats:
        """The axis that bends a finger toward the palm, a thumb toward the root of the little finger, shape (3,)."""
        at = self._rig.at
        direction = at(f"{finger} distal") - at(f"{finger} proximal")
        toward = at("little proximal") - at("thumb distal") if finger == "thumb" else self._palm
        axis = np.cross(direction, toward)
        unit: Floats = axis / np.linalg.norm(axis)
        return unit

    def _bend_at_rest(self, finger: str) -> Floats:
        """How far each joint that bends is bent at rest, from the bone before it [rad]."""
        axis = self._axes[finger]
        bones = np.diff(np.array([self._rig.at(bone) for bone in self._bones(finger)]), axis=0)
        bones = bones - (bones @ axis)[:, None] * axis
        bent: Floats = np.arctan2(np.cross(bones[:-1], bones[1:]) @ axis, np.einsum("ij,ij->i", bones[:-1], bones[1:]))
        return bent
