"""How the links turn the hair direction of a particle: Bando et al. 2006, eq. 15."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from ..head.rows import row_dot, row_length, rows_at
from .model import HairModel
from .springs import LinkState, Springs


def updated_directions(model: HairModel, springs: Springs, links: LinkState, directions: Floats) -> Floats:
    """New unit hair directions t_i*, (n, 3): the mean over a particle's links of t_i^j, weighted with alpha_ij k_ij.

    directions: the present ones, unit, (n, 3). A root particle keeps its own; so does one whose links cancel out.
    """
    at_ends = rows_at(directions, model.links.T.ravel())
    seen = turned(np.concatenate([links.unit, -links.unit]), at_ends, model.rest_cosine.ravel(order="F"))
    total = springs.sum_at_ends(np.tile(links.stiffness, 2)[:, None] * seen)
    length = row_length(total)
    steady = model.fixed | (length <= 1e-12 * length.max(initial=1e-300))
    return np.where(steady[:, None], directions, total / np.where(steady, 1.0, length)[:, None])


def turned(unit: Floats, direction: Floats, cosine: Floats) -> Floats:
    """t_i^j: the connection's direction ``unit`` turned by theta toward the hair's ``direction``, (m, 3) each.

    ``cosine`` is cos theta, (m,). The turn is about the axis normal to both; where they are parallel there is no such
    axis, and the answer is +-unit, on the hair's side.
    """
    along = row_dot(unit, direction)
    across = np.sqrt(np.maximum(1.0 - along * along, 0.0))
    parallel = across < 1e-6
    sine = np.sqrt(np.maximum(1.0 - cosine * cosine, 0.0))
    sideways = np.where(parallel, 0.0, sine / np.where(parallel, 1.0, across))
    lengthwise = np.where(parallel, np.sign(along), cosine - sideways * along)
    return lengthwise[:, None] * unit + sideways[:, None] * direction
