"""How deep a point lies below the skin: the exact measure, for reports. Hair itself feels only the contact planes."""

from __future__ import annotations

import igl
import numpy as np

from .frame import HeadFrame
from .head import Head
from .locate import Locator
from .mesh import Floats, Ints, TriangleMesh


class SkinDepth:
    """Signed distances to the skin of a bust whose head may have turned.

    The neck bends between head and torso. Points are measured against the two halves, each in its own frame; the seam
    between them is left to whichever half faces the point.
    """

    def __init__(self, head: Head) -> None:
        weight = head.head_weight[head.skin.faces].mean(axis=1)
        self._halves = [
            (_Surface(head.skin, np.flatnonzero(which)), turns)
            for which, turns in ((weight >= 0.5, True), (weight < 0.5, False))
            if which.any()
        ]

    def deepest(self, points: Floats, frame: HeadFrame) -> float:
        """Depth of the deepest point below the skin [m], 0 when none is. points: in the head frame [m], (n, 3)."""
        depth = 0.0
        for surface, turns in self._halves:
            seen = points if turns else frame.rotation.apply(points)
            depth = max(depth, float(np.max(-surface.signed_distance(seen), initial=0.0)))
        return depth


class _Surface:
    """Part of a mesh, with a tree for closest points."""

    def __init__(self, mesh: TriangleMesh, faces: Ints) -> None:
        self._mesh = TriangleMesh(mesh.vertices, mesh.faces[faces])
        self._locator = Locator(self._mesh.vertices, self._mesh.faces)
        border = igl.boundary_facets(self._mesh.faces)[0]
        self._on_border = np.zeros(len(mesh.vertices), dtype=bool)
        self._on_border[border.ravel()] = True

    def signed_distance(self, points: Floats) -> Floats:
        """Distance to the surface [m], negative below it, (n,). Past the surface's border nothing is below it."""
        mesh = self._mesh
        nearest, distance = self._locator.nearest(points)
        closest = nearest.blend(mesh.vertices, mesh.faces)
        # At an edge or a corner no single face tells the inside: the normals of the corners, weighted by angle, do.
        normals = nearest.blend(mesh.vertex_normals, mesh.faces)
        below = np.einsum("ij,ij->i", points - closest, normals) < 0
        below &= ~self._on_border[mesh.faces[nearest.faces]].any(axis=1)
        return np.where(below, -distance, distance)
