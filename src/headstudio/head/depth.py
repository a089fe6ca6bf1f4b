"""How deep a point lies below the skin: the exact measure, for reports. Hair itself feels only the contact planes."""

from __future__ import annotations

import igl
import numpy as np
from numpy.typing import NDArray

from .frame import HeadFrame
from .hair_tight import standing_on_floor
from .head import Head
from .locate import Locator
from .mesh import Floats, Ints, TriangleMesh
from .neck import turned_by
from .rows import row_dot


class SkinDepth:
    """Signed distances to the skin of a bust whose head may have turned, as it is drawn.

    Head and torso are rigid and are looked up in their own frames. The skin between them bends, and is built anew.
    """

    def __init__(self, head: Head) -> None:
        skin, weight = head.skin, head.head_weight
        solid, self._bends = standing_on_floor(head), head.neck
        self._body = igl.FastWindingNumberBVH()
        self._body.init(solid.vertices, solid.faces)
        on_border = np.zeros(len(skin.vertices), dtype=bool)
        on_border[igl.boundary_facets(skin.faces)[0].ravel()] = True
        turns, stays = weight[skin.faces].min(axis=1) == 1.0, weight[skin.faces].max(axis=1) == 0.0
        self._head, self._torso = (_Piece(skin, skin.faces[which], on_border) for which in (turns, stays))
        # With the faces around them, so that every corner of a face that bends has its normal.
        bends = np.zeros(len(skin.vertices), dtype=bool)
        bends[skin.faces[~turns & ~stays]] = True
        used, faces = np.unique(skin.faces[bends[skin.faces].any(axis=1)], return_inverse=True)
        self._neck = TriangleMesh(skin.vertices[used], faces.reshape(-1, 3))
        self._neck_weight, self._neck_on_border = weight[used], on_border[used]

    def deepest(self, points: Floats, frame: HeadFrame) -> float:
        """Depth of the deepest point below the skin [m], 0 when none is. points: in the head frame [m], (n, 3)."""
        return float(np.max(-self.signed_distance(points, frame), initial=0.0))

    def signed_distance(self, points: Floats, frame: HeadFrame) -> Floats:
        """Distance to the skin [m], negative below it, (n,). points: in the head frame [m], (n, 3).

        Past the skin's border nothing is below it. The skin of a scan may be folded over itself, and look inward where it does:
        what is below it has to be inside the body as well.
        """
        seen, turn = frame.rotation.apply(points), frame.rotation.as_rotvec()
        bent = self._neck.moved(turned_by(self._neck.vertices, turn, self._neck_weight))
        neck = _Piece(bent, bent.faces, self._neck_on_border)
        pieces = ((self._head, points), (self._torso, seen), (neck, seen))
        signed = np.stack([piece.signed_distance(places) for piece, places in pieces])
        nearest = np.abs(signed).argmin(axis=0)
        signed = np.take_along_axis(signed, nearest[None], axis=0)[0]
        below = np.flatnonzero(signed < 0.0)
        signed[below[~self._encloses(seen[below], turn)]] *= -1.0
        return signed

    def _encloses(self, seen: Floats, turn: Floats) -> NDArray[np.bool_]:
        """Whether the body winds around points in the axes of the torso [m], (n, 3), led back to where they are at rest."""
        shares = self._bends.shares_when_bent(seen, turn)
        rest = np.concatenate([turned_by(seen, turn, -share) for share in shares])
        return (self._body.winding_number(rest).reshape(2, -1) > 0.5).any(axis=0)


class _Piece:
    """Some faces of a skin, with a tree for closest points."""

    def __init__(self, mesh: TriangleMesh, faces: Ints, on_border: NDArray[np.bool_]) -> None:
        self._mesh, self._faces, self._on_border = mesh, faces, on_border
        self._locator = Locator(mesh.vertices, faces) if len(faces) else None

    def signed_distance(self, points: Floats) -> Floats:
        if self._locator is None:
            return np.full(len(points), np.inf)
        nearest, distance = self._locator.nearest(points)
        closest = nearest.blend(self._mesh.vertices, self._faces)
        # At an edge or a corner no single face tells the inside: the normals of the corners, weighted by angle, do.
        normals = nearest.blend(self._mesh.vertex_normals, self._faces)
        below = row_dot(points - closest, normals) < 0
        below &= ~self._on_border[self._faces[nearest.faces]].any(axis=1)
        return np.where(below, -distance, distance)
