"""Eyelashes: single tapering hairs on the strip that a model gives them."""

from __future__ import annotations

from itertools import pairwise

import igl
import numpy as np
from scipy.interpolate import LinearNDInterpolator

from .mesh import Floats, Ints, TriangleMesh
from .subdivision import QuadMesh

_HAIRS = 36
_LEVELS = 4
_ROOT_WIDTH = 1.1 / _HAIRS
"""Width of a hair at its root, as a part of the length of the strip: the roots merge into a line along the lid."""

# From hair to hair length and slant vary with the golden ratio: even, without a visible period.
_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
_SHORTEST = 0.8
_SLANT = 0.03


def lash_hairs(strip: QuadMesh, eye_centre: Floats) -> TriangleMesh:
    """Hairs that grow on a strip of quads along a lid, from its edge at the lid to its free edge [m].

    strip: a surface with four corners and one border. eye_centre: middle of the eyeball, shape (3,); the free edge is
    the one away from it. Every hair is a narrow ribbon that ends in a point.
    """
    along, across = _strip_coordinates(strip, eye_centre)
    surface = LinearNDInterpolator(np.stack([along, across], axis=1), strip.vertices)
    hair = np.arange(_HAIRS)
    variation = (hair * _GOLDEN) % 1.0
    root = (hair + 0.5) / _HAIRS
    tip = root + _SLANT * (2.0 * ((hair * _GOLDEN**2) % 1.0) - 1.0) + 2.0 * _SLANT * (2.0 * root - 1.0)
    length = (_SHORTEST + (1.0 - _SHORTEST) * variation) * np.sin(np.pi * np.clip(root, 0.05, 0.95)) ** 0.25

    level = np.linspace(0.0, 1.0, _LEVELS)
    middle = root[:, None] + (tip - root)[:, None] * level
    half_width = 0.5 * _ROOT_WIDTH * (1.0 - level) ** 0.8
    sides = np.stack([middle - half_width, middle + half_width], axis=2)
    height = np.broadcast_to((length[:, None] * level)[..., None], sides.shape)
    margin = 1e-3
    vertices = surface(np.clip(sides, margin, 1 - margin), np.clip(height, margin, 1 - margin)).reshape(-1, 3)

    first = (2 * _LEVELS * hair[:, None] + 2 * np.arange(_LEVELS - 1)).reshape(-1, 1)
    corners = np.array([[0, 1, 3], [0, 3, 2]])
    mesh = TriangleMesh(vertices, (first[:, None] + corners).reshape(-1, 3))
    away = mesh.vertices[mesh.faces[:, 0]] - eye_centre
    inward = np.einsum("ij,ij->", mesh.face_normals, away) < 0
    return TriangleMesh(vertices, mesh.faces[:, ::-1]) if inward else mesh


def _strip_coordinates(strip: QuadMesh, eye_centre: Floats) -> tuple[Floats, Floats]:
    """Harmonic coordinates along the strip and across it, 0 to 1, shape (n,) each."""
    mesh = strip.triangulated()
    loop = np.asarray(igl.boundary_loop(mesh.faces), dtype=np.int64)
    faces_at = np.bincount(strip.faces.ravel(), minlength=len(strip.vertices))
    corners = np.nonzero(faces_at[loop] == 1)[0]
    loop = np.roll(loop, -corners[0])
    cuts = [*(corners - corners[0]), len(loop)]
    closed = np.append(loop, loop[0])
    sides = [closed[start : end + 1] for start, end in pairwise(cuts)]
    lengths = [np.linalg.norm(np.diff(strip.vertices[side], axis=0), axis=1).sum() for side in sides]
    long = 0 if lengths[0] + lengths[2] > lengths[1] + lengths[3] else 1
    edges = sorted((sides[long], sides[long + 2]), key=lambda side: _distance(strip.vertices[side], eye_centre))
    ends = (sides[1 - long], sides[(3 - long) % 4])
    return _harmonic(mesh, *ends), _harmonic(mesh, *edges)


def _distance(points: Floats, centre: Floats) -> float:
    return float(np.linalg.norm(points - centre, axis=1).mean())


def _harmonic(mesh: TriangleMesh, zero: Ints, one: Ints) -> Floats:
    """The harmonic function that is 0 on some border vertices and 1 on others, shape (n,)."""
    fixed = np.concatenate([zero, one])
    values = np.concatenate([np.zeros(len(zero)), np.ones(len(one))])[:, None]
    return np.asarray(igl.harmonic(mesh.vertices, mesh.faces, fixed, values, 1)).ravel()
