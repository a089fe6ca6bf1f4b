"""Bulges stop where the skin comes to face itself: in folds, between furrows side by side, of a finger against the palm.

A ball that touches the skin from outside at a point, and rests on another part of it, has its middle half way between
both. No bulge may rise beyond that middle, whichever furrows it belongs to: then neither part can reach through the
other. Against a part of the skin that is flat around q with normal m, the ball at p with normal n has the radius

    r = (p - q) . m / (1 - n . m),

half the gap between two walls, and the way to the plane between them in a fold of any angle.

Skin that faces itself is rare. So creases of the coarse skin that are sharper than a bulge is high are looked for first,
and patches that come face to face; points are compared in those alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.repair import edge_neighbours
from ..head.rows import row_dot
from .furrow_bed import FurrowBed
from .smooth_surface import PosedSurface, SmoothSurface, cross, unit

# Edge of a patch, and how far patches may move before those that face each other are looked for again [m].
_PATCH = 0.006
_SLACK = 0.007
# Bulges lower than this meet nothing [m]; those that are half as high may soon be higher. Those that meet stop so far from
# the middle [m], and so many times the height of the smooth skin over its triangles, which is how well places are known.
_LOW, _SOON = 5e-5, 2.5e-5
_CLEAR, _UNSURE = 5e-6, 4.0
# Skin that bends by less than 25 degrees does not face itself, as a cosine: bulges are too low for wider folds. Patches
# do from 60 degrees on; what bends less lies around a crease.
_FACING, _OPPOSED = 0.9, 0.5
# Normals of a point and of its triangle differ: triangles count as facing each other up to this.
_TURNED = 0.97
# A crease counts where it turns within so many heights of a bulge.
_SHARP = 2.0


class Folds:
    """Points on the bulges of furrows, and the parts of the skin that they may meet."""

    def __init__(self, bed: FurrowBed, surface: SmoothSurface, unit_height: Floats) -> None:
        """surface: with a row for every entry of the bed. unit_height: of the entries at full amplitude [m], (i,)."""
        skin = bed.layout.skin
        self._faces = skin.faces
        raised = np.unique(surface.row_of[bed.vertex[unit_height > 0]])
        face = bed.refined.home[surface.vertices[raised]]
        # Rows of bulges, those of one triangle after the other.
        order = np.argsort(face, kind="stable")
        self._rows: Ints = raised[order]
        self._bulging, self._starts, self._count = np.unique(face[order], return_index=True, return_counts=True)
        self._creases = _Creases(skin, self._bulging)
        self._patches = _Patches(skin)

    def clamped(self, height: Floats, posed: Floats, surface: PosedSurface) -> Floats:
        """Heights [m], (k,), of the surface's vertices, none beyond the middle of a ball between it and other skin.

        posed: the coarse skin [m], (n, 3).
        """
        if not len(self._rows):
            return height
        tops = np.zeros(len(self._faces))
        tops[self._bulging] = np.maximum.reduceat(height[self._rows], self._starts)
        if tops.max() <= _LOW:
            return height
        close = self._patches.facing(tops, posed, surface.coarse_normals) | self._creases.sharp(tops, posed)
        raised = np.flatnonzero(close[self._bulging] & (tops[self._bulging] > _LOW))
        if not len(raised):
            return height
        skin = _Facets.of(self._faces[close], posed, surface.coarse_normals)
        bulges = _Facets.of(self._faces[self._bulging[raised]], posed, surface.coarse_normals)
        bulge, other = bulges.facing(skin, tops[self._bulging[raised]])
        # Every point of a bulge against every triangle that its own one faces.
        count = self._count[raised[bulge]]
        first = self._starts[raised[bulge]] - np.concatenate([[0], np.cumsum(count)[:-1]])
        rows = self._rows[np.repeat(first, count) + np.arange(count.sum())]
        other = np.repeat(other, count)
        up = height[rows] > _LOW
        rows, other = rows[up], other[up]
        radius = skin.radii(other, surface.positions[rows], surface.normals[rows])
        clamped = height.copy()
        np.minimum.at(clamped, rows, np.maximum(radius - skin.clear[other], 0.0))
        return clamped


@dataclass(frozen=True, eq=False)
class _Facets:
    """Triangles of the coarse skin: middles on the smooth skin [m] and unit normals, (k, 3), how far their corners are
    from there and how far from it bulges stop [m], (k,)."""

    middle: Floats
    normal: Floats
    size: Floats
    clear: Floats

    @classmethod
    def of(cls, faces: Ints, posed: Floats, normals: Floats) -> _Facets:
        """faces: (k, 3). posed, normals: of the skin's vertices, (n, 3)."""
        corners = posed[faces]
        middle = corners.mean(axis=1)
        size = np.sqrt(((corners - middle[:, None]) ** 2).sum(axis=2).max(axis=1))
        normal = unit(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        # The smooth skin lies above or below its triangles by as much as their corners' normals tell.
        bend = -0.5 * np.einsum("fki,fki->f", middle[:, None] - corners, normals[faces]) / 3.0
        return cls(middle + bend[:, None] * normal, normal, size, _CLEAR + _UNSURE * np.abs(bend))

    def facing(self, others: _Facets, tops: Floats) -> tuple[Ints, Ints]:
        """Pairs of one of these and one of the others that its bulge, as high as ``tops`` [m], (k,), may meet."""
        # A ball on a point of one that rests on a point of the other is at least half as wide as these are apart.
        reach = 2.0 * tops + self.size
        found = cKDTree(self.middle).sparse_distance_matrix(
            cKDTree(others.middle), float(reach.max() + others.size.max()), output_type="ndarray"
        )
        mine, other = found["i"], found["j"]
        near = found["v"] < reach[mine] + others.size[other]
        mine, other = mine[near], other[near]
        n, m = self.normal[mine], others.normal[other]
        gap = row_dot(self.middle[mine] - others.middle[other], m)
        fits = (row_dot(n, m) < _TURNED) & (gap > -self.size[mine])
        return mine[fits], other[fits]

    def radii(self, which: Ints, p: Floats, n: Floats) -> Floats:
        """Radius of the ball at p with normal n that rests on the skin near some of these [m], (k,); inf where none does.

        It rests on the plane of the triangle where it touches that within its size; and it never holds its middle.
        """
        away, m = p - self.middle[which], self.normal[which]
        toward = -row_dot(away, n)
        turn = 1.0 - row_dot(n, m)
        gap = row_dot(away, m)
        plane = gap / np.maximum(turn, 1e-9)
        touch = away + plane[:, None] * (n - m)
        near = row_dot(touch, touch) < self.size[which] ** 2
        point = row_dot(away, away) / np.maximum(2.0 * toward, 1e-12)
        radius = np.minimum(np.where(near, plane, np.inf), np.where(toward > 0, point, np.inf))
        return np.where((turn > 1.0 - _FACING) & (gap > 0), radius, np.inf)


class _Creases:
    """Edges at bulges, and the triangles around them."""

    def __init__(self, skin: TriangleMesh, bulging: Ints) -> None:
        near = np.zeros(len(skin.faces), dtype=bool)
        near[bulging] = True
        pairs = edge_neighbours(skin.faces)
        self._pairs: Ints = pairs[near[pairs].any(axis=1)]
        middle = skin.vertices[skin.faces[self._pairs]].mean(axis=2)
        self._length = np.linalg.norm(middle[:, 1] - middle[:, 0], axis=1)
        self._skin = skin

    def sharp(self, tops: Floats, posed: Floats) -> NDArray[np.bool_]:
        """Which triangles lie at an edge where the skin turns towards itself within some heights of its bulges, (m,)."""
        faces, close = self._skin.faces, np.zeros(len(tops), dtype=bool)
        top = np.maximum(tops[self._pairs[:, 0]], tops[self._pairs[:, 1]])
        # The largest turn is a half one, and skin shrinks to a half at most.
        chosen = np.flatnonzero((top > _LOW) & (0.5 * self._length < _SHARP * np.pi * top))
        if not len(chosen):
            return close
        # Each triangle once, though it has three edges.
        used = np.zeros(len(faces), dtype=bool)
        used[self._pairs[chosen]] = True
        place = np.cumsum(used) - 1
        corners = posed[faces[used]]
        normal = unit(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        middle = corners.mean(axis=1)
        one, other = place[self._pairs[chosen]].T
        step, n, m = middle[other] - middle[one], normal[one], normal[other]
        cosine = np.clip(row_dot(n, m), -1.0, 1.0)
        length = np.sqrt(row_dot(step, step))
        hit = (row_dot(step, n - m) > 0) & (length < _SHARP * top[chosen] * np.arccos(cosine))
        if not hit.any():
            return close
        # And all around their corners.
        at = np.zeros(len(posed), dtype=bool)
        at[faces[self._pairs[chosen[hit]]]] = True
        return _touching(at, faces)


class _Patches:
    """The skin in pieces of some millimetres, each with a place and a direction."""

    def __init__(self, skin: TriangleMesh) -> None:
        cells = np.floor(skin.vertices / _PATCH).astype(np.int64)
        # Two sides of a thin part of the body are not one patch.
        facing = np.argmax(np.abs(skin.vertex_normals), axis=1)
        outward = np.take_along_axis(skin.vertex_normals, facing[:, None], axis=1)[:, 0] > 0
        _, patch = np.unique(np.column_stack([cells, 2 * facing + outward]), axis=0, return_inverse=True)
        patch = patch.reshape(-1)
        size = np.bincount(patch)
        columns = np.arange(len(patch))
        self._mean = sparse.csr_array((1.0 / size[patch], (patch, columns)), shape=(len(size), len(columns)))
        self._of_face: Ints = patch[skin.faces]
        self._count = len(size)
        self._found: _Pairs | None = None

    def facing(self, tops: Floats, posed: Floats, normals: Floats) -> NDArray[np.bool_]:
        """Which triangles belong to a patch with bulges that faces another closely, or to that other, (m,).

        tops: how high the bulges of every triangle are [m], (m,). posed, normals: of the skin, (n, 3).
        """
        close = np.zeros(len(tops), dtype=bool)
        up = np.flatnonzero(tops > _SOON)
        height = np.zeros(self._count)
        for k in range(3):
            np.maximum.at(height, self._of_face[up, k], tops[up])
        pairs = self._near(height, posed, normals)
        middle, normal, top = pairs.mean @ posed, unit(pairs.mean @ normals), height[pairs.patch]
        first, second = (ends[top[pairs.first] > _LOW] for ends in (pairs.first, pairs.second))
        step, n, m, top = middle[first] - middle[second], normal[first], normal[second], top[first]
        turn = 1.0 - row_dot(n, m)
        gap = row_dot(step, m)
        # A sixth of a patch is how far skin of a patch may be from the plane of its middle where it bends.
        slack = 0.15 * _PATCH
        hit = (turn > 1.0 - _OPPOSED) & (gap > -slack) & (gap < turn * top + 2.0 * slack)
        hit &= row_dot(step, n) < slack
        hit &= row_dot(step, step) < (1.7 * _PATCH + 2.0 * top) ** 2
        if hit.any():
            of_patch = np.zeros(self._count, dtype=bool)
            of_patch[pairs.patch[first[hit]]] = of_patch[pairs.patch[second[hit]]] = True
            close = _touching(of_patch, self._of_face)
        return close

    def _near(self, height: Floats, posed: Floats, normals: Floats) -> _Pairs:
        """Patches that bulge and others that look towards them; found again when the skin has moved or more of it bulges.

        height: of the bulges of every patch [m], (patches,).
        """
        if self._found is not None and self._found.hold(height, posed):
            return self._found
        raised, room = np.flatnonzero(height), 1.5 * float(height.max())
        # Two bulges, and from the middle of either patch to its corner.
        reach = 1.7 * _PATCH + 2.0 * room + _SLACK
        middle, normal = self._mean @ posed, unit(self._mean @ normals)
        # Directions count as half of it: face to face they are nothing apart, side by side as much as it takes.
        mine = np.concatenate([middle, 0.5 * reach * normal], axis=1)[raised]
        theirs = np.concatenate([middle, -0.5 * reach * normal], axis=1)
        found = cKDTree(mine).sparse_distance_matrix(cKDTree(theirs), reach, output_type="ndarray")
        ends = np.stack([raised[found["i"]], found["j"]])
        kept, local = np.unique(ends, return_inverse=True)
        first, second = local.reshape(2, -1)
        mean = sparse.csr_array(self._mean[kept])
        self._found = _Pairs(kept, first, second, mean, np.where(height > 0, room, _LOW), posed)
        return self._found


def _touching(chosen: NDArray[np.bool_], faces: Ints) -> NDArray[np.bool_]:
    """Which triangles, of (m, 3), have a chosen one among their three corners or patches, (m,)."""
    return np.asarray(chosen[faces[:, 0]] | chosen[faces[:, 1]] | chosen[faces[:, 2]])


@dataclass(frozen=True, eq=False)
class _Pairs:
    """Patches that bulge, each with one that looks towards it.

    patch: which patches these are, (k,); first, second: the two of a pair among them, (pairs,). mean: takes values of the
    skin's vertices to those of the patches, (k, n). room: how high the bulges of all patches may grow before there are
    others [m], (patches,). posed: where the skin was when these were found [m], (n, 3).
    """

    patch: Ints
    first: Ints
    second: Ints
    mean: sparse.csr_array
    room: Floats
    posed: Floats

    def hold(self, height: Floats, posed: Floats) -> bool:
        """Whether there can be no others yet, with bulges so high [m], (patches,), and the skin there, (n, 3)."""
        if (height > self.room).any():
            return False
        moved = posed - self.posed
        return bool(row_dot(moved, moved).max() < (0.5 * _SLACK) ** 2)
