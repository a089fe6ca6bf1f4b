"""How the loose parts of a head follow its face: eyes turn, lower teeth and tongue go with the jaw, lashes with lids."""

from __future__ import annotations

from dataclasses import replace

import igl
import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from ..head.head import Head, Part
from ..head.mesh import Floats, Ints, TriangleMesh
from .jaw import Jaw, lower_share
from .lids import Lids, turned_down

# How many vertices of the skin carry a lash, and how evenly near ones share [m].
_CARRIERS = 6
_SOFT = 0.0005
# A piece with less than this part of the vertices of all lashes is a single hair.
_HAIR_SHARE = 0.2


class EyeMotion:
    """An eye that turns about its middle. What it was last is kept, so that an eye at rest stays the same object."""

    def __init__(self, eye: Part, left: Floats) -> None:
        self._eye = self._last = eye
        self._left = left
        self._angle = 0.0

    def posed(self, down: float) -> Part:
        """The eye turned down by an angle [rad]."""
        eye = self._eye
        if down != self._angle and eye.centre is not None and eye.axis is not None:
            turn = Rotation.from_rotvec(down * self._left)
            vertices = eye.centre + turn.apply(eye.mesh.vertices - eye.centre)
            self._last = replace(eye, mesh=eye.mesh.moved(vertices), axis=turn.apply(eye.axis)) if down else eye
            self._angle = down
        return self._last


class JawPartMotion:
    """Teeth and tongue: what belongs to the lower jaw turns with it."""

    def __init__(self, part: Part, jaw: Jaw, teeth_level: float) -> None:
        self._part = part
        self._jaw = jaw
        count = len(part.mesh.vertices)
        self._share = np.ones(count) if part.kind == "tongue" else lower_share(part, teeth_level)

    def posed(self, angle: float) -> Part:
        """The part with the jaw open by an angle [rad]."""
        if angle == 0.0 or not self._share.any():
            return self._part
        vertices = self._jaw.turned(self._part.mesh.vertices, self._share, angle)
        return replace(self._part, mesh=self._part.mesh.moved(vertices))


class BrowMotion:
    """Brows: every vertex keeps its place beside the vertex of the skin that it grows from."""

    def __init__(self, part: Part, head: Head) -> None:
        self._part = part
        self._rest = head.skin.vertices
        self._root = cKDTree(self._rest).query(part.mesh.vertices)[1]

    def posed(self, positions: Floats) -> Part:
        """The part on the skin at ``positions`` [m], (n, 3)."""
        change = positions[self._root] - self._rest[self._root]
        return (
            replace(self._part, mesh=self._part.mesh.moved(self._part.mesh.vertices + change))
            if change.any()
            else self._part
        )


class LashMotion:
    """Lashes: each hair turns with the margin of its lid, and is carried by what else moves the skin there.

    A lash that is no single hair but a whole strip turns point by point.
    """

    def __init__(self, part: Part, head: Head, lids: Lids) -> None:
        self._part = part
        self._lids = lids
        roots = part.mesh.vertices[_hair_roots(part.mesh, lids.centre)]
        self._fall, self._rise = lids.margin_beside(roots)
        self._rest = head.skin.vertices[lids.vertices]
        distance, near = cKDTree(self._rest).query(roots, k=_CARRIERS)
        weight = 1.0 / (distance + _SOFT) ** 2
        weight /= weight.sum(axis=1, keepdims=True)
        carriers, used = np.unique(near, return_inverse=True)
        starts = np.arange(0, near.size + 1, _CARRIERS)
        self._carriers: Ints = carriers
        self._carried = sparse.csr_array((weight.ravel(), used.ravel(), starts), shape=(len(roots), len(carriers)))

    def posed(self, positions: Floats, upper: float, lower: float) -> Part:
        """The part on the skin at ``positions`` [m], (n, 3), with the lids of its eye closed so far."""
        lids = self._lids
        carriers = self._carriers
        turns = turned_down(lids.fall[carriers], lids.rise[carriers], upper, lower)
        besides = positions[lids.vertices[carriers]] - lids.turned(self._rest[carriers], turns)
        margin = turned_down(self._fall, self._rise, upper, lower)
        vertices = lids.turned(self._part.mesh.vertices, margin) + self._carried @ besides
        return replace(self._part, mesh=self._part.mesh.moved(vertices))

    @property
    def lids(self) -> Lids:
        """The lids that the lashes grow on."""
        return self._lids


def _hair_roots(lash: TriangleMesh, eye_centre: Floats) -> Ints:
    """The vertex at the root of every vertex's hair, the one nearest to the eye; in a strip each is its own, (k,)."""
    pieces = igl.connected_components(igl.adjacency_matrix(lash.faces))[1]
    order = np.lexsort((np.linalg.norm(lash.vertices - eye_centre, axis=1), pieces))
    first = order[np.unique(pieces[order], return_index=True)[1]]
    is_hair = np.bincount(pieces) < _HAIR_SHARE * len(pieces)
    return np.where(is_hair[pieces], first[pieces], np.arange(len(pieces)))
