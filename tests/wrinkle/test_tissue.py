"""Tissue that is pressed together lifts the skin."""

from __future__ import annotations

import numpy as np
import pytest

from headstudio.head.mesh import TriangleMesh
from headstudio.wrinkle.tissue import TissueLift

THICKNESS = 0.008


def sheet(count: int = 41, size: float = 0.1) -> TriangleMesh:
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, count) * size, np.linspace(-0.5, 0.5, count) * size)
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).reshape(-1, 1)
    faces = (corner[:, None] + np.array([[0, 1, count + 1], [0, count + 1, count]])).reshape(-1, 3)
    return TriangleMesh(np.stack([x, y, np.zeros_like(x)], axis=2).reshape(-1, 3), faces)


@pytest.mark.parametrize("squeeze", [0.5, 0.8, 0.95, 1.0, 1.25])
@pytest.mark.parametrize("spread", [0.0, 0.01])
def test_even_compression_lifts_by_the_printed_amount(squeeze, spread):
    mesh = sheet()
    lift = TissueLift(mesh, spread=spread)
    pressed = mesh.vertices * [squeeze, 1.0, 1.0]
    # Areas are measured in single precision: the lift is right within some ten nanometres.
    np.testing.assert_allclose(lift.expansion(pressed), squeeze, rtol=2e-5)
    lifted = lift.lifted(pressed, np.full(len(pressed), THICKNESS))
    np.testing.assert_allclose(lifted[:, 2], THICKNESS / squeeze - THICKNESS, rtol=1e-5, atol=1e-7)
    np.testing.assert_allclose(lifted[:, :2], pressed[:, :2], atol=1e-9)


def test_the_lift_keeps_the_volume_of_the_tissue():
    mesh = sheet(81)
    x = mesh.vertices[:, 0]
    pressed = mesh.vertices.copy()
    pressed[:, 0] -= 0.004 * np.sin(2 * np.pi * x / 0.1)
    for spread in (0.0, 0.006):
        lifted = TissueLift(mesh, spread=spread).lifted(pressed, np.full(len(x), THICKNESS))
        corners = lifted[mesh.faces]
        a, b, c = corners[..., :2].swapaxes(0, 1)
        area = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
        volume = (area * (THICKNESS + corners[..., 2].mean(axis=1))).sum()
        assert volume == pytest.approx(0.1 * 0.1 * THICKNESS, rel=0.01)
        assert np.ptp(lifted[:, 2]) > 0.3 * THICKNESS


def test_a_collapsed_triangle_makes_no_spike():
    mesh = sheet(9)
    flat = mesh.vertices * [0.0, 1.0, 1.0]
    lifted = TissueLift(mesh).lifted(flat, np.full(len(flat), THICKNESS))
    assert np.isfinite(lifted).all()
    assert np.abs(lifted[:, 2]).max() <= 3.0 * THICKNESS * (1 + 1e-9)


def test_two_sides_of_a_fold_do_not_share_their_tissue():
    front = sheet(21)
    back = TriangleMesh(front.vertices + np.array([0.0, 0.0, -0.002]), front.faces[:, ::-1])
    both = TriangleMesh(
        np.concatenate([front.vertices, back.vertices]), np.concatenate([front.faces, back.faces + len(front.vertices)])
    )
    pressed = both.vertices.copy()
    pressed[: len(front.vertices), 0] *= 0.8
    lifted = TissueLift(both).lifted(pressed, np.full(len(pressed), THICKNESS))
    np.testing.assert_allclose(lifted[: len(front.vertices), 2], 0.25 * THICKNESS, rtol=1e-6)
    np.testing.assert_allclose(lifted[len(front.vertices) :], back.vertices, atol=1e-9)


def test_only_the_faces_that_move_are_lifted():
    mesh = sheet(21)
    part = mesh.faces[(mesh.vertices[mesh.faces][..., 0] < 0).all(axis=1)]
    lifted = TissueLift(mesh, part).lifted(0.9 * mesh.vertices, np.full(len(mesh.vertices), THICKNESS))
    touched = np.zeros(len(mesh.vertices), dtype=bool)
    touched[part] = True
    assert (lifted[touched, 2] > 0).all()
    assert not lifted[~touched, 2].any()
