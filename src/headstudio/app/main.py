"""What the word ``headstudio`` opens."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..params import assign
from .application import Application
from .studio import Studio
from .window import Window

NOTHING: Mapping[str, Any] = MappingProxyType({})


def main(project: str | None = None, changes: Mapping[str, Any] = NOTHING) -> None:
    """Open the window, on ``project`` if one is named, and return when it is closed.

    ``changes`` are parameters by dotted path that are set at once; undo takes them back. Raises WindowError when there is
    no display or no OpenGL 3.3; ProjectError or OSError for a project that cannot be opened; ParameterError for a change
    that cannot be made. Should the program fail, unsaved work is written to a file of its own, which the error then names.
    """
    studio = Studio(live=True)
    warnings = studio.work.open(Path(project)) if project is not None else studio.work.start_over()
    for warning in warnings:
        studio.messages.say(warning, "warning")
    changed = assign(studio.work.document, changes)
    studio.work.change(changed, "Command line")
    studio.work.look(changed.camera, "Command line")
    window = Window("headstudio")
    try:
        Application(window, studio).run()
    except Exception as error:
        if studio.work.modified:
            error.add_note(f"The unsaved work is in {studio.work.rescue()}; File > Open recent lists it.")
        raise
    finally:
        window.close()
        studio.builds.close()
