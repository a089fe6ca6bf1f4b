"""Hair against the body and at the end of its reach: thesis, eq. 3.19 to 3.24."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from headstudio.head.contact import ContactField
from headstudio.head.frame import HeadFrame
from headstudio.head.mesh import TriangleMesh
from headstudio.head.neck import Neck, turned_by
from headstudio.head.parts import joined
from headstudio.head.rows import row_dot
from headstudio.lcp.body import Body
from headstudio.lcp.contact import LONGEST_REACH, Touching, put_back, stop_at_body, stop_at_reach, touching

from .dome import CENTRE, RADIUS, ball_mesh, hanging_chain

UP = np.array([[0.0, 1.0, 0.0]])
DT = 1 / 60


def at_floor(distance, drift=(0.0, 0.0, 0.0), keep=0.0):
    """One particle over a floor that moves with the velocity ``drift``."""
    return Touching(np.array([distance]), UP, np.array([drift], float), np.array([keep]))


def stopped(velocity, distance, friction=0.0, dt=DT, **floor):
    touch = at_floor(distance, **floor)
    return stop_at_body(np.array([velocity], float), touch, touch.distance, friction, dt)[0][0]


def test_hair_that_leaves_is_left_alone():
    np.testing.assert_allclose(stopped([3.0, 0.5, -1.0], 0.0, friction=2.0), [3.0, 0.5, -1.0])


def test_hair_that_will_not_arrive_is_left_alone():
    np.testing.assert_allclose(stopped([3.0, -0.5, -1.0], 0.02, friction=2.0), [3.0, -0.5, -1.0])


def test_hair_on_the_body_loses_its_normal_velocity():
    """Eq. 3.21: an inelastic stop."""
    np.testing.assert_allclose(stopped([3.0, -0.5, -1.0], 0.0), [3.0, 0.0, -1.0])


def test_hair_that_comes_from_afar_gets_as_far_as_the_surface():
    after = stopped([0.0, -5.0, 0.0], 0.03)
    assert 0.03 + DT * after[1] == pytest.approx(0.0, abs=1e-12)


def test_hair_keeps_its_thickness_from_the_skin():
    after = stopped([0.0, -5.0, 0.0], 0.03, keep=0.01)
    assert 0.03 + DT * after[1] == pytest.approx(0.01)


def test_friction_stops_hair_inside_the_cone_of_coulomb():
    """Eq. 3.23: the floor pushes with 1 m/s, so a coefficient of 0.5 holds what slides slower than 0.5 m/s."""
    np.testing.assert_allclose(stopped([0.3, -1.0, 0.39], 0.0, friction=0.5), 0, atol=1e-12)
    np.testing.assert_allclose(stopped([0.3, -1.0, 0.4], 0.0, friction=0.5), 0, atol=1e-12)


def test_friction_brakes_hair_outside_the_cone():
    np.testing.assert_allclose(stopped([3.0, -1.0, 4.0], 0.0, friction=0.5), [2.7, 0.0, 3.6])


def test_a_moving_body_takes_hair_along():
    """All velocities count against the body's own."""
    np.testing.assert_allclose(stopped([0.0, 0.0, 0.0], 0.0, friction=1.0, drift=(0.5, 2.0, 0.0)), [0.5, 2.0, 0.0])
    np.testing.assert_allclose(stopped([1.0, -3.0, 0.0], 0.0, drift=(0.0, -4.0, 0.0)), [1.0, -3.0, 0.0])


@settings(max_examples=200, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.floats(-0.02, 0.05),
    st.floats(-0.005, 0.01),
    st.floats(0, 2),
    st.sampled_from([1e-4, 1 / 240, 1 / 60]),
)
def test_contact_only_pushes_out_and_only_brakes(seed, distance, keep, friction, dt):
    v, body = np.random.default_rng(seed).normal(size=(2, 3))
    after = stopped(v, distance, friction, dt, drift=tuple(body), keep=keep)
    before, after = v - body, after - body
    pushed = after[1] - before[1]
    assert pushed >= -1e-12
    along, slowed = np.hypot(*before[::2]), np.hypot(*after[::2])
    assert along - slowed <= friction * pushed + 1e-12
    assert slowed <= along + 1e-12
    assert before[::2] @ after[::2] >= -1e-12
    # The step ends above the surface, or at least no deeper than it began.
    assert distance + dt * after[1] >= min(distance, keep) - 1e-12


