"""Fields, lines, marching cubes and remeshing on shapes whose answer is known."""

import igl
import numpy as np
import pytest

from headstudio.head.mannequin import skin
from headstudio.head.mannequin.fields import Tube, carve, cone, ellipsoid, join, meet, shaped
from headstudio.head.mannequin.lines import Lines, Section
from headstudio.head.mannequin.polygonise import polygonise
from headstudio.head.mannequin.remesh import Surface, remesh

RADIUS = 20.0


@pytest.fixture
def points() -> np.ndarray:
    return np.random.default_rng(7).uniform(-40, 40, (3, 500))


def ball(points: np.ndarray) -> np.ndarray:
    return np.linalg.norm(points, axis=1) - RADIUS


def onto_ball(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    normals = points / np.linalg.norm(points, axis=1, keepdims=True)
    return RADIUS * normals, normals


def test_ellipsoid_of_equal_radii_is_a_ball(points: np.ndarray) -> None:
    expected = np.linalg.norm(points - np.array([[1.0], [2.0], [3.0]]), axis=0) - 5.0
    assert ellipsoid(points, (1, 2, 3), (5, 5, 5), (10, 20, 30)) == pytest.approx(expected)


def test_ellipsoid_turns(points: np.ndarray) -> None:
    turned = ellipsoid(points, (0, 0, 0), (5, 10, 15), (0, 0, 90))
    assert turned == pytest.approx(ellipsoid(points, (0, 0, 0), (10, 5, 15)))


def test_straight_tube_is_a_capsule(points: np.ndarray) -> None:
    tube = Tube([(-20, 0, 0), (-5, 0, 0), (10, 0, 0), (20, 0, 0)], [4, 4, 4, 4])
    assert tube(points) == pytest.approx(cone(points, (-20, 0, 0), (20, 0, 0), 4, 4), abs=1e-2)


def test_joins_agree_with_sets_away_from_the_seam(points: np.ndarray) -> None:
    a, b = cone(points, (-9, 0, 0), (0, 0, 0), 8, 8), ellipsoid(points, (9, 0, 0), (8, 8, 8))
    apart = np.abs(a - b) > 3.0
    assert join(a, b, 3.0)[apart] == pytest.approx(np.minimum(a, b)[apart])
    assert meet(a, b, 3.0)[apart] == pytest.approx(np.maximum(a, b)[apart])
    assert (join(a, b, 3.0) <= np.minimum(a, b)).all()
    outside = np.abs(a + b) > 3.0
    assert carve(a, b, 3.0)[outside] == pytest.approx(np.maximum(a, -b)[outside])


def test_shaping_keeps_to_its_box(points: np.ndarray) -> None:
    result = shaped(points, np.zeros(points.shape[1]), (0, 0, 0), (40, 40, 40), lambda p, field: field + p[0])
    inside = (points > 0).all(axis=0)
    assert np.array_equal(result, np.where(inside, points[0], 0.0))


def test_lines_of_a_ball_give_a_ball() -> None:
    heights = np.linspace(-RADIUS, RADIUS, 21)
    half = np.sqrt(RADIUS**2 - heights**2)
    body = Lines([Section(y, r, 0.0, r, -r) for y, r in zip(heights, half)])
    directions = np.random.default_rng(3).normal(size=(3, 200))
    directions /= np.linalg.norm(directions, axis=0)
    for radius in (0.9 * RADIUS, RADIUS, 1.1 * RADIUS):
        assert body(radius * directions) == pytest.approx(radius - RADIUS, abs=0.7)


def test_fuller_lines_swell_between_their_ends_only() -> None:
    def body(fullness: float) -> Lines:
        return Lines([Section(y, 10, 0, 12, -8, fullness, fullness) for y in (-50.0, 0.0, 50.0)])

    ends = np.array([(10.0, 0, 0), (0, 0, 12.0), (0, 0, -8.0)]).T
    assert body(0.2)(ends) == pytest.approx(0.0, abs=1e-3)
    diagonal = np.array([[8.0], [0.0], [9.6]])
    assert body(0.2)(diagonal) < body(0.0)(diagonal) - 0.5


def test_marching_cubes_end_in_the_plane_of_the_box() -> None:
    vertices, faces = polygonise(ball, (0, -30, -30), (30, 30, 30), 2.0)
    assert np.abs(ball(vertices)).max() < 0.1
    (loop,) = igl.boundary_loop_all(faces)
    assert (vertices[loop, 0] == 0.0).all()
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0  # positive: faces look outward
    assert volume == pytest.approx(2.0 / 3.0 * np.pi * RADIUS**3, rel=0.02)


def test_remeshing_reaches_the_wanted_lengths_and_keeps_the_border() -> None:
    surface = Surface(
        onto=onto_ball,
        size=lambda p: 1.5 + 0.08 * (p[:, 1] + RADIUS),
        planes=lambda p: p[:, :1] == 0.0,
    )
    vertices, faces = polygonise(ball, (0, -30, -30), (30, 30, 30), 2.3)
    vertices, faces = remesh(vertices, faces, surface, rounds=6)
    assert igl.is_edge_manifold(faces)[0]
    edges = igl.edges(faces)
    assert len(vertices) - len(edges) + len(faces) == 1
    (loop,) = igl.boundary_loop_all(faces)
    assert (vertices[loop, 0] == 0.0).all()
    relative = np.linalg.norm(np.diff(vertices[edges], axis=1)[:, 0], axis=1) / surface.size(
        vertices[edges].mean(axis=1)
    )
    assert np.percentile(relative, 1) > 0.6
    assert np.percentile(relative, 99) < 1.45
    corners = vertices[faces]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert (4 * np.sqrt(3) * area / (sides**2).sum(axis=1)).min() > 0.5


def test_the_last_digits_of_a_processor_do_not_change_the_mesh(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sums and powers differ in them from one processor to another, and edges were split and turned otherwise."""
    vertices, faces = skin.sculpted_half()
    rng, clay = np.random.default_rng(0), skin.sculpture
    monkeypatch.setattr(skin, "sculpture", lambda p: clay(p) * (1.0 + 4e-16 * rng.uniform(-1.0, 1.0, len(p))))
    shaken = skin.sculpted_half()
    np.testing.assert_array_equal(shaken[1], faces)
    np.testing.assert_allclose(shaken[0], vertices, atol=1e-5)
