"""Making one clean surface of what a file holds: welded, without degenerate or duplicate faces, wound outward."""

from __future__ import annotations

from dataclasses import dataclass, replace

import igl
import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .mesh import Floats, Ints, TriangleMesh
from .read import TriangleSoup

# Vertices nearer than this part of the model's diagonal are one: well above the rounding of text formats, well below
# the finest detail of a scan.
_WELD = 1e-6
_DEGENERATE_AREA = 1e-14


@dataclass(frozen=True)
class Repairs:
    """What was found and mended: numbers of vertices and faces."""

    vertices_in_file: int
    faces_in_file: int
    welded_vertices: int = 0
    degenerate_faces: int = 0
    duplicate_faces: int = 0
    turned_faces: int = 0

    def lines(self) -> list[str]:
        """A line for everything that was found."""
        found = [
            (self.welded_vertices, "vertices welded (they share their position with another)"),
            (self.degenerate_faces, "degenerate faces dropped"),
            (self.duplicate_faces, "duplicate faces dropped"),
            (self.turned_faces, "faces turned to face outward like their neighbours"),
        ]
        return [f"{count:,} {what}" for count, what in found if count]


def repair(soup: TriangleSoup) -> tuple[TriangleMesh, Repairs]:
    """The surface of a file: welded by position, without degenerate and duplicate faces, wound coherently and outward.

    Texture coordinates stay with the corners of the faces, so that a texture seam does not open the surface. The mesh
    has no loose vertices; it may have no faces.
    """
    diagonal = float(np.linalg.norm(np.ptp(soup.vertices[np.unique(soup.faces)], axis=0)))
    position_of = weld(soup.vertices, _WELD * diagonal)
    faces = position_of[soup.faces]
    sides = np.stack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]], axis=1)
    collapsed = (sides[..., 0] == sides[..., 1]).any(axis=1)
    flat = TriangleMesh(soup.vertices, faces).face_areas <= _DEGENERATE_AREA * diagonal**2
    degenerate = collapsed | flat
    kept = np.nonzero(~degenerate)[0]
    first = np.sort(np.unique(np.sort(faces[kept], axis=1), axis=0, return_index=True)[1])
    duplicates = len(kept) - len(first)
    kept = kept[first]

    uv = None if soup.corner_uv is None else soup.corner_uv[kept]
    mesh = without_loose_vertices(TriangleMesh(soup.vertices, faces[kept], uv))
    mesh, turned = wound_outward(mesh)
    used = len(np.unique(soup.faces))
    repairs = Repairs(
        vertices_in_file=len(soup.vertices),
        faces_in_file=len(soup.faces),
        welded_vertices=used - len(np.unique(position_of[soup.faces])),
        degenerate_faces=int(degenerate.sum()),
        duplicate_faces=duplicates,
        turned_faces=turned,
    )
    return mesh, repairs


def weld(vertices: Floats, tolerance: float) -> Ints:
    """For each vertex, shape (n, 3), the index of the one that stands for all within ``tolerance`` of it, shape (n,)."""
    distinct, first, group = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
    pairs = cKDTree(distinct).query_pairs(tolerance, output_type="ndarray")
    graph = sparse.coo_array((np.ones(len(pairs)), pairs.T), shape=(len(distinct), len(distinct)))
    clusters, cluster = connected_components(graph, directed=False)
    representative = np.full(clusters, len(vertices))
    np.minimum.at(representative, cluster, first)
    return representative[cluster[group.reshape(-1)]]


def without_loose_vertices(mesh: TriangleMesh) -> TriangleMesh:
    """The same faces with only the vertices they use."""
    used, faces = np.unique(mesh.faces, return_inverse=True)
    return TriangleMesh(mesh.vertices[used], faces.reshape(-1, 3), mesh.corner_uv)


def face_components(faces: Ints) -> Ints:
    """Which connected piece each face belongs to, shape (m,).

    Faces hang together where exactly two of them share an edge: pieces that merely touch stay apart.
    """
    edge_faces = edge_neighbours(faces)
    graph = sparse.coo_array((np.ones(len(edge_faces)), edge_faces.T), shape=(len(faces), len(faces)))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def edge_neighbours(faces: Ints) -> Ints:
    """Pairs of faces that share an edge which no third face has, shape (k, 2)."""
    _, edge_of, faces_at_edge = _edges(faces)
    order = np.argsort(edge_of, kind="stable")
    shared = order[np.repeat(faces_at_edge == 2, faces_at_edge)]
    return (shared // 3).reshape(-1, 2)


def border_edges(faces: Ints) -> Ints:
    """Directed edges that have a face on one side only, shape (k, 2)."""
    half_edges, edge_of, faces_at_edge = _edges(faces)
    return half_edges[faces_at_edge[edge_of] == 1]


def non_manifold_edge_count(faces: Ints) -> int:
    """Number of edges with more than two faces."""
    return int((_edges(faces)[2] > 2).sum())


def border_loops(faces: Ints) -> list[Ints]:
    """The vertices of every connected piece of the border, longest first: the holes and open ends of the surface."""
    edges = border_edges(faces)
    vertices, ends = np.unique(edges, return_inverse=True)
    ends = ends.reshape(-1, 2)
    graph = sparse.coo_array((np.ones(len(ends)), ends.T), shape=(len(vertices), len(vertices)))
    count, loop = connected_components(graph, directed=False)
    loops = [vertices[loop == k] for k in range(count)]
    return sorted(loops, key=len, reverse=True)


def wound_outward(mesh: TriangleMesh) -> tuple[TriangleMesh, int]:
    """The mesh with every connected piece wound coherently and outward, and how many faces were turned over.

    A piece is outward when it encloses a positive volume, seen from its own middle; that also decides open pieces.
    """
    if not len(mesh.faces):
        return mesh, 0
    coherent = np.asarray(igl.bfs_orient(mesh.faces)[0], dtype=np.int64)
    piece = face_components(coherent)
    area = TriangleMesh(mesh.vertices, coherent).face_areas
    corners = mesh.vertices[coherent]
    weight = np.bincount(piece, area)
    moment = np.stack([np.bincount(piece, area * corners[..., k].mean(axis=1)) for k in range(3)], axis=1)
    middle = moment / np.maximum(weight, np.finfo(float).tiny)[:, None]
    local = corners - middle[piece][:, None, :]
    volume = np.bincount(piece, np.einsum("ij,ij->i", local[:, 0], np.cross(local[:, 1], local[:, 2])))
    outward = np.where((volume < 0)[piece][:, None], coherent[:, ::-1], coherent)
    return _rewound(mesh, outward)


def _rewound(mesh: TriangleMesh, faces: Ints) -> tuple[TriangleMesh, int]:
    """The mesh with the corners of each face in the order of ``faces``; texture coordinates follow their corners."""
    place = (faces[:, :, None] == mesh.faces[:, None, :]).argmax(axis=2)
    turned = int((((place[:, 1] - place[:, 0]) % 3) == 2).sum())
    uv = None if mesh.corner_uv is None else np.take_along_axis(mesh.corner_uv, place[..., None], axis=1)
    return replace(mesh, faces=faces, corner_uv=uv), turned


def _edges(faces: Ints) -> tuple[Ints, Ints, Ints]:
    """Half edges (3 m, 2), face by face; the edge each belongs to (3 m,); the number of faces at every edge."""
    half_edges = faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    _, edge_of, count = np.unique(np.sort(half_edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    return half_edges, edge_of.reshape(-1), count
