"""Both solvers: against the differential equation, against each other, and against whatever sliders and heads may do."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from headstudio.head.frame import HeadFrame
from headstudio.lcp.dynamics import Circumstances, Dynamics
from headstudio.lcp.implicit import ImplicitSolver
from headstudio.lcp.leapfrog import LeapfrogSolver
from headstudio.lcp.model import HairState
from headstudio.lcp.settings import DynamicsSettings
from headstudio.lcp.springs import Springs
from headstudio.params import assign, parameters_of
from headstudio.scene.motion import YAW, about_axis, swing

from .dome import CENTRE, RADIUS, hanging_chain, no_body

STILL = HeadFrame()
GENTLE = DynamicsSettings(
    elastic_modulus=1e4,
    bending_scale=1.0,
    hold=0.0,
    stiffness=0.0,
    spring_damping=1.0,
    inner_friction=0.0,
    air_friction=0.5,
    interactions=False,
)
SHAKE = about_axis(YAW, swing(math.radians(60), 4.0))  # as far and as fast as the motion's sliders go


class Chain:
    """A chain that hangs in balance and has been given a gentle push, and where it will be half a second later."""

    seconds = 0.5

    def __init__(self):
        self.model = hanging_chain(6, spacing=0.02)
        self.springs = Springs(self.model)
        mass = self.model.mass[0]
        weight = GENTLE.gravity * mass * np.arange(5, 0, -1)  # below each link
        rest = self.springs.at(self.model.rest_positions, GENTLE.elastic_modulus).stiffness
        self.start = self.model.rest_positions.copy()
        self.start[1:, 1] -= np.cumsum(weight / rest)
        self.push = np.outer(self.start[:, 1] / self.start[-1, 1], [0.2, 0.0, 0.1])

        def motion(_, y):
            x, v = y.reshape(2, 6, 3)
            links = self.springs.at(x, GENTLE.elastic_modulus)
            a = (
                self.springs.forces(links, self.springs.load(links, GENTLE), v) / mass
                - GENTLE.air_friction * v
                + [0, -GENTLE.gravity, 0]
            )
            a[0] = 0
            return np.concatenate([v.ravel(), a.ravel()])

        begin = np.concatenate([self.start.ravel(), self.push.ravel()])
        solved = solve_ivp(motion, (0, self.seconds), begin, method="LSODA", rtol=1e-8, atol=1e-11)
        self.end = solved.y[:18, -1].reshape(6, 3)

    def error(self, make_solver, rate, tuning=GENTLE):
        solver = make_solver(Dynamics(self.model, no_body()))
        state = HairState(self.start, self.push, self.model.rest_directions)
        for _ in range(round(self.seconds * rate)):
            state = solver.step(state, Circumstances(tuning, STILL), 1 / rate)
        return np.linalg.norm(state.positions - self.end, axis=1).max()


@pytest.fixture(scope="module")
def chain():
    return Chain()


def test_the_chain_swings_by_a_centimetre(chain):
    assert np.linalg.norm(chain.end[-1] - chain.start[-1]) > 0.01


def test_the_real_time_solver_is_of_second_order(chain):
    def exact(dynamics):
        return ImplicitSolver(dynamics, parts=2, tolerance=1e-6)

    coarse, middle, fine = (chain.error(exact, rate) for rate in (60, 120, 240))
    assert coarse < 1e-3
    assert coarse / middle > 3.2
    assert middle / fine > 3.2


def test_the_reference_is_the_solution(chain):
    assert chain.error(LeapfrogSolver, 60) < 2e-5


@pytest.mark.parametrize(
    "damping", [DynamicsSettings().spring_damping, parameters_of(DynamicsSettings)["spring_damping"].high]
)
def test_the_reference_is_stable_whatever_the_damping(chain, damping):
    """More damping swings no wider: the chain stays within the swing it has without."""
    assert chain.error(LeapfrogSolver, 60, replace(GENTLE, spring_damping=damping)) < 0.01


def shaken(hair, ball, tuning, seconds=0.7, motion=SHAKE, solver=ImplicitSolver, state=None):
    """Every state of hair on a head in motion, at the display's rate."""
    solver = solver(Dynamics(hair, ball))
    states = [state or HairState.at_rest(hair)]
    for k in range(round(60 * seconds)):
        now = Circumstances(tuning, motion((k + 1) / 60), None, motion)
        states.append(solver.step(states[-1], now, 1 / 60))
    return states


def ends_of_sliders():
    return [
        pytest.param({name: value}, id=f"{name}={value:g}")
        for name, declared in parameters_of(DynamicsSettings).items()
        for value in ((False, True) if declared.kind == "switch" else (declared.low, declared.high))
    ]


