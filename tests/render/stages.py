"""A little head with hair, made of formulas, so that what is drawn does not depend on how heads and hair are built."""

from __future__ import annotations

import numpy as np
import trimesh
from scipy.spatial import cKDTree

from headstudio.head.head import Head, Landmarks, Part
from headstudio.head.mesh import Floats, TriangleMesh
from headstudio.head.neck import Neck
from headstudio.lcp.model import HairModel
from headstudio.scene.stage import HairOnStage, Stage

RADII = np.array([0.075, 0.110, 0.095])
CENTRE = np.array([0.0, 0.05, 0.0])


def on_face(x: float, y: float) -> Floats:
    """The point of the egg in front of (x, y) [m]."""
    left = 1 - (x / RADII[0]) ** 2 - ((y - CENTRE[1]) / RADII[1]) ** 2
    return np.array([x, y, RADII[2] * np.sqrt(left)])


def egg_head() -> Head:
    """An egg with two eyes and a mouth; its lower part stays behind when it turns."""
    ball = trimesh.creation.icosphere(subdivisions=4)
    skin = TriangleMesh(np.array(ball.vertices) * RADII + CENTRE, np.array(ball.faces))
    eyes = [on_face(side * 0.03, 0.06) for side in (1, -1)]
    parts = tuple(_eye(place) for place in eyes)
    landmarks = Landmarks(
        crown=CENTRE + RADII * [0, 1, 0],
        hairline=on_face(0, 0.12),
        glabella=on_face(0, 0.08),
        nasion=on_face(0, 0.07),
        nose_tip=on_face(0, 0.03),
        chin=on_face(0, -0.04),
        nape=np.array([0, 0.0, -0.09]),
        occiput=np.array([0, 0.06, -RADII[2]]),
        left_tragus=np.array([RADII[0], 0.05, 0]),
        right_tragus=np.array([-RADII[0], 0.05, 0]),
        left_eye=eyes[0],
        right_eye=eyes[1],
        mouth_left=on_face(0.022, -0.005),
        mouth_right=on_face(-0.022, -0.005),
    )
    return Head("egg", skin, Neck(np.array([0.0, 1.0, 0.0]), 0.01, 0.05), landmarks, parts)


def _eye(place: Floats) -> Part:
    ball = trimesh.creation.icosphere(subdivisions=3, radius=0.012)
    centre = place - [0, 0, 0.006]
    mesh = TriangleMesh(np.array(ball.vertices) + centre, np.array(ball.faces))
    return Part("eye", mesh, centre, np.array([0.0, 0.0, 1.0]), 0.012)


def falling_hair(strands: int = 130, per_strand: int = 9, length: float = 0.16) -> HairModel:
    """Hair that leaves the upper back of the egg, runs down over it and falls straight; linked along and across."""
    spiral = np.arange(strands) + 0.5
    height = 1 - 0.75 * spiral / strands
    around = spiral * np.pi * (3 - np.sqrt(5))
    level = np.sqrt(1 - height**2)
    outward = np.stack([level * np.cos(around), height, level * np.sin(around)], axis=1)
    outward = outward[outward[:, 2] < 0.35 + outward[:, 1] * 0.3]
    roots = CENTRE + RADII * outward
    arc = np.concatenate([[-0.01], np.linspace(0.005, length, per_strand - 1)])
    # Out of the scalp, then more and more along gravity.
    bend = np.clip((arc + 0.02) / 0.05, 0, 1)[None, :, None]
    direction = (1 - bend) * outward[:, None] + bend * (0.35 * outward[:, None] * [1, 0, 1] + [0, -1, 0])
    direction /= np.linalg.norm(direction, axis=2, keepdims=True)
    steps = np.diff(arc, prepend=0.0)[None, :, None] * direction
    positions = roots[:, None] + np.cumsum(steps, axis=1) + 0.006 * outward[:, None]
    return model_of(
        positions.reshape(-1, 3),
        direction.reshape(-1, 3),
        np.tile(arc, len(roots)),
        np.repeat(roots, per_strand, axis=0),
    )


def model_of(positions: Floats, directions: Floats, arc_length: Floats, roots: Floats) -> HairModel:
    """A model of these particles; neighbours along the hair are linked."""
    n = len(positions)
    spacing = float(cKDTree(positions).query(positions, k=min(7, n))[0][:, 1:].mean()) if n > 1 else 0.012
    pairs = cKDTree(positions).query_pairs(2.2 * spacing, output_type="ndarray") if n > 1 else np.zeros((0, 2), int)
    between = positions[pairs[:, 1]] - positions[pairs[:, 0]]
    distance = np.linalg.norm(between, axis=1)
    cosine = np.einsum("ni,ni->n", directions[pairs[:, 0]], between) / np.maximum(distance, 1e-9)
    pairs = np.where((cosine < 0)[:, None], pairs[:, ::-1], pairs)
    along = np.abs(cosine) > 0.8
    pairs, distance, cosine = pairs[along], distance[along], np.abs(cosine[along])
    return HairModel(
        coordinates=np.column_stack([np.zeros((n, 2)), arc_length]),
        root_points=roots,
        rest_positions=positions,
        rest_directions=directions,
        mass=np.full(n, 0.1 / max(n, 1)),
        fixed=arc_length < 0,
        links=pairs,
        rest_length=distance,
        alignment=cosine,
        strength=np.ones(len(pairs)),
        rest_cosine=np.column_stack([cosine, cosine]),
        lifeline=np.full(n, -1),
        smoothing_length_links=spacing,
        smoothing_length=spacing,
        spacing=spacing,
        rest_density=np.full(n, 1.0),
        rest_clearance=np.full(n, np.inf),
        bending_length=0.04,
    )


def stage_with(head: Head, model: HairModel) -> Stage:
    """The hair at rest on the head."""
    return Stage(head, hair=HairOnStage(model, model.rest_positions, model.rest_directions))