def test_what_is_below_the_surface_comes_out():
    """Eq. 3.24: the deeper, the faster."""
    shallow, deep = stopped([0, 0, 0], -0.001)[1], stopped([0, 0, 0], -0.004)[1]
    assert 0 < shallow < deep
    depth = 0.01
    for _ in range(12):
        depth -= DT * stopped([0, 0, 0], -depth)[1]
    assert 0 <= depth < 0.001


def test_hair_that_lies_below_a_coarse_plane_at_rest_stays_there():
    np.testing.assert_allclose(stopped([0, 0, 0], -0.003, keep=-0.003), 0)


def test_far_from_the_body_there_is_no_contact():
    touch = Touching(np.array([np.inf]), np.zeros((1, 3)), np.zeros((1, 3)), np.array([0.005]))
    v = np.array([[1.0, -100.0, 3.0]])
    np.testing.assert_array_equal(stop_at_body(v, touch, touch.distance, 1.0, DT)[0], v)


def test_what_is_too_deep_is_put_back_to_the_surface():
    chain = hanging_chain(3)
    touch = Touching(np.array([0.0, -0.05, -0.0001]), np.repeat(UP, 3, axis=0), np.zeros((3, 3)), np.zeros(3))
    moved = put_back(chain, chain.rest_positions, touch, touch.distance) - chain.rest_positions
    assert moved[1, 1] == pytest.approx(0.05, abs=0.005)
    np.testing.assert_allclose(moved[2], 0, atol=1e-12)


def test_root_particles_are_not_lifted():
    chain = hanging_chain(2)
    touch = Touching(np.full(2, -0.05), np.repeat(UP, 2, axis=0), np.zeros((2, 3)), np.zeros(2))
    np.testing.assert_array_equal(
        put_back(chain, chain.rest_positions, touch, touch.distance)[0], chain.rest_positions[0]
    )


def test_what_is_too_far_out_is_put_back_within_its_reach():
    chain = hanging_chain(3, arc_length=np.array([-0.002, 0.05, 0.1]))
    x = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, -2.0], [0.03, 0.0, 0.04]])
    back = put_back(chain, x, no_touch(3), no_touch(3).distance)
    assert np.linalg.norm(back[1]) == pytest.approx(LONGEST_REACH * 0.05, rel=0.03)
    np.testing.assert_allclose(back[1] / np.linalg.norm(back[1]), x[1] / 3)
    np.testing.assert_allclose(back[[0, 2]], x[[0, 2]])


def test_hair_at_rest_touches_nothing_that_moves_it(hair, ball):
    """In the initial state no particle is pushed: hair begins where it may be."""
    touch = touching(hair, ball, hair.rest_positions, HeadFrame())
    still = np.zeros((hair.count, 3))
    free = ~hair.fixed
    assert np.abs(stop_at_body(still, touch, touch.distance, 0.5, DT)[0][free]).max() < 0.1
    np.testing.assert_allclose(
        put_back(hair, hair.rest_positions, touch, touch.distance)[free], hair.rest_positions[free]
    )


def test_falling_hair_stops_on_the_ball(hair, ball):
    """However fast: it ends outside, by no more than the planes are off."""
    rng = np.random.default_rng(1)
    out = rng.normal(size=(hair.count, 3))
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    x = CENTRE + (RADIUS + 0.004) * out
    v = -3.0 * out + rng.normal(size=x.shape)
    touch = touching(hair, ball, x, HeadFrame())
    x = x + DT * stop_at_body(v, touch, touch.distance, 0.3, DT)[0]
    height = np.linalg.norm(x - CENTRE, axis=1) - RADIUS
    assert np.all(height[~hair.fixed] > np.minimum(touch.keep[~hair.fixed], 0.0) - 0.003)


