"""How far hair may be off at the end of a step, whatever the forces were: too deep, too far out, or left behind."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from ..head.rows import row_dot, row_length, rows_at
from .contact import Touching
from .links import LENGTHWISE
from .model import HairModel
from .strand import led_along

LONGEST_REACH = 1.035
"""A taut strand (strand.py) gives way to this much of its length."""
LONGEST_LINK = 1.08
_LEAST_GAIN = 0.2  # of a way along the body over the straight one
_DEEPEST, _DEEPEST_CAUGHT = 0.001, 0.0045  # that hair may be below the surface [m]


def put_back(model: HairModel, positions: Floats, velocities: Floats, touch: Touching) -> tuple[Floats, Floats]:
    """Positions [m] and velocities [m/s], (n, 3) each, with what forces could not stop put back and stopped.

    touch: seen from the positions. None ends deeper than ``_DEEPEST`` below its plane, or goes on into the body (eq. 3.21),
    and then none further from its root than ``LONGEST_REACH`` times its length, or goes on outward. Next to the root, closer
    than to its neighbours, it may be off by as much as a neighbour. Hair that is caught behind an edge can have neither: so
    far as it reaches too far it may be deeper, up to ``_DEEPEST_CAUGHT``.
    """
    back, stopped = positions.copy(order="K"), velocities.copy(order="K")
    s = model.arc_length
    longest = s + (LONGEST_REACH - 1.0) * np.maximum(s, model.spacing)
    deepest = np.minimum(touch.keep, 0.0) - _DEEPEST
    deep = np.flatnonzero((touch.distance < deepest) & ~model.fixed)
    normals = rows_at(touch.normals, deep)
    out = (deepest - touch.distance)[deep]
    back[deep] += out[:, None] * normals
    too_far = row_length(rows_at(back - model.root_points, deep)) - longest[deep]
    caught = np.clip(too_far, 0.0, np.minimum(out, _DEEPEST_CAUGHT - _DEEPEST))
    back[deep] -= caught[:, None] * normals
    approach = row_dot(rows_at(velocities - touch.velocity, deep), normals)
    stopped[deep] -= np.minimum(approach, 0.0)[:, None] * normals

    from_root = back - model.root_points
    reach = row_length(from_root)
    far = np.flatnonzero((reach > longest) & ~model.fixed)
    inward = -rows_at(from_root, far) / reach[far, None]
    way = led_along(inward, far, touch)
    # A way along the body brings less than the straight one.
    back[far] += ((reach - longest)[far] / np.maximum(row_dot(way, inward), _LEAST_GAIN))[:, None] * way
    stopped[far] -= np.minimum(row_dot(rows_at(stopped, far), way), 0.0)[:, None] * way
    return back, stopped


class Tethers:
    """What keeps hair from being left far behind by the hair that it continues.

    What squeezes between head and torso can hold hair so fast that its springs would have to pull for many steps. A
    particle follows those of its rootward links that run along the hair and still hold, and its lifeline in any case.
    """

    def __init__(self, model: HairModel) -> None:
        lifeline = np.zeros(len(model.links), dtype=bool)
        lifeline[model.lifeline[model.lifeline >= 0]] = True
        chosen = np.flatnonzero(lifeline | (model.alignment >= LENGTHWISE))
        self._rootward, self._tipward = np.ascontiguousarray(model.links[chosen].T)
        self._longest = LONGEST_LINK * model.rest_length[chosen]
        self._holds_until = np.where(lifeline[chosen], np.inf, 2.0 * model.smoothing_length_links)

    def drawn_along(self, positions: Floats) -> Floats:
        """Positions [m], (n, 3), where what was left behind has followed."""
        offset = rows_at(positions, self._tipward) - rows_at(positions, self._rootward)
        square = row_dot(offset, offset)
        far = np.flatnonzero((square > self._longest**2) & (square < self._holds_until**2))
        if len(far) == 0:
            return positions
        length = np.sqrt(square[far])
        behind, count = self._tipward[far], len(positions)
        way = (self._longest[far] / length - 1.0)[:, None] * offset[far]
        share = 1.0 / np.bincount(behind, minlength=count)[behind]
        drawn = positions.copy(order="K")
        for axis in range(3):
            drawn[:, axis] += np.bincount(behind, share * way[:, axis], count)
        return drawn
