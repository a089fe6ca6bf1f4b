"""Hair in motion on a whole head: any frame rate, any hiccup, any motion."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.params import assign
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.motion import head_motion
from headstudio.scene.settings import MotionSettings
from headstudio.scene.simulation import STEP_RATE, Simulation

SMALL = assign(Document(), {"head.source": "mannequin", "hair.particles": 300, "motion.kind": "shake"})
SHAKE = head_motion(SMALL.motion)
REST = HeadFrame()
NOWHERE = np.full(3, np.nan)


def still(time):
    return REST


@pytest.fixture(scope="module")
def built():
    return Builder().build(SMALL)


@pytest.fixture
def simulation(built):
    return Simulation(built, SMALL)


def play(simulation, motion, seconds, rate=60):
    """Advance frame by frame; returns the state after every internal step."""
    states, solver = [], simulation.solver
    step = solver.step
    solver.step = lambda *arguments: states.append(step(*arguments)) or states[-1]
    for _ in range(round(seconds * rate)):
        simulation.advance(motion, 1 / rate)
    solver.step = step
    return states


def is_finite(simulation):
    hair = simulation.stage().hair
    arrays = [simulation.state.positions, simulation.state.velocities, hair.positions, hair.directions]
    return all(np.isfinite(array).all() for array in arrays)


# --- any frame rate -------------------------------------------------------------------------------------------------


def test_the_frame_rate_changes_nothing(built):
    """The internal steps are the same, bit for bit, whatever the display asks for."""
    runs = [play(Simulation(built, SMALL), SHAKE, 0.5, rate) for rate in (10, 24, 30, 60, 144)]
    assert {len(states) for states in runs} == {round(0.5 * STEP_RATE)}
    for states in runs[1:]:
        for first, other in zip(runs[0], states, strict=True):
            assert first.time == other.time
            np.testing.assert_array_equal(first.positions, other.positions)
            np.testing.assert_array_equal(first.directions, other.directions)


def test_uneven_frames_change_nothing_either(built, simulation):
    even = play(Simulation(built, SMALL), SHAKE, 0.5)
    rng = np.random.default_rng(2)
    while simulation.time < 0.5 - 1e-6:
        simulation.advance(SHAKE, rng.uniform(0.0, min(0.08, 0.5 - simulation.shown_time)))
    np.testing.assert_array_equal(simulation.state.positions, even[-1].positions)


def test_what_is_shown_lies_between_the_last_two_steps(simulation):
    play(simulation, SHAKE, 0.2)
    first, last = simulation.before, simulation.state
    for part in (0.25, 0.5, 0.75):
        simulation.advance(SHAKE, 0.25 / STEP_RATE)
        assert simulation.state is last
        shown = simulation.stage()
        np.testing.assert_allclose(
            shown.hair.positions, (1 - part) * first.positions + part * last.positions, atol=1e-12
        )
        np.testing.assert_allclose(np.linalg.norm(shown.hair.directions, axis=1), 1.0)
        assert simulation.shown_time == pytest.approx(last.time - (1 - part) / STEP_RATE)
        turned = shown.frame.rotation.as_euler("YXZ")[0]
        assert turned == pytest.approx(SHAKE(simulation.shown_time).rotation.as_euler("YXZ")[0], abs=0.01)


def test_a_hiccup_is_left_out_and_said(simulation):
    simulation.advance(SHAKE, 5.0)
    assert simulation.time == pytest.approx(0.25)
    assert any("hiccup" in note for note in simulation.notes)
    assert is_finite(simulation)


def test_a_slow_frame_is_no_hiccup(simulation):
    play(simulation, SHAKE, 0.4, rate=5)
    assert simulation.time == pytest.approx(0.4)
    assert simulation.notes == []


# --- any motion -----------------------------------------------------------------------------------------------------


def test_the_wildest_shake_is_no_reason_for_a_note(built):
    document = assign(SMALL, {"motion.angle": math.radians(60), "motion.rate": 4.0})
    simulation = Simulation(built, document)
    play(simulation, head_motion(document.motion), 1.0)
    assert simulation.notes == []
    figures = simulation.measure()
    assert all(math.isfinite(value) for value in figures.values())
    assert figures["reach_max"] <= 1.05
    assert figures["penetration_max"] <= 0.005


@pytest.mark.parametrize(
    "elsewhere",
    [HeadFrame(translation=np.array([2.0, 0.0, -1.0])), HeadFrame(rotation=Rotation.from_rotvec([0.0, 0.6, 0.0]))],
    ids=["moved", "turned"],
)
def test_hair_goes_along_when_the_head_is_put_elsewhere(simulation, elsewhere):
    play(simulation, still, 0.5)
    before = simulation.state.positions
    play(simulation, lambda time: elsewhere, 1 / 60)
    # Only where the torso is now is hair pushed away.
    assert np.median(np.linalg.norm(simulation.state.positions - before, axis=1)) < 0.003
    assert any("jump" in note for note in simulation.notes)
    play(simulation, lambda time: elsewhere, 0.3)
    assert len(simulation.notes) == 1
    assert is_finite(simulation)


def broken(frame):
    """A motion that is at rest but for a fifth of a second, when it yields ``frame``."""
    return lambda time: frame if 0.3 < time < 0.5 else REST


NONSENSE = {
    "no acceleration": replace(REST, acceleration=NOWHERE),
    "no angular acceleration": replace(REST, angular_acceleration=NOWHERE),
    "no place": replace(REST, translation=NOWHERE),
    "no velocity": replace(REST, velocity=NOWHERE),
    "a crash": replace(REST, acceleration=np.array([1e6, 0.0, 0.0])),
    "an absurd crash": replace(REST, acceleration=np.array([1e300, 0.0, 0.0])),
    "a centrifuge": replace(REST, angular_velocity=np.array([0.0, 1e5, 0.0])),
}


@pytest.mark.parametrize("frame", NONSENSE.values(), ids=NONSENSE.keys())
def test_no_motion_loses_the_hair(simulation, frame):
    play(simulation, broken(frame), 0.8)
    assert is_finite(simulation)
    assert simulation.time == pytest.approx(0.8)
    assert simulation.measure()["reach_max"] <= 1.05
    assert simulation.measure()["kinetic_energy"] < 0.5  # calm again, once the nonsense is over


@pytest.mark.parametrize("name", [name for name in NONSENSE if name != "a crash"])  # hair outlives that one
def test_a_motion_that_makes_no_sense_is_said(simulation, name):
    frame = NONSENSE[name]
    play(simulation, broken(frame), 0.8)
    assert simulation.notes


@pytest.mark.parametrize("frame", NONSENSE.values(), ids=NONSENSE.keys())
def test_the_head_is_never_shown_nowhere(simulation, frame):
    play(simulation, broken(frame), 0.4)
    shown = simulation.stage().frame
    assert np.isfinite(shown.translation).all()
    assert np.isfinite(shown.rotation.as_matrix()).all()


@pytest.mark.parametrize("frame", NONSENSE.values(), ids=NONSENSE.keys())
def test_no_motion_breaks_the_wind(built, frame):
    simulation = Simulation(built, assign(SMALL, {"wind.on": True}))
    play(simulation, broken(frame), 0.6)
    assert is_finite(simulation)
    assert np.isfinite(simulation.air.positions).all()


def test_what_is_restored_is_the_last_good_state_at_rest(simulation):
    play(simulation, SHAKE, 1.2)
    play(simulation, lambda time: replace(SHAKE(time), angular_velocity=np.array([0.0, 1e5, 0.0])), 1 / 60)
    assert any("restored" in note for note in simulation.notes)
    np.testing.assert_array_equal(simulation.state.velocities, 0)
    assert np.abs(simulation.state.positions - simulation.built.hair.rest_positions).max() > 0.01  # not the first one
    play(simulation, SHAKE, 0.5)
    assert is_finite(simulation)
    assert simulation.time == pytest.approx(1.2 + 1 / 60 + 0.5)


# --- controls -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "changes",
    [{}, {"wind.on": True}],
    ids=["shake", "wind"],
)
def test_after_a_reset_all_is_as_it_was(built, changes):
    simulation = Simulation(built, assign(SMALL, changes))
    first = play(simulation, SHAKE, 0.6)
    simulation.reset()
    assert simulation.time == 0.0
    assert simulation.shown_time == 0.0
    np.testing.assert_array_equal(simulation.stage().hair.positions, built.hair.rest_positions)
    second = play(simulation, SHAKE, 0.6)
    np.testing.assert_array_equal(first[-1].positions, second[-1].positions)


def test_two_simulations_of_one_document_are_one(built):
    document = assign(SMALL, {"wind.on": True})
    ends = [play(Simulation(built, document), SHAKE, 0.4)[-1] for _ in range(2)]
    np.testing.assert_array_equal(ends[0].positions, ends[1].positions)
    np.testing.assert_array_equal(ends[0].velocities, ends[1].velocities)


def test_live_parameters_act_from_the_next_step(built, simulation):
    other = Simulation(built, SMALL)
    play(simulation, still, 0.3)
    play(other, still, 0.3)
    other.retune(assign(SMALL, {"lcp.gravity": 0.0, "lcp.elastic_modulus": 1e6}))
    np.testing.assert_array_equal(simulation.state.positions, other.state.positions)
    play(simulation, still, 0.2)
    play(other, still, 0.2)
    rise = other.state.positions[:, 1] - simulation.state.positions[:, 1]
    assert rise[~built.hair.fixed].mean() > 0.0005
    assert other.built is built


def test_hair_lags_behind_a_turning_head(simulation):
    """Seen from the head, the tips of hair go against the turn that begins."""
    turn = head_motion(MotionSettings(kind="turn", rate=2.0))
    play(simulation, turn, 0.35)
    hair = simulation.built.hair
    back_tips = (hair.arc_length > 0.7 * hair.arc_length.max()) & (hair.rest_positions[:, 2] < -0.05)
    rested = Simulation(simulation.built, SMALL)
    play(rested, still, 0.35)
    lag = (simulation.state.positions - rested.state.positions)[back_tips, 0].mean()
    assert turn(0.35).rotation.as_euler("YXZ")[0] > 0.1  # the head turns to its left: its back goes to the right
    assert lag > 0.002  # and the hair behind it stays, to the left in the head's frame


def test_hands_part_the_hair_and_it_closes_again(simulation):
    simulation.retune(assign(SMALL, {"motion.kind": "rest"}))
    play(simulation, still, 0.3)
    simulation.hold_apart()
    play(simulation, still, 1.5)
    assert simulation.measure()["gap"] > 0.06
    simulation.release()
    # It does not snap shut: hands come together.
    play(simulation, still, 0.1)
    assert simulation.measure()["gap"] > 0.03
    play(simulation, still, 2.9)
    assert simulation.measure()["gap"] < 0.02
    assert simulation.notes == []


def test_the_motion_split_has_hands_of_its_own(built):
    simulation = Simulation(built, assign(SMALL, {"motion.kind": "split"}))
    play(simulation, still, 0.1)
    assert simulation.parting is None
    play(simulation, still, 1.0)
    assert simulation.parting is not None
    play(simulation, still, 1.0)
    assert simulation.parting is None
    assert simulation.measure()["gap"] >= 0.0


def test_wind_leans_hair_downwind_and_its_momentum_balances(built):
    document = assign(SMALL, {"wind.on": True, "wind.gusts": 0.0, "wind.speed": 8.0, "motion.kind": "rest"})
    blown, calm = Simulation(built, document), Simulation(built, SMALL)
    play(blown, still, 1.5)
    play(calm, still, 1.5)
    lean = (blown.state.positions - calm.state.positions)[~built.hair.fixed]
    assert lean[:, 0].mean() > 0.01  # the default heading is to the person's left
    figures = blown.measure()
    assert figures["air_impulse"] > 0
    assert figures["air_imbalance"] <= 1e-9 * figures["air_impulse"]


def test_the_figures_of_hair_at_rest(simulation):
    figures = simulation.measure()
    assert figures["kinetic_energy"] == 0.0
    assert figures["stretch_max"] == pytest.approx(0.0, abs=1e-9)
    assert figures["reach_max"] <= 1.0 + 1e-9
    assert figures["min_pair_distance"] > 0.0
    assert figures["density_variance"] > 0.0
    assert not any(name.startswith("air_") or name == "gap" for name in figures)


def test_the_reference_solver_goes_the_same_way(built):
    reference = Simulation(built, SMALL, reference=True)
    assert (reference.solver_name, Simulation(built, SMALL).solver_name) == ("leapfrog", "implicit")
    play(reference, still, 0.1)
    assert is_finite(reference)
    assert reference.time == pytest.approx(0.1)


def test_timings_name_the_stages(simulation):
    simulation.advance(SHAKE, 1 / 30)
    assert {"neighbours", "interactions", "springs", "solve", "contact", "directions"} <= set(simulation.timings)
    assert all(spent > 0 for spent in simulation.timings.values())
