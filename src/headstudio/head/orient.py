"""Finding out from its shape alone how a head stands: which way is up, where it looks and how large it is.

A head mirrors itself, so its plane of symmetry is found first. Seen square to that plane a head has a silhouette like no
other: every direction in the plane is tried as up, forward to either side and over all sizes, against a standard one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .mesh import Floats, TriangleMesh
from .symmetry import MirrorPlane, mirror_planes, sample_surface

# Silhouette of a standard head in 24 level slices from the crown down to the chin, all in heights of the head: how far
# it reaches forward, how far back, and half its breadth with the ears. Mean of young and old, female and male adults.
_FRONT = (0.17, 0.25, 0.29, 0.33, 0.36, 0.38, 0.40, 0.41, 0.42, 0.42, 0.42, 0.41,
          0.41, 0.44, 0.46, 0.49, 0.49, 0.46, 0.45, 0.44, 0.43, 0.41, 0.40, 0.39)  # fmt: skip
_BACK = (0.24, 0.32, 0.37, 0.41, 0.43, 0.45, 0.46, 0.47, 0.47, 0.47, 0.47, 0.47,
         0.46, 0.45, 0.44, 0.41, 0.38, 0.35, 0.33, 0.32, 0.32, 0.32, 0.33, 0.34)  # fmt: skip
_BREADTH = (0.17, 0.23, 0.26, 0.28, 0.30, 0.31, 0.32, 0.32, 0.33, 0.33, 0.33, 0.36,
            0.38, 0.38, 0.37, 0.37, 0.36, 0.34, 0.30, 0.27, 0.26, 0.24, 0.24, 0.24)  # fmt: skip
_STANDARD = np.array([_FRONT, _BACK, _BREADTH])

_SAMPLES = 24_000
_SLICES = 512
_HEIGHTS = np.geomspace(0.08, 1.1, 80)
_TURNS = 24
"""Directions in the plane of symmetry that are tried as up."""

_MIRRORED = 6000
_SAME_AXIS = np.radians(3.0)
# Heads measured, natural, old, stylised and cropped, deviate by 0.01 to 0.03; a hand by 0.05, a ball by 0.07.
_WORST_MISFIT = 0.045
# A head deviates clearly more when its back is taken for its face; an egg does not.
_FACE_SHOWS = 1.15
_BOWED = 1.25
_FLAT = 0.03


@dataclass(frozen=True, eq=False)
class Stance:
    """How a head stands in its file.

    rotation: turns the file's axes to the head's (+X left, +Y up, +Z face), shape (3, 3). plane: its plane of symmetry
    in the file. height: crown to chin in the file's unit. misfit: mean deviation of its silhouette from the standard
    one, in heights of the head.
    """

    rotation: Floats
    plane: MirrorPlane
    height: float
    misfit: float

    def upright(self, points: Floats, scale: float) -> Floats:
        """Points of the file, shape (n, 3), upright, mirrored at x = 0, and scaled."""
        on_plane = self.plane.offset * self.plane.normal
        return scale * ((points - on_plane) @ self.rotation.T)

    @property
    def axes(self) -> tuple[str, str] | None:
        """The axes of the file that point up and to where the face looks, such as ("+Z", "-Y"), if they are axes."""
        names = []
        for direction in self.rotation[1:]:
            axis = int(np.abs(direction).argmax())
            if abs(direction[axis]) < 1.0 - 1e-9:
                return None
            names.append("+-"[int(direction[axis] < 0)] + "XYZ"[axis])
        return names[0], names[1]


def find_stance(mesh: TriangleMesh) -> Stance | None:
    """The stance in which ``mesh`` looks most like a head, be it a head, a bust or a whole body.

    None when it looks like a head in no stance.
    """
    points = sample_surface(mesh, _SAMPLES)
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if spread[2] < _FLAT * spread[0]:
        return None
    stances = []
    for plane in mirror_planes(points[:_MIRRORED], 2):
        plane = _along_axis(plane, points.mean(axis=0))
        stances += [_best_of(points, plane, up, side) for up in _ups(plane.normal) for side in (1.0, -1.0)]
    best = min(stances, key=lambda stance: stance.misfit)
    facing_away = [stance.misfit for stance in stances if stance.rotation[2] @ best.rotation[2] < -0.8]
    if best.misfit > _WORST_MISFIT or min(facing_away) < _FACE_SHOWS * best.misfit:
        return None
    return _levelled(points, best, stances)


def _along_axis(plane: MirrorPlane, middle: Floats) -> MirrorPlane:
    """The plane square to an axis of the file when it all but is, turned about the middle of the points."""
    axis = np.eye(3)[np.abs(plane.normal).argmax()]
    cosine = float(plane.normal @ axis)
    if abs(cosine) < np.cos(_SAME_AXIS):
        return plane
    axis = axis * np.sign(cosine)
    return MirrorPlane(axis, plane.offset + float((axis - plane.normal) @ middle), plane.error)


def _levelled(points: Floats, best: Stance, stances: list[Stance]) -> Stance:
    """A head that stands along the axes of its file, a little bowed perhaps, stays so; any other is set upright."""
    axis_up = [
        stance
        for stance in stances
        if stance.axes is not None and stance.rotation[1] @ best.rotation[1] > 0.9 and stance.plane is best.plane
    ]
    near = min(axis_up, key=lambda stance: stance.misfit, default=best)
    if near.axes is not None and near.misfit < _BOWED * best.misfit:
        return near
    side = float(np.sign(np.cross(best.plane.normal, best.rotation[1]) @ best.rotation[2]))
    for step in np.radians([5.0, 2.5]):
        turned = [np.cos(angle) * best.rotation[1] + np.sin(angle) * best.rotation[2] for angle in (-step, step)]
        best = min([best, *(_best_of(points, best.plane, up, side) for up in turned)], key=lambda s: s.misfit)
    return best


def _ups(normal: Floats) -> Floats:
    """Directions square to ``normal``, every 15 degrees, starting from the axis of the file nearest to the plane."""
    axis = np.eye(3)[np.argmin(np.abs(normal))]
    first = axis - (axis @ normal) * normal
    first /= np.linalg.norm(first)
    angles = np.arange(_TURNS) * 2.0 * np.pi / _TURNS
    ups = np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * np.cross(normal, first)
    return np.where(np.abs(ups) < 1e-12, 0.0, ups)


def _best_of(points: Floats, plane: MirrorPlane, up: Floats, side: float) -> Stance:
    """The best size of the head for one direction up and one forward."""
    forward = side * np.cross(plane.normal, up)
    outline, extent = _silhouette(points, plane, up, forward)
    misfit, height = _compare(outline, extent)
    return Stance(np.stack([np.cross(up, forward), up, forward]), plane, height, misfit)


def _silhouette(points: Floats, plane: MirrorPlane, up: Floats, forward: Floats) -> tuple[Floats, float]:
    """Reach forward, reach back and half breadth in even slices from the top down, shape (3, slices); and the extent."""
    depth = points @ forward
    level = points @ up
    extent = float(np.ptp(level))
    slice_of = np.minimum(((level.max() - level) / extent * _SLICES).astype(np.int64), _SLICES - 1)
    reach = np.stack([depth, -depth, np.abs(points @ plane.normal - plane.offset)])
    outline = np.full((3, _SLICES), -np.inf)
    for row, values in zip(outline, reach):
        np.maximum.at(row, slice_of, values)
    filled = np.nonzero(np.isfinite(outline[0]))[0]
    every = np.arange(_SLICES)
    return np.stack([np.interp(every, filled, row[filled]) for row in outline]), extent


def _compare(outline: Floats, extent: float) -> tuple[float, float]:
    """The misfit against the standard silhouette for the size that fits best, and that size."""
    heights = _HEIGHTS * extent
    levels = (np.arange(_STANDARD.shape[1]) + 0.5) / _STANDARD.shape[1]
    position = heights[:, None] * levels / extent * _SLICES - 0.5
    found = np.stack([np.interp(position, np.arange(_SLICES), row) for row in outline]) / heights[:, None]
    difference = found - _STANDARD[:, None, :]
    # Where the file has its origin does not matter: the front and the back may shift together.
    shift = 0.5 * (difference[0] - difference[1]).mean(axis=1, keepdims=True)
    difference[0] -= shift
    difference[1] += shift
    misfit = np.abs(difference).mean(axis=(0, 2))
    best = int(misfit.argmin())
    return float(misfit[best]), float(heights[best])
