"""A ball with strands, made of formulas: small enough to march rays through in numpy."""

from __future__ import annotations

import numpy as np
import trimesh

from headstudio.head.mesh import Floats, TriangleMesh
from headstudio.wisp.strands import Strands

BALL_RADIUS = 0.08


def ball() -> TriangleMesh:
    sphere = trimesh.creation.icosphere(subdivisions=3, radius=BALL_RADIUS)
    return TriangleMesh(np.array(sphere.vertices), np.array(sphere.faces))


def fur(strands: int, points: int = 10, radius: float = 1.5e-4, seed: int = 3, length: float = 0.08) -> Strands:
    """Strands that leave the upper half of the ball and lean over backwards."""
    rng = np.random.default_rng(seed)
    outward = rng.normal(size=(strands, 3))
    outward[:, 1] = np.abs(outward[:, 1])
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    along = np.linspace(0.0, 1.0, points)[None, :, None]
    lean = np.array([0.0, -0.02, -0.04]) + rng.normal(scale=0.006, size=(strands, 3))
    places = outward[:, None] * (BALL_RADIUS + length * along) + lean[:, None] * along**2
    return Strands.of_equal_count(places.astype(np.float32), radius=np.full((strands, points), radius, np.float32))


def strands_crossed(strands: Strands, places: Floats, owner: np.ndarray, to_light: Floats) -> Floats:
    """How many strands, their own left out, a ray from each place towards the light meets, (n,): marched one by one."""
    right = np.cross(to_light, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    plane = np.stack([right, np.cross(right, to_light)], axis=1)
    count = strands.count
    points = strands.points.reshape(count, -1, 3).astype(float)
    start, end = points[:, :-1].reshape(-1, 3), points[:, 1:].reshape(-1, 3)
    strand = np.repeat(np.arange(count), points.shape[1] - 1)
    assert strands.radius is not None
    radius = strands.radius.reshape(count, -1)[:, 1:].ravel()
    a, b = start @ plane, end @ plane
    ab = b - a
    crossed = np.zeros(len(places))
    for k, place in enumerate(places):
        t = np.clip(((place @ plane - a) * ab).sum(axis=1) / np.maximum((ab**2).sum(axis=1), 1e-18), 0, 1)
        aside = np.linalg.norm(a + t[:, None] * ab - place @ plane, axis=1)
        ahead = (start + t[:, None] * (end - start) - place) @ to_light
        crossed[k] = len(np.unique(strand[(aside < radius) & (ahead > 1e-4) & (strand != owner[k])]))
    return crossed
