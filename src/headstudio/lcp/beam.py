"""The cantilever beam that gives hair its initial shape (Anjyo, Usami, Kurihara 1992).

A hair is a beam clamped at its root and bent by its own weight w per length, with the flexural rigidity B. It bends in
the plane of its root direction and gravity, so its shape is one angle along its length: theta above the horizontal,

    B theta''(s) = (w (L - s) + P) cos theta(s),   theta(0) given,   theta'(L) = 0,

P being a load at the tip. With the bending length l = (B / w)^(1/3) only L / l is left. Anjyo's method finds the shape
from the bending moments joint by joint; here the same balance of moments is solved for all beams at once by Newton steps
on the tridiagonal system of the joints, so that even hair much longer than its bending length settles exactly.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats

_NEWTON_STEPS = 60
_LARGEST_TURN = 0.5


def beam_angles(
    root_angle: Floats, length: Floats, bending_length: float, joints: int = 48, tip_load: float = 0.0
) -> Floats:
    """Angles of many beams above the horizontal at the middle of their pieces [rad], shape (k, joints).

    root_angle: angle at the clamped root [rad], (k,). length: L [m], (k,). bending_length: (B / w)^(1/3) [m].
    tip_load: P as a multiple of w times the bending length.
    """
    ratio = (np.asarray(length) / bending_length)[:, None]
    piece = ratio / joints  # length of a piece in bending lengths
    # Weight beyond the joint at the end of piece j (in w * l), which bends it; the piece's own half counts.
    middle = (np.arange(joints) + 0.5) / joints
    load = (ratio * (1.0 - middle) + tip_load) * piece**2
    angle = np.repeat(np.asarray(root_angle, dtype=np.float64)[:, None], joints, axis=1)
    root = np.asarray(root_angle, dtype=np.float64)[:, None]
    for _ in range(_NEWTON_STEPS):
        # The clamp acts half a piece before the first middle, hence the factor 2; nothing acts behind the last.
        before = np.concatenate([2.0 * (angle[:, :1] - root), angle[:, 1:] - angle[:, :-1]], axis=1)
        after = np.concatenate([angle[:, 1:] - angle[:, :-1], np.zeros_like(root)], axis=1)
        residual = after - before - load * np.cos(angle)
        diagonal = np.full_like(angle, -2.0)
        diagonal[:, 0] = -3.0
        diagonal[:, -1] += 1.0
        # Past the horizontal the load would make the matrix indefinite; leaving that part out keeps every step downhill.
        diagonal += np.minimum(load * np.sin(angle), 0.0)
        change = np.clip(_solve_unit_tridiagonal(diagonal, -residual), -_LARGEST_TURN, _LARGEST_TURN)
        angle = angle + change
        if np.max(np.abs(change), initial=0.0) < 1e-12:
            break
    return angle


def _solve_unit_tridiagonal(diagonal: Floats, right: Floats) -> Floats:
    """Solve rows of systems with ``diagonal`` and ones beside it: Thomas' algorithm along axis 1, for all rows at once."""
    count = diagonal.shape[1]
    upper = np.empty_like(diagonal)
    value = np.empty_like(right)
    upper[:, 0] = 1.0 / diagonal[:, 0]
    value[:, 0] = right[:, 0] / diagonal[:, 0]
    for k in range(1, count):
        pivot = diagonal[:, k] - upper[:, k - 1]
        upper[:, k] = 1.0 / pivot
        value[:, k] = (right[:, k] - value[:, k - 1]) / pivot
    for k in range(count - 2, -1, -1):
        value[:, k] -= upper[:, k] * value[:, k + 1]
    return value


def beam_directions(root_directions: Floats, length: Floats, bending_length: float, joints: int = 48) -> Floats:
    """Unit directions of the pieces of many beams under gravity (along -y), shape (k, joints, 3).

    root_directions: unit vectors, (k, 3). length: [m], (k,).
    """
    up = np.clip(root_directions[:, 1], -1.0, 1.0)
    outward = root_directions * (1.0, 0.0, 1.0)
    reach = np.linalg.norm(outward, axis=1, keepdims=True)
    outward = np.divide(outward, reach, out=np.zeros_like(outward), where=reach > 1e-9)
    angle = beam_angles(np.arcsin(up), length, bending_length, joints)
    directions = np.cos(angle)[:, :, None] * outward[:, None, :]
    directions[:, :, 1] = np.sin(angle)
    return directions / np.linalg.norm(directions, axis=2, keepdims=True)
