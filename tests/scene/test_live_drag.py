"""The head under the mouse."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from headstudio.scene.live_drag import NECK, LiveDrag

FRAME = 1 / 60


def yaw(frame):
    return frame.rotation.as_euler("YXZ")[0]


def held(drag, angles, seconds):
    """Aim at ``angles`` for a while, once a frame; returns the frames between."""
    frames = []
    for time in np.arange(0, seconds, FRAME):
        drag.aim(time, np.asarray(angles))
        frames += [drag(time + part * FRAME) for part in (0.0, 0.25, 0.5, 0.75)]
    return frames


def test_it_stays_where_nobody_pulls():
    np.testing.assert_array_equal(LiveDrag()(3.0).rotation.as_rotvec(), 0)


def test_it_gets_there_without_overshooting():
    frames = held(LiveDrag(), [0.0, 0.6, 0.0], 1.5)
    turned = np.array([yaw(frame) for frame in frames])
    assert turned[-1] == pytest.approx(0.6, abs=1e-3)
    assert np.all(np.diff(turned) > -1e-9)


def test_it_follows_the_place_too():
    drag = LiveDrag()
    drag.aim(0.0, np.zeros(3), np.array([0.05, 0.0, -0.02]))
    np.testing.assert_allclose(drag(2.0).translation, [0.05, 0.0, -0.02], atol=1e-6)


def test_it_turns_no_farther_than_a_neck():
    frames = held(LiveDrag(), [0.0, 30.0, 0.0], 2.0)
    assert yaw(frames[-1]) == pytest.approx(NECK.farthest[1], abs=1e-3)


def test_between_two_aims_the_derivatives_are_exact():
    drag = LiveDrag()
    drag.aim(0.0, np.array([0.1, 0.4, -0.1]), np.array([0.05, 0, 0]))
    drag.aim(0.05, np.array([0.1, -0.4, 0.1]))
    step, time = 1e-5, 0.08
    before, now, after = drag(time - step), drag(time), drag(time + step)
    turn = (after.rotation * before.rotation.inv()).as_rotvec() / (2 * step)
    np.testing.assert_allclose(now.angular_velocity, turn, atol=1e-4)
    np.testing.assert_allclose(now.velocity, (after.translation - before.translation) / (2 * step), atol=1e-5)
    bend = (after.angular_velocity - before.angular_velocity) / (2 * step)
    np.testing.assert_allclose(now.angular_acceleration, bend, atol=1e-2)


def test_pose_and_velocity_never_jump():
    drag = LiveDrag()
    held(drag, [0.2, 0.6, 0.0], 0.1)
    before = drag(0.1)
    drag.aim(0.1, np.array([-0.5, -1.0, 0.3]))
    after = drag(0.1)
    np.testing.assert_allclose(after.rotation.as_quat(), before.rotation.as_quat(), atol=1e-12)
    np.testing.assert_allclose(after.angular_velocity, before.angular_velocity, atol=1e-9)


@given(st.lists(st.floats(-2, 2), min_size=5, max_size=60))
@settings(max_examples=30, deadline=None)
def test_no_mouse_exceeds_what_a_head_can_do(wishes):
    drag = LiveDrag()
    for number, wish in enumerate(wishes):
        drag.aim(number * FRAME, np.array([0.0, wish, 0.0]))
        for part in np.linspace(0, 1, 5):
            frame = drag((number + part) * FRAME)
            assert abs(yaw(frame)) < 1.5 * NECK.farthest[1]
            assert abs(frame.angular_velocity[1]) < 1.1 * NECK.speed[1]
            assert abs(frame.angular_acceleration[1]) < 1.001 * NECK.acceleration[1]


def test_after_a_reset_it_is_at_rest():
    drag = LiveDrag()
    drag.aim(1.0, np.array([0.0, 0.5, 0.0]))
    drag.reset()
    np.testing.assert_array_equal(drag(3.0).rotation.as_rotvec(), 0)


def test_a_solver_that_starts_over_asks_for_earlier_times():
    drag = LiveDrag()
    drag.aim(100.0, np.array([0.0, 0.5, 0.0]))
    assert yaw(drag(0.0)) == pytest.approx(0.0)
