"""Laying a scan on a head: rigid, and blind to what only one of them has (grooves, hair, shoulders, a part that is missing)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from ..head.locate import Locator
from ..head.mesh import Floats, TriangleMesh


class ScanError(ValueError):
    """A scan that cannot be compared with a head. The message is one line for the user."""


# Points of the scan that are laid on the head, first for every start and then for the best of them.
_COARSE, _FINE = 1200, 6000
_ROUNDS, _SETTLED = 40, 1e-6
# Pairs whose normals differ by more than this cosine, or that are farther apart than this [m], do not pull.
_FACING, _FARTHEST = 0.5, 0.03
# Tukey's weight is zero beyond so many standard deviations, and these are never taken for less than this [m].
_TUKEY, _LEAST_SPREAD = 4.685, 2e-4
# Directions in which the surface holds the scan this much less than in the best one are left as they are: on a forehead
# alone a scan could slide.
_HELD = 1e-4
# A motion that brings the scan nearer by less than this part is not worth it.
_WORTH = 0.05
# How near a scan must lie [m], and with how much of it, to be of this head. What is near is the same skin when most of it
# is nearer than this [m] and faces as the skin does: scans that are grooved, noisy or of another age reach 0.78 and more,
# scans of other heads, turned or scaled ones 0.46 at most.
_NEAR, _SHARE = 0.012, 0.25
_FITS, _ALIKE, _SAME = 0.003, 0.85, 0.62


@dataclass(frozen=True, eq=False)
class Alignment:
    """matrix: from the scan's coordinates to the head's [m], (4, 4). distance: mean distance of the scan's points, none
    counted as more than 12 mm [m]."""

    matrix: Floats
    distance: float


def align(scan: TriangleMesh, base: TriangleMesh, starts: Sequence[Floats]) -> Alignment:
    """Where ``scan``, in its own unit, lies on ``base`` [m]; starts: matrices (4, 4) to begin from, similarities.

    Point to plane (Chen and Medioni 1992) with Tukey's weights. A start that is as good as where it leads is kept.
    Raises ScanError when the scan lies on the head from none of them.
    """
    target = Locator(base.vertices, base.faces)
    few, many = (_samples(scan, count) for count in (_COARSE, _FINE))
    tried = [_settled(few, target, base, start) for start in starts]
    if not tried:
        raise ScanError("the scan has no size that a head could have")
    # A scan taken for much smaller than it is can lie nearer than the right one, but not like skin.
    best = max(tried, key=lambda each: _likeness(few, each.matrix, target, base)[1])
    best = _settled(many, target, base, best.matrix)
    for start in starts:
        unmoved = _distance(_moved(many[0], start), target)
        if unmoved < (1.0 + _WORTH) * best.distance:
            best = Alignment(start, unmoved)
    near, same = _likeness(many, best.matrix, target, base)
    if near < _SHARE or same < _SAME * near:
        raise ScanError(
            f"the scan does not lie on this head: {near:.0%} of it come within {1e3 * _NEAR:.0f} mm, "
            f"{same:.0%} lie like its skin; give a scan of the same head, in its coordinates or near them"
        )
    return best


def _likeness(
    samples: tuple[Floats, Floats], matrix: Floats, target: Locator, base: TriangleMesh
) -> tuple[float, float]:
    """The parts of the samples that lie near the base, and that lie on it and face as it does."""
    normals = _unit(samples[1] @ matrix[:3, :3].T)
    # Loose points, which belong to no triangle, face nowhere.
    faces_somewhere = normals.any(axis=1)
    found, away = target.nearest(_moved(samples[0], matrix))
    skin = _unit(found.blend(base.vertex_normals, base.faces))
    alike = (away < _FITS) & (np.einsum("kd,kd->k", skin, normals) > _ALIKE)
    return float(((away < _NEAR) & faces_somewhere).mean()), float(alike.mean())


def plausible_units(scan: TriangleMesh) -> list[Floats]:
    """Starts for a scan in the frame of the head: one for each unit in which it is as large as a face or a part of it."""
    extent = float(np.linalg.norm(np.ptp(scan.vertices, axis=0)))
    units = (1.0, 1e-3, 1e-2, 0.1, 0.0254)
    return [np.diag([unit, unit, unit, 1.0]) for unit in units if 0.02 < unit * extent < 1.2]


def _samples(scan: TriangleMesh, count: int) -> tuple[Floats, Floats]:
    """Vertices of the scan, evenly drawn, and their normals, (k, 3) each."""
    chosen = np.unique(np.linspace(0, len(scan.vertices) - 1, count).astype(np.int64))
    if len(chosen) < len(scan.vertices):
        chosen = np.sort(np.random.default_rng(0).choice(len(scan.vertices), len(chosen), replace=False))
    return scan.vertices[chosen], scan.vertex_normals[chosen]


def _settled(samples: tuple[Floats, Floats], target: Locator, base: TriangleMesh, start: Floats) -> Alignment:
    matrix = start.copy()
    for _ in range(_ROUNDS):
        points = _moved(samples[0], matrix)
        normals = _unit(samples[1] @ matrix[:3, :3].T)
        found, away = target.nearest(points)
        planes = base.face_normals[found.faces]
        used = (away < _FARTHEST) & (np.einsum("kd,kd->k", planes, normals) > _FACING)
        if used.sum() < 20:
            break
        foot = found.blend(base.vertices, base.faces)
        height = np.einsum("kd,kd->k", planes, points - foot)[used]
        middle = points[used].mean(axis=0)
        spread = max(float(np.median(np.abs(height))) / 0.6745, _LEAST_SPREAD)
        weight = np.clip(1.0 - (height / (_TUKEY * spread)) ** 2, 0.0, None) ** 2
        columns = np.concatenate([planes[used], np.cross(points[used] - middle, planes[used]) / 0.1], axis=1)
        normal = columns.T @ (weight[:, None] * columns)
        values, vectors = np.linalg.eigh(normal)
        held = values > _HELD * values[-1]
        pull = vectors.T @ (columns.T @ (weight * -height))
        twist = vectors[:, held] @ (pull[held] / values[held])
        shift, turn = twist[:3], Rotation.from_rotvec(twist[3:] / 0.1).as_matrix()
        step = np.eye(4)
        step[:3, :3], step[:3, 3] = turn, middle + shift - turn @ middle
        matrix = step @ matrix
        if np.abs(twist).max() < _SETTLED:
            break
    return Alignment(matrix, _distance(_moved(samples[0], matrix), target))


def _unit(vectors: Floats) -> Floats:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), np.finfo(float).tiny)


def _distance(points: Floats, target: Locator) -> float:
    return float(np.minimum(target.nearest(points)[1], _NEAR).mean())


def _moved(points: Floats, matrix: Floats) -> Floats:
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def moved(mesh: TriangleMesh, matrix: Floats) -> TriangleMesh:
    """A mesh moved by a matrix, (4, 4)."""
    return mesh.moved(_moved(mesh.vertices, matrix))
