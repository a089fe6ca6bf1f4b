"""Drives the window as a person does: one event a frame, at a fixed frame length, widgets found by their labels."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from imgui_bundle import imgui

from headstudio.app.application import Application
from headstudio.app.ui import Rect
from headstudio.scene.animation import needs

FRAME = 1 / 60


class Driver:
    """Mouse and keyboard for an Application."""

    def __init__(self, app: Application) -> None:
        self.app = app

    @property
    def studio(self):
        return self.app.studio

    def frames(self, count: int = 1) -> None:
        for _ in range(count):
            self.app.frame(FRAME)

    def until(self, happened: Callable[[], bool], seconds: float = 180.0) -> None:
        """Go on until something has happened; the wall clock ends a wait in vain."""
        deadline = time.perf_counter() + seconds
        while not happened():
            assert time.perf_counter() < deadline, "it did not happen"
            self.frames()
            time.sleep(0.002)

    def built(self) -> None:
        """Wait for the hair that the document asks for."""

        def done() -> bool:
            grown, document = self.studio.grown, self.studio.document
            return grown is not None and needs(grown.document) == needs(document)

        self.frames(2)
        self.until(done)
        self.frames(2)

    def rect(self, path: str) -> Rect:
        """Where the widget with this label path, or this end of a path, was drawn."""
        found = {name: rect for name, rect in self.app.ui.rectangles.items() if f"/{name}".endswith(f"/{path}")}
        assert len(found) == 1, f"{path!r} names {sorted(found)} among {sorted(self.app.ui.rectangles)}"
        return next(iter(found.values()))

    def shown(self, path: str) -> bool:
        return any(f"/{name}".endswith(f"/{path}") for name in self.app.ui.rectangles)

    def move(self, x: float, y: float) -> None:
        imgui.get_io().add_mouse_pos_event(x, y)
        self.frames()

    def press(self, button: int = 0) -> None:
        imgui.get_io().add_mouse_button_event(button, True)
        self.frames()

    def release(self, button: int = 0) -> None:
        imgui.get_io().add_mouse_button_event(button, False)
        self.frames()

    def click(self, path: str, button: int = 0, keys: tuple[imgui.Key, ...] = ()) -> None:
        self.click_at(self.rect(path).centre, button, keys)

    def click_at(self, point: tuple[float, float], button: int = 0, keys: tuple[imgui.Key, ...] = ()) -> None:
        self.move(*point)
        self._hold(keys)
        self.press(button)
        self.release(button)
        self._let_go(keys)
        self.frames()

    def drag(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        *,
        button: int = 0,
        keys: tuple[imgui.Key, ...] = (),
        steps: int = 6,
        release: bool = True,
    ) -> None:
        self.move(*start)
        self._hold(keys)
        self.press(button)
        for point in np.linspace(start, end, steps + 1)[1:]:
            self.move(float(point[0]), float(point[1]))
        if release:
            self.release(button)
        self._let_go(keys)
        self.frames()

    def wheel(self, point: tuple[float, float], notches: float) -> None:
        self.move(*point)
        imgui.get_io().add_mouse_wheel_event(0.0, notches)
        self.frames(2)

    def key(self, *keys: imgui.Key) -> None:
        """Press a chord such as (Key.mod_ctrl, Key.z)."""
        self._hold(keys)
        self._let_go(keys)
        self.frames()

    def type(self, text: str) -> None:
        imgui.get_io().add_input_characters_utf8(text)
        self.frames(2)

    def menu(self, menu: str, item: str) -> None:
        self.click(menu)
        self.click(f"{menu}/{item}")

    def messages(self) -> list[str]:
        return [message.text for message in self.studio.messages.log]

    def _hold(self, keys: tuple[imgui.Key, ...]) -> None:
        for key in keys:
            imgui.get_io().add_key_event(key, True)
            self.frames()

    def _let_go(self, keys: tuple[imgui.Key, ...]) -> None:
        for key in reversed(keys):
            imgui.get_io().add_key_event(key, False)
            self.frames()
