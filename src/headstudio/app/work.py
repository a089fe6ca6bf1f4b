"""The artist's work: the document with its undo, the view with its own, and the file they belong to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..params import assign
from ..scene.document import Document
from ..scene.history import History
from ..scene.project import SUFFIX, load_project, new_project, save_project
from ..scene.recent import config_folder, remember_project
from ..scene.settings import Camera

VIEW = "camera."


class Work:
    """One open project.

    Looking around is no change of the work: the camera is saved with it but has a history of its own, so that undo
    never takes back a view and a glance from the side never costs a redo. Whether hair is shown as particles or as
    strands and whether the skin lives are ways of looking, too: they go with the tab that is open, and undo leaves them
    alone.
    """

    def __init__(self) -> None:
        document = Document()
        self.history: History[Document] = History(document)
        self.views: History[Camera] = History(document.camera)
        self.hair_as = document.look.hair_as
        self.skin_as = document.look.skin_as
        self.path: Path | None = None

    @property
    def document(self) -> Document:
        """The document as it is now, with the view it is seen from."""
        return self._seen(self.history.document)

    @property
    def name(self) -> str:
        """What the title bar calls it."""
        return self.path.stem if self.path else "Untitled"

    @property
    def modified(self) -> bool:
        """Whether there is something that would be lost."""
        return self.history.modified

    def change(self, document: Document, label: str) -> None:
        """Replace the document (its camera apart); one entry of the history, or part of the open gesture."""
        present = self.history.document
        self.hair_as, self.skin_as = document.look.hair_as, document.look.skin_as
        look = replace(document.look, hair_as=present.look.hair_as, skin_as=present.look.skin_as)
        self.history.change(replace(document, camera=present.camera, look=look), label)

    def set(self, path: str, value: Any, label: str) -> None:
        """Set the parameter at a dotted path. Raises ParameterError for what it cannot take."""
        if path.startswith(VIEW):
            self.views.change(assign(self.document, {path: value}).camera, label)
        else:
            self.change(assign(self.document, {path: value}), label)

    def look(self, camera: Camera, label: str = "View") -> None:
        """See the scene through another camera."""
        self.views.change(camera, label)

    def begin_gesture(self, label: str, path: str = "") -> None:
        """From here to ``end_gesture`` everything is one entry, of the view or of the work as ``path`` says."""
        (self.views if path.startswith(VIEW) else self.history).begin_gesture(label)

    def end_gesture(self) -> None:
        """The mouse was let go."""
        self.history.end_gesture()
        self.views.end_gesture()

    @property
    def in_gesture(self) -> bool:
        """Whether the user is in the middle of a drag or of typing."""
        return self.history.in_gesture or self.views.in_gesture

    def start_over(self) -> tuple[str, ...]:
        """A new, empty project; returns warnings."""
        project = new_project()
        self._reopen(project.document, None)
        return project.warnings

    def open(self, path: Path) -> tuple[str, ...]:
        """Open a project; returns warnings. Raises ProjectError or OSError, and then nothing has changed."""
        project = load_project(path)
        self._reopen(project.document, path)
        _remember(path)
        return project.warnings

    def save(self, path: Path) -> Path:
        """Write the project and return where it is. Raises OSError."""
        if path.suffix != SUFFIX:
            path = path.with_name(path.name + SUFFIX)
        save_project(self.document, path)
        self.path = path
        self.history.mark_saved()
        _remember(path)
        return path

    def rescue(self) -> Path:
        """Write the work beside the user's settings, where the recent projects name it; returns where. Raises OSError."""
        path = config_folder() / f"rescued{SUFFIX}"
        path.parent.mkdir(parents=True, exist_ok=True)
        save_project(self.document, path)
        _remember(path)
        return path

    def go_back(self, wanted: Callable[[Document], bool]) -> bool:
        """Undo until the document is as ``wanted``. False when it never was: then nothing is undone."""
        steps = 0
        while not wanted(self.document):
            if not self.history.undo():
                for _ in range(steps):
                    self.history.redo()
                return False
            steps += 1
        return True

    def _seen(self, document: Document) -> Document:
        look = document.look
        if (look.hair_as, look.skin_as) != (self.hair_as, self.skin_as):
            look = replace(look, hair_as=self.hair_as, skin_as=self.skin_as)
        return replace(document, camera=self.views.document, look=look)

    def _reopen(self, document: Document, path: Path | None) -> None:
        self.history.reopen(document)
        self.views.reopen(document.camera)
        self.hair_as, self.skin_as = document.look.hair_as, document.look.skin_as
        self.path = path


def _remember(path: Path) -> None:
    """A list of recent projects that cannot be written is no reason to fail: the project itself is safe."""
    try:
        remember_project(path)
    except OSError:
        return
