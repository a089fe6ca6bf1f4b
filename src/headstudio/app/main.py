"""What the word ``headstudio`` opens."""

from __future__ import annotations

from pathlib import Path

from .application import Application
from .studio import Studio
from .window import Window


def main(project: str | None = None) -> None:
    """Open the window, on ``project`` if one is named, and return when it is closed.

    Raises WindowError when there is no display or no OpenGL 3.3; ProjectError or OSError for a project that cannot be
    opened. Should the program fail, unsaved work is written to a file of its own, which the error then names.
    """
    studio = Studio()
    warnings = studio.work.open(Path(project)) if project is not None else studio.work.start_over()
    for warning in warnings:
        studio.messages.say(warning, "warning")
    window = Window("headstudio")
    try:
        Application(window, studio).run()
    except Exception as error:
        if studio.work.modified:
            error.add_note(f"The unsaved work is in {studio.work.rescue()}; File > Open recent lists it.")
        raise
    finally:
        window.close()
