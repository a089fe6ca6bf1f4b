"""Linear blend skinning."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import sparse
from scipy.spatial.transform import Rotation

from headstudio.head.rig import Rig
from headstudio.wrinkle.skeleton import joint_motions, skinned


@pytest.fixture
def rod() -> tuple[Rig, np.ndarray]:
    """Three joints along y, and points that pass from one to the next."""
    height = np.linspace(-0.05, 0.25, 61)
    vertices = np.column_stack([0.01 * np.cos(40 * height), height, 0.01 * np.sin(40 * height)])
    weights = np.clip(1 - np.abs(height[:, None] - [0.0, 0.1, 0.2]) / 0.1, 0, 1)
    weights[height < 0] = [1, 0, 0]
    weights[height > 0.2] = [0, 0, 1]
    joints = np.array([[0.0, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.2, 0.0]])
    return Rig(("root", "middle", "end"), np.array([-1, 0, 1]), joints, sparse.csr_array(weights)), vertices


def test_no_turn_leaves_the_skin_as_it_is(rod):
    rig, vertices = rod
    np.testing.assert_allclose(skinned(rig, vertices, joint_motions(rig, np.zeros((3, 3)))), vertices, atol=1e-15)


def test_the_root_turns_everything_rigidly(rod):
    rig, vertices = rod
    turn = np.array([0.3, -0.8, 0.5])
    moved = skinned(rig, vertices, joint_motions(rig, np.array([turn, [0, 0, 0], [0, 0, 0]])))
    np.testing.assert_allclose(moved, Rotation.from_rotvec(turn).apply(vertices), atol=1e-14)


def test_what_belongs_to_one_joint_moves_rigidly(rod):
    rig, vertices = rod
    turns = np.array([[0, 0, 0], [0.9, 0, 0], [0, 0, 0.7]])
    moved = skinned(rig, vertices, joint_motions(rig, turns))
    below, above = vertices[:, 1] <= 0, vertices[:, 1] >= 0.2
    np.testing.assert_allclose(moved[below], vertices[below], atol=1e-15)
    before, after = (np.linalg.norm(points[above][:, None] - points[above], axis=2) for points in (vertices, moved))
    np.testing.assert_allclose(after, before, atol=1e-14)


def test_turns_add_up_along_the_chain(rod):
    rig, _ = rod
    motions = joint_motions(rig, np.array([[0.4, 0, 0], [0.5, 0, 0], [0.6, 0, 0]]))
    np.testing.assert_allclose(motions[2, :, :3], Rotation.from_rotvec([1.5, 0, 0]).as_matrix(), atol=1e-14)
    for joint, parent in ((1, 0), (2, 1)):
        own, carried = (motions[k, :, :3] @ rig.positions[joint] + motions[k, :, 3] for k in (joint, parent))
        np.testing.assert_allclose(own, carried, atol=1e-15)
