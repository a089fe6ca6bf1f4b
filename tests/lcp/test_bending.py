"""Bending stiffness near the root: the initial shape is one of balance."""

import numpy as np
import pytest

from headstudio.lcp.bending import Bending
from headstudio.lcp.settings import DynamicsSettings

HOLD = DynamicsSettings(hold=1.0)


def across(hair, vectors):
    return vectors - np.einsum("ij,ij->i", vectors, hair.rest_directions)[:, None] * hair.rest_directions


def test_at_the_root_the_weight_across_the_hair_is_carried(hair):
    """What gravity and bending leave there points along the hair; springs take that."""
    weight = np.array([[0.0, -HOLD.gravity, 0.0]])
    left = across(hair, weight + Bending(hair).acceleration(hair.rest_positions, HOLD))
    begins = ~hair.fixed & (hair.arc_length < 0.25 * hair.bending_length)
    assert np.linalg.norm(left[begins], axis=1).max() < 0.02 * HOLD.gravity


def test_nowhere_is_more_than_the_weight_carried(hair):
    weight = np.tile([0.0, -HOLD.gravity, 0.0], (hair.count, 1))
    support = Bending(hair).acceleration(hair.rest_positions, HOLD)
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
    back = bending.acceleration(hair.rest_positions + away, HOLD) - bending.acceleration(hair.rest_positions, HOLD)
    np.testing.assert_allclose(back, -bending.kappa(HOLD)[:, None] * away, atol=1e-9)


def test_hair_without_hold_is_free(hair):
    free = DynamicsSettings(hold=0.0)
    away = hair.rest_positions + 0.05
    np.testing.assert_array_equal(Bending(hair).acceleration(away, free), 0)


@pytest.mark.parametrize("gravity", [0.0, 1.62, 30.0])
def test_the_weight_that_is_carried_is_the_weight_there_is(hair, gravity):
    tuning = DynamicsSettings(gravity=gravity)
    left = across(hair, np.array([0.0, -gravity, 0.0]) + Bending(hair).acceleration(hair.rest_positions, tuning))
    begins = ~hair.fixed & (hair.arc_length < 0.25 * hair.bending_length)
    assert np.linalg.norm(left[begins], axis=1).max() <= 0.02 * gravity
