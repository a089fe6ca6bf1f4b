"""The springs, eq. 7 to 14, on hair small enough to work it out by hand."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.lcp.kernel import kernel
from headstudio.lcp.settings import DynamicsSettings
from headstudio.lcp.springs import HAIR_MATERIAL_DENSITY, Springs

from .dome import bundle, hair_of, hanging_chain

E = 3e5
UNDAMPED = DynamicsSettings(spring_damping=0.0)


def forces_of(springs, links, velocities, settings):
    """Force of the damped springs on every particle under ``settings``."""
    return springs.forces(links, springs.load(links, settings), velocities)


def modulus_on_each_side(model, state):
    """E A of every particle by eq. 10 and 11: the sums over its rootward and its tipward springs [N], (n,) each."""
    pull = model.rest_length * state.stiffness
    rootward_sum = np.bincount(model.links[:, 1], pull, model.count)
    tipward_sum = np.bincount(model.links[:, 0], pull, model.count)
    return rootward_sum, tipward_sum


def test_the_section_of_a_particle_is_that_of_equation_9():
    model = hanging_chain(mass=2e-4)
    np.testing.assert_allclose(Springs(model).section, (2e-4 / HAIR_MATERIAL_DENSITY) ** (2 / 3))


def test_two_springs_share_the_load_as_worked_out_by_hand():
    """One particle on two roots, one of them closer: eq. 7, 13 and 14 with numbers."""
    points = [[0, 0, 0], [0.006, 0, 0], [0, -0.01, 0]]
    h, mass = 0.011, 1e-4
    model = hair_of(points, [[0, -1, 0]] * 3, [(0, 2), (1, 2)], fixed=(0, 1), smoothing_length_links=h, mass=mass)
    moved = np.array([[0, 0, 0], [0.006, 0, 0], [0.001, -0.0115, 0]])
    area = (mass / HAIR_MATERIAL_DENSITY) ** (2 / 3)
    rest = np.array([0.01, np.hypot(0.006, 0.01)])
    aligned = np.array([1.0, 0.01 / rest[1]])
    length = np.array([np.hypot(0.001, 0.0115), np.hypot(0.005, 0.0115)])
    k = aligned * rest * kernel(length, h)  # eq. 5 and 7
    alpha_r = E * area / np.sum(rest * k)  # eq. 13 for the particle
    alpha_t = E * area / (rest * k)  # eq. 13 for each root, which has one spring
    state = Springs(model).at(moved, E)
    np.testing.assert_allclose(state.length, length)
    np.testing.assert_allclose(state.stiffness, (alpha_r + alpha_t) / 2 * k, rtol=1e-12)


@pytest.mark.parametrize("stretch", [0.7, 1.0, 1.2, 1.9])
def test_a_chain_keeps_its_modulus_however_far_it_is_drawn(stretch):
    model = hanging_chain()
    state = Springs(model).at(model.rest_positions * stretch, E)
    rootward, tipward = modulus_on_each_side(model, state)
    wanted = E * Springs(model).section
    np.testing.assert_allclose(rootward[1:], wanted[1:], rtol=1e-9)
    np.testing.assert_allclose(tipward[:-1], wanted[:-1], rtol=1e-9)


@pytest.mark.parametrize("apart", [0.0, 0.005, 0.012, 0.03])
def test_a_bundle_keeps_its_modulus_when_its_strands_part(apart):
    """Eq. 14 averages the two ends of a spring, so each side may be off, but in the mean it is not."""
    model = bundle(strands=3)
    positions = model.rest_positions.copy()
    positions[:, 0] += apart * np.round(positions[:, 0] / 0.01) * (-positions[:, 1] / 0.05)
    state = Springs(model).at(positions, E)
    wanted = E * Springs(model).section
    for side, carries in zip(modulus_on_each_side(model, state), (~model.fixed, model.rest_positions[:, 1] > -0.05)):
        relative = side[carries] / wanted[carries]
        assert relative.mean() == pytest.approx(1.0, abs=0.1)
        assert np.all((relative > 0.5) & (relative < 1.6))


def test_what_is_left_carries_what_has_let_go():
    """Figure 3 of the text: the remaining connections become strong."""
    model = bundle(strands=2, joints=2)
    springs = Springs(model)
    together = springs.at(model.rest_positions, E)
    positions = model.rest_positions.copy()
    positions[[1, 3], 0] += 0.05  # the second strand goes away, taking its own link along
    apart = springs.at(positions, E)
    own = [k for k, (i, j) in enumerate(model.links) if j == i + 2]
    crossing = [k for k in range(4) if k not in own]
    assert np.all(apart.stiffness[crossing] < 1e-2 * apart.stiffness[own].min())  # a lifeline keeps a little
    np.testing.assert_allclose(apart.stiffness[own] * model.rest_length[own], E * springs.section[0], rtol=1e-2)
    assert np.all(apart.stiffness[own] > together.stiffness[own])


def test_the_modulus_scales_all_springs(hair):
    springs = Springs(hair)
    soft, stiff = (springs.at(hair.rest_positions, modulus).stiffness for modulus in (1e5, 1e6))
    np.testing.assert_allclose(stiff, 10 * soft)


def test_a_drawn_spring_pulls_and_a_pushed_one_pushes_less():
    model = hanging_chain(2)
    springs = Springs(model)
    for factor, share in ((1.1, 1.0), (0.9, 0.25)):
        state = springs.at(model.rest_positions * factor, E)
        force = forces_of(springs, state, np.zeros((2, 3)), DynamicsSettings(bending_scale=0.25))
        expected = share * state.stiffness[0] * 0.01 * (factor - 1)
        np.testing.assert_allclose(force, [[0, -expected, 0], [0, expected, 0]], rtol=1e-9)


def test_limp_springs_do_not_push():
    model = hanging_chain(4)
    springs = Springs(model)
    state = springs.at(model.rest_positions * 0.6, E)
    np.testing.assert_array_equal(forces_of(springs, state, np.ones((4, 3)), DynamicsSettings(bending_scale=0.0)), 0)


def shaken(model, seed=1):
    rng = np.random.default_rng(seed)
    size = 0.3 * model.rest_length.mean()
    return (
        model.rest_positions + rng.normal(scale=size, size=(model.count, 3)),
        rng.normal(size=(model.count, 3)),
    )


def test_springs_move_neither_the_whole_nor_turn_it(hair):
    springs = Springs(hair)
    x, v = shaken(hair)
    force = forces_of(springs, springs.at(x, E), v, DynamicsSettings(inner_friction=0.0))
    size = np.abs(force).sum()
    assert size > 1.0
    assert np.linalg.norm(force.sum(axis=0)) < 1e-12 * size
    assert np.linalg.norm(np.cross(x, force).sum(axis=0)) < 1e-12 * size


def test_springs_feel_the_same_wherever_they_are(hair):
    springs = Springs(hair)
    x, v = shaken(hair)
    turn, shift = Rotation.from_rotvec([0.3, -1.2, 0.7]), np.array([0.4, -1.0, 2.0])
    here = forces_of(springs, springs.at(x, E), v, DynamicsSettings())
    there = forces_of(springs, springs.at(turn.apply(x) + shift, E), turn.apply(v), DynamicsSettings())
    np.testing.assert_allclose(there, turn.apply(here), atol=1e-9 * np.abs(here).max())


def test_damping_takes_energy_and_leaves_sideways_motion_alone(hair):
    springs = Springs(hair)
    x, v = shaken(hair)
    state = springs.at(x, E)
    damped = forces_of(springs, state, v, DynamicsSettings(spring_damping=1.0)) - forces_of(springs, state, v, UNDAMPED)
    assert np.sum(damped * v) < 0
    chain = hanging_chain(2)
    chain_springs = Springs(chain)
    state = chain_springs.at(chain.rest_positions * 1.05, E)
    sideways = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, -1.0]])
    np.testing.assert_allclose(
        forces_of(chain_springs, state, sideways, DynamicsSettings()),
        forces_of(chain_springs, state, sideways, UNDAMPED),
    )


def test_critical_damping_is_that_of_two_masses_on_a_spring():
    model = hanging_chain(2, mass=2e-4)
    assert Springs(model).damping(np.array([50.0]), 1.0) == pytest.approx([2 * np.sqrt(50.0 * 1e-4)])


@pytest.mark.parametrize("blow_up", [3.0, 100.0, 1e6])
def test_nothing_is_infinite_when_all_have_parted(hair, blow_up):
    """Farther than 2 h_1 no spring has anything left, and alpha would be 0 / 0."""
    springs = Springs(hair)
    x = hair.rest_positions * blow_up
    state = springs.at(x, E)
    assert np.all(np.isfinite(state.stiffness))
    assert np.all(state.stiffness >= 0)
    force = forces_of(springs, state, np.zeros_like(x), UNDAMPED)
    assert np.all(np.isfinite(force))
    # Every particle is still drawn by its lifeline.
    assert np.all(state.stiffness[hair.lifeline[~hair.fixed]] > 0)


def test_nothing_is_infinite_when_all_are_in_one_place(hair):
    springs = Springs(hair)
    x = np.zeros_like(hair.rest_positions)
    state = springs.at(x, E)
    assert np.all(np.isfinite(forces_of(springs, state, x, DynamicsSettings())))
    assert np.all(np.isfinite(state.stiffness))
