"""Nasty little meshes, and heads put into files in every way a stranger might."""

from functools import cache
from pathlib import Path

import numpy as np
import trimesh

from headstudio.head.clip import clip_by_plane
from headstudio.head.head import Head
from headstudio.head.makehuman import makehuman
from headstudio.head.mesh import TriangleMesh
from headstudio.head.parts import joined
from headstudio.head.read import TriangleSoup

UP = np.array([0.0, 1.0, 0.0])


@cache
def human(age: float = 0.2, masculine: float = 0.0) -> Head:
    return makehuman(age, masculine)


def mesh_of(shape: trimesh.Trimesh) -> TriangleMesh:
    return TriangleMesh(shape.vertices, shape.faces)


def sphere(radius=1.0, centre=(0.0, 0.0, 0.0), subdivisions=3) -> TriangleMesh:
    ball = trimesh.creation.icosphere(subdivisions=subdivisions, radius=radius)
    return TriangleMesh(ball.vertices + centre, ball.faces)


def open_cap() -> TriangleMesh:
    return clip_by_plane(sphere(), np.array([0.0, -0.3, 0.0]), UP)[0]


def cube() -> TriangleMesh:
    return mesh_of(trimesh.creation.box().subdivide().subdivide().subdivide())


def plane() -> TriangleMesh:
    x, y = np.meshgrid(np.linspace(0, 1, 20), np.linspace(0, 1, 20))
    corner = (np.arange(19)[:, None] * 20 + np.arange(19)).reshape(-1, 1)
    faces = (corner[:, None] + np.array([[0, 1, 21], [0, 21, 20]])).reshape(-1, 3)
    return TriangleMesh(np.stack([x, y, np.zeros_like(x)], axis=2).reshape(-1, 3), faces)


def egg() -> TriangleMesh:
    return sphere().moved(sphere().vertices * [0.75, 1.1, 1.0])


def moebius(count: int = 40) -> TriangleMesh:
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)[:, None]
    across = np.array([-0.3, 0.3])
    radius = 1 + across * np.cos(turn / 2)
    points = np.stack([radius * np.cos(turn), radius * np.sin(turn), across * np.sin(turn / 2)], axis=2).reshape(-1, 3)
    first = 2 * np.arange(count)
    following = np.where(first + 2 < 2 * count, first + 2, 0)
    twisted = np.where(first + 2 < 2 * count, 0, 1)
    low, high = following + twisted, following + 1 - twisted
    return TriangleMesh(
        points, np.concatenate([np.stack([first, low, first + 1], 1), np.stack([first + 1, low, high], 1)])
    )


def torn(mesh: TriangleMesh) -> TriangleSoup:
    """Every triangle with vertices of its own, as STL has it."""
    uv = mesh.vertices[mesh.faces][..., :2]
    return TriangleSoup(mesh.vertices[mesh.faces].reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3), uv)


def soup(mesh: TriangleMesh) -> TriangleSoup:
    return TriangleSoup(mesh.vertices, mesh.faces, mesh.corner_uv)


def moved(mesh: TriangleMesh, rotation=None, scale=1.0, shift=(0.0, 0.0, 0.0)) -> TriangleMesh:
    vertices = mesh.vertices if rotation is None else rotation.apply(mesh.vertices)
    return mesh.moved(vertices * scale + np.asarray(shift))


def bare(mesh: TriangleMesh) -> TriangleMesh:
    return TriangleMesh(mesh.vertices, mesh.faces)


def neckless(head: Head) -> TriangleMesh:
    """The head alone, cut under the chin."""
    return clip_by_plane(bare(head.skin), head.landmarks.chin - [0, 0.01, 0], UP)[0]


def with_parts(head: Head) -> TriangleMesh:
    """Skin, eyes, teeth, tongue and lashes in one mesh, as a file has them."""
    return joined([bare(head.skin), *(bare(part.mesh) for part in head.parts)])


def write(mesh: TriangleMesh, path: Path) -> str:
    trimesh.Trimesh(mesh.vertices, mesh.faces, process=False).export(path)
    return str(path)


def signed_volume(mesh: TriangleMesh) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def is_coherent(faces: np.ndarray) -> bool:
    """No edge is run through twice in the same direction."""
    half_edges = faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    return len(np.unique(half_edges, axis=0)) == len(half_edges)
