"""The laws of Waters' muscles, against their closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from headstudio.wrinkle.muscles import LinearMuscle, SheetMuscle, SphincterMuscle

START, END, ZONE = 0.01, 0.05, np.radians(40.0)
X, Y, Z = np.eye(3)


@pytest.fixture
def linear() -> LinearMuscle:
    return LinearMuscle(np.array([0.01, 0.02, 0.0]), np.array([0.01, 0.06, 0.0]), START, END, ZONE)


@pytest.fixture
def sheet() -> SheetMuscle:
    return SheetMuscle(np.zeros(3), 0.04 * -Y, X, 0.03, START, END)


@pytest.fixture
def ring() -> SphincterMuscle:
    return SphincterMuscle(np.zeros(3), X, Y, 0.03, 0.02, 0.02)


def at(muscle: LinearMuscle, distance: float, angle: float) -> np.ndarray:
    """A point at a distance and an angle from the axis of the cone."""
    return muscle.origin + distance * np.array([np.sin(angle), np.cos(angle), 0.0])


@pytest.mark.parametrize("distance", [0.004, 0.01, 0.02, 0.035, 0.049])
@pytest.mark.parametrize("degrees", [0.0, 12.0, -30.0, 39.0])
def test_linear_muscle_pulls_toward_its_origin_by_the_printed_law(linear, distance, degrees):
    angle = np.radians(degrees)
    point = at(linear, distance, angle)
    fading = 1.0 if distance < START else np.cos(np.pi / 2 * (distance - START) / (END - START))
    expected = (point - linear.origin) * (1 - np.cos(angle) / np.cos(ZONE)) * fading
    np.testing.assert_allclose(linear.field(point[None])[0], expected, atol=1e-15)
    assert expected @ (point - linear.origin) < 0


def test_linear_muscle_leaves_what_is_outside_its_cone(linear):
    outside = [at(linear, 0.02, np.radians(degrees)) for degrees in (41.0, 90.0, 180.0)] + [at(linear, 0.051, 0.0)]
    assert not linear.field(np.array(outside)).any()


@pytest.mark.parametrize("border", [(START, 0.0), (END, 0.1), (0.03, ZONE), (0.0, 0.0)])
def test_linear_muscle_is_continuous_at_its_borders(linear, border):
    distance, angle = border
    steps = 1e-7 * np.array([[-1, 0], [1, 0], [0, -1], [0, 1]])
    around = np.array([at(linear, max(distance + step, 0.0), angle + turn) for step, turn in steps])
    assert np.ptp(linear.field(around), axis=0).max() < 1e-6


def test_sheet_muscle_moves_parallel_fibres_alike(sheet):
    x = np.linspace(-0.011, 0.011, 7)
    field = sheet.field(np.column_stack([x, np.full(7, -0.03), np.zeros(7)]))
    fading = np.cos(np.pi / 2 * (0.03 - START) / (END - START))
    np.testing.assert_allclose(field, np.tile([0.0, 0.03 * fading, 0.0], (7, 1)), atol=1e-15)


def test_sheet_muscle_fades_at_its_sides_and_ends(sheet):
    outside = np.array([[0.0301, -0.03, 0], [0.0, -0.0501, 0], [0.0, 0.01, 0], [0.0, -0.03, 0.061]])
    assert not sheet.field(outside).any()
    nearly = np.array([[0.0299, -0.03, 0], [0.0, -0.0499, 0]])
    assert 0 < np.linalg.norm(sheet.field(nearly), axis=1).max() < 2e-4


def test_sphincter_draws_toward_its_middle_by_the_ellipse(ring):
    points = np.array([[0.01, 0.0, 0.0], [0.0, -0.015, 0.0], [0.012, 0.008, 0.0]])
    lx, ly = ring.half_width, ring.half_height
    inside = 1 - np.sqrt(ly**2 * points[:, 0] ** 2 + lx**2 * points[:, 1] ** 2) / (lx * ly)
    np.testing.assert_allclose(ring.field(points), -inside[:, None] * points, atol=1e-15)


def test_sphincter_leaves_its_border_and_what_is_beyond(ring):
    angle = np.linspace(0, 2 * np.pi, 17)
    border = np.column_stack([0.03 * np.cos(angle), 0.02 * np.sin(angle), np.zeros(17)])
    assert np.abs(ring.field(border)).max() < 1e-15
    assert not ring.field(1.3 * border).any()
    assert not ring.field(np.array([[0.01, 0.0, 0.021]])).any()


def test_sphincter_may_push_its_middle_forward():
    lips = SphincterMuscle(np.zeros(3), X, Y, 0.03, 0.02, 0.02, protrusion=0.004)
    np.testing.assert_allclose(lips.field(np.zeros((1, 3)))[0], 0.004 * Z, atol=1e-15)
