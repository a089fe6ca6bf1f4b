"""Landmarks of any upright head, from its shape.

The profile gives what lies in the middle: the nose is what reaches farthest forward in the middle of the face, the
nasion is the hollow above it, the chin the corner below it, the nape the hollow of the neck. The rest follows from the
proportions of the face and from looking at the surface where it must lie. Lengths are in heights of the head, crown to
chin, and come from MakeHuman's adults and the artist's canon (the face in thirds, the eyes half way).
"""

from __future__ import annotations

import numpy as np

from .ears import find_tragi
from .head import Landmarks
from .mesh import Floats, TriangleMesh
from .profile import Profile, midline, seen_from

_EYE_SPREAD = 0.138
_MOUTH_SPREAD = 0.101
_LOOK_AROUND = 0.03
# How far back from the nasion to the hindmost point of the skull the ear hole lies.
_TRAGUS_DEPTH = 0.454


def find_landmarks(skin: TriangleMesh, height: float, eyes: tuple[Floats, Floats] | None = None) -> Landmarks:
    """The landmarks of an upright head, mirrored at x = 0, face along +Z [m].

    skin: a head, a bust or a whole body. height: of the head from crown to chin, within some 10 % [m]. eyes: the
    pupils, left and right, shape (3,), when they are known.
    """
    profile = midline(skin)
    top = float(profile.level[-1])
    nose = _farthest(profile.between(top - 0.80 * height, top - 0.54 * height), (0.0, 1.0))
    chin = _chin(profile, top, height)
    height = top - chin[1]
    nasion = _nasion(profile, nose, height)
    glabella = profile.front_at(nasion[1] + 0.05 * height)
    hairline = profile.front_at(glabella[1] + 0.215 * height)
    skull = profile.between(top - 0.7 * height, top - 0.05 * height)
    occiput = skull.back_at(float(skull.level[skull.back.argmin()]))
    neck = profile.between(chin[1] - 0.02 * height, chin[1] + 0.2 * height)
    nape = neck.back_at(float(neck.level[neck.back.argmax()]))

    if eyes is None:
        eyes = _pair(skin, _EYE_SPREAD * height, nasion[1] - 0.008 * height, height)
    mouth = _pair(skin, _MOUTH_SPREAD * height, _mouth_level(profile, nose, chin), height)
    expected = np.array([nose[1] + 0.045 * height, nasion[2] - _TRAGUS_DEPTH * (nasion[2] - occiput[2])])
    tragi = find_tragi(skin, expected, height)
    return Landmarks(
        crown=_crown(profile, height),
        hairline=hairline,
        glabella=glabella,
        nasion=nasion,
        nose_tip=nose,
        chin=chin,
        nape=nape,
        occiput=occiput,
        left_tragus=tragi[0],
        right_tragus=tragi[1],
        left_eye=eyes[0],
        right_eye=eyes[1],
        mouth_left=mouth[0],
        mouth_right=mouth[1],
    )


def skull_base(landmarks: Landmarks) -> Floats:
    """The base of the skull, where the head turns on the neck [m], shape (3,): below and behind the ear holes."""
    height = landmarks.crown[1] - landmarks.chin[1]
    between = 0.5 * (landmarks.left_tragus + landmarks.right_tragus)
    return np.array([0.0, between[1] - 0.06 * height, between[2] - 0.058 * height])


def _farthest(profile: Profile, direction: tuple[float, float]) -> Floats:
    """The point of the front that lies farthest in a direction (y, z)."""
    best = int((profile.level * direction[0] + profile.front * direction[1]).argmax())
    return profile.front_at(float(profile.level[best]))


def _crown(profile: Profile, height: float) -> Floats:
    """The top of the head, above the middle of its cap: many a skull is flat on top."""
    top = float(profile.level[-1])
    cap = top - 0.01 * height
    middle = 0.5 * (profile.front_at(cap)[2] + profile.back_at(cap)[2])
    return np.array([0.0, top, middle])


def _chin(profile: Profile, top: float, height: float) -> Floats:
    """The lowest point of the chin in front: on the corner that stands out between mouth and throat."""
    below = profile.between(top - 1.12 * height, top - 0.82 * height)
    throat, mouth = below.front_at(float(below.level[0])), below.front_at(float(below.level[-1]))
    corner = _farthest(below, _across(throat, mouth))[1]
    return _farthest(profile.between(corner - 0.05 * height, corner + 0.05 * height), (-0.9, 0.44))


def _across(lower: Floats, upper: Floats) -> tuple[float, float]:
    """The direction (y, z) square to the line between two points of the middle, forward."""
    return float(lower[2] - upper[2]), float(upper[1] - lower[1])


def _nasion(profile: Profile, nose: Floats, height: float) -> Floats:
    """The hollow between nose and forehead: deepest below a line that leans half as much as the one that joins them."""
    face = profile.between(nose[1] + 0.06 * height, nose[1] + 0.26 * height)
    forehead = profile.front_at(nose[1] + 0.30 * height)
    lean = 0.5 * (forehead[2] - nose[2]) / (forehead[1] - nose[1])
    return profile.front_at(float(face.level[(lean * face.level - face.front).argmax()]))


def _mouth_level(profile: Profile, nose: Floats, chin: Floats) -> float:
    """The level where the lips meet: the hollow between them when there is one, else its usual place."""
    drop = nose[1] - chin[1]
    usual = float(nose[1] - 0.45 * drop)
    upper = _farthest(profile.between(usual + 0.02 * drop, usual + 0.16 * drop), (0.0, 1.0))
    lower = _farthest(profile.between(usual - 0.16 * drop, usual - 0.02 * drop), (0.0, 1.0))
    lips = profile.between(lower[1], upper[1])
    hollow = int(lips.front.argmin())
    return float(lips.level[hollow]) if 0 < hollow < len(lips.level) - 1 else usual


def _pair(skin: TriangleMesh, spread: float, level: float, height: float) -> tuple[Floats, Floats]:
    """The points of the front at a level, to the left and right of the middle by ``spread``.

    The outermost of a few looks around each point, since lids and lips may stand open there.
    """
    around = _LOOK_AROUND * height * np.array([[0, 0], [0, 1], [0, -1], [1, 0], [-1, 0]])
    points = np.array([[spread, level], [-spread, level]])
    depth = seen_from(skin, 2, 1.0, (points[:, None] + around).reshape(-1, 2)).reshape(2, -1).max(axis=1)
    return np.array([*points[0], depth[0]]), np.array([*points[1], depth[1]])
