"""Recorded head motions."""

import numpy as np
import pytest

from headstudio.scene.take import Take, TakeError

TIMES = np.linspace(2.0, 4.0, 41)
ANGLES = np.stack([0.3 * np.sin(2 * TIMES), 0.5 * np.sin(3 * TIMES), 0.2 * np.cos(TIMES)], axis=1)
PLACES = np.stack([0.1 * np.sin(TIMES), 0.02 * TIMES, 0 * TIMES], axis=1)


@pytest.fixture
def take():
    return Take(TIMES, ANGLES, PLACES)


def test_it_goes_through_its_samples(take):
    for time, angles, place in zip(TIMES, ANGLES, PLACES, strict=True):
        frame = take(time - 2.0)
        pitch, yaw, roll = angles
        np.testing.assert_allclose(frame.rotation.as_euler("YXZ"), [yaw, pitch, roll], atol=1e-12)
        np.testing.assert_allclose(frame.translation, place, atol=1e-12)


def test_its_derivatives_are_those_of_the_spline(take):
    step = 1e-5
    for time in (0.01, 0.513, 1.2, 1.99):
        before, now, after = take(time - step), take(time), take(time + step)
        turn = (after.rotation * before.rotation.inv()).as_rotvec() / (2 * step)
        np.testing.assert_allclose(now.angular_velocity, turn, atol=1e-5)
        np.testing.assert_allclose(now.velocity, (after.translation - before.translation) / (2 * step), atol=1e-6)
        bend = (after.angular_velocity - before.angular_velocity) / (2 * step)
        np.testing.assert_allclose(now.angular_acceleration, bend, atol=1e-3)


def test_it_starts_and_ends_at_rest_and_holds_there(take):
    for time in (-1.0, 0.0, take.seconds, take.seconds + 5):
        np.testing.assert_allclose(take(time).angular_velocity, 0, atol=1e-9)
        np.testing.assert_allclose(take(time).velocity, 0, atol=1e-9)
    np.testing.assert_allclose(take(99.0).translation, PLACES[-1])


def test_an_angle_that_wraps_is_no_whirl():
    times = np.linspace(0, 1, 21)
    angles = np.zeros((21, 3))
    angles[:, 1] = (np.linspace(3.0, 3.4, 21) + np.pi) % (2 * np.pi) - np.pi
    take = Take(times, angles, np.zeros((21, 3)))
    speed = [np.linalg.norm(take(time).angular_velocity) for time in np.linspace(0, 1, 200)]
    assert max(speed) < 1.0


def test_one_moment_is_no_take():
    with pytest.raises(TakeError, match="two moments"):
        Take(np.zeros(1), np.zeros((1, 3)), np.zeros((1, 3)))


def test_time_rises():
    with pytest.raises(TakeError, match="rise"):
        Take(np.zeros(2), np.zeros((2, 3)), np.zeros((2, 3)))
