"""One joint of an outline: the closed form of Choe, Ko 2005, eq. 5, and how the segment's frame follows."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats

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
    """The unit direction q that maximises E = Phi . q + kappa q0 . q (eq. 5), (k, 3).

    E is linear in q, so q is the normalised Phi + kappa q0. force: Phi, rest: q0, (k, 3). Where the sum vanishes q stays
    q0.
    """
    return unit(force + kappa * rest, otherwise=rest)


def turn(frames: Floats, start: Floats, end: Floats) -> Floats:
    """Frames, (k, 3, 3), whose last column is ``start``, turned by the smallest rotation that takes it to ``end``, (k, 3).

    The smallest rotation does not twist (parallel transport), so details keep their place around the outline.
    """
    both = start + end
    # 1 + start . end; opposite directions have no smallest rotation.
    scale = 0.5 * np.einsum("ij,ij->i", both, both)
    opposite = scale < 1e-9
    across = frames[:, :, 0]
    along_both = np.einsum("ij,ij->i", both, across) / np.where(opposite, 1.0, scale)
    turned = across - along_both[:, None] * both + 2.0 * np.einsum("ij,ij->i", start, across)[:, None] * end
    if opposite.any():
        turned[opposite] = _half_turn(across[opposite], start[opposite])
    # Made square again: errors of rounding would double at every joint.
    first = unit(turned - np.einsum("ij,ij->i", turned, end)[:, None] * end, otherwise=turned)
    return np.stack([first, cross(end, first), end], axis=2)


def _half_turn(vectors: Floats, direction: Floats) -> Floats:
    """Vectors turned half around about an axis across ``direction``, (k, 3) each."""
    least = np.eye(3)[np.abs(direction).argmin(axis=1)]
    axis = unit(cross(direction, least), otherwise=least)
    return 2.0 * np.einsum("ij,ij->i", axis, vectors)[:, None] * axis - vectors


def bend_toward(direction: Floats, goal: Floats, angle: float) -> Floats:
    """Unit ``direction``, (k, 3), turned by ``angle`` [rad] toward the unit vectors ``goal``, (k, 3), and not beyond."""
    along = np.einsum("ij,ij->i", direction, goal)
    across = unit(goal - along[:, None] * direction, otherwise=np.zeros_like(goal))
    by = np.minimum(angle, np.arccos(np.clip(along, -1.0, 1.0)))[:, None]
    return unit(np.cos(by) * direction + np.sin(by) * across, otherwise=direction)


def cross(one: Floats, other: Floats) -> Floats:
    """The vector product of vectors, (k, 3) each; for some hundreds of them numpy's own mostly looks for their axis."""
    result = np.empty(one.shape)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        result[:, k] = one[:, i] * other[:, j] - one[:, j] * other[:, i]
    return result


def unit(vectors: Floats, otherwise: Floats) -> Floats:
    """``vectors``, (k, 3), of length 1; where one vanishes, ``otherwise``."""
    length = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))[:, None]
    if length.min(initial=1.0) > 1e-9:
        return vectors / length
    gone = length[:, 0] <= 1e-9
    return np.where(gone[:, None], otherwise, vectors / np.maximum(length, 1e-9))