@pytest.mark.parametrize("change", ends_of_sliders())
def test_no_slider_breaks_hair(hair, ball, change):
    """Shaken by 60 degrees at 4 Hz: finite, on its head, no faster than a head can throw it, no longer than it is."""
    last = shaken(hair, ball, assign(DynamicsSettings(), change))
    for state in last[:: len(last) // 8]:
        check_hair(hair, state)


@pytest.mark.parametrize("end", ["low", "high"])
def test_all_sliders_at_one_end_do_not_break_hair(hair, ball, end):
    declared = parameters_of(DynamicsSettings)
    change = {name: getattr(p, end) for name, p in declared.items() if p.kind == "number"}
    check_hair(hair, shaken(hair, ball, assign(DynamicsSettings(), change))[-1])


def check_hair(hair, state):
    for array in (state.positions, state.velocities, state.directions):
        assert np.all(np.isfinite(array))
    assert np.abs(state.velocities).max() < 40.0
    np.testing.assert_allclose(np.linalg.norm(state.directions, axis=1), 1.0)
    out = hair.arc_length >= hair.smoothing_length
    reach = np.linalg.norm(state.positions - hair.root_points, axis=1)[out] / hair.arc_length[out]
    assert reach.max() <= 1.05


def test_hair_stays_out_of_the_head(hair, ball):
    states = shaken(hair, ball, DynamicsSettings())
    depth = [RADIUS - np.linalg.norm(state.positions[~hair.fixed] - CENTRE, axis=1).min() for state in states]
    assert max(depth) <= 0.005


def test_same_start_same_end_bit_for_bit(hair, ball):
    first, second = (shaken(hair, ball, DynamicsSettings())[-1] for _ in range(2))
    np.testing.assert_array_equal(first.positions, second.positions)
    np.testing.assert_array_equal(first.velocities, second.velocities)
    np.testing.assert_array_equal(first.directions, second.directions)


def kinetic(hair, state):
    return np.sum(hair.mass[:, None] * state.velocities**2)


@pytest.mark.parametrize("tuning", [DynamicsSettings(), DynamicsSettings(interactions=False)], ids=["default", "alone"])
def test_hair_comes_to_rest(hair, ball, tuning):
    """Pushed to one side and then left alone: within 3 s less than a hundredth of the energy is left."""
    rng = np.random.default_rng(1)
    push = np.outer(np.maximum(hair.arc_length, 0) / 0.2, [1.0, 0.0, 0.3]) + rng.normal(scale=0.1, size=(hair.count, 3))
    push[hair.fixed] = 0
    state = replace(HairState.at_rest(hair), velocities=push)
    energy = [kinetic(hair, state) for state in shaken(hair, ball, tuning, 3.0, lambda time: STILL, state=state)]
    assert max(energy[-10:]) < 0.01 * max(energy)


def test_hair_grows_into_a_shape_that_nearly_holds(hair, ball):
    """Left alone from the start, hair sinks a little and comes to rest near where it grew."""
    end = shaken(hair, ball, DynamicsSettings(), 3.0, lambda time: STILL)[-1]
    sunk = np.linalg.norm(end.positions - hair.rest_positions, axis=1)
    assert np.sqrt(np.mean(sunk**2)) < 0.15 * 0.2


def test_root_particles_never_move(hair, ball):
    for state in shaken(hair, ball, DynamicsSettings())[::7]:
        np.testing.assert_allclose(state.positions[hair.fixed], hair.rest_positions[hair.fixed], rtol=0, atol=1e-12)
        np.testing.assert_array_equal(state.velocities[hair.fixed], 0)
        np.testing.assert_array_equal(state.directions[hair.fixed], hair.rest_directions[hair.fixed])


def test_hair_at_rest_in_a_falling_head_only_springs_back():
    """Weightless and undisturbed, a chain without tension stays exactly where it is."""
    model = hanging_chain(5)
    falling = HeadFrame(acceleration=np.array([0.0, -GENTLE.gravity, 0.0]))
    solver = ImplicitSolver(Dynamics(model, no_body()))
    state = HairState.at_rest(model)
    for _ in range(30):
        state = solver.step(state, Circumstances(GENTLE, falling), 1 / 60)
    np.testing.assert_allclose(state.positions, model.rest_positions, atol=1e-12)


def test_time_goes_on(hair, ball):
    assert shaken(hair, ball, DynamicsSettings(), 0.5)[-1].time == pytest.approx(0.5)
