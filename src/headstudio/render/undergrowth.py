"""Short hair close to the scalp, between the particles.

Particles are a centimetre and more apart, and where hair parts from a whorl few of them lie over the scalp. Real hair
is as dense at the root as anywhere. The undergrowth fills in: short curves on the skin that run the way the hair around
them does. They move with the head, as roots do, and take their light from the particle that is rooted nearest.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..head.frame import HeadFrame
from ..head.head import Head
from ..head.mesh import Floats, Ints
from ..lcp.model import HairModel
from .skin_paint import clustered, scalp_cover
from .strands import SECTIONS, HairCurves, unit

_GAP = 0.009
_LENGTH = 0.032
_HEIGHT = 0.003
# Particles with less hair behind them than this [m] tell how hair lies on the scalp.
_NEAR_SCALP = 0.02
_ROOTS_ASKED = 6


class Undergrowth:
    """Curves on the scalp of a head, c of them, in the head frame; made once per head and model.

    source: the particle that each curve takes its light from, (c,).
    """

    def __init__(self, head: Head, hair: HairModel) -> None:
        low = np.flatnonzero(hair.arc_length < _NEAR_SCALP)
        places, _ = clustered(head.skin.vertices, _GAP)
        places = places[scalp_cover(head, hair)[places] > 0.9]
        if len(low) == 0 or len(places) == 0:
            low = places = np.zeros(0, np.int64)
        self._path = self._grow(head, hair, low, places)
        self._tangent = unit(np.asarray(np.gradient(self._path, axis=1)))
        self._sideways = unit(np.cross(self._tangent[:, SECTIONS // 2], head.skin.vertex_normals[places]))
        self.source: Ints = low[cKDTree(hair.root_points[low]).query(self._path[:, 0])[1]] if len(low) else low

    @staticmethod
    def _grow(head: Head, hair: HairModel, low: Ints, places: Ints) -> Floats:
        """Follow the way that hair lies, a little above the skin: paths [m], (c, SECTIONS, 3)."""
        path = np.empty((len(places), SECTIONS, 3))
        if len(places) == 0:
            return path
        roots = cKDTree(hair.root_points[low])
        skin = cKDTree(head.skin.vertices)
        here = head.skin.vertices[places]
        for section in range(SECTIONS):
            _, nearest = skin.query(here)
            normal = head.skin.vertex_normals[nearest]
            above = np.einsum("ni,ni->n", here - head.skin.vertices[nearest], normal)
            height = _HEIGHT * min(section / 2, 1.0)
            here = here + (height - above)[:, None] * normal
            path[:, section] = here
            here = here + _LENGTH / (SECTIONS - 1) * _lie(roots, hair.rest_directions[low], here, normal)
        return path

    def __len__(self) -> int:
        return len(self.source)

    def curves(self, frame: HeadFrame) -> HairCurves:
        """The curves in the world."""
        turn = frame.rotation.as_matrix().T
        path, tangent = self._path @ turn + frame.translation, self._tangent @ turn
        middle = SECTIONS // 2
        along = np.broadcast_to(np.linspace(-0.7, 1.0, SECTIONS), path.shape[:2])
        grown = np.broadcast_to(np.minimum(np.arange(SECTIONS), 1.0), path.shape[:2])
        return HairCurves(path[:, middle], tangent[:, middle], self._sideways @ turn, path, tangent, along, grown)


def _lie(roots: cKDTree, directions: Floats, points: Floats, normals: Floats) -> Floats:
    """The way hair lies at points on the scalp [m], unit vectors along the skin, (n, 3)."""
    distance, near = roots.query(points, k=range(1, min(_ROOTS_ASKED, roots.n) + 1))
    way = np.einsum("nk,nki->ni", 1.0 / (distance + 0.004) ** 2, directions[near])
    return unit(way - np.einsum("ni,ni->n", way, normals)[:, None] * normals)
