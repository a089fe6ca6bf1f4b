"""The simulation in a process of its own: the same hair, one frame ahead, and whatever happens to it in between."""

import multiprocessing

import numpy as np
import pytest

from headstudio.head.frame import HeadFrame
from headstudio.params import assign
from headstudio.scene.ahead import SampledMotion, SimulationAhead
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.motion import head_motion
from headstudio.scene.simulation import Simulation

SMALL = assign(Document(), {"head.source": "mannequin", "hair.particles": 150, "motion.kind": "shake"})
SHAKE = head_motion(SMALL.motion)
FRAME = 1 / 30


@pytest.fixture(scope="module")
def built():
    return Builder().build(SMALL)


@pytest.fixture(scope="module")
def running(built):
    simulation = SimulationAhead(built, SMALL)
    assert simulation.wait_for_process()
    return simulation


@pytest.fixture
def ahead(running):
    running.reset()
    running.retune(SMALL)
    return running


def play(simulation, frames, motion=SHAKE):
    for _ in range(frames):
        simulation.advance(motion, FRAME)


def test_it_shows_the_same_hair_one_frame_later(ahead, built):
    plain = Simulation(built, SMALL)
    play(plain, 12)
    play(ahead, 13)
    assert ahead.time == pytest.approx(plain.time)
    moved = np.abs(plain.state.positions - built.hair.rest_positions).max()
    assert np.abs(ahead.state.positions - plain.state.positions).max() < 0.02 * moved
    assert ahead.frame.is_near(plain.frame, 1e-9)
    assert ahead.timings.keys() == plain.timings.keys()
    assert ahead.measure().keys() == plain.measure().keys()


def test_the_first_frame_is_rest(ahead, built):
    play(ahead, 1)
    np.testing.assert_array_equal(ahead.stage().hair.positions, built.hair.rest_positions)


def test_hands_take_hold_while_a_frame_is_on_its_way(ahead):
    play(ahead, 3)
    ahead.hold_apart()
    play(ahead, 20, lambda time: HeadFrame())
    assert ahead.measure()["gap"] > 0.05
    ahead.release()
    play(ahead, 3)
    assert ahead.parting is None


def test_a_reset_is_not_overtaken_by_the_frame_before_it(ahead, built):
    play(ahead, 5)
    ahead.reset()
    assert ahead.time == 0.0
    play(ahead, 2)
    assert ahead.time == pytest.approx(FRAME)


def test_sliders_reach_the_other_process(ahead):
    def heights(gravity):
        ahead.reset()
        ahead.retune(assign(SMALL, {"lcp.gravity": gravity}))
        play(ahead, 10, lambda time: HeadFrame())
        return ahead.state.positions[:, 1].mean()

    assert heights(20.0) < heights(0.0) - 0.001


def test_what_happens_there_is_told_here(ahead):
    away = HeadFrame(translation=np.array([1.0, 0.0, 0.0]))
    play(ahead, 2, lambda time: HeadFrame() if time < 0.05 else away)
    play(ahead, 1, lambda time: away)
    assert any("jumped" in note for note in ahead.notes)
    ahead.notes.clear()


def test_without_the_process_hair_goes_on_and_says_so(built):
    simulation = SimulationAhead(built, SMALL)
    others = set(multiprocessing.active_children())
    assert simulation.wait_for_process()
    play(simulation, 2)
    (process,) = set(multiprocessing.active_children()) - others
    process.terminate()
    process.join()
    play(simulation, 4)
    assert simulation.time > 2 * FRAME
    assert [note for note in simulation.notes if "process" in note] == simulation.notes[:1]


def test_the_process_ends_with_the_simulation(built):
    others = set(multiprocessing.active_children())
    simulation = SimulationAhead(built, SMALL)
    assert simulation.wait_for_process()
    (process,) = set(multiprocessing.active_children()) - others
    del simulation
    process.join(10.0)
    assert not process.is_alive()


def test_a_sampled_motion_is_the_motion():
    sampled = SampledMotion.of(SHAKE, 0.5, 180.0, 7)
    for k in range(7):
        assert sampled(0.5 + k / 180.0) is sampled.frames[k]
        assert sampled.frames[k].is_near(SHAKE(0.5 + k / 180.0), 1e-12)


def test_no_other_frame_is_asked_for(built):
    """What the other process is told about the head is all that a step asks for."""
    simulation = Simulation(built, SMALL)
    play(simulation, 2)
    for seconds in (FRAME, 0.011, 0.2, 0.4, 0.001):
        start, count = simulation.frame_times(seconds)
        asked = []
        simulation.advance(lambda time, asked=asked: asked.append(time) or SHAKE(time), seconds)
        places = (np.array(asked) - start) * 60 * simulation.parts
        np.testing.assert_allclose(places, places.round(), atol=1e-6)
        assert places.max(initial=0) < count
