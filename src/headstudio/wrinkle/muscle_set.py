"""The muscles of expression, and how they find their places on any head.

The linear muscles and their figures are the set that Waters published in 1994, on a face of its own with a unit of some
16 mm; the face that it belongs to is known here by its landmarks. Muscles are carried from there by the smoothest map
that takes the landmarks of that face to those of the head (thin plate splines), so that an asymmetric head has
asymmetric muscles. Sheets, sphincters and the muscles that the set lacks are laid out on the same face.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.interpolate import RBFInterpolator

from ..head.head import Landmarks
from ..head.mesh import Floats, Ints
from .muscles import LinearMuscle, Muscle, SheetMuscle, SphincterMuscle

SIDES = ("left", "right")
Place = tuple[float, float, float]

# The landmarks of the face that the muscles are laid out on, on its middle and on its right, which is -x.
_MIDDLE = {
    "hairline": (0.0, 6.5, 7.27),
    "glabella": (0.0, 3.3, 8.2),
    "nose_tip": (0.0, -0.1, 9.28),
    "chin": (0.0, -4.95, 7.1),
}
_PAIRED = {
    ("left_eye", "right_eye"): (-2.03, 2.1, 7.32),
    ("mouth_left", "mouth_right"): (-1.57, -2.22, 7.85),
    ("left_tragus", "right_tragus"): (-4.8, 0.5, 1.95),
}


class _Linear(NamedTuple):
    insertion: Place
    origin: Place
    fade_start: float
    fade_end: float
    zone: float


class _Sheet(NamedTuple):
    insertion: Place
    origin: Place
    half_width: float
    fade_start: float
    fade_end: float


class _Sphincter(NamedTuple):
    centre: Place
    half_width: float
    half_height: float
    depth: float
    draw: tuple[float, float]
    protrusion: float


_Entry = _Linear | _Sheet | _Sphincter


_WATERS: dict[str, _Entry] = {
    "zygomatic major": _Linear((-1.570, -2.221, 7.820), (-3.805, 0.868, 6.600), 0.1, 4.8, 45),
    "angular depressor": _Linear((-1.570, -2.221, 8.025), (-2.559, -4.277, 5.351), 0.3, 4.5, 65),
    "frontalis inner": _Linear((-0.487, 3.639, 8.101), (-0.354, 6.247, 7.229), 0.1, 3.6, 35),
    "frontalis major": _Linear((-2.381, 3.830, 8.000), (-2.244, 6.363, 6.969), 0.1, 3.7, 65),
    "frontalis outer": _Linear((-3.095, 3.970, 7.895), (-3.639, 5.648, 5.945), 0.1, 3.5, 45),
    "labi nasi": _Linear((-1.776, -0.834, 8.239), (-1.560, 1.887, 7.332), 0.1, 5.2, 35),
    "inner labi nasi": _Linear((-1.002, 0.217, 8.462), (-0.638, 2.084, 7.661), 0.1, 4.5, 35),
    "lateral corrugator": _Linear((-1.170, 4.658, 7.356), (0.0, 3.262, 8.208), 0.5, 3.0, 45),
    "secondary frontalis": _Linear((-0.584, 3.052, 8.055), (-0.991, 4.862, 8.093), 0.1, 4.8, 45),
}
"""The set of 1994 as printed."""

_ADDED: dict[str, _Entry] = {
    "frontalis": _Sheet((-1.7, 3.7, 8.0), (-1.7, 6.7, 6.9), 2.6, 1.6, 4.1),
    # Its outer part reaches the temple, where it folds skin into crow's feet.
    "orbicularis oculi": _Sphincter((-2.45, 2.0, 7.1), 2.75, 1.75, 3.0, (0.35, 1.0), 0.0),
    "orbicularis oris": _Sphincter((0.0, -2.3, 8.2), 2.6, 2.0, 2.0, (1.0, 0.35), 0.5),
    "depressor supercilii": _Linear((-1.7, 3.9, 7.9), (-0.8, 2.3, 7.5), 0.4, 3.0, 60),
    "procerus": _Linear((-0.35, 3.8, 8.1), (-0.2, 1.9, 8.2), 0.3, 3.0, 45),
    # With its pull all along, the cheek would move farther than the corner of the mouth, and bulge; the printed zygomatic
    # major does. These shorten evenly from bone to lip, so that a smile is drawn by its corners.
    "zygomatic minor": _Linear((-1.570, -2.221, 7.820), (-3.1, 0.9, 6.85), 3.4, 5.2, 27),
    "risorius": _Linear((-1.570, -2.221, 7.85), (-4.2, -1.5, 4.4), 4.2, 6.2, 30),
    "depressor labii": _Linear((-0.75, -2.9, 8.2), (-1.1, -4.5, 7.0), 0.1, 2.7, 45),
    "mentalis": _Linear((-0.3, -4.6, 7.5), (-0.25, -2.9, 7.8), 0.2, 2.6, 50),
}
"""What the set lacks: sheet, sphincters, and the muscles that knit the brow and move the lower lip."""

MUSCLES = tuple(_WATERS) + tuple(_ADDED)
"""The names of the muscles; there is one on each side."""


def place_muscles(landmarks: Landmarks) -> dict[tuple[str, str], Muscle]:
    """All muscles on a head with these landmarks, by side ("left" or "right", the person's own) and name."""
    carry = _carry_to(landmarks)
    return {
        (side, name): _placed(entry, _Carried(carry, 1.0 if side == "right" else -1.0))
        for name, entry in {**_WATERS, **_ADDED}.items()
        for side in SIDES
    }


def carried_face_points(landmarks: Landmarks, places: Sequence[Place]) -> tuple[Floats, Ints]:
    """Points of the face of 1994, of its middle and its right, on a head with these landmarks, and mirrored: (k, 3) [m].

    Returns with them which of ``places`` each comes from, (k,); what lies in the middle is there once.
    """
    right = np.array(places)
    paired = np.nonzero(right[:, 0] != 0.0)[0]
    points = np.concatenate([right, right[paired] * [-1.0, 1.0, 1.0]])
    return _carry_to(landmarks)(points), np.concatenate([np.arange(len(right)), paired])


def _carry_to(landmarks: Landmarks) -> RBFInterpolator:
    names, face = _face_landmarks()
    return RBFInterpolator(face, np.array([getattr(landmarks, name) for name in names]), kernel="linear", degree=1)


def _face_landmarks() -> tuple[list[str], Floats]:
    names, points = list(_MIDDLE), list(_MIDDLE.values())
    for (left, right), (x, y, z) in _PAIRED.items():
        names += [left, right]
        points += [(-x, y, z), (x, y, z)]
    return names, np.array(points)


class _Carried:
    """Points, directions and lengths of the face of 1994, one side of it, on the head."""

    def __init__(self, carry: RBFInterpolator, mirror: float) -> None:
        self._carry = carry
        self._mirror = np.array([mirror, 1.0, 1.0])

    def point(self, place: Place) -> Floats:
        carried: Floats = self._carry(np.array([place]) * self._mirror)[0]
        return carried

    def step(self, place: Place, axis: int) -> Floats:
        """Where a unit along an axis of the right half of the face goes; x always to the person's left."""
        half = 0.5 * np.eye(3)[axis]
        end, start = self.point(tuple(np.array(place) + half)), self.point(tuple(np.array(place) - half))
        step: Floats = end - start
        return step * self._mirror[0] if axis == 0 else step


def _placed(entry: _Entry, carried: _Carried) -> Muscle:
    if isinstance(entry, _Sphincter):
        return _placed_sphincter(entry, carried)
    origin, insertion = carried.point(entry.origin), carried.point(entry.insertion)
    scale = float(np.linalg.norm(insertion - origin) / math.dist(entry.insertion, entry.origin))
    if isinstance(entry, _Sheet):
        across = carried.step(entry.insertion, 0)
        width = float(np.linalg.norm(across))
        return SheetMuscle(
            origin,
            insertion,
            across / width,
            entry.half_width * width,
            entry.fade_start * scale,
            entry.fade_end * scale,
        )
    return LinearMuscle(origin, insertion, entry.fade_start * scale, entry.fade_end * scale, math.radians(entry.zone))


def _placed_sphincter(entry: _Sphincter, carried: _Carried) -> SphincterMuscle:
    across, up = carried.step(entry.centre, 0), carried.step(entry.centre, 1)
    width = float(np.linalg.norm(across))
    across = across / width
    up = up - (up @ across) * across
    height = float(np.linalg.norm(up))
    return SphincterMuscle(
        carried.point(entry.centre),
        across,
        up / height,
        entry.half_width * width,
        entry.half_height * height,
        entry.depth * width,
        entry.draw,
        entry.protrusion * width,
    )
