"""How far a skin is from a scan of it: Bando's thesis, section 2.7, figure 2.15.

The distance from each vertex of one mesh to the nearest triangle of the other, both ways. A vertex counts by the skin
around it: a mesh that is finer around furrows than elsewhere would else be measured mostly there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.locate import Locator
from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.repair import border_edges
from .alignment import ScanError

# Farther away than this nothing is the same skin [m]; its normals agree to this cosine.
_REACH, _FACING = 0.015, 0.3
# Where the other mesh has skin of this one so many times as near, and this much nearer still [m], that is what it shows.
_MUCH, _NEARER = 4.0, 3e-3
# What lies this near to a place where the scan departs from the smooth skin belongs to its wrinkles [m].
AROUND = 0.008


@dataclass(frozen=True)
class Distances:
    """Of one mesh from another: mean, root of the mean square and maximum [m], and over how many vertices."""

    mean: float
    rms: float
    largest: float
    count: int

    @classmethod
    def of(cls, distances: Floats, area: Floats) -> Distances:
        """The figures of distances [m], (k,), at least one. area: of the skin that each stands for, (k,)."""
        size, share = np.abs(distances), area / area.sum()
        return cls(float(share @ size), float(np.sqrt(share @ size**2)), float(size.max()), len(size))


@dataclass(frozen=True, eq=False)
class Comparison:
    """A skin and a scan over what both cover.

    vertices: of the skin that the scan covers, (k,). to_scan: signed distance of each to the scan [m], above 0 where the
    scan lies higher, (k,). scan_vertices: of the scan that lie on the skin, (l,). to_skin: signed distance of each [m].
    area: that each vertex of the skin and then of the scan stands for [m^2], (k + l,).
    """

    vertices: Ints
    to_scan: Floats
    scan_vertices: Ints
    to_skin: Floats
    area: Floats

    @property
    def both_ways(self) -> Floats:
        """Signed distances of the skin's vertices and then of the scan's [m], (k + l,)."""
        return np.concatenate([self.to_scan, self.to_skin])

    def distances(self) -> Distances:
        """Both ways."""
        return Distances.of(self.both_ways, self.area)


def compare(skin: TriangleMesh, scan: TriangleMesh, part: np.ndarray | None = None) -> Comparison:
    """Compare a skin, n vertices, with a scan in its frame [m]. part: the vertices of the skin that count, (n,).

    Places beside the border of the other mesh do not count: nobody knows how it goes on there. Nor do places behind it,
    as the inside of a lid beside a scan that ends at its edge: what the other mesh has there is skin that lies much
    nearer to it. Raises ScanError when no place of one lies on the other.
    """
    part = np.ones(len(skin.vertices), dtype=bool) if part is None else part
    vertices, to_scan, _ = _one_way(skin, scan, np.flatnonzero(part))
    scan_vertices, to_skin, foot = _one_way(scan, skin, np.arange(len(scan.vertices)))
    counts = part[skin.faces[foot]].all(axis=1)
    if not len(vertices) or not counts.any():
        raise ScanError("the scan covers no part of the face")
    scan_vertices = scan_vertices[counts]
    area = np.concatenate([_areas(skin)[vertices], _areas(scan)[scan_vertices]])
    return Comparison(vertices, to_scan, scan_vertices, -to_skin[counts], area)


def around(points: Floats, wrinkled: Floats) -> np.ndarray:
    """Which of ``points`` [m], (k, 3), lie around one of the ``wrinkled`` places, (l, 3)."""
    if not len(wrinkled):
        return np.zeros(len(points), dtype=bool)
    return np.asarray(np.isfinite(cKDTree(wrinkled).query(points, distance_upper_bound=AROUND)[0]))


def _areas(mesh: TriangleMesh) -> Floats:
    """A third of the triangles around every vertex [m^2], (n,)."""
    thirds = np.repeat(mesh.face_areas / 3.0, 3)
    areas = np.zeros(len(mesh.vertices))
    areas += np.bincount(mesh.faces.ravel(), thirds, len(mesh.vertices))
    return areas


def _one_way(mesh: TriangleMesh, other: TriangleMesh, vertices: Ints) -> tuple[Ints, Floats, Ints]:
    """Vertices that lie on the other mesh, their signed distances [m] and its triangles nearest to them.

    Above 0: the other mesh lies higher.
    """
    points, normals = mesh.vertices[vertices], mesh.vertex_normals[vertices]
    found, away = Locator(other.vertices, other.faces).nearest(points)
    foot = found.blend(other.vertices, other.faces)
    facing = np.einsum("kd,kd->k", other.face_normals[found.faces], normals) > _FACING
    open_end = np.zeros(len(other.vertices), dtype=bool)
    open_end[border_edges(other.faces)] = True
    corners = other.faces[found.faces]
    # On the border a foot has weight on border vertices alone.
    at_end = (open_end[corners] | (found.weights < 1e-9)).all(axis=1)
    back = Locator(mesh.vertices, mesh.faces).nearest(foot)[1]
    behind = away > _NEARER + _MUCH * back
    kept = facing & ~at_end & ~behind & (away < _REACH)
    side = np.where(np.einsum("kd,kd->k", foot - points, normals) >= 0, 1.0, -1.0)
    return vertices[kept], (side * away)[kept], found.faces[kept]
