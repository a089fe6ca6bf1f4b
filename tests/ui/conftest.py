"""One window without a screen for all of these tests; each starts with a small head of hair at rest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from imgui_bundle import imgui

from headstudio.app.application import EDITORS, Application
from headstudio.app.studio import Studio
from headstudio.app.window import Window
from headstudio.params import assign
from headstudio.scene.document import Document

from . import wrinkle_scenes
from .driver import Driver

SMALL = {"head.source": "mannequin", "hair.particles": 300, "look.shadow_size": 64}
WINDOW = (1000, 1300)


@pytest.fixture(scope="session")
def application() -> Iterator[Application]:
    window = Window("test", WINDOW, headless=True)
    application = Application(window, Studio())
    # Every panel is in sight, and the picture small, for speed.
    application.sizes.foot = 760
    application.studio.work.history.reopen(assign(application.studio.document, SMALL))
    yield application
    window.close()


@pytest.fixture
def driver(application: Application, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Driver]:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    studio = application.studio
    start = assign(Document(), SMALL)
    _begin_with(application, start)
    application.open_editor(EDITORS[0])
    studio.work.hair_as, studio.work.skin_as = start.look.hair_as, start.look.skin_as
    driver = Driver(application)
    driver.move(2, 1290)
    driver.built()
    studio.reset()
    driver.frames()
    yield driver
    assert application.window.gl.error == "GL_NO_ERROR"


@pytest.fixture
def face(application: Application, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Driver]:
    """A face with three furrows and no hair, in its tab. It does not pass by the particles: what is built stays built."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    studio = application.studio
    start = assign(Document(), SMALL | wrinkle_scenes.SMALL)
    _begin_with(application, replace(start, wrinkle=replace(start.wrinkle, furrows=wrinkle_scenes.FURROWS)))
    application.open_editor(EDITORS[2])
    studio.work.hair_as, studio.work.skin_as = "none", "living"
    application.beside.shown = False
    application.viewport.tool = application.tools[0]
    furrows = wrinkle_scenes.tool_of(application, "Furrows").set
    furrows.chosen, furrows.mirror = None, True
    driver = Driver(application)
    driver.move(2, 1290)
    driver.key(imgui.Key["_1"])
    driver.built()
    driver.key(imgui.Key.h)
    studio.reset()
    driver.frames()
    yield driver
    studio.work.history.end_gesture()
    assert application.window.gl.error == "GL_NO_ERROR"


def _begin_with(application: Application, document: Document) -> None:
    """A document as if it had just been opened, and nothing said about it yet."""
    studio = application.studio
    studio.work.history.reopen(document)
    studio.work.views.reopen(document.camera)
    studio.work.path = None
    studio.messages.shown.clear()
    studio.messages.log.clear()
    studio.playback.playing = False
