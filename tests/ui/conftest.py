"""One window without a screen for all of these tests; each starts with a small head of hair at rest."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from headstudio.app.application import Application
from headstudio.app.studio import Studio
from headstudio.app.window import Window
from headstudio.params import assign

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
    start = assign(type(studio.document)(), SMALL)
    studio.work.history.reopen(start)
    studio.work.views.reopen(start.camera)
    studio.work.path = None
    studio.messages.shown.clear()
    studio.messages.log.clear()
    studio.playback.playing = False
    driver = Driver(application)
    driver.move(2, 1290)
    driver.built()
    studio.reset()
    driver.frames()
    yield driver
    assert application.window.gl.error == "GL_NO_ERROR"