def test_the_torso_stands_still_while_the_head_turns():
    balls = joined([ball_mesh(), ball_mesh(centre=np.array([0.0, -0.2, 0.1]))])
    body = Body(ContactField.around(balls, 0.014), Neck(np.array([0.0, 1.0, 0.0]), -0.02, 0.02))
    frame = HeadFrame(rotation=Rotation.from_rotvec([0.0, 0.8, 0.0]), angular_velocity=np.array([0.0, 3.0, 0.0]))
    on_torso = np.array([[0.02, -0.1, 0.1]])  # in the world
    seen = frame.to_head(on_torso)
    planes = body.planes(seen, frame)
    distance, normals, velocity = planes.distance, planes.normals, planes.velocity
    assert distance[0] == pytest.approx(np.linalg.norm(on_torso[0] - [0, -0.2, 0.1]) - RADIUS, abs=0.002)
    outward = frame.rotation.apply(normals)[0]
    assert outward @ (on_torso[0] - [0, -0.2, 0.1]) > 0.095
    # A point of the torso stands in the world, so against the head it moves back.
    later = HeadFrame(rotation=Rotation.from_rotvec([0.0, 0.8 + 3e-6, 0.0]))
    np.testing.assert_allclose(velocity, (later.to_head(on_torso) - seen) / 1e-6, atol=1e-5)
    on_head = np.array([[0.0, 0.18, 0.0]])
    np.testing.assert_array_equal(body.planes(on_head, frame).velocity, 0)


def test_planes_bend_with_the_neck():
    """A post for a neck, nodded and turned: planes are as far from what is off its skin as the bent skin is."""
    post = trimesh.creation.cylinder(radius=0.05, height=0.5, sections=64)
    post.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0]))
    post = post.subdivide_to_size(0.025)
    neck = Neck(np.array([0.0, 1.0, 0.2]) / np.hypot(1.0, 0.2), 0.05, 0.12)
    skin = TriangleMesh(np.asarray(post.vertices), np.asarray(post.faces))
    body = Body(ContactField.around(skin, 0.007), neck)
    turn = np.array([0.5, 0.3, 0.1])
    frame = HeadFrame(rotation=Rotation.from_rotvec(turn), angular_velocity=np.array([1.0, 0.0, 0.0]))
    bent = skin.moved(turned_by(skin.vertices, turn, neck.share(skin.vertices)))
    on_side = np.abs(skin.vertices[:, 1]) < 0.2
    off = bent.vertices[on_side] + 0.004 * bent.vertex_normals[on_side]
    planes = body.planes(frame.to_head(off), frame)
    assert np.median(np.abs(planes.distance - 0.004)) < 2e-4
    assert np.abs(planes.distance - 0.004).max() < 0.002
    facing = row_dot(frame.rotation.apply(planes.normals), bent.vertex_normals[on_side])
    assert facing.min() > 0.97
    share = neck.share(skin.vertices[on_side])
    np.testing.assert_allclose(planes.velocity[share == 1], 0, atol=1e-5)
    still = frame.to_head(off)[share == 0]
    against_the_head = -np.cross(frame.rotation.inv().apply(frame.angular_velocity), still)
    np.testing.assert_allclose(planes.velocity[share == 0], against_the_head, atol=1e-3)


def no_touch(count):
    return Touching(np.full(count, np.inf), np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count))


def test_hair_reaches_no_farther_than_it_is_long():
    chain = hanging_chain(6, arc_length=np.array([-0.002, 0.01, 0.02, 0.03, 0.04, 0.05]))
    rng = np.random.default_rng(2)
    x, v = chain.rest_positions, rng.normal(scale=5.0, size=(6, 3))
    held = stop_at_reach(chain, x, v, no_touch(6), np.full(6, np.inf), DT)
    after = np.linalg.norm(x + DT * held - chain.root_points, axis=1)
    assert np.all(after[1:] <= LONGEST_REACH * chain.arc_length[1:] * (1 + 1e-9))
    np.testing.assert_array_equal(held[0], v[0])


def test_hair_within_its_reach_is_free():
    chain = hanging_chain(6, arc_length=np.full(6, 0.5))
    v = np.random.default_rng(2).normal(size=(6, 3))
    np.testing.assert_array_equal(stop_at_reach(chain, chain.rest_positions, v, no_touch(6), np.full(6, np.inf), DT), v)


def test_hair_at_the_end_of_its_reach_is_drawn_along_the_body_and_not_into_it():
    chain = hanging_chain(2, arc_length=np.array([-0.002, 0.05]))
    x = np.array([[0.0, 0.0, 0.0], [0.06, 0.01, 0.0]])  # the root lies below and beside, the floor between them
    touch = Touching(np.zeros(2), np.repeat(UP, 2, axis=0), np.zeros((2, 3)), np.zeros(2))
    held = stop_at_reach(chain, x, np.zeros((2, 3)), touch, touch.distance, DT)[1]
    assert held[0] < 0
    assert held[1] == pytest.approx(0.0, abs=1e-12)
    after = np.linalg.norm(x[1] + DT * held)
    assert after == pytest.approx(LONGEST_REACH * 0.05, rel=0.02)
