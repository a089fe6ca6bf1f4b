import dataclasses

import numpy as np
import pytest

from headstudio.head.depth import SkinDepth
from headstudio.head.frame import HeadFrame
from headstudio.head.locate import locator
from headstudio.head.mesh import TriangleMesh
from headstudio.head.mouth import lines_mouth
from headstudio.head.sampling import sample_surface
from headstudio.wisp.proportions import Proportions
from headstudio.wisp.surroundings import Surroundings

from .dressed import body


def beside_skin(head, depth: float, count: int = 4000) -> np.ndarray:
    """Points from ``depth`` below the skin to as far above it."""
    rng = np.random.default_rng(5)
    # No hair gets into a mouth.
    outer = ~lines_mouth(head.skin, head.landmarks)[head.skin.faces].any(axis=1)
    points, normals = sample_surface(TriangleMesh(head.skin.vertices, head.skin.faces[outer]), 0.004)
    chosen = rng.choice(len(points), count)
    return points[chosen] + rng.uniform(-depth, depth, (count, 1)) * normals[chosen]


def beside_scalp(distance) -> np.ndarray:
    """Points so far above the scalp, (k,)."""
    _, scalp, _ = body()
    uv = scalp.random_points(len(distance), np.random.default_rng(6))
    return scalp.points(uv) + distance[:, None] * scalp.normals(uv)


def test_distances_are_those_to_the_mesh():
    head, _, surroundings = body()
    points = beside_scalp(np.linspace(-0.006, 0.006, 3000))
    _, exact = locator(head.skin).nearest(points)
    error = np.abs(np.abs(surroundings.distance(points)) - exact)
    assert np.percentile(error, 95) < 3e-4


def test_the_gradient_leads_away_from_the_skin():
    _, _, surroundings = body()
    skin, above = beside_scalp(np.zeros(2000)), beside_scalp(np.full(2000, 0.004))
    agreement = np.einsum("ij,ij->i", surroundings.gradient(above), (above - skin) / 0.004)
    assert np.percentile(agreement, 2) > 0.97


@pytest.mark.parametrize("margin", [0.0003, 0.001])
def test_no_point_stays_below_the_skin(margin):
    head, _, surroundings = body()
    pushed = surroundings.keep_outside(beside_skin(head, 0.02).astype(np.float32), margin)
    assert SkinDepth(head).deepest(pushed.astype(np.float64), HeadFrame()) < 0.001


def test_points_outside_stay_where_they_are_and_points_inside_go_the_short_way():
    head, _, surroundings = body()
    points = beside_skin(head, 0.01).astype(np.float32)
    depth = -surroundings.distance(points)
    pushed = surroundings.keep_outside(points.copy(), 0.0005)
    moved = np.linalg.norm(pushed - points, axis=1)
    assert np.all(moved[depth < -0.0006] == 0.0)
    inside = depth > 0.001
    assert np.median(moved[inside] / depth[inside]) < 1.6


def test_hair_below_the_bust_stays_out_of_the_body():
    head, _, surroundings = body()
    below = np.array([[0.0, head.skin.bounds[0, 1] - 0.05, 0.0]])
    assert surroundings.distance(below)[0] < -0.01


def test_places_mean_the_same_on_every_head():
    head, _, _ = body()
    marks = head.landmarks
    proportions = Proportions.of(marks)
    assert proportions.measure(marks.left_tragus)[0] == pytest.approx(1.0)
    assert proportions.measure(marks.crown)[1] == pytest.approx(1.0)
    assert proportions.measure(marks.glabella)[2] == pytest.approx(1.0)
    assert proportions.measure(marks.occiput)[2] == pytest.approx(-1.0)
    places = np.random.default_rng(0).normal(size=(20, 3))
    assert proportions.measure(proportions.place(places)) == pytest.approx(places)


def test_a_hole_in_the_face_gets_a_lid_and_changes_nothing_below_it():
    """A socket without an eye, and a mouth: a wall from there to the floor would come out under the jaw."""
    head, _, surroundings = body()
    skin, marks = head.skin, head.landmarks
    holes = [marks.left_eye, marks.right_eye]
    middles = skin.vertices[skin.faces].mean(axis=1)
    gone = np.min([np.linalg.norm(middles - hole, axis=1) for hole in holes], axis=0) < 0.016
    assert gone.any()
    open_head = dataclasses.replace(head, skin=TriangleMesh(skin.vertices, skin.faces[~gone]))
    opened = Surroundings.around(open_head)
    nodes = surroundings.skin_grid.nodes
    below = (nodes[:, 1] < marks.left_eye[1] - 0.05) & (nodes[:, 1] > skin.bounds[0, 1])
    now, before = opened.distance(nodes[below]), surroundings.distance(nodes[below])
    # Away from the skin distances are known to a voxel, but not to the side.
    np.testing.assert_allclose(now[np.abs(before) < 0.004], before[np.abs(before) < 0.004], atol=1e-4)
    np.testing.assert_array_equal(now < 0, before < 0)
    assert opened.distance(np.array(holes) - [0.0, 0.0, 0.03]).max() < 0.0
