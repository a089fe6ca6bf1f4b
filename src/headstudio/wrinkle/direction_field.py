"""The field that fine furrows follow: Bando's thesis, section 2.6.1.

A few direction vectors in texture space are given; the others minimise the energy of springs along the edges of the
mesh, with the constants of a harmonic map (Eck et al. 1995), while the given ones stay as they are.
"""

from __future__ import annotations

from typing import NamedTuple

import igl
import numpy as np
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import splu

from ..head.mesh import Floats, Ints
from .texels import TexelMap
from .texture_map import TextureMap

# Pull of every vertex towards the mean of the given values, in parts of its own springs. It decides only where nothing
# else does: on pieces of the mesh that hold no given vertex.
_PULL = 1e-9


def interpolate(texture_map: TextureMap, vertices: Ints, values: Floats) -> Floats:
    """Values at all vertices, (n, d), that are ``values``, (k, d), at ``vertices``, (k,), and smooth elsewhere.

    The system is factorised once for all d columns. A vertex that is named twice takes the mean of its values.
    """
    given, place = np.unique(vertices, return_inverse=True)
    fixed = np.zeros((len(given), values.shape[1]))
    np.add.at(fixed, place, values)
    fixed /= np.bincount(place)[:, None]

    mesh = texture_map.mesh
    count = len(mesh.vertices)
    result = np.empty((count, values.shape[1]))
    result[given] = fixed
    free = np.setdiff1d(np.arange(count), given)
    if len(free) == 0:
        return result
    stiffness = csc_array(-igl.cotmatrix(mesh.vertices, mesh.faces))
    own = np.abs(stiffness.diagonal())[free]
    pull = _PULL * np.where(own > 0, own, 1.0)
    system = stiffness[free][:, free] + diags_array(pull)
    load = pull[:, None] * fixed.mean(axis=0) - stiffness[free][:, given] @ fixed
    result[free] = splu(csc_array(system)).solve(load)
    return result


class FieldSample(NamedTuple):
    """The field at k points. On a triangle of -1, off the mesh, the rest means nothing.

    directions: unit, (k, 2). magnitudes: m, 0 to 1, (k,). units: see DirectionField, (k,). triangles: (k,).
    """

    directions: Floats
    magnitudes: Floats
    units: Floats
    triangles: Ints


class DirectionField:
    """Direction vectors given at the vertices of a texture map, asked at any of its points."""

    def __init__(self, texels: TexelMap, vectors: Floats, units: float | Floats = 1.0) -> None:
        """vectors: per vertex of the map, in texture space, (n, 2); their length is the magnitude m.

        units: how many texels the unit of the laws is at every vertex, (n,), or everywhere. See ``units_on_skin``.
        """
        self.texels = texels
        self.vectors = vectors
        self.units = np.broadcast_to(np.asarray(units, dtype=np.float64), len(vectors))

    def at(self, points: Floats) -> FieldSample:
        """The field at ``points`` [texels], (k, 2), interpolated between the corners of the triangle of each.

        This is step 1 of section 2.6.2. Where the field vanishes every direction is as good: it is u.
        """
        triangle = self.texels.triangle_at(points)
        weights = self.texels.weights(triangle, points)
        corners = self.texels.map.mesh.faces[triangle]
        vector = (weights[:, :, None] * self.vectors[corners]).sum(axis=1)
        length = np.hypot(vector[:, 0], vector[:, 1])
        vector[length == 0] = 1.0, 0.0
        direction = vector / np.where(length == 0, 1.0, length)[:, None]
        return FieldSample(direction, np.minimum(length, 1.0), (weights * self.units[corners]).sum(axis=1), triangle)

    @property
    def directions(self) -> Floats:
        """Unit directions at the vertices, (n, 2); u where the field vanishes."""
        length = np.linalg.norm(self.vectors, axis=1, keepdims=True)
        return np.where(length == 0, [1.0, 0.0], self.vectors / np.where(length == 0, 1.0, length))

    @property
    def strongest(self) -> float:
        """The largest magnitude at any vertex, at most 1."""
        return float(min(np.hypot(self.vectors[:, 0], self.vectors[:, 1]).max(initial=0.0), 1.0))
