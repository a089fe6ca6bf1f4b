"""Heads of a kind: ellipsoids with bumps, in the size of a human head, at any resolution."""

import igl
import numpy as np
import trimesh
from scipy.spatial import ConvexHull

from headstudio.head.head import Head, Landmarks
from headstudio.head.mesh import TriangleMesh
from headstudio.head.neck import NO_NECK

SEMI_AXES = np.array([0.075, 0.11, 0.095])


def smooth_head(subdivisions: int) -> Head:
    """A plain ellipsoid with even triangles."""
    sphere = trimesh.creation.icosphere(subdivisions=subdivisions)
    return _head(np.array(sphere.vertices), np.array(sphere.faces), lambda directions: directions * SEMI_AXES)


def bumpy_head(vertices: int, seed: int, height: float = 0.05) -> Head:
    """An ellipsoid with ``vertices`` random vertices and smooth bumps of about ``height`` of its size."""
    rng = np.random.default_rng(seed)
    directions = rng.normal(size=(vertices, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    faces = ConvexHull(directions).simplices
    corners = directions[faces]
    inward = np.einsum("ij,ij->i", np.cross(corners[:, 1], corners[:, 2]), corners[:, 0]) < 0
    faces[inward] = faces[inward, ::-1]
    waves, phases, heights = rng.normal(size=(8, 3)) * 3, rng.uniform(0, 6, 8), height * rng.uniform(-1, 1, 8)

    def shape(directions: np.ndarray) -> np.ndarray:
        return directions * (1 + np.cos(directions @ waves.T + phases) @ heights)[:, None] * SEMI_AXES

    return _head(directions, faces, shape)


def _head(directions: np.ndarray, faces: np.ndarray, shape) -> Head:
    def mark(*point: float) -> np.ndarray:
        direction = np.array([point]) / SEMI_AXES
        return shape(direction / np.linalg.norm(direction))[0]

    landmarks = Landmarks(
        crown=mark(0, 0.11, 0),
        hairline=mark(0, 0.07, 0.075),
        glabella=mark(0, 0.02, 0.095),
        nasion=mark(0, 0.01, 0.095),
        nose_tip=mark(0, -0.02, 0.095),
        chin=mark(0, -0.1, 0.05),
        nape=mark(0, -0.06, -0.07),
        occiput=mark(0, 0.03, -0.095),
        left_tragus=mark(0.075, -0.01, 0),
        right_tragus=mark(-0.075, -0.01, 0),
        left_eye=mark(0.03, 0, 0.09),
        right_eye=mark(-0.03, 0, 0.09),
        mouth_left=mark(0.02, -0.05, 0.09),
        mouth_right=mark(-0.02, -0.05, 0.09),
    )
    skin = TriangleMesh(shape(directions), faces)
    assert igl.is_edge_manifold(skin.faces)
    return Head("bumpy", skin, NO_NECK, landmarks)
