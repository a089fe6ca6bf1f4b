"""The bending stiffness that springs lack: the initial shape is one of balance, and a kink straightens."""

import math
from dataclasses import replace

import numpy as np
import pytest

from headstudio.lcp.bending import Bending
from headstudio.lcp.settings import DynamicsSettings

from .dome import hanging_chain

HOLD = DynamicsSettings(hold=1.0)


def across(hair, vectors):
    return vectors - np.einsum("ij,ij->i", vectors, hair.rest_directions)[:, None] * hair.rest_directions


@pytest.mark.parametrize("gravity", [0.0, 1.62, 9.81, 30.0])
def test_at_the_root_the_weight_across_the_hair_is_carried(hair, gravity):
    """What gravity and bending leave there points along the hair; springs take that."""
    tuning = DynamicsSettings(hold=1.0, gravity=gravity)
    left = across(hair, np.array([0.0, -gravity, 0.0]) + Bending(hair).place(hair.rest_positions, tuning))
    begins = ~hair.fixed & (hair.arc_length < 0.25 * hair.bending_length)
    assert np.linalg.norm(left[begins], axis=1).max() <= 0.02 * gravity


def test_nowhere_is_more_than_the_weight_carried(hair):
    weight = np.tile([0.0, -HOLD.gravity, 0.0], (hair.count, 1))
    support = Bending(hair).place(hair.rest_positions, HOLD)
    np.testing.assert_allclose(np.einsum("ij,ij->i", support, hair.rest_directions), 0, atol=1e-9)
    before, after = (np.linalg.norm(across(hair, a), axis=1) for a in (weight, weight + support))
    assert np.all(after <= before + 1e-9)


def test_the_tip_is_freer_than_the_root(hair):
    stiff = Bending(hair).kappa(HOLD)
    order = np.argsort(hair.arc_length)
    assert np.all(np.diff(stiff[order]) <= 1e-12)
    assert stiff[order[-1]] < 1e-2 * stiff[order[0]]


def test_hair_is_drawn_back_to_where_it_grew(hair):
    bending = Bending(hair)
    away = np.random.default_rng(1).normal(scale=0.02, size=(hair.count, 3))
    back = bending.place(hair.rest_positions + away, HOLD) - bending.place(hair.rest_positions, HOLD)
    np.testing.assert_allclose(back, -bending.kappa(HOLD)[:, None] * away, atol=1e-9)


def test_hair_without_hold_is_free(hair):
    np.testing.assert_array_equal(Bending(hair).place(hair.rest_positions + 0.05, DynamicsSettings(hold=0.0)), 0)


def curvature(model, positions, dt=1e-6, velocities=None, directions=None, stiffness=1.0):
    v = np.zeros_like(positions) if velocities is None else velocities
    t = model.rest_directions if directions is None else directions
    bending = Bending(model)
    settings = DynamicsSettings(stiffness=stiffness)
    rigidity = bending.rigidity(settings) * bending.carried(settings, dt)
    return bending.curvature_force(positions, v, bending.rest_turn(t), rigidity)


def test_hair_at_rest_has_the_curvature_it_wants(hair):
    np.testing.assert_allclose(curvature(hair, hair.rest_positions), 0, atol=1e-12)


def test_a_kink_straightens_with_the_moment_of_the_beam():
    """A turn by theta over the distance d costs B theta^2 / 2 d, with B = (m g / d) l^3; its slopes are the forces."""
    d, theta = 0.01, 1e-3
    chain = hanging_chain(7, spacing=d)
    bent = chain.rest_positions.copy()
    bent[4:, 0] += theta * d * np.arange(1, 4)
    moment = chain.mass[0] * 9.81 / d * chain.bending_length**3 * theta / d
    force = curvature(chain, bent)
    np.testing.assert_allclose(force[:, 0], moment / d * np.array([0, 0, -1, 2, -1, 0, 0]), rtol=1e-3, atol=1e-12)
    np.testing.assert_allclose(force[:, 1:], 0, atol=1e-12)


def test_moved_and_stretched_hair_is_not_bent():
    chain = hanging_chain(7)
    stretched = 1.3 * chain.rest_positions + np.array([0.5, -2.0, 0.1])
    np.testing.assert_allclose(curvature(chain, stretched), 0, atol=1e-12)


def test_bending_does_not_push_the_whole(hair):
    rng = np.random.default_rng(1)
    x = hair.rest_positions + rng.normal(scale=0.005, size=(hair.count, 3))
    force = curvature(hair, x, velocities=rng.normal(size=x.shape))
    assert np.all(np.isfinite(force))
    assert np.linalg.norm(force.sum(axis=0)) < 1e-12 * np.abs(force).sum()


def test_curved_hair_that_is_turned_as_a_whole_is_not_bent():
    """The curvature that hair wants turns with its direction."""
    angle = 0.15 * np.arange(7)
    along = np.stack([np.sin(angle), -np.cos(angle), np.zeros(7)], axis=1)
    chain = hanging_chain(7)
    positions = 0.01 * np.concatenate([np.zeros((1, 3)), np.cumsum(along[:-1], axis=0)])
    curved = replace(chain, rest_positions=positions, rest_directions=along)
    turn = np.array([[math.cos(1.0), -math.sin(1.0), 0.0], [math.sin(1.0), math.cos(1.0), 0.0], [0.0, 0.0, 1.0]])
    np.testing.assert_allclose(curvature(curved, positions @ turn.T, directions=along @ turn.T), 0, atol=1e-12)
    straightened = chain.rest_positions
    assert np.abs(curvature(curved, straightened, directions=chain.rest_directions)).max() > 1e-5


def test_hair_without_stiffness_folds_like_cloth(hair):
    rng = np.random.default_rng(2)
    x = hair.rest_positions + rng.normal(scale=0.005, size=(hair.count, 3))
    np.testing.assert_array_equal(curvature(hair, x, stiffness=0.0), 0)


@pytest.mark.parametrize("stiffness", [1.0, 10.0])
@pytest.mark.parametrize("dt", [1e-3, 1 / 120, 1 / 60])
def test_no_step_is_too_long_for_bending(hair, stiffness, dt):
    """The forces are linear, and a step by them turns nothing round: their largest rate stays below 2 / dt."""
    rng = np.random.default_rng(3)
    shape = rng.normal(size=(hair.count, 3))
    rate = 0.0
    for _ in range(60):  # power iteration
        shape[hair.fixed] = 0
        shape /= np.linalg.norm(shape)
        bent = curvature(hair, hair.rest_positions + 1e-6 * shape, dt, stiffness=stiffness)
        image = -(bent - curvature(hair, hair.rest_positions, dt, stiffness=stiffness)) / 1e-6 / hair.mass[:, None]
        rate = np.sum(image * shape)
        shape = image
    assert rate * dt**2 < 4.0
