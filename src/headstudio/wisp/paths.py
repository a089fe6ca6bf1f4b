"""Paths through the air and along the body that locks of hair are led on."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ..head.mesh import Floats
from ..head.rows import row_unit
from ..head.scalp_curves import catmull_rom
from .force import ForceField
from .surroundings import Surroundings

_APPROACHES = 5
STEP = 0.005  # between the points of a path [m]
# A plait beside the body comes to lie on it: how strongly it is drawn there against its weight, and from how far [m].
_TO_BODY, _BESIDE = 0.5, 0.08
_TURN = 0.35  # how fast a rope gives way to what pulls it, in a step


def off_skin(surroundings: Surroundings, points: Floats, clearance: float) -> Floats:
    """Points [m], (k, 3), moved out to ``clearance`` [m] off the skin where they are nearer."""
    return surroundings.keep_outside(points.astype(np.float32), clearance).astype(np.float64)


def at_height(surroundings: Surroundings, points: Floats, height: float) -> Floats:
    """Points [m], (k, 3), moved straight to or from the skin until they are ``height`` [m] off it."""
    for _ in range(_APPROACHES):
        distance, away = surroundings.distance_and_gradient(points)
        points = points + (height - distance)[:, None] * away
    return off_skin(surroundings, points, height)


def outward(surroundings: Surroundings, points: Floats) -> Floats:
    """Unit directions away from the skin, (k, 3), at points [m], (k, 3)."""
    return surroundings.gradient(points).astype(np.float64)


def hang(
    surroundings: Surroundings, force: ForceField, start: Floats, first: Floats, length: float, clearance: float
) -> Floats:
    """The path of a rope of ``length`` [m] that leaves ``start`` [m] in direction ``first``, (3,) each, falls in a bow as
    ``force`` leads it and lies on the body no nearer than ``clearance`` [m]: (n, 3).
    """
    down = np.array([0.0, -1.0, 0.0])
    points = [np.asarray(start, dtype=np.float64)]
    direction = np.asarray(first, dtype=np.float64)
    for _ in range(max(round(length / STEP), 1)):
        distance, away = surroundings.distance_and_gradient_anywhere(points[-1][None])
        beside = 1.0 - min(max(float(distance[0]) - clearance, 0.0) / _BESIDE, 1.0)
        pull = force.at(points[-1][None])[0] - _TO_BODY * beside * away[0]
        direction = row_unit((direction + _TURN * pull)[None], otherwise=down[None])[0]
        free = points[-1] + STEP * direction
        for _ in range(_APPROACHES):
            distance, away = surroundings.distance_and_gradient_anywhere(free[None])
            free = free + max(clearance - float(distance[0]), 0.0) * away[0]
        direction = row_unit((free - points[-1])[None], otherwise=down[None])[0]
        points.append(points[-1] + STEP * direction)
    return _smooth(np.array(points))


def along_skin(surroundings: Surroundings, proportions: Floats, clearance: float) -> Floats:
    """The Catmull-Rom curve through places in proportions of the head, (k, 3), kept ``clearance`` [m] off the skin: (n, 3)."""
    curve = catmull_rom(surroundings.proportions.place(np.asarray(proportions, dtype=np.float64)))
    fine = curve(np.linspace(0.0, 1.0, 50 * len(proportions)))
    return off_skin(surroundings, _evenly(_smooth(off_skin(surroundings, _evenly(fine), clearance))), clearance)


def sideways(surroundings: Surroundings, path: Floats) -> tuple[Floats, Floats]:
    """Two unit directions across a path, (n, 3) [m]: along the skin and away from it, (n, 3) each, turning slowly."""
    tangent = row_unit(np.gradient(path, axis=0), otherwise=np.broadcast_to([0.0, -1.0, 0.0], path.shape))
    away = gaussian_filter1d(outward(surroundings, path), 0.03 / STEP, axis=0, mode="nearest")
    away = away - np.einsum("ij,ij->i", away, tangent)[:, None] * tangent
    away = row_unit(away, otherwise=np.cross(tangent, [1.0, 0.0, 0.0]))
    return np.cross(tangent, away), away


def _smooth(points: Floats) -> Floats:
    """A path without kinks; its ends stay."""
    smooth = gaussian_filter1d(points, 2.0, axis=0, mode="nearest")
    blend = np.minimum(np.minimum(np.arange(len(points)), np.arange(len(points))[::-1]) / 5.0, 1.0)[:, None]
    return blend * smooth + (1 - blend) * points


def _evenly(points: Floats) -> Floats:
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(steps)])
    even = np.linspace(0.0, length[-1], max(int(np.ceil(length[-1] / STEP)), 1) + 1)
    return np.stack([np.interp(even, length, points[:, k]) for k in range(3)], axis=1)
