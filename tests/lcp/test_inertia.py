"""What hair feels because its head moves, section 3.5: a free particle must not notice the head at all."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.lcp.dynamics import Circumstances, Dynamics
from headstudio.lcp.implicit import ImplicitSolver
from headstudio.lcp.inertia import apparent_acceleration
from headstudio.lcp.model import HairState
from headstudio.lcp.settings import DynamicsSettings
from headstudio.scene.motion import frame_from_angles

from .dome import hanging_chain, no_body

G = 9.81
LOOSE = DynamicsSettings(
    elastic_modulus=1e-9,
    hold=0.0,
    stiffness=0.0,
    spring_damping=0.0,
    inner_friction=0.0,
    air_friction=0.0,
    interactions=False,
)
X = np.array([[0.1, 0.2, -0.3], [0.0, -0.1, 0.05]])
V = np.array([[1.0, -0.5, 2.0], [0.2, 0.0, -0.4]])


def test_a_head_at_rest_leaves_gravity():
    np.testing.assert_allclose(apparent_acceleration(HeadFrame(), X, V, G), [[0, -G, 0]] * 2)


def test_a_tilted_head_sees_gravity_tilted():
    frame = HeadFrame(rotation=Rotation.from_euler("z", 90, degrees=True))  # the head's x is the world's y
    np.testing.assert_allclose(apparent_acceleration(frame, X, V, G), [[-G, 0, 0]] * 2, atol=1e-12)


def test_a_falling_head_is_weightless():
    frame = HeadFrame(acceleration=np.array([0.0, -G, 0.0]))
    np.testing.assert_allclose(apparent_acceleration(frame, X, V, G), 0, atol=1e-12)


def test_uniform_motion_is_not_felt():
    frame = HeadFrame(velocity=np.array([3.0, 1.0, -2.0]))
    np.testing.assert_allclose(apparent_acceleration(frame, X, V, 0.0), 0, atol=1e-12)


def test_turning_throws_outward_and_aside():
    """Centrifugal and Coriolis acceleration of a head that turns about the vertical."""
    frame = HeadFrame(angular_velocity=np.array([0.0, 3.0, 0.0]))
    felt = apparent_acceleration(frame, np.array([[0.2, 0.5, 0.0]]), np.array([[0.0, 1.0, 0.0]]), 0.0)
    np.testing.assert_allclose(felt, [[9 * 0.2, 0, 0]], atol=1e-12)
    felt = apparent_acceleration(frame, np.zeros((1, 3)), np.array([[1.0, 0.0, 0.0]]), 0.0)
    np.testing.assert_allclose(felt, [[0, 0, 6.0]], atol=1e-12)  # -2 omega x v


def test_starting_to_turn_leaves_hair_behind():
    frame = HeadFrame(angular_acceleration=np.array([0.0, 5.0, 0.0]))
    felt = apparent_acceleration(frame, np.array([[0.2, 0.0, 0.0]]), np.zeros((1, 3)), 0.0)
    np.testing.assert_allclose(felt, [[0, 0, 1.0]], atol=1e-12)  # -alpha x r: against the turn


def _sine(size, rate, time):
    """A row of sines with its two derivatives, (3, k)."""
    size, omega = np.asarray(size), 2 * math.pi * np.asarray(rate)
    return np.stack(
        [size * np.sin(omega * time), size * omega * np.cos(omega * time), -size * omega**2 * np.sin(omega * time)]
    )


def _sliding(time):
    place = _sine([0.3, 0.1, 0.2], [0.7, 1.1, 0.5], time)
    return HeadFrame(translation=place[0], velocity=place[1], acceleration=place[2])


def _spinning(time):
    rate = np.array([0.5, 2.0, -1.0])
    return HeadFrame(rotation=Rotation.from_rotvec(rate * time), angular_velocity=rate)


def _shaking(time):
    return frame_from_angles(*_sine([0.0, 0.7, 0.0], [0.0, 1.0, 0.0], time))


def _everything(time):
    return frame_from_angles(
        *_sine([0.4, 0.7, 0.3], [0.9, 1.3, 0.6], time), *_sine([0.3, 0.1, 0.2], [0.7, 1.1, 0.5], time)
    )


@pytest.mark.parametrize("motion", [_sliding, _spinning, _shaking, _everything])
def test_a_free_particle_flies_on_its_parabola(motion):
    """Followed for a second in the frame of the head, it ends where it would fall in the world."""
    start, end = motion(0.0), motion(1.0)
    x, v = np.array([0.1, 0.2, -0.1]), np.array([0.5, 1.0, -0.7])  # in the world
    seen = start.to_head(x[None])[0]
    spin = np.cross(start.angular_velocity, x - start.translation)
    moving = start.rotation.inv().apply(v - start.velocity - spin)

    def flight(time, y):
        return np.concatenate([y[3:], apparent_acceleration(motion(time), y[None, :3], y[None, 3:], G)[0]])

    solved = solve_ivp(flight, (0, 1), np.concatenate([seen, moving]), rtol=1e-9, atol=1e-10)
    landed = end.to_world(solved.y[None, :3, -1])[0]
    np.testing.assert_allclose(landed, x + v + [0, -0.5 * G, 0], atol=1e-6)


@pytest.mark.parametrize("motion", [_spinning, _shaking, _everything])
def test_the_real_time_solver_follows_it_with_second_order(motion):
    """Loose hair, hardly linked, in a head that moves: half the step leaves a quarter of the error."""

    def error(rate):
        model = hanging_chain(2, spacing=0.1)
        state = HairState(model.rest_positions, np.array([[0.0, 0.0, 0.0], [0.2, 0.6, -0.1]]), model.rest_directions)
        solver = ImplicitSolver(Dynamics(model, no_body()), parts=1, tolerance=1e-6)
        seen = np.concatenate([state.positions[1], state.velocities[1]])

        def flight(time, y):
            return np.concatenate([y[3:], apparent_acceleration(motion(time), y[None, :3], y[None, 3:], G)[0]])

        expected = solve_ivp(flight, (0, 0.05), seen, rtol=1e-10, atol=1e-12).y[:3, -1]
        for step in range(1, round(0.05 * rate) + 1):
            state = solver.step(state, Circumstances(LOOSE, motion(step / rate), motion=motion), 1 / rate)
        return np.linalg.norm(state.positions[1] - expected)

    assert error(200) > 3 * error(400) > 0
