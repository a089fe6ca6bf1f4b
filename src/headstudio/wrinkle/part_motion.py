"""How the loose parts of a head follow its face: eyes turn, lower teeth and tongue go with the jaw, lashes with the lids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from ..head.head import Head, Part
from ..head.mesh import Floats
from .jaw import Jaw, lower_share
from .lids import Lids

# Lashes grow where a lid turns by at least this part of its margin.
_MARGIN = 0.9


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


class HairPartMotion:
    """Lashes and brows: every vertex keeps its place beside the vertex of the skin that it grows from."""

    def __init__(self, part: Part, head: Head, lids: list[Lids]) -> None:
        self._part = part
        self._rest = head.skin.vertices
        self._lids: Lids | None = None
        vertices = part.mesh.vertices
        if part.kind == "lashes" and lids:
            middle = vertices.mean(axis=0)
            self._lids = min(lids, key=lambda each: float(np.linalg.norm(each.centre - middle)))
            turn = np.abs(np.maximum(self._lids.fall, self._lids.rise))
            margin = np.nonzero(turn > _MARGIN * _nearby_most(turn, self._rest[self._lids.vertices]))[0]
            self._entry = margin[cKDTree(self._rest[self._lids.vertices[margin]]).query(vertices)[1]]
            self._root = self._lids.vertices[self._entry]
        else:
            self._root = cKDTree(self._rest).query(vertices)[1]

    def posed(self, positions: Floats, upper: float, lower: float) -> Part:
        """The part on the skin at ``positions`` [m], (n, 3), with the lids of its eye closed so far."""
        moved = positions[self._root]
        if np.array_equal(moved, self._rest[self._root]):
            return self._part
        beside = self._part.mesh.vertices - self._rest[self._root]
        if self._lids is not None:
            turn = self._lids.turns(upper, lower)[self._entry]
            beside = self._lids.turned(self._lids.centre + beside, turn) - self._lids.centre
        return replace(self._part, mesh=self._part.mesh.moved(moved + beside))

    @property
    def lids(self) -> Lids | None:
        """The lids that the part grows on, None for brows."""
        return self._lids


def _nearby_most(values: Floats, points: Floats) -> Floats:
    """The greatest value among the 30 nearest points, (k,)."""
    near = cKDTree(points).query(points, k=min(30, len(points)))[1]
    most: Floats = values[near].max(axis=1)
    return most
