"""Eyes: balls with a pupil."""

from __future__ import annotations

import numpy as np
import trimesh

from .head import Part
from .mesh import Floats, TriangleMesh


def eyeball(centre: Floats, axis: Floats, radius: float) -> Part:
    """An eye as an even sphere. centre [m] and unit axis out of the pupil, shape (3,); radius [m]."""
    ball = trimesh.creation.icosphere(subdivisions=3, radius=radius)
    return Part("eye", TriangleMesh(ball.vertices + centre, ball.faces), centre, axis, radius)


def pupil(eye: Part) -> Floats:
    """Where the axis of an eye leaves its ball [m], shape (3,). Raises ValueError for a part that is no eye."""
    if eye.centre is None or eye.axis is None:
        raise ValueError(f"a part of kind {eye.kind!r} has no pupil")
    return eye.centre + eye.radius * eye.axis


def fit_sphere(points: Floats) -> tuple[Floats, float]:
    """The sphere nearest to ``points``, shape (n, 3), by linear least squares: centre, shape (3,), and radius."""
    middle = points.mean(axis=0)
    local = points - middle
    system = np.column_stack([2.0 * local, np.ones(len(local))])
    solution = np.linalg.lstsq(system, (local**2).sum(axis=1), rcond=None)[0]
    centre = solution[:3]
    return centre + middle, float(np.sqrt(max(solution[3] + centre @ centre, 0.0)))
