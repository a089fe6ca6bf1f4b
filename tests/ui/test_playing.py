"""Time: play, pause, step, reset, record; and what was measured on the way."""

import numpy as np
import pytest
from imgui_bundle import imgui
from PIL import Image

from headstudio.app.performance import Performance
from headstudio.app.playback import LONGEST_FRAME, Playback
from headstudio.app.plots import KEPT, Series
from headstudio.app.recorder import FRAMES_PER_SECOND
from headstudio.scene.settings import MotionSettings


def test_space_plays_and_pauses(driver):
    assert driver.studio.time == 0
    driver.key(imgui.Key.space)
    driver.frames(20)
    played = driver.studio.time
    assert played > 0.2
    driver.key(imgui.Key.space)
    paused = driver.studio.time
    driver.frames(5)
    assert driver.studio.time == paused


def test_step_goes_on_by_one_display_step(driver):
    driver.click("Transport/Step")
    assert driver.studio.time == pytest.approx(1 / 60)
    driver.key(imgui.Key.right_arrow)
    assert driver.studio.time == pytest.approx(2 / 60)
    assert not driver.studio.playback.playing


def test_a_motion_moves_the_head_and_reset_brings_it_back(driver):
    driver.click("Motion/Shake")
    driver.frames(25)
    assert driver.studio.playback.playing
    assert driver.studio.stage.frame.rotation.magnitude() > 0.1
    driver.key(imgui.Key.space)
    driver.key(imgui.Key.home)
    assert driver.studio.time == 0
    assert driver.studio.stage.frame.rotation.magnitude() == 0


def test_a_parameter_reaches_the_running_simulation(driver):
    driver.studio.set("lcp.gravity", 0.5, "Gravity")
    driver.frames(2)
    assert driver.studio.grown.animation.simulation.document.lcp.gravity == 0.5


def test_another_hair_is_grown_beside_the_running_window(driver):
    shown = driver.studio.stage.hair.model
    driver.studio.set("hair.particles", 500, "Particles")
    driver.frames(1)
    assert driver.studio.building
    assert driver.studio.stage.hair.model is shown, "the last hair stays on show"
    driver.built()
    assert driver.studio.grown.animation.simulation.built.hair.count == pytest.approx(500, rel=0.05)


def test_a_build_can_be_cancelled_and_the_change_is_taken_back(driver):
    before = driver.studio.grown
    driver.studio.set("hair.particles", 3000, "Particles")
    driver.until(lambda: driver.shown("Cancel"))
    driver.click("Cancel")
    driver.frames(2)
    assert not driver.studio.building
    assert driver.studio.grown is before
    assert driver.studio.document.hair.particles == 300
    driver.until(lambda: driver.studio.builds.seconds == 0)
    driver.frames(3)
    assert driver.studio.grown is before


@pytest.mark.parametrize("kind", ["folder", "film.mp4"])
def test_a_recording_is_even_in_time(driver, tmp_path, kind):
    driver.app.actions._start_recording(tmp_path / kind)
    start = driver.studio.time
    driver.frames(6)
    assert driver.app.recorder.seconds == pytest.approx(6 / FRAMES_PER_SECOND)
    assert driver.studio.time - start == pytest.approx(6 / FRAMES_PER_SECOND)
    driver.click("Transport/Record")
    assert any("Recorded" in text for text in driver.messages())
    if kind == "folder":
        pictures = sorted((tmp_path / kind).glob("*.png"))
        assert len(pictures) >= 6
        assert np.asarray(Image.open(pictures[0])).std() > 10
    else:
        assert (tmp_path / kind).stat().st_size > 1000


def test_a_recording_that_cannot_be_written_ends_with_a_message(driver, tmp_path):
    (tmp_path / "file").write_text("")
    driver.app.actions._start_recording(tmp_path / "file" / "below")
    driver.frames(3)
    assert not driver.app.recorder.recording
    assert driver.studio.messages.log[-1].kind == "error"


def test_an_error_while_playing_pauses_and_keeps_the_picture(driver, monkeypatch):
    shown = driver.studio.stage.hair.model

    def fail(*args):
        raise FloatingPointError("overflow")

    monkeypatch.setattr(driver.studio.grown.animation, "advance", fail)
    driver.key(imgui.Key.space)
    driver.frames(3)
    assert not driver.studio.playback.playing
    assert driver.studio.stage.hair.model is shown
    assert any("overflow" in text for text in driver.messages())


def test_a_hiccup_is_not_caught_up_with():
    playback = Playback()
    assert playback.take(2.0) == LONGEST_FRAME
    assert playback.take(2.0, fixed=1 / 30) == 1 / 30
    playback.speed = 0.5
    assert playback.take(0.02) == pytest.approx(0.01)


def test_series_keep_the_newest_values_and_start_over_after_a_reset():
    series = Series()
    for k in range(KEPT + 10):
        series.add(k, 2.0 * k)
    times, values = series.arrays
    assert (times[0], times[-1], values[-1]) == (10, KEPT + 9, 2.0 * (KEPT + 9))
    series.add(0.0, 5.0)
    assert series.arrays[1].tolist() == [5.0]


@pytest.mark.parametrize("change", [{"kind": "nod"}, {"angle": 0.2}, {"rate": 3.0}])
def test_another_motion_begins_without_a_jump(change):
    performance = Performance(MotionSettings(kind="shake"))
    at = 1.37
    before, early = performance(at), performance(at - 1e-4)
    performance.follow(MotionSettings(**({"kind": "shake"} | change)), at)
    after, late = performance(at), performance(at + 1e-4)
    assert (after.rotation * before.rotation.inv()).magnitude() < 1e-9
    assert after.angular_velocity == pytest.approx(before.angular_velocity, abs=1e-6)
    drift = (late.rotation * early.rotation.inv()).as_rotvec() / 2e-4
    assert drift == pytest.approx(before.angular_velocity, abs=0.02)
