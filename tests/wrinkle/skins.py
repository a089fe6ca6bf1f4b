"""Small skins to map and to wrinkle, and independent ways to look at the result."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh

from headstudio.head.mesh import Floats, TriangleMesh
from headstudio.wrinkle.furrow import Furrow
from headstudio.wrinkle.texture_map import TextureMap


def sheet(cells: int = 30, size: float = 0.1, jitter: float = 0.25, seed: int = 0) -> TriangleMesh:
    """A flat square [m] of uneven triangles."""
    rng = np.random.default_rng(seed)
    x, y = np.meshgrid(*[np.linspace(0, size, cells + 1)] * 2)
    points = np.stack([x, y, np.zeros_like(x)], axis=2).reshape(-1, 3)
    inner = ((points[:, :2] > 1e-9) & (points[:, :2] < size - 1e-9)).all(axis=1)
    points[inner, :2] += rng.uniform(-jitter, jitter, (inner.sum(), 2)) * size / cells
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1, 1)
    faces = (corner[:, None] + np.array([[0, 1, cells + 2], [0, cells + 2, cells + 1]])).reshape(-1, 3)
    return TriangleMesh(points, faces)


def cut(mesh: TriangleMesh, keep: np.ndarray) -> TriangleMesh:
    """The faces where ``keep`` holds."""
    used, faces = np.unique(mesh.faces[keep], return_inverse=True)
    return TriangleMesh(mesh.vertices[used], faces.reshape(-1, 3))


def sheet_with_holes() -> TriangleMesh:
    flat = sheet()
    middle = flat.vertices[flat.faces].mean(axis=1)[:, :2]
    holes = [
        np.linalg.norm(middle - centre, axis=1) < radius
        for centre, radius in (((0.03, 0.03), 0.012), ((0.07, 0.06), 0.02))
    ]
    return cut(flat, ~holes[0] & ~holes[1])


def horseshoe() -> TriangleMesh:
    """Bent into a dome, with a deep bay: a border that is not convex at all."""
    flat = sheet()
    middle = flat.vertices[flat.faces].mean(axis=1)
    bent = cut(flat, ~((abs(middle[:, 0] - 0.05) < 0.02) & (middle[:, 1] < 0.075)))
    v = bent.vertices - [0.05, 0.05, 0]
    return bent.moved(np.column_stack([v[:, :2], 0.05 * np.cos(20 * v[:, 0]) * np.cos(20 * v[:, 1])]))


def cap(height: float = -0.02, bumps: float = 0.0) -> TriangleMesh:
    """The part of a sphere of 5 cm above a height, with bumps; below the equator it overhangs."""
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.05)
    ball = TriangleMesh(ball.vertices, ball.faces)
    top = cut(ball, ball.vertices[ball.faces][..., 2].mean(axis=1) > height)
    return top.moved(top.vertices * (1 + bumps * np.sin(top.vertices @ [160, 90, 120])[:, None]))


def box_with_hole() -> TriangleMesh:
    """A box without its lid, with a window in one side."""
    box = trimesh.creation.box(extents=[0.06, 0.06, 0.06])
    for _ in range(4):
        box = box.subdivide()
    mesh = TriangleMesh(np.array(box.vertices), np.array(box.faces))
    middle = mesh.vertices[mesh.faces].mean(axis=1)
    window = (middle[:, 0] > 0.0299) & (np.abs(middle[:, 1:]) < 0.012).all(axis=1)
    return cut(mesh, ~window & (middle[:, 2] < 0.0299))


def tube(
    around: int = 40, along: int = 30, radius: float = 0.008, length: float = 0.06, bend: float = 0.0
) -> TriangleMesh:
    """A finger without its tip: open at both ends, upright, bent forward by ``bend`` [m]."""
    angle, part = np.meshgrid(np.arange(around) / around * 2 * np.pi, np.linspace(0, 1, along + 1))
    wide = radius * (1 + 0.15 * np.sin(7 * part))
    points = np.stack([wide * np.sin(angle), length * part, wide * np.cos(angle) + bend * part**2], axis=2).reshape(
        -1, 3
    )
    corner = np.arange(around * along)
    right = corner - corner % around + (corner + 1) % around
    faces = np.concatenate(
        [np.stack([corner, right, right + around], 1), np.stack([corner, right + around, corner + around], 1)]
    )
    return TriangleMesh(points, faces)


def flat_map(mesh: TriangleMesh, stretch: tuple[float, float] = (8.0, 8.0)) -> TextureMap:
    """A flat sheet mapped by its own coordinates, as long in u and v as asked for: not isotropic, if so."""
    uv = mesh.vertices[:, :2] * stretch + 0.1
    return TextureMap(mesh, uv, uv[mesh.faces], 1.0 / float(np.sqrt(np.prod(stretch))), wrapped=False)


def line_between(start: tuple[float, float], end: tuple[float, float], **values: float) -> Furrow:
    """A straight furrow."""
    part = np.linspace(0, 1, 4)[:, None]
    points = (1 - part) * np.array(start) + part * np.array(end)
    furrow = Furrow(controls=tuple((float(x), float(y)) for x, y in points), initial=1.0)
    return replace(furrow, **values)


def covering_counts(texture_map: TextureMap, work: int = 500_000, seed: int = 1) -> np.ndarray:
    """How many triangles cover random points within triangles of the map, by looking at every triangle for each."""
    rng = np.random.default_rng(seed)
    count = min(400, work // len(texture_map.corner_uv))
    corners = texture_map.corner_uv
    chosen = rng.integers(len(corners), size=count)
    weights = rng.dirichlet([1.0, 1.0, 1.0], count)
    points = np.einsum("ij,ijk->ik", weights, corners[chosen])
    shifts = (-1.0, 0.0, 1.0) if texture_map.wrapped else (0.0,)
    covered = np.zeros(count, dtype=int)
    for shift in shifts:
        for batch in range(0, count, 50):
            away = corners[None] - (points[batch : batch + 50] + np.array([shift, 0.0]))[:, None, None]
            ahead = np.roll(away, -1, axis=2)
            covered[batch : batch + 50] += (
                ((away[..., 0] * ahead[..., 1] - away[..., 1] * ahead[..., 0]) > 0).all(axis=2).sum(axis=1)
            )
    return covered


def volume_between(faces: np.ndarray, before: Floats, after: Floats) -> float:
    """Volume gained when a surface moves from ``before`` to ``after`` [m^3], by prisms under every triangle."""

    def enclosed(points: Floats) -> float:
        a, b, c = (points[faces[:, k]] - before.mean(axis=0) for k in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)

    return enclosed(after) - enclosed(before)
