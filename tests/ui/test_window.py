"""The window itself: it opens without a screen, draws itself, and says clearly when it cannot open."""

import os
import subprocess
import sys

import numpy as np
import pytest
from imgui_bundle import imgui

from headstudio.app import theme
from headstudio.app.messages import SECONDS, Messages
from headstudio.app.work import Work
from headstudio.scene.project import load_project
from headstudio.scene.recent import recent_projects

from .conftest import WINDOW


def test_the_whole_window_is_drawn(driver):
    driver.frames(2)
    picture = driver.app.window.picture()
    assert picture.shape == (*WINDOW[::-1], 3)
    ground = np.round(np.array(theme.GROUND) * 255)
    assert np.abs(picture[4, 700] - ground).max() <= 2, "the menu bar"
    rect = driver.rect("Viewport")
    view = picture[int(rect.y) : int(rect.y + rect.height), int(rect.x) : int(rect.x + rect.width)]
    assert view.std() > 12, "a head in the viewport"
    accent = np.abs(picture.astype(int) - np.round(np.array(theme.ACCENT_DEEP) * 255)).max(axis=2) < 12
    assert accent.sum() > 1500, "filled sliders and the tool in the hand"


def test_the_view_is_not_upside_down(driver):
    rect = driver.rect("Viewport")
    picture = driver.app.window.picture()
    view = picture[int(rect.y) : int(rect.y + rect.height), int(rect.x) : int(rect.x + rect.width)]
    shown = driver.app.viewport.picture()[: len(view)].astype(int)
    assert np.abs(view - shown).mean() < 0.2 * np.abs(view - shown[::-1]).mean()


def test_the_panels_can_be_hidden_and_resized(driver):
    before = driver.rect("Viewport")
    x, y = driver.rect("Left edge").centre
    driver.drag((x, y), (x + 40, y))
    assert driver.rect("Viewport").width == pytest.approx(before.width - 40, abs=2)
    driver.drag((x + 40, y), (x, y))
    driver.key(imgui.Key.tab)
    driver.frames(2)
    assert driver.rect("Viewport").width == WINDOW[0]
    driver.key(imgui.Key.tab)
    driver.frames(2)
    assert driver.rect("Viewport").width == pytest.approx(before.width, abs=2)


def test_without_a_display_one_line_says_what_to_do():
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    code = (
        "from headstudio.app import WindowError, main\ntry:\n    main()\nexcept WindowError as error:\n    print(error)"
    )
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, timeout=60)
    assert "headstudio demo" in done.stdout
    assert len(done.stdout.splitlines()) == 1
    assert done.stderr == ""


def test_messages_age_and_go():
    messages = Messages()
    messages.say("one")
    messages.say("two", "error")
    messages.say("one")
    assert [(m.text, m.times) for m in messages.shown] == [("one", 2), ("two", 1)]
    messages.pass_time(SECONDS["info"] + 0.1)
    assert [m.text for m in messages.shown] == ["two"]
    assert [m.text for m in messages.log] == ["one", "two"]


def test_everything_grows_with_the_density_of_the_screen(driver, monkeypatch):
    before = driver.rect("Transport/Play")
    window = type(driver.app.window)
    monkeypatch.setattr(window, "scale", property(lambda self: 1.5))
    driver.frames(3)
    assert driver.rect("Transport/Play").height == pytest.approx(1.5 * before.height, abs=2)
    monkeypatch.undo()
    driver.frames(3)
    assert driver.rect("Transport/Play").height == pytest.approx(before.height, abs=1)


def test_a_failing_program_keeps_the_work(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    work = Work()
    work.set("lcp.gravity", 3.0, "Gravity")
    path = work.rescue()
    assert load_project(path).document.lcp.gravity == 3.0
    assert recent_projects() == [path]
    assert work.modified


def test_a_minimised_window_draws_nothing_and_waits(driver, monkeypatch):
    time = driver.studio.time
    driver.studio.playback.playing = True
    monkeypatch.setattr(type(driver.app.window), "minimised", property(lambda self: True))
    driver.frames(3)
    assert driver.studio.time == time
    monkeypatch.undo()
    driver.frames(3)
    assert driver.studio.time > time
