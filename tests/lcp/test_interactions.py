"""What hair does to hair nearby, eq. 1 and 16 to 18, against loops over pairs."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from headstudio.lcp.density import density
from headstudio.lcp.interactions import hair_hair_forces
from headstudio.lcp.kernel import kernel, kernel_slope
from headstudio.lcp.model import HairState
from headstudio.lcp.neighbours import find_pairs
from headstudio.lcp.settings import DynamicsSettings

from .dome import hair_of

H = 0.01  # smoothing length of hair made by hand
STILL = DynamicsSettings(pressure=0.0, collision=0.0, friction=0.0)
PRESSURE = replace(STILL, pressure=0.5, rest_density=0.2)
COLLISION = replace(STILL, collision=1.0)
FRICTION = replace(STILL, friction=1.0)


def crowd(count=60, seed=1, size=0.04):
    """Hair along the three axes, so that pairs either cross or are parallel, and velocities."""
    rng = np.random.default_rng(seed)
    directions = np.eye(3)[rng.integers(3, size=count)]
    return hair_of(rng.random((count, 3)) * size, directions, [(0, 1)]), rng.normal(size=(count, 3))


def two(apart, t_i=(0, 1, 0), t_j=(0, 1, 0)):
    return hair_of([[0, 0, 0], apart], [t_i, t_j], [(0, 1)])


def forces(model, tuning, velocities=None, dt=0.0):
    v = np.zeros((model.count, 3)) if velocities is None else np.asarray(velocities, float)
    pairs = find_pairs(model.rest_positions, 2 * model.smoothing_length)
    return hair_hair_forces(model, tuning, HairState(model.rest_positions, v, model.rest_directions), pairs, dt)


def everybody(model):
    """Pairs of different particles, both ways round, with x_ij and its length."""
    x = model.rest_positions
    for i in range(model.count):
        for j in range(model.count):
            if i != j:
                yield i, j, x[j] - x[i], np.linalg.norm(x[j] - x[i])


def direction_of_collision(t_i, t_j, x_ij):
    normal = np.cross(t_i, t_j)
    if np.linalg.norm(normal) < 0.1:
        normal = x_ij - (x_ij @ t_i) * t_i
    return normal / np.linalg.norm(normal)


def test_density_is_that_of_equation_1():
    model, _ = crowd()
    by_hand = model.mass * kernel(np.zeros(1), H)
    for i, j, _, r in everybody(model):
        by_hand[i] += model.mass[j] * kernel(np.array(r), H)
    far_too = find_pairs(model.rest_positions, 5 * H)
    np.testing.assert_allclose(density(model.rest_positions, model.mass, far_too, H), by_hand)
    np.testing.assert_allclose(forces(model, STILL)[1], by_hand)


def test_repulsion_is_that_of_equation_16():
    model = replace(crowd()[0], spacing=1e-6)  # nobody is in anybody's elbow room
    force, rho = forces(model, PRESSURE)
    pressure = 0.5 * (rho - 0.2 * model.rest_density)
    assert np.all(pressure > 0)
    by_hand = np.zeros((model.count, 3))
    for i, j, x_ij, r in everybody(model):
        gradient = -kernel_slope(np.array(r), H) * x_ij / r  # of W with respect to x_i
        share = pressure[i] / rho[i] ** 2 + pressure[j] / rho[j] ** 2
        by_hand[i] -= model.mass[i] * model.mass[j] * share * gradient
    np.testing.assert_allclose(force, by_hand, atol=1e-9 * np.abs(by_hand).max())


def test_crowded_hair_parts_and_sparse_hair_comes_together():
    crowded, _ = forces(two([0.004, 0, 0]), replace(PRESSURE, rest_density=0.2))
    assert crowded[0, 0] < 0 < crowded[1, 0]
    sparse, _ = forces(two([0.012, 0, 0]), replace(PRESSURE, rest_density=2.0))
    assert sparse[1, 0] < 0 < sparse[0, 0]


def test_cohesion_does_not_draw_hair_into_clumps():
    """Under the largest cohesion, pairs far closer than the mean distance still drive each other apart."""
    for apart in (0.001, 0.003):
        force, _ = forces(two([apart, 0, 0]), replace(PRESSURE, rest_density=2.0, pressure=2.0))
        assert force[0, 0] < 0 < force[1, 0]


@pytest.mark.parametrize("tuning", [PRESSURE, COLLISION, FRICTION, DynamicsSettings()])
@pytest.mark.parametrize("dt", [0.0, 1 / 60])
def test_hair_gives_what_it_takes(tuning, dt):
    model, v = crowd()
    force, _ = forces(model, tuning, v, dt)
    size = np.abs(force).sum()
    assert size > 0
    assert np.linalg.norm(force.sum(axis=0)) < 1e-12 * size


def test_repulsion_turns_nothing():
    model, _ = crowd()
    force, _ = forces(model, PRESSURE)
    assert np.linalg.norm(np.cross(model.rest_positions, force).sum(axis=0)) < 1e-12 * np.abs(force).sum()


def test_collision_is_that_of_equation_17():
    """Up to the constant d_c, the same for all pairs."""
    model, v = crowd()
    force, _ = forces(model, COLLISION, v)
    by_hand = np.zeros((model.count, 3))
    for i, j, x_ij, r in everybody(model):
        if j < i:
            continue
        normal = direction_of_collision(model.rest_directions[i], model.rest_directions[j], x_ij)
        v_ij = v[j] - v[i]
        if (x_ij @ normal) * (v_ij @ normal) < 0:
            pull = kernel(np.array(r), H) * (v_ij @ normal) * normal
            by_hand[i] += pull
            by_hand[j] -= pull
    constant = np.sum(force * by_hand) / np.sum(by_hand * by_hand)
    assert constant > 0
    np.testing.assert_allclose(force, constant * by_hand, atol=1e-9 * np.abs(force).max())


def test_friction_is_that_of_equation_18():
    model, v = crowd()
    force, _ = forces(model, FRICTION, v)
    by_hand = np.zeros((model.count, 3))
    for i, j, x_ij, r in everybody(model):
        normal = direction_of_collision(model.rest_directions[i], model.rest_directions[j], x_ij)
        v_ij = v[j] - v[i]
        across = v_ij - (v_ij @ normal) * normal
        by_hand[i] += kernel(np.array(r), H) * across
    constant = np.sum(force * by_hand) / np.sum(by_hand * by_hand)
    assert constant > 0
    np.testing.assert_allclose(force, constant * by_hand, atol=1e-9 * np.abs(force).max())


def test_crossing_hair_collides_along_the_normal_of_both():
    model = two([0.001, 0.002, 0.004], t_i=(1, 0, 0), t_j=(0, 1, 0))
    meeting, _ = forces(model, COLLISION, [[0.3, 0.2, 1.0], [0.1, -0.5, -1.0]])
    assert meeting[0, 2] < 0 < meeting[1, 2]  # along x the normal is z, and both are slowed down
    np.testing.assert_allclose(meeting[:, :2], 0, atol=1e-15)
    parting, _ = forces(model, COLLISION, [[0.3, 0.2, -1.0], [0.1, -0.5, 1.0]])
    np.testing.assert_array_equal(parting, 0)


def test_parallel_hair_collides_across_itself():
    model = two([0.004, 0.003, 0.0])
    meeting, _ = forces(model, COLLISION, [[1.0, 5.0, 0.0], [-1.0, -5.0, 0.0]])
    assert meeting[0, 0] < 0 < meeting[1, 0]
    np.testing.assert_allclose(meeting[:, 1:], 0, atol=1e-15)
    sliding, _ = forces(model, COLLISION, [[0.0, 5.0, 0.0], [0.0, -5.0, 0.0]])
    np.testing.assert_allclose(sliding, 0, atol=1e-15)


def test_friction_acts_across_the_normal_only():
    model = two([0.004, 0.003, 0.0])
    force, _ = forces(model, FRICTION, [[1.0, 2.0, 0.5], [-1.0, -2.0, -0.5]])
    np.testing.assert_allclose(force[:, 0], 0, atol=1e-15)
    assert force[0] @ [0, 2.0, 0.5] < 0 < force[1] @ [0, 2.0, 0.5]
    assert force[0, 1] / force[0, 2] == pytest.approx(4.0)


def test_hair_that_moves_together_is_not_slowed_down():
    model, _ = crowd()
    force, _ = forces(model, replace(COLLISION, friction=10.0), np.tile([3.0, -1.0, 0.5], (model.count, 1)), 1 / 60)
    np.testing.assert_array_equal(force, 0)


@settings(max_examples=40, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.floats(0.004, 0.06),
    st.floats(0, 10),
    st.floats(0, 10),
    st.sampled_from([1e-4, 1 / 60, 0.1]),
)
def test_rubbing_never_gives_energy(seed, size, collision, friction, dt):
    """However dense the hair, however strong the damping and long the step: it slows hair down, and does not turn it round."""
    model, v = crowd(40, seed, size)
    force, _ = forces(model, replace(STILL, collision=collision, friction=friction), v, dt)
    after = v + dt * force / model.mass[:, None]
    assert np.all(np.isfinite(after))
    assert np.sum(after**2) <= np.sum(v**2) * (1 + 1e-9)
    assert np.sum(after * v) >= 0


@pytest.mark.parametrize("t_j", [(0, 1, 0), (1, 0, 0), (0, -1, 0)])
@pytest.mark.parametrize("apart", [(0, 0, 0), (0, 0.004, 0)])
def test_nothing_is_infinite_for_hair_in_one_place_or_one_line(t_j, apart):
    force, _ = forces(two(apart, t_j=t_j), DynamicsSettings(), [[0, 1, 0], [0.5, -1, 0]], 1 / 60)
    assert np.all(np.isfinite(force))


def test_hair_on_its_own_feels_nothing():
    model = two([0.05, 0, 0])
    force, rho = forces(model, DynamicsSettings(), [[1, 0, 0], [-1, 0, 0]], 1 / 60)
    np.testing.assert_array_equal(force, 0)
    np.testing.assert_allclose(rho, model.mass * kernel(np.zeros(1), H))
