"""Wind as particles of air, section 3.5."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from headstudio.head.frame import HeadFrame
from headstudio.lcp.kernel import kernel
from headstudio.lcp.settings import WindSettings
from headstudio.lcp.wind import AIR_DENSITY, Wind

from .dome import CENTRE, RADIUS, hanging_chain, no_body

DT = 1 / 60
STEADY = WindSettings(on=True, gusts=0.0, heading=math.pi / 2)  # blows toward +x


def blow(wind, tuning, positions, velocities, seconds=1.5):
    """The air after every step, and what the step gave to the hair and took from the air, [(hair, air)]."""
    air, states, given_and_taken = wind.still_air(), [], []
    for k in range(round(seconds / DT)):
        air, exchange = wind.step(air, tuning, HeadFrame(), positions, velocities, k * DT, DT)
        states.append(air)
        given_and_taken.append((exchange.hair, exchange.air))
    return states, given_and_taken


def later(states):
    """Positions and velocities of all air in the last second, when the wind has arrived everywhere."""
    return (np.concatenate([getattr(air, what) for air in states[-60:]]) for what in ("positions", "velocities"))


@pytest.fixture(scope="module")
def storm(hair, ball):
    """Steady wind past hair that is held still."""
    wind = Wind(hair, ball, seed=3)
    return wind, *blow(wind, STEADY, hair.rest_positions, np.zeros_like(hair.rest_positions))


def test_air_loses_what_hair_gains(storm):
    _, _, steps = storm
    assert any(np.abs(hair).sum() > 0 for hair, _ in steps)
    for hair, air in steps:
        assert np.linalg.norm(hair.sum(axis=0) + air.sum(axis=0)) <= 1e-12 * np.abs(hair).sum()


def test_wind_pushes_downwind(storm):
    _, _, steps = storm
    total = sum(hair.sum(axis=0) for hair, _ in steps[-30:])
    assert total[0] > 0
    assert np.abs(total[1:]).max() < 0.3 * total[0]


def test_air_is_slower_behind_the_hair_than_in_front(storm, hair):
    _, states, _ = storm
    positions, velocities = later(states)
    low, high = hair.rest_positions.min(axis=0), hair.rest_positions.max(axis=0)
    in_line = np.all((positions[:, 1:] > low[1:]) & (positions[:, 1:] < high[1:]), axis=1)
    x, speed = positions[in_line, 0], velocities[in_line, 0]
    front, behind = (x > low[0] - 0.06) & (x < low[0]), (x > high[0]) & (x < high[0] + 0.06)
    assert min(front.sum(), behind.sum()) > 500
    assert speed[behind].mean() < 0.8 * speed[front].mean()


@pytest.mark.parametrize("speed", [4.0, 15.0])
def test_air_does_not_blow_through_the_head(hair, ball, speed):
    """In the head there is next to no air, compared with the shell around it."""
    tuning = WindSettings(on=True, gusts=0.0, speed=speed)
    states, _ = blow(Wind(hair, ball, seed=3), tuning, hair.rest_positions, np.zeros_like(hair.rest_positions))
    positions, _ = later(states)
    height = np.linalg.norm(positions - CENTRE, axis=1) - RADIUS
    shell, core = (0.0, 0.06), (-RADIUS, -0.03)
    around, inside = (
        np.count_nonzero((height > a) & (height < b)) / ((RADIUS + b) ** 3 - (RADIUS + a) ** 3)
        for a, b in (shell, core)
    )
    assert around > 0
    assert inside < 0.01 * around


@pytest.mark.parametrize("speed", [0.5, 4.0, 15.0])
@pytest.mark.parametrize("heading", [math.pi / 2, 0.7, -2.5])
def test_wind_that_meets_nothing_blows_evenly(hair, speed, heading):
    """The speed far away is the speed everywhere, in and out of the box, and so is the density."""
    wind = Wind(hair, no_body(), seed=1)
    downwind = np.array([math.sin(heading), 0.0, math.cos(heading)])
    depth = np.abs(downwind) @ wind.half
    tuning = WindSettings(on=True, gusts=0.0, drag=0.0, speed=speed, heading=heading)
    still = np.zeros((hair.count, 3))
    states, _ = blow(wind, tuning, hair.rest_positions, still, seconds=2.2 * depth / speed + 10 * DT)
    air = states[-1]
    assert air.velocities @ downwind == pytest.approx(speed, rel=0.05)
    inner = np.all(np.abs(air.positions - wind.centre) < wind.half - 0.1, axis=1)
    near = cKDTree(air.positions[inner]).sparse_distance_matrix(cKDTree(air.positions), 0.1, output_type="ndarray")
    density = np.bincount(near["i"], wind.mass * kernel(near["v"], 0.05))
    assert density.mean() == pytest.approx(AIR_DENSITY, rel=0.03)
    assert density == pytest.approx(AIR_DENSITY, rel=0.25)


def test_gusts_change_the_speed_and_not_the_density(hair):
    tuning = WindSettings(on=True, gusts=1.0, drag=0.0, speed=10.0)
    still = np.zeros((hair.count, 3))
    states, _ = blow(Wind(hair, no_body(), seed=1), tuning, hair.rest_positions, still)
    full = states[len(states) // 2 :]
    speeds = [air.velocities[:, 0].mean() for air in full]
    counts = [len(air.positions) for air in full]
    assert max(speeds) > 1.5 * min(speeds)
    assert max(counts) < 1.3 * min(counts)  # layers come and go as a whole


def test_air_does_not_blow_back_at_the_inlet(storm):
    wind, states, _ = storm
    positions, velocities = later(states)
    at_inlet = positions[:, 0] < wind.centre[0] - wind.half[0] + 0.05
    np.testing.assert_allclose(velocities[at_inlet, 0], STEADY.speed)


def test_air_comes_to_rest_when_the_wind_does(storm, hair):
    wind, states, _ = storm
    air, calm = states[-1], WindSettings(on=True, speed=0.0)
    for k in range(180):
        air, _ = wind.step(air, calm, HeadFrame(), hair.rest_positions, np.zeros((hair.count, 3)), k * DT, DT)
    assert len(air.positions) > 0
    assert np.abs(air.velocities).max() < 0.05


@pytest.mark.parametrize("wrong", [np.nan, np.inf, 1e200])
def test_broken_hair_or_head_does_not_break_the_air(storm, hair, wrong):
    wind, states, _ = storm
    positions, velocities = hair.rest_positions.copy(), np.zeros((hair.count, 3))
    positions[7] = wrong
    velocities[11] = wrong
    air, exchange = wind.step(states[-1], STEADY, HeadFrame(), positions, velocities, 0.0, DT)
    assert np.isfinite(air.positions).all()
    assert np.isfinite(air.velocities).all()
    if not np.isfinite(wrong):
        assert not np.isfinite(exchange.hair[[7, 11]]).any()
        assert np.isfinite(np.delete(exchange.hair, [7, 11], axis=0)).all()
    nowhere = HeadFrame(translation=np.full(3, wrong), velocity=np.full(3, wrong))
    everywhere = np.full_like(positions, wrong)
    air, _ = wind.step(states[-1], STEADY, nowhere, everywhere, velocities, 0.0, DT)
    assert np.isfinite(air.positions).all()


def test_air_stays_in_its_box(storm):
    wind, states, _ = storm
    for air in states:
        assert np.all(np.isfinite(air.velocities))
        assert np.all(np.abs(air.positions - wind.centre) <= wind.half + 0.1)


@pytest.mark.parametrize("heading", [0.0, math.pi / 2, math.pi, -2.0])
def test_it_blows_where_it_is_said_to_blow(hair, heading):
    tuning = WindSettings(on=True, gusts=0.0, heading=heading, drag=0.0)
    states, _ = blow(Wind(hair, no_body()), tuning, hair.rest_positions, np.zeros_like(hair.rest_positions), 0.4)
    downwind = np.array([math.sin(heading), 0.0, math.cos(heading)])
    assert states[-1].velocities.mean(axis=0) @ downwind == pytest.approx(tuning.speed, rel=0.1)


def test_without_wind_no_air_enters(hair, ball):
    calm = WindSettings(on=True, speed=0.0)
    states, _ = blow(Wind(hair, ball), calm, hair.rest_positions, np.zeros_like(hair.rest_positions), 0.2)
    assert len(states[-1].positions) == 0


def test_same_seed_same_wind(hair, ball):
    winds = [Wind(hair, ball, seed=5)] * 2 + [Wind(hair, ball, seed=5)]  # again with the same one, and with a new one
    still = np.zeros_like(hair.rest_positions)
    runs = [blow(wind, STEADY, hair.rest_positions, still, 0.3)[0][-1] for wind in winds]
    for run in runs[1:]:
        np.testing.assert_array_equal(runs[0].positions, run.positions)
        np.testing.assert_array_equal(runs[0].velocities, run.velocities)


def test_one_particle_of_air_and_one_of_hair_meet_in_the_middle_at_most():
    chain = hanging_chain(2)
    wind = Wind(chain, no_body())
    place = np.zeros((1, 3))
    hair, hair_v = np.array([[0.0, 0.0, 0.01], [9.0, 0.0, 0.0]]), np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    air_v = np.array([[4.0, 0.0, 0.0]])
    last = 4.0
    for drag in (0.1, 1.0, 5.0):
        for dt in (1e-3, 1 / 60, 10.0):
            exchange = wind.exchange(place, air_v, hair, hair_v, drag, dt)
            blown = hair_v[0] + exchange.hair[0] / chain.mass[0]
            slowed = air_v[0] + exchange.air[0] / wind.mass
            assert 0 < blown[0] <= slowed[0] < 4.0
            last = min(last, slowed[0] - blown[0])
            np.testing.assert_array_equal(exchange.hair[1], 0)
    assert last < 0.1  # the longest step brings them together


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(2, 40), st.floats(0, 5), st.floats(1e-4, 1.0))
def test_drag_never_gives_energy_and_always_balances(seed, airs, hairs, drag, dt):
    rng = np.random.default_rng(seed)
    chain = hanging_chain(hairs, mass=10.0 ** rng.uniform(-6, -2))
    wind = Wind(chain, no_body())
    air, hair = rng.normal(scale=0.05, size=(airs, 3)), rng.normal(scale=0.05, size=(hairs, 3))
    air_v, hair_v = rng.normal(size=(airs, 3)) * 5, rng.normal(size=(hairs, 3))
    exchange = wind.exchange(air, air_v, hair, hair_v, drag, dt)
    gained, lost = exchange.hair.sum(axis=0), exchange.air.sum(axis=0)
    assert np.linalg.norm(gained + lost) <= 1e-12 * max(np.abs(exchange.hair).sum(), 1e-300)
    before = wind.mass * np.sum(air_v**2) + np.sum(chain.mass[:, None] * hair_v**2)
    air_v = air_v + exchange.air / wind.mass
    hair_v = hair_v + exchange.hair / chain.mass[:, None]
    after = wind.mass * np.sum(air_v**2) + np.sum(chain.mass[:, None] * hair_v**2)
    assert after <= before * (1 + 1e-12)
