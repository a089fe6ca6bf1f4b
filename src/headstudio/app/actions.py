"""What the menus and keys do."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from imgui_bundle import imgui
from PIL import Image

from ..io.film import FILM_SUFFIXES
from ..io.hair import READABLE
from ..scene.project import SUFFIX
from ..scene.recent import recent_projects
from .commands import Command
from .file_browser import FileWish
from .tools.tool import Tool
from .wisps.hair_files import HairFiles
from .wrinkles.face_files import FaceFiles

if TYPE_CHECKING:
    from .application import Application

HEAD_ENDINGS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
TOOL_KEYS = "QWERTYUIOP"
VIEW_KEYS = {"front": "1", "left": "3", "right": "Ctrl+3", "back": "9", "top": "7", "three-quarter": "0"}


class Actions:
    """The verbs of the application, and the list of commands that names them."""

    def __init__(self, app: Application) -> None:
        self._app = app
        self._studio = app.studio
        self.hair_files = HairFiles(app.studio, app.dialogs)
        self.face_files = FaceFiles(app.studio, app.dialogs)

    def commands(self) -> list[Command]:
        """Every command in the order of the menus."""
        return [*self._file(), *self._edit(), *self._tools(), *self._play(), *self._view(), *self._help()]

    # -- projects ----------------------------------------------------------------------------------------------------

    def new(self) -> None:
        """Start an empty project."""
        self._unless_unsaved(self._studio.new)

    def open(self) -> None:
        """Ask for a project and open it."""
        wish = FileWish("Open a project", (SUFFIX,))
        self._unless_unsaved(lambda: self._app.dialogs.ask_file(wish, self._studio.open))

    def save(self, then: Callable[[], None] = lambda: None) -> None:
        """Write the project where it came from, or ask where to."""
        if self._studio.work.path is None:
            self.save_as(then)
        elif self._studio.save(self._studio.work.path):
            then()

    def save_as(self, then: Callable[[], None] = lambda: None) -> None:
        """Ask where to, and write the project there."""

        def save(path: Path) -> None:
            if self._studio.save(path):
                then()

        wish = FileWish("Save the project", (SUFFIX,), saving=True, suggestion=f"{self._studio.work.name}{SUFFIX}")
        self._app.dialogs.ask_file(wish, save)

    def import_head(self) -> None:
        """Ask for a mesh, and grow the hair on it."""
        wish = FileWish("Choose a head", HEAD_ENDINGS)
        self._app.dialogs.ask_file(wish, lambda path: self._studio.set("head.source", str(path), "Head"))

    def take_dropped(self, paths: list[Path]) -> None:
        """Open what was dropped on the window: a project, a mesh as the head, or strands for it."""
        path = paths[0]
        if path.suffix == SUFFIX:
            self._unless_unsaved(lambda: self._studio.open(path))
        elif path.suffix.lower() in HEAD_ENDINGS:
            self._studio.set("head.source", str(path), "Head")
        elif path.suffix.lower() in READABLE:
            self.hair_files.look_into(path)
        else:
            self._studio.messages.say(f"{path.name} is neither a project nor a head nor hair", "warning")

    def recent_menu(self) -> None:
        """The projects opened last, as a menu inside the menu."""
        if not imgui.begin_menu("Open recent"):
            return
        for path in recent_projects():
            if imgui.menu_item_simple(str(path)):
                self._unless_unsaved(lambda path=path: self._studio.open(path))  # type: ignore[misc]
        imgui.end_menu()

    def quit(self) -> None:
        """Close the window, unless there is something to be saved first."""

        def close() -> None:
            self._app.closed = True

        self._unless_unsaved(close)

    def _unless_unsaved(self, go_on: Callable[[], object]) -> None:
        work = self._studio.work
        if work.modified:
            self._app.dialogs.ask_unsaved(work.name, self.save, lambda: (go_on(), None)[1])
        else:
            go_on()

    # -- pictures ----------------------------------------------------------------------------------------------------

    def export_picture(self) -> None:
        """Ask where to, and write what the viewport shows, in its size and smoother."""
        wish = FileWish("Export the picture", (".png",), saving=True, suggestion=f"{self._studio.work.name}.png")
        # Drawing another picture takes the texture away that this frame is going to show: wait for its end.
        self._app.dialogs.ask_file(wish, lambda path: self._app.after_frame.append(lambda: self._write_picture(path)))

    def _write_picture(self, path: Path) -> None:
        path = path if path.suffix else path.with_suffix(".png")
        with self._studio.reporting() as outcome:
            Image.fromarray(self._app.viewport.picture(supersampling=2)).save(path)
        if outcome.good:
            self._studio.messages.say(f"Wrote {path}", "good")

    def record(self) -> None:
        """Begin a recording, after asking where to, or end it."""
        recorder = self._app.recorder
        if recorder.recording:
            self._studio.messages.say(recorder.stop(), "good")
            return
        wish = FileWish("Record to a film or a folder", (*FILM_SUFFIXES, ""), saving=True, suggestion="film.mp4")
        self._app.dialogs.ask_file(wish, self._start_recording)

    def _start_recording(self, path: Path) -> None:
        self._app.recorder.start(path)
        self._studio.playback.playing = True

    # -- the list ----------------------------------------------------------------------------------------------------

    def _file(self) -> list[Command]:
        return [
            Command("File", "New", self.new, "Ctrl+N"),
            Command("File", "Open...", self.open, "Ctrl+O"),
            Command("File", "Save", self.save, "Ctrl+S"),
            Command("File", "Save as...", self.save_as, "Ctrl+Shift+S"),
            _line("File"),
            Command("File", "Import a head...", self.import_head, "Ctrl+I"),
            Command("File", "Export picture...", self.export_picture, "Ctrl+E", self._has_picture),
            _line("File"),
            *self.hair_files.commands(),
            _line("File"),
            *self.face_files.commands(),
            _line("File"),
            Command("File", "Quit", self.quit, "Ctrl+Q"),
        ]

    def _edit(self) -> list[Command]:
        history, views = self._studio.work.history, self._studio.work.views
        return [
            Command(
                "Edit",
                "Undo",
                self._studio.undo,
                "Ctrl+Z",
                lambda: history.undo_label is not None,
                name=lambda: f"Undo {history.undo_label or ''}",
            ),
            Command(
                "Edit",
                "Redo",
                self._studio.redo,
                "Ctrl+Shift+Z Ctrl+Y",
                lambda: history.redo_label is not None,
                name=lambda: f"Redo {history.redo_label or ''}",
            ),
            _line("Edit"),
            Command("Edit", "Previous view", views.undo, "[", lambda: views.undo_label is not None),
            Command("Edit", "Next view", views.redo, "]", lambda: views.redo_label is not None),
        ]

    def _tools(self) -> list[Command]:
        viewport = self._app.viewport

        def command(tool: Tool, key: str) -> Command:
            def take() -> None:
                viewport.tool = tool

            return Command("Tools", tool.label, take, key, on=lambda: viewport.tool is tool)

        return [command(tool, key) for tool, key in zip(self._app.tools, TOOL_KEYS)]

    def _play(self) -> list[Command]:
        playback = self._studio.playback
        return [
            Command("Play", "Play", playback.toggle, "Space", on=lambda: playback.playing),
            Command("Play", "Step", playback.step, "Right"),
            Command("Play", "Reset", self._studio.reset, "Home"),
            _line("Play"),
            Command("Play", "Record...", self.record, "Ctrl+R", on=lambda: self._app.recorder.recording),
        ]

    def _view(self) -> list[Command]:
        viewport, sizes = self._app.viewport, self._app.sizes

        def toggle_panels() -> None:
            sizes.panels = not sizes.panels

        def toggle_adaptive() -> None:
            viewport.adaptive = not viewport.adaptive

        sides = [
            Command("View", side.capitalize(), lambda side=side: viewport.look_from(side), keys)  # type: ignore[misc]
            for side, keys in VIEW_KEYS.items()
        ]
        beside = self._app.beside

        def toggle_beside() -> None:
            assert beside is not None
            beside.shown = not beside.shown

        opener = [Command("View", beside.label, toggle_beside, "M", on=lambda: beside.shown)] if beside else []
        return [
            *opener,
            Command("View", "Frame all", viewport.frame_all, "F"),
            Command("View", "Frame head", viewport.frame_head, "H"),
            _line("View"),
            *sides,
            _line("View"),
            Command("View", "Panels", toggle_panels, "Tab", on=lambda: sizes.panels),
            Command("View", "Coarser while moving", toggle_adaptive, on=lambda: viewport.adaptive),
        ]

    def _help(self) -> list[Command]:
        return [Command("Help", "Keys and mouse", self._app.dialogs.show_keys, "F1")]

    def _has_picture(self) -> bool:
        return self._studio.stage is not None


def _line(menu: str) -> Command:
    """A line between two groups of a menu."""
    return Command(menu, "-", lambda: None)
