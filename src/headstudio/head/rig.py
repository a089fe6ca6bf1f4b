"""A body part with a skeleton: joints, and how much of each joint's motion every point of the skin takes."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from .head import HeadError
from .mesh import Floats, Ints, TriangleMesh

FINGERS = ("thumb", "index", "middle", "ring", "little")
PHALANGES = ("metacarpal", "proximal", "intermediate", "distal", "tip")


@dataclass(frozen=True, eq=False)
class Rig:
    """Joints at rest.

    names: of the joints; those of a hand are "wrist" and FINGER PHALANX, such as "index proximal", the joint at which
    that bone starts. parents: index of the joint that each hangs on, -1 for none, and always before it, (j,). positions:
    of the joints [m], (j, 3). weights: share of each joint in the motion of each vertex, rows add up to 1, (n, j).
    """

    names: tuple[str, ...]
    parents: Ints
    positions: Floats
    weights: sparse.csr_array

    def index(self, name: str) -> int:
        """The joint of that name. Raises HeadError when there is none."""
        if name not in self.names:
            raise HeadError(f"the skeleton has no joint {name!r}; it has {', '.join(self.names)}")
        return self.names.index(name)

    def at(self, name: str) -> Floats:
        """Where a joint is at rest [m], shape (3,). Raises HeadError when there is none of that name."""
        position: Floats = self.positions[self.index(name)]
        return position


@dataclass(frozen=True, eq=False)
class BodyPart:
    """A hand, an arm, a foot. skin: in metres. rig: its skeleton, None for one that holds still. notes: what was found
    in the source and what was done to it, a line each."""

    name: str
    skin: TriangleMesh
    rig: Rig | None = None
    notes: tuple[str, ...] = ()


def is_hand(names: Collection[str]) -> bool:
    """Whether joints of these names make a hand: a wrist, and fingers from their knuckles to their tips."""
    return {"wrist", *(f"{finger} {bone}" for finger in FINGERS for bone in ("proximal", "tip"))} <= set(names)


def bones_of(finger: str) -> tuple[str, ...]:
    """The joints of a finger from its root to its tip. A thumb has one phalanx less."""
    return tuple(f"{finger} {name}" for name in PHALANGES if (finger, name) != ("thumb", "intermediate"))


def hand_parents(names: tuple[str, ...]) -> Ints:
    """What each joint of a hand hangs on, by its name, -1 for none, (j,)."""
    before = {
        joint: parent for finger in FINGERS for parent, joint in zip(("wrist", *bones_of(finger)), bones_of(finger))
    }
    return np.array([names.index(before[name]) if before.get(name) in names else -1 for name in names])


def hand_frame(names: tuple[str, ...], positions: Floats) -> Floats:
    """Axes of a hand as rows, (3, 3): third out of its back, second from the wrist to the middle finger, first across.

    positions: of the joints, (j, 3). The palm is the side that fingers bend to and the thumb lies on, so a left and a
    right hand are told apart by themselves.
    """
    at = dict(zip(names, positions))
    along = at["middle proximal"] - at["wrist"]
    along = along / np.linalg.norm(along)
    across = at["index proximal"] - at["little proximal"]
    across = across - (across @ along) * along
    across = across / np.linalg.norm(across)
    normal = np.cross(across, along)
    bend = sum((at[f"{name} tip"] - at[f"{name} proximal"]) @ normal for name in FINGERS[1:])
    lies = (at["thumb tip"] - at["wrist"]) @ normal
    back = -normal if bend + lies > 0 else normal
    return np.stack([np.cross(along, back), along, back])
