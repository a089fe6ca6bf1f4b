"""The planes that hair collides with, against a body whose distance is known: a ball."""

import numpy as np
import pytest
import trimesh

from headstudio.head.contact import ContactField
from headstudio.head.mesh import TriangleMesh

CENTRE = np.array([0.02, 0.1, -0.03])
RADIUS = 0.1
VOXEL = 0.012


def mesh_of(shape):
    return TriangleMesh(np.asarray(shape.vertices), np.asarray(shape.faces))


@pytest.fixture(scope="module")
def ball():
    shape = trimesh.creation.icosphere(subdivisions=4, radius=RADIUS)
    return ContactField.around(mesh_of(shape.apply_translation(CENTRE)), VOXEL)


def around_the_ball(heights, count=4000, seed=2):
    """Random points at ``heights`` above the surface, (count, 3), and the directions in which they lie."""
    rng = np.random.default_rng(seed)
    out = rng.normal(size=(count, 3))
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    return CENTRE + (RADIUS + rng.uniform(*heights, size=(count, 1))) * out, out


def test_distance_is_that_to_the_ball(ball):
    """A plane a voxel wide leaves a ball by the square of its size over the diameter."""
    points, out = around_the_ball((-0.006, 0.006))
    distance, normals = ball.at(points)
    exact = np.linalg.norm(points - CENTRE, axis=1) - RADIUS
    assert np.all(np.isfinite(distance))
    assert np.sqrt(np.mean((distance - exact) ** 2)) < 0.06 * VOXEL
    assert np.abs(distance - exact).max() < 0.35 * VOXEL
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)
    assert np.einsum("ij,ij->i", normals, out).min() > 0.95


def test_both_sides_are_told_apart(ball):
    for side in (-1, 1):
        points, _ = around_the_ball(sorted((side * 0.004, side * 0.015)))
        assert np.all(np.sign(ball.at(points)[0]) == side)


def test_what_got_in_deep_still_finds_its_way_out(ball):
    points, out = around_the_ball((-0.025, -0.01))
    distance, normals = ball.at(points)
    assert np.all(distance < 0)
    assert np.einsum("ij,ij->i", normals, out).min() > 0.9


def test_far_away_there_is_no_body(ball):
    far = CENTRE + np.array([[0, 0, 0], [0.3, 0, 0], [0, -50.0, 0], [1e9, 1e9, 1e9], [0.16, 0, 0]])
    np.testing.assert_array_equal(ball.at(far)[0], np.inf)


def test_nobody_asks(ball):
    distance, normals = ball.at(np.zeros((0, 3)))
    assert distance.shape == (0,)
    assert normals.shape == (0, 3)


def test_a_finer_grid_is_more_exact():
    shape = mesh_of(trimesh.creation.icosphere(subdivisions=5, radius=RADIUS).apply_translation(CENTRE))
    points, _ = around_the_ball((-0.003, 0.003))
    exact = np.linalg.norm(points - CENTRE, axis=1) - RADIUS
    off = [np.sqrt(np.mean((ContactField.around(shape, voxel).at(points)[0] - exact) ** 2)) for voxel in (0.02, 0.01)]
    assert off[1] < 0.4 * off[0]


def slab(height):
    """A flat box with so many triangles that its edges round off nothing but their own surroundings."""
    box = trimesh.creation.box(extents=(0.4, height, 0.4))
    return mesh_of(box.subdivide_to_size(0.015))


def test_a_flat_wall_is_exact():
    field = ContactField.around(slab(0.2), 0.01)
    x, z = np.random.default_rng(1).uniform(-0.12, 0.12, (2, 500))
    points = np.column_stack([x, np.linspace(0.075, 0.125, 500), z])
    distance, normals = field.at(points)
    np.testing.assert_allclose(distance, points[:, 1] - 0.1, atol=1e-9)
    np.testing.assert_allclose(normals, np.tile([0.0, 1.0, 0.0], (500, 1)), atol=1e-9)


def test_a_thin_sheet_has_no_plane_that_points_sideways():
    """Where one voxel holds both sides, their mean normal means nothing; such a voxel has no plane of its own."""
    field = ContactField.around(slab(0.004), 0.02)
    inner = np.all(np.abs(field.points[:, [0, 2]]) < 0.15, axis=1)
    assert np.all(np.abs(field.normals[inner, 1]) > 0.9)


def test_same_body_same_planes():
    shape = mesh_of(trimesh.creation.icosphere(subdivisions=3, radius=RADIUS))
    first, second = (ContactField.around(shape, VOXEL) for _ in range(2))
    np.testing.assert_array_equal(first.points, second.points)
    np.testing.assert_array_equal(first.plane, second.plane)


def test_a_surface_hides_nothing_beyond_its_border():
    """Below the rim of a cap the planes of its rim would, drawn on, call the outside inside."""
    ball = trimesh.creation.icosphere(subdivisions=5, radius=RADIUS).apply_translation(CENTRE)
    rim = CENTRE[1] + 0.5 * RADIUS
    cap = mesh_of(trimesh.Trimesh(ball.vertices, ball.faces[ball.triangles_center[:, 1] > rim], process=False))
    turn, down, out = np.random.default_rng(3).random((3, 2000))
    around = np.sqrt(0.75) * RADIUS + out * VOXEL
    below = (2.0 + 0.4 * down) * VOXEL
    beyond = np.column_stack([around * np.cos(7 * turn), rim - CENTRE[1] - below, around * np.sin(7 * turn)]) + CENTRE
    assert np.all(np.isinf(ContactField.around(cap, VOXEL).at(beyond)[0]))


def test_beyond_a_ridge_outside_stays_outside():
    """Above one slope of a roof a point is not below the other one's plane."""
    roof = trimesh.creation.box(extents=(0.4, 0.1, 0.4)).apply_transform(
        trimesh.transformations.rotation_matrix(np.pi / 4, [0, 0, 1])
    )
    field = ContactField.around(mesh_of(roof.subdivide_to_size(0.008)), 0.014)
    rng = np.random.default_rng(5)
    points = rng.uniform(-0.3, 0.3, (60_000, 3)) * [1.0, 1.0, 0.4]
    turned = points @ np.array([[1, 1, 0], [-1, 1, 0], [0, 0, np.sqrt(2)]]).T / np.sqrt(2)
    outside = np.max(np.abs(turned) - [0.2, 0.05, 0.2], axis=1)
    seen = field.at(points)[0]
    assert np.all(seen[outside > 0.01] > 0)
