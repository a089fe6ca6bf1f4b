"""Questions to the user: which file, what to do with unsaved work, and the page of keys."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Protocol

from imgui_bundle import imgui, portable_file_dialogs

from . import theme
from .commands import Command
from .file_browser import FileBrowser, FileWish
from .ui import Ui

MOUSE = (
    ("Drag beside the head", "Orbit"),
    ("Alt+drag", "Orbit, also on the head"),
    ("Middle drag, Shift+drag", "Pan"),
    ("Wheel, right drag", "Zoom"),
    ("Drag the head", "Shake it (tool Shake)"),
    ("Ctrl+drag the head", "Move the bust (tool Shake)"),
    ("Right click a parameter", "Back to its default"),
    ("Ctrl+click a slider", "Type a value"),
)


class Question(Protocol):
    """Something that the user is asked in a window over the others."""

    def draw(self, ui: Ui) -> bool:
        """Draw it; True once it is answered."""


class Dialogs:
    """At most one question at a time; the answer goes to the function that came with it."""

    def __init__(self, *, native: bool = True) -> None:
        self._native = native and _has_native_dialogs()
        self._pending: portable_file_dialogs.open_file | portable_file_dialogs.save_file | None = None
        self._browser: FileBrowser | None = None
        self._then: Callable[[Path], object] = lambda path: None
        self._question: Question | None = None
        self._keys_open = False
        self._folder = Path.cwd()

    def ask_file(self, wish: FileWish, then: Callable[[Path], object]) -> None:
        """Let the user choose a file; ``then`` gets its path, unless the user thinks better of it."""
        self._then = then
        if not self._native:
            self._browser = FileBrowser(wish, self._folder)
            return
        pattern = [wish.title, " ".join(f"*{ending}" for ending in wish.endings)]
        if wish.saving:
            self._pending = portable_file_dialogs.save_file(wish.title, str(self._folder / wish.suggestion), pattern)
        else:
            self._pending = portable_file_dialogs.open_file(wish.title, str(self._folder), pattern)

    def ask_unsaved(self, name: str, save: Callable[[Callable[[], None]], None], go_on: Callable[[], None]) -> None:
        """Ask what to do with unsaved work before ``go_on``; ``save`` gets what to do after saving."""
        self._question = _Unsaved(name, save, go_on)

    def ask(self, question: Question) -> None:
        """Ask something else."""
        self._question = question

    def show_keys(self) -> None:
        """Open the page of keys and mouse."""
        self._keys_open = True

    @property
    def asking(self) -> bool:
        """Whether a question stands open, so that keys are not for the scene."""
        return any((self._browser, self._question, self._keys_open, self._pending))

    def draw(self, ui: Ui, commands: Iterable[Command]) -> None:
        """Draw the open question, if there is one, and pass its answer on."""
        self._draw_file(ui)
        question = self._question
        # The answer may be another question.
        if question is not None and question.draw(ui) and self._question is question:
            self._question = None
        if self._keys_open:
            self._draw_keys(ui, commands)

    def _draw_file(self, ui: Ui) -> None:
        chosen: Path | None = None
        if self._browser is not None:
            chosen = self._browser.draw(ui)
            if self._browser.closed:
                self._browser = None
        elif self._pending is not None and self._pending.ready(0):
            answer = self._pending.result()
            self._pending = None
            names = [answer] if isinstance(answer, str) else answer
            chosen = Path(names[0]) if names and names[0] else None
        if chosen is not None:
            self._folder = chosen.parent
            self._then(chosen)

    def _draw_keys(self, ui: Ui, commands: Iterable[Command]) -> None:
        title = "Keys and mouse"
        imgui.open_popup(title)
        centre = imgui.get_main_viewport().get_center()
        imgui.set_next_window_pos((centre.x, centre.y), imgui.Cond_.always.value, (0.5, 0.5))
        shown, stays = imgui.begin_popup_modal(title, True, imgui.WindowFlags_.always_auto_resize.value)
        if not shown:
            self._keys_open = False
            return
        with ui.within(title):
            rows = [(command.keys.replace(" ", ", "), command.label) for command in commands if command.keys]
            _draw_pairs(ui, "Keys", rows)
            imgui.same_line(0, ui.px(28))
            _draw_pairs(ui, "Mouse", MOUSE)
            closed = ui.button("Close", width=ui.px(100))
        if closed or not stays or imgui.is_key_pressed(imgui.Key.escape):
            self._keys_open = False
            imgui.close_current_popup()
        imgui.end_popup()


_NARROW = imgui.TableFlags_.sizing_fixed_fit.value | imgui.TableFlags_.no_host_extend_x.value


class _Unsaved:
    """The question before unsaved work is given up."""

    TITLE = "Unsaved changes"

    def __init__(self, name: str, save: Callable[[Callable[[], None]], None], go_on: Callable[[], None]) -> None:
        self._name, self._save, self._go_on = name, save, go_on

    def draw(self, ui: Ui) -> bool:
        """Draw the question; True once it is answered."""
        imgui.open_popup(self.TITLE)
        centre = imgui.get_main_viewport().get_center()
        imgui.set_next_window_pos((centre.x, centre.y), imgui.Cond_.always.value, (0.5, 0.5))
        if not imgui.begin_popup_modal(self.TITLE, None, imgui.WindowFlags_.always_auto_resize.value)[0]:
            return False
        answer: Callable[[], None] | None = None
        with ui.within(self.TITLE):
            imgui.text_unformatted(f"{self._name} has changes that are not saved.")
            imgui.dummy((0, ui.px(6)))
            if ui.button("Save", on=True, width=ui.px(110)):
                answer = self._save_first
            imgui.same_line()
            if ui.button("Discard", width=ui.px(110)):
                answer = self._go_on
            imgui.same_line()
            if ui.button("Cancel", width=ui.px(110)) or imgui.is_key_pressed(imgui.Key.escape):
                answer = _stay
        if answer is not None:
            imgui.close_current_popup()
        imgui.end_popup()
        if answer is not None:
            answer()
        return answer is not None

    def _save_first(self) -> None:
        self._save(self._go_on)


def _stay() -> None:
    return


def _draw_pairs(ui: Ui, heading: str, pairs: Iterable[tuple[str, str]]) -> None:
    imgui.begin_group()
    ui.caption(heading)
    if imgui.begin_table(heading, 2, _NARROW):
        for keys, meaning in pairs:
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.push_style_color(imgui.Col_.text.value, theme.rgba(theme.ACCENT))
            imgui.text_unformatted(keys)
            imgui.pop_style_color()
            imgui.table_next_column()
            imgui.text_unformatted(meaning)
        imgui.end_table()
    imgui.end_group()


def _has_native_dialogs() -> bool:
    """Linux asks a helper program; elsewhere the system has dialogs of its own."""
    return not sys.platform.startswith("linux") or any(map(shutil.which, ("zenity", "kdialog", "matedialog", "qarma")))
