"""Where a command keeps furrows: in a project or in a furrow set."""

from __future__ import annotations

from pathlib import Path

from ..io.faces import write_furrows
from ..scene.document import Document
from ..scene.project import save_project
from .reporting import say

FURROW_SUFFIXES = (".headstudio", ".json")


def keep_furrows(document: Document, out: Path) -> None:
    """Write the furrows of a document: a furrow set where ``out`` ends in .json, else the whole project. Raises OSError."""
    if out.suffix.lower() == ".json":
        write_furrows(document.wrinkle.furrows, out)
    else:
        save_project(document, out)
    say(str(out))
