"""Hair against the body: thesis, eq. 3.19 to 3.24."""

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
from headstudio.lcp.contact import Touching, looked_again, pressed, touching

from .dome import RADIUS, ball_mesh, hanging_chain

UP = np.array([[0.0, 1.0, 0.0]])


def at_floor(distance, velocity=(0.0, 0.0, 0.0), drift=(0.0, 0.0, 0.0), keep=0.01, friction=0.0):
    """What holds one particle over a floor that moves with the velocity ``drift``."""
    chain = hanging_chain(2)
    still = np.zeros((2, 3))
    touch = Touching(still, np.array([1.0, distance]), np.repeat(UP, 2, axis=0), still + drift, np.full(2, keep))
    return chain.mass[1], pressed(chain, touch, still + velocity, friction)


def test_hair_off_the_body_is_left_alone():
    assert len(at_floor(0.0101, velocity=(3.0, -9.0, 1.0), friction=1.0)[1].which) == 0


def test_the_floor_pushes_from_nothing_on():
    """Eq. 3.24, from where hair touches: f_r = k_r times how far it is pressed."""
    mass, touched = at_floor(0.01 - 1e-9)
    np.testing.assert_allclose(touched.forces() / mass, 0, atol=1e-4)
    mass, half = at_floor(0.008)
    _, full = at_floor(0.006)
    np.testing.assert_allclose(full.forces(), 2 * half.forces())
    np.testing.assert_allclose(full.forces() / mass, [[0.0, 60.0, 0.0]])


def test_below_the_skin_it_pushes_harder():
    mass, above = at_floor(0.001)
    _, below = at_floor(-0.001)
    assert below.forces()[0, 1] - above.forces()[0, 1] > 100.0 * mass


def test_hair_that_begins_in_the_skin_is_not_pushed_there():
    assert len(at_floor(-0.003, keep=-0.003)[1].which) == 0
    mass, pushed = at_floor(-0.004, keep=-0.003)
    assert pushed.forces()[0, 1] > 50.0 * mass


def test_falling_hair_comes_to_rest_within_its_thickness():
    """At 1 m/s, in small steps: it does not get through, does not spring back and ends where its weight presses it."""
    height, speed, dt, lowest, highest = 0.02, -1.0, 1e-5, 1.0, 0.0
    for _ in range(40000):
        mass, hold = at_floor(height, velocity=(0.0, speed, 0.0))
        force = hold.forces()[0, 1] if len(hold.which) else 0.0
        speed += dt * (force / mass - 9.81)
        height += dt * speed
        lowest = min(lowest, height)
        highest = max(highest, height if lowest < 0.009 else 0.0)
    assert 0.0 < lowest < 0.008
    assert highest < 0.01
    assert height == pytest.approx(0.01 - 0.004 * 9.81 / 60.0, abs=1e-5)


def test_friction_is_coulombs():
    """Eq. 3.22, 3.23: mu times what presses, against the slip, and not more than it takes to stop what hardly slides."""
    mass, hold = at_floor(0.006, velocity=(3.0, 0.0, 4.0), friction=0.5)
    np.testing.assert_allclose(hold.forces() / mass, [[-18.0, 60.0, -24.0]])
    mass, slow = at_floor(0.006, velocity=(3e-4, 0.0, 4e-4), friction=0.5)
    assert 0 < np.hypot(*slow.forces()[0, ::2]) < 0.11 * 30.0 * mass
    load = np.array([0.01]) / mass
    after = np.array([3e-4, 4e-4]) + load * slow.forces(load)[0, ::2]
    assert np.all(np.abs(after) < 1e-4)


def test_a_moving_body_takes_hair_along():
    """All velocities count against the body's own."""
    mass, hold = at_floor(0.006, velocity=(1.0, -2.0, 0.0), drift=(1.0, -2.0, 0.0), friction=1.0)
    np.testing.assert_allclose(hold.forces() / mass, [[0.0, 60.0, 0.0]], atol=1e-12)
    _, dragged = at_floor(0.006, drift=(2.0, 0.0, 0.0), friction=1.0)
    assert dragged.forces()[0, 0] == pytest.approx(60.0 * mass)


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(-0.02, 0.05), st.floats(-0.005, 0.01), st.floats(0, 2))
def test_contact_pushes_out_and_takes_energy(seed, distance, keep, friction):
    v, body = np.random.default_rng(seed).normal(size=(2, 3))
    mass, hold = at_floor(distance, velocity=v, drift=body, keep=keep, friction=friction)
    assert np.all(hold.push >= 0)
    force = (hold.forces() - hold.push[:, None] * hold.direction).sum(axis=0)
    assert force @ (v - body) <= 1e-12
    assert np.hypot(*force[::2]) <= friction * hold.push.sum() + 1e-9 * mass


def test_hair_is_not_pushed_where_it_begins(hair, ball):
    """In the initial state only grown hair that lies closer than it is thick is pushed: out, by less than its thickness."""
    touch = touching(hair, ball, hair.rest_positions, HeadFrame())
    hold = pressed(hair, touch, np.zeros((hair.count, 3)), 0.5)
    pressed_by = hold.push / hold.stiffness_along
    moved = hold.which[pressed_by > 1e-4]
    assert len(moved)
    assert np.all(hair.arc_length[moved] >= 3.0 * hair.spacing)
    assert pressed_by.max() <= 0.5 * hair.spacing
    assert not np.any(hair.fixed[hold.which])


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


def test_hair_that_came_to_another_plane_sees_it():
    """Between two balls: whoever is within its thickness of either sees it as if it had not come from elsewhere."""
    left, right = ball_mesh(0.05, (-0.055, 0.0, 0.0)), ball_mesh(0.05, (0.055, 0.0, 0.0))
    body = Body(ContactField.around(joined([left, right]), 0.007))
    rng = np.random.default_rng(4)
    count, keep = 3000, 0.004
    x = rng.uniform(-1, 1, (count, 3)) * [0.03, 0.05, 0.05]
    way = rng.normal(scale=0.008, size=(count, 3))
    before, after = body.planes(x), body.planes(x + way)
    touch = Touching(x, before.distance, before.normals, before.velocity, np.full(count, keep))
    again = looked_again(body, touch, x + way, HeadFrame())
    closer = after.distance < keep
    assert np.count_nonzero(closer & (touch.seen_from(x + way).distance > 2 * keep)) > 20
    np.testing.assert_array_equal(again.distance[closer], after.distance[closer])
    np.testing.assert_array_equal(again.normals[closer], after.normals[closer])
    far = touch.distance > 0.04
    np.testing.assert_array_equal(again.distance[far], touch.seen_from(x + way).distance[far])
