"""Head motions: the derivatives are those of the poses, and nothing jerks."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from headstudio.scene.motion import combined, frame_from_angles, head_motion
from headstudio.scene.settings import MOTIONS, MotionSettings

STEP = 1e-5
MOVING = ("shake", "nod", "tilt", "turn")


def assert_derivatives_fit(motion, time, step=STEP, tolerance=1e-4):
    """Compare velocities and accelerations of ``motion`` with differences of its poses and velocities."""
    before, now, after = (motion(time + offset) for offset in (-step, 0.0, step))
    turn = (after.rotation * before.rotation.inv()).as_rotvec() / (2 * step)
    scale = 1 + np.linalg.norm(now.angular_acceleration)
    np.testing.assert_allclose(now.angular_velocity, turn, atol=tolerance * scale)
    for now_, before_, after_ in (
        (now.velocity, before.translation, after.translation),
        (now.acceleration, before.velocity, after.velocity),
        (now.angular_acceleration, before.angular_velocity, after.angular_velocity),
    ):
        difference = (after_ - before_) / (2 * step)
        np.testing.assert_allclose(now_, difference, atol=tolerance * (scale + np.linalg.norm(difference)))


def angle(frame):
    return math.degrees(frame.rotation.magnitude())


@pytest.mark.parametrize("kind", MOVING)
@pytest.mark.parametrize("time", [0.0, 0.07, 0.33, 0.5, 1.4, 3.21, 9.9])
def test_derivatives_of_motions_are_exact(kind, time):
    assert_derivatives_fit(head_motion(MotionSettings(kind=kind, angle=0.7, rate=2.0)), time, tolerance=1e-3)


@given(st.lists(st.floats(-3, 3), min_size=9, max_size=9), st.floats(0, 2))
@settings(max_examples=50, deadline=None)
def test_derivatives_of_any_three_angles_are_exact(numbers, time):
    constant, linear, square = np.reshape(numbers, (3, 3))

    def motion(t):
        return frame_from_angles(constant + linear * t + square * t**2, linear + 2 * square * t, 2 * square)

    assert_derivatives_fit(motion, time, tolerance=1e-3)


@pytest.mark.parametrize("kind", MOVING)
def test_a_motion_starts_from_rest(kind):
    first = head_motion(MotionSettings(kind=kind))(0.0)
    for value in (first.rotation.as_rotvec(), first.angular_velocity, first.angular_acceleration):
        np.testing.assert_allclose(value, 0, atol=1e-12)


@pytest.mark.parametrize("kind", MOVING)
def test_the_acceleration_never_jumps(kind):
    motion = head_motion(MotionSettings(kind=kind))
    times = np.arange(0, 6, 1e-3)
    acceleration = np.array([motion(time).angular_acceleration for time in times])
    jumps = np.linalg.norm(np.diff(acceleration, axis=0), axis=1)
    assert jumps.max() < 0.02 * np.linalg.norm(acceleration, axis=1).max()


def test_a_shake_reaches_its_angle_on_both_sides_at_its_rate():
    motion = head_motion(MotionSettings(kind="shake", angle=math.radians(40), rate=2.0))
    yaw = [motion(time).rotation.as_euler("YXZ", degrees=True)[0] for time in np.arange(1, 2, 1 / 80)]
    assert max(yaw) == pytest.approx(40)
    assert min(yaw) == pytest.approx(-40)
    np.testing.assert_allclose(yaw[:40], yaw[40:], atol=1e-9)


def test_every_motion_turns_about_its_own_axis():
    axes = {}
    for kind in MOVING:
        turn = head_motion(MotionSettings(kind=kind))(0.6).rotation.as_rotvec()
        axes[kind] = int(np.argmax(np.abs(turn)))
        assert np.count_nonzero(np.abs(turn) > 1e-12) == 1
    assert axes == {"shake": 1, "nod": 0, "tilt": 2, "turn": 1}


def test_the_chin_drops_first_in_a_nod():
    nose = np.array([[0.0, 0.0, 0.1]])
    assert head_motion(MotionSettings(kind="nod"))(0.1).to_world(nose)[0, 1] < 0


def test_a_turn_holds_still_on_either_side():
    motion = head_motion(MotionSettings(kind="turn", angle=math.radians(40), rate=2.0))
    for time, yaw in ((1.0, 40), (1.7, 40), (3.0, -40), (3.9, -40), (5.5, 40)):
        frame = motion(time)
        assert frame.rotation.as_euler("YXZ", degrees=True)[0] == pytest.approx(yaw)
        np.testing.assert_allclose(frame.angular_velocity, 0, atol=1e-9)


@pytest.mark.parametrize("kind", sorted(set(MOTIONS) - set(MOVING)))
def test_in_the_others_the_head_stands_still(kind):
    frame = head_motion(MotionSettings(kind=kind))(1.23)
    assert angle(frame) == 0
    np.testing.assert_array_equal(frame.translation, 0)


@pytest.mark.parametrize("time", [0.12, 0.7])
def test_one_motion_inside_another_has_exact_derivatives(time):
    outer = head_motion(MotionSettings(kind="tilt", angle=0.5, rate=1.0))
    inner = head_motion(MotionSettings(kind="nod", angle=0.7, rate=2.0))
    assert_derivatives_fit(lambda t: combined(outer(t), inner(t)), time, tolerance=1e-3)
