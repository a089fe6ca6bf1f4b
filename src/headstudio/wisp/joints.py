"""One joint of an outline: the closed form of Choe, Ko 2005, eq. 5, and how the segment's frame follows. Vectors are
columns, (3, k)."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from .columns import cross, dot, unit

# The length of a segment for which kappa means what the paper says [m]; see ``joint_stiffness``.
REFERENCE_SEGMENT = 0.02


def joint_stiffness(kappa: float, segment: float) -> float:
    """kappa for joints ``segment`` [m] apart, so that hair bends alike however finely it is cut.

    A joint leaves about kappa / (1 + kappa) of the angle between hair and force. Over the same length finer segments have
    more joints; each must leave more, so that all together leave as much.
    """
    if kappa <= 0:
        return 0.0
    left = (kappa / (1 + kappa)) ** (segment / REFERENCE_SEGMENT)
    return float(left / (1 - left))


def most_aligned(force: Floats, rest: Floats, kappa: float | Floats) -> Floats:
    """The unit direction q that maximises E = Phi . q + kappa q0 . q (eq. 5), (3, k).

    E is linear in q, so q is the normalised Phi + kappa q0. force: Phi, rest: q0, (3, k). Where the sum vanishes q stays
    q0.
    """
    return unit(force + kappa * rest, otherwise=rest)


def turn(across: Floats, start: Floats, end: Floats) -> Floats:
    """Unit vectors ``across`` directions ``start``, turned by the smallest rotation that takes those to ``end``, (3, k) each.

    The smallest rotation does not twist (parallel transport), so details keep their place around the outline.
    """
    both = start + end
    # 1 + start . end; opposite directions have no smallest rotation.
    scale = 0.5 * dot(both, both)
    opposite = scale < 1e-9
    turned = across - dot(both, across) / np.where(opposite, 1.0, scale) * both + 2.0 * dot(start, across) * end
    if opposite.any():
        turned[:, opposite] = _half_turn(across[:, opposite], start[:, opposite])
    # Made square again: errors of rounding would double at every joint.
    return unit(turned - dot(turned, end) * end, otherwise=turned)


def _half_turn(vectors: Floats, direction: Floats) -> Floats:
    """Vectors turned half around about an axis across ``direction``, (3, k) each."""
    least = np.eye(3)[:, np.abs(direction).argmin(axis=0)]
    axis = unit(cross(direction, least), otherwise=least)
    return 2.0 * dot(axis, vectors) * axis - vectors


def bend_toward(direction: Floats, goal: Floats, angle: float | Floats) -> Floats:
    """Unit ``direction``, (3, k), turned by ``angle`` [rad], of all or of each, (k,), toward the unit vectors ``goal``, (3, k),
    and not beyond.
    """
    along = dot(direction, goal)
    across = unit(goal - along * direction, otherwise=np.zeros_like(goal))
    by = np.minimum(angle, np.arccos(np.maximum(np.minimum(along, 1.0), -1.0)))
    return unit(np.cos(by) * direction + np.sin(by) * across, otherwise=direction)
