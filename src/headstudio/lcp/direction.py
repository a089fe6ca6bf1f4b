"""How the links turn the hair direction of a particle: Bando et al. 2006, eq. 15.

The mean of eq. 15 is taken of the direction that it is to give, and comes to rest only when it is taken again and again:
tens of times where most links lie across the hair. The small steps of the paper see to that. So that long ones come to the
same, a direction goes on to where the mean leads, by a step of Newton's method. With S the sum over the links, s its part
along t and r the rest of it, t changes by

    ((1 + e) s - B)^-1 r,     B = sum of alpha k sin theta / |u x t|^3 (u x t)(u x t)^T

over its links u. Without B and e that is eq. 15. A single link does not tell how far hair is turned about it: there B is as
large as s and r is nothing.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from ..head.rows import row_dot, row_length, rows_at
from .model import HairModel
from .springs import LinkState, Springs

_STEADINESS = 0.02  # e: what the links hardly tell is changed slowly
_FARTHEST = 0.5  # that Newton's method turns a direction [rad]
_PARALLEL = 1e-6


def updated_directions(model: HairModel, springs: Springs, links: LinkState, directions: Floats) -> Floats:
    """New unit hair directions t_i*, (n, 3): where the mean over a particle's links of t_i^j, weighted with alpha_ij k_ij,
    leads.

    directions: the present ones, unit, (n, 3). A root particle keeps its own; so does one whose links cancel out.
    """
    at_ends = rows_at(directions, model.links.T.ravel())
    unit, cosine = np.concatenate([links.unit, -links.unit]), model.rest_cosine.ravel(order="F")
    weight = np.tile(links.stiffness, 2)
    total = springs.sum_at_ends(weight[:, None] * turned(unit, at_ends, cosine))
    length, along = row_length(total), row_dot(total, directions)
    steady = model.fixed | (length <= 1e-12 * length.max(initial=1e-300))
    # Far from where they lead, what the links say is taken as it is.
    near = ~steady & (along > np.cos(_FARTHEST) * length)
    change = _led_on(
        total, np.where(near, along, 1.0), directions, springs.sum_at_ends(_hold(weight, unit, at_ends, cosine))
    )
    new = np.where(near[:, None], directions + change, total)
    return np.where(steady[:, None], directions, new / np.where(steady, 1.0, row_length(new))[:, None])


def turned(unit: Floats, direction: Floats, cosine: Floats) -> Floats:
    """t_i^j: the connection's direction ``unit`` turned by theta toward the hair's ``direction``, (m, 3) each.

    ``cosine`` is cos theta, (m,). The turn is about the axis normal to both; where they are parallel there is no such
    axis, and the answer is +-unit, on the hair's side.
    """
    along = row_dot(unit, direction)
    across = np.sqrt(np.maximum(1.0 - along * along, 0.0))
    parallel = across < _PARALLEL
    sideways = np.where(parallel, 0.0, _sine(cosine) / np.where(parallel, 1.0, across))
    lengthwise = np.where(parallel, np.sign(along), cosine - sideways * along)
    return lengthwise[:, None] * unit + sideways[:, None] * direction


def _hold(weight: Floats, unit: Floats, direction: Floats, cosine: Floats) -> Floats:
    """What each link adds to B, the six numbers xx, xy, xz, yy, yz, zz of a symmetric matrix, (m, 6)."""
    (ux, uy, uz), (tx, ty, tz) = unit.T, direction.T
    x, y, z = uy * tz - uz * ty, uz * tx - ux * tz, ux * ty - uy * tx
    square = np.maximum(x * x + y * y + z * z, _PARALLEL**2)
    scale = weight * _sine(cosine) / (square * np.sqrt(square))
    sx, sy = scale * x, scale * y
    return np.stack([sx * x, sx * y, sx * z, sy * y, sy * z, scale * z * z]).T


def _led_on(total: Floats, along: Floats, directions: Floats, held: Floats) -> Floats:
    """The change of unit ``directions`` that S = ``total`` asks for, (n, 3). along: s, above zero, (n,). held: B, (n, 6).

    B lies in the plane across t, where a matrix is inverted by its trace and determinant.
    """
    xx, xy, xz, yy, yz, zz = held.T
    trace = xx + yy + zz
    minors = xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz
    largest = 0.5 * trace + np.sqrt(np.maximum(0.25 * trace * trace - minors, 0.0))
    # No more than s, or the mean would lead away from where it comes to rest.
    part = np.minimum(along / np.maximum(largest, 1e-300), 1.0)
    own, trace, minors = (1.0 + _STEADINESS) * along, part * trace, part * part * minors
    across = total - along[:, None] * directions
    x, y, z = across.T
    turned_on = np.stack([xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]).T
    change = (own - trace)[:, None] * across + part[:, None] * turned_on
    change /= (own * (own - trace) + minors)[:, None]
    return change * np.minimum(_FARTHEST / np.maximum(row_length(change), 1e-300), 1.0)[:, None]


def _sine(cosine: Floats) -> Floats:
    return np.sqrt(np.maximum(1.0 - cosine * cosine, 0.0))
