"""How the links turn the hair direction of a particle: Bando et al. 2006, eq. 15.

The mean of eq. 15 is taken of the direction that it is to give, and comes to rest only when it is taken again and again:
tens of times where most links lie across the hair. The small steps of the paper see to that. So that long ones come to the
same, a direction goes on to where the mean leads, by a step of Newton's method. With S the sum over the links, s its part
along t and r the rest of it, t changes by

    ((1 + e) s - B)^-1 r,     B = sum of alpha k sin theta / |u x t|^3 (u x t)(u x t)^T

over its links u. Without B and e that is eq. 15. A single link does not tell how far hair is turned about it: there B is as
large as s and r is nothing.

B lies in the plane across t, and in a plane what lies across vectors is known from the vectors: with P the sum of the same
times u u^T, seen in that plane, B = tr P - P.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ..head.mesh import Floats
from ..head.rows import row_dot, row_length
from .model import HairModel
from .springs import LinkState

_STEADINESS = 0.02  # e: what the links hardly tell is changed slowly
_FARTHEST = 0.5  # that Newton's method turns a direction [rad]
_PARALLEL = 1e-6


class DirectionUpdate:
    """Eq. 15 for all particles of one head of hair.

    Every link has two ends, and all is worked out for the ends, in the order of the particles that they belong to.
    """

    def __init__(self, model: HairModel) -> None:
        links, particle = len(model.links), model.links.ravel(order="F")
        order = np.argsort(particle, kind="stable")
        self._link = order % max(links, 1)
        self._ends = np.bincount(particle, minlength=model.count)
        # The tipward end sees the link the other way round. So does its angle: what is to be found is an even function.
        self._cosine = model.rest_cosine.ravel(order="F")[order] * np.where(order < links, 1.0, -1.0)
        self._sine = np.sqrt(np.maximum(1.0 - self._cosine**2, 0.0))
        begins = np.append(0, np.cumsum(self._ends))
        self._at_particles = sparse.csr_array((np.zeros(2 * links), self._link, begins), shape=(model.count, links))
        self._fixed = model.fixed

    def led_by(self, links: LinkState, directions: Floats) -> Floats:
        """New unit hair directions t_i*, (n, 3): where the mean over a particle's links of t_i^j, weighted with alpha_ij k_ij,
        leads.

        directions: the present ones, unit, (n, 3). A root particle keeps its own; so does one whose links cancel out.
        """
        at_ends = (t.repeat(self._ends) for t in directions.T)
        cosine = sum(t * u.take(self._link) for t, u in zip(at_ends, links.unit.T, strict=True))
        lengthwise, sideways, square = turned(cosine, self._cosine, self._sine)
        weight = links.stiffness.take(self._link)
        sideways *= weight
        own = self._sum(sideways, np.ones((len(links.unit), 1)))
        total = self._sum(weight * lengthwise, links.unit) + own * directions
        length, along = row_length(total), row_dot(total, directions)
        steady = self._fixed | (length <= 1e-12 * length.max(initial=1e-300))
        # Far from where they lead, what the links say is taken as it is.
        near = ~steady & (along > np.cos(_FARTHEST) * length)
        x, y, z = links.unit.T
        held = self._sum(sideways / square, np.stack([x * x, x * y, x * z, y * y, y * z, z * z]).T)
        change = _led_on(total, np.where(near, along, 1.0), directions, held)
        new = np.where(near[:, None], directions + change, total)
        return np.where(steady[:, None], directions, new / np.where(steady, 1.0, row_length(new))[:, None])

    def _sum(self, weight: Floats, of_links: Floats) -> Floats:
        """Sums over the links of a particle of what they have, (m, k), with a ``weight`` for each end, (2 m,): (n, k)."""
        self._at_particles.data = weight
        return np.stack([self._at_particles @ column for column in of_links.T]).T


def turned(between: Floats, cosine: Floats, sine: Floats) -> tuple[Floats, Floats, Floats]:
    """t_i^j, the direction u of the connection turned by theta toward that of the hair, t: its parts along u and t, and
    |u x t|^2, (m,).

    between: the cosine of the angle between u and t. cosine, sine: of theta, (m,) each. The turn is about the axis normal
    to both; where they are parallel there is no such axis, and the answer is +-u, on the hair's side.
    """
    square = np.maximum(1.0 - between * between, _PARALLEL**2)
    sideways = sine / np.sqrt(square)
    lengthwise = cosine - sideways * between
    parallel = np.flatnonzero(square == _PARALLEL**2)
    lengthwise[parallel], sideways[parallel] = np.sign(between[parallel]), 0.0
    return lengthwise, sideways, square


def _led_on(total: Floats, along: Floats, directions: Floats, held: Floats) -> Floats:
    """The change of unit ``directions`` that S = ``total`` asks for, (n, 3).

    along: s, above zero, (n,). held: P, not yet seen in the plane across t, as xx, xy, xz, yy, yz, zz, (n, 6). A matrix in a
    plane is inverted by its trace and determinant.
    """
    xx, xy, xz, yy, yz, zz = held.T
    x, y, z = directions.T
    trace = xx + yy + zz - (x * (xx * x + 2.0 * (xy * y + xz * z)) + y * (yy * y + 2.0 * yz * z) + z * z * zz)
    # Of its cofactors, what belongs to the plane.
    determinant = x * x * (yy * zz - yz * yz) + y * y * (xx * zz - xz * xz) + z * z * (xx * yy - xy * xy)
    determinant += 2.0 * (x * y * (xz * yz - xy * zz) + x * z * (xy * yz - xz * yy) + y * z * (xy * xz - xx * yz))
    largest = 0.5 * trace + np.sqrt(np.maximum(0.25 * trace * trace - determinant, 0.0))
    # No more than s, or the mean would lead away from where it comes to rest.
    part = np.minimum(along / np.maximum(largest, 1e-300), 1.0)
    own = (1.0 + _STEADINESS) * along
    across = total - along[:, None] * directions
    x, y, z = across.T
    seen = np.stack([xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]).T
    seen -= row_dot(seen, directions)[:, None] * directions
    change = own[:, None] * across - part[:, None] * seen
    change /= (own * (own - part * trace) + part * part * determinant)[:, None]
    return change * np.minimum(_FARTHEST / np.maximum(row_length(change), 1e-300), 1.0)[:, None]
