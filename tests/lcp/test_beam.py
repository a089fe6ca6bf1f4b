"""The cantilever beam of the initial shape, against the theory of elastic beams."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_bvp
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

from headstudio.lcp.beam import beam_angles, beam_directions


def shape(root_angle, ratio, joints=48, tip_load=0.0):
    """Angles of one beam that is ``ratio`` bending lengths long."""
    return beam_angles(np.array([root_angle]), np.array([ratio]), 1.0, joints, tip_load)[0]


@pytest.mark.parametrize("root_angle", [-1.2, 0.0, 0.7, 1.3])
@pytest.mark.parametrize("ratio", [0.5, 2.0, 4.0])
def test_it_solves_the_equation_of_the_beam(root_angle, ratio):
    def bend(s, y):
        return np.stack([y[1], (ratio - s) * np.cos(y[0])])

    def ends(root, tip):
        return np.array([root[0] - root_angle, tip[1]])

    s = np.linspace(0, ratio, 60)
    # From a beam that leans down: the shape that hair takes, not one of the curls that are in balance, too.
    guess = np.stack([root_angle + (-np.pi / 2 - root_angle) * np.sin(0.5 * np.pi * s / ratio), np.zeros_like(s)])
    exact = solve_bvp(bend, ends, s, guess, tol=1e-8, max_nodes=20_000)
    assert exact.success
    joints = 400
    middle = (np.arange(joints) + 0.5) * ratio / joints
    np.testing.assert_allclose(shape(root_angle, ratio, joints), exact.sol(middle)[0], atol=2e-4)


def test_its_error_falls_with_the_square_of_its_pieces():
    finest = shape(0.5, 3.0, joints=1296).reshape(48, 27)[:, 13]
    coarse = np.abs(shape(0.5, 3.0, joints=48) - finest).max()
    finer = np.abs(shape(0.5, 3.0, joints=144).reshape(48, 3)[:, 1] - finest).max()
    assert coarse / finer > 7


def test_a_stiff_beam_sinks_by_the_textbook():
    """w L^4 / 8 B at the tip of a horizontal cantilever."""
    ratio = 0.1
    sunk = -ratio * np.sin(shape(0.0, ratio)).mean()
    assert sunk == pytest.approx(ratio**4 / 8, rel=2e-3)


@pytest.mark.parametrize("tip_angle", [0.05, 0.4, 0.9, 1.4])
def test_a_weightless_beam_with_a_load_at_its_tip_is_an_elastica(tip_angle):
    modulus = (1 + np.sin(tip_angle)) / 2
    start = np.arcsin(1 / np.sqrt(2 * modulus))
    load = (ellipk(modulus) - ellipkinc(start, modulus)) ** 2  # P L^2 / B
    sunk = 1 - 2 * (ellipe(modulus) - ellipeinc(start, modulus)) / np.sqrt(load)
    out = np.sqrt(2 * np.sin(tip_angle) / load)
    ratio = 1e-3  # so short that its weight does nothing
    angles = shape(0.0, ratio, joints=600, tip_load=load / ratio**2)
    assert -angles[-1] == pytest.approx(tip_angle, rel=2e-4)
    assert -np.sin(angles).mean() == pytest.approx(sunk, rel=2e-4)
    assert np.cos(angles).mean() == pytest.approx(out, rel=2e-4)


@settings(max_examples=40, deadline=None)
@given(st.floats(-np.pi / 2, 1.55), st.floats(0.0, 200.0))
def test_hair_of_any_length_bends_down_and_never_curls(root_angle, ratio):
    angles = shape(root_angle, ratio)
    assert np.all(angles <= root_angle + 1e-9)
    assert np.all(angles >= -np.pi / 2 - 1e-9)
    assert np.all(np.diff(angles) <= 1e-9)


def test_very_long_hair_hangs_straight_down_behind_its_arch():
    angles = shape(1.4, 200.0, joints=64)
    np.testing.assert_allclose(angles[8:], -np.pi / 2, atol=1e-3)


def test_hair_that_grows_straight_down_stays_straight():
    directions = beam_directions(np.array([[0.0, -1.0, 0.0]]), np.array([0.5]), 0.04)
    np.testing.assert_allclose(directions[0], np.tile([0.0, -1.0, 0.0], (48, 1)), atol=1e-12)


def test_short_hair_that_grows_straight_up_stands():
    directions = beam_directions(np.array([[0.0, 1.0, 0.0]]), np.array([0.03]), 0.04)
    np.testing.assert_allclose(directions[0], np.tile([0.0, 1.0, 0.0], (48, 1)), atol=1e-9)


def test_hair_that_grows_straight_up_has_no_hairpin_in_it():
    """Long hair at the very top falls to some side, or stands: it does not go up and come down through itself."""
    directions = beam_directions(np.array([[0.0, 1.0, 0.0]]), np.array([0.5]), 0.04)[0]
    bends = np.einsum("ij,ij->i", directions[:-1], directions[1:])
    assert bends.min() > 0


def test_it_bends_in_the_plane_of_root_and_gravity():
    rng = np.random.default_rng(5)
    roots = rng.normal(size=(50, 3))
    roots /= np.linalg.norm(roots, axis=1, keepdims=True)
    directions = beam_directions(roots, rng.uniform(0.01, 0.6, 50), 0.04)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=2), 1.0, atol=1e-12)
    out_of_plane = np.cross(roots, [0.0, 1.0, 0.0])
    np.testing.assert_allclose(np.einsum("ikj,ij->ik", directions, out_of_plane), 0, atol=1e-9)


def test_beams_do_not_depend_on_each_other():
    roots, lengths = np.array([0.2, 1.4, -0.8]), np.array([0.3, 12.0, 4.0])
    together = beam_angles(roots, lengths, 1.0)
    alone = np.stack([shape(*one) for one in zip(roots, lengths, strict=True)])
    np.testing.assert_allclose(together, alone, atol=1e-9)
