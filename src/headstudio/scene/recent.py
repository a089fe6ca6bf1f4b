"""The projects opened last, for the menu of the window: a list of paths in the user's configuration folder."""

from __future__ import annotations

import json
import os
from pathlib import Path

from .files import write_atomically

LONGEST = 10


def config_folder() -> Path:
    """Where headstudio keeps what belongs to the user and not to a project (XDG base directories)."""
    base = os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config"
    return Path(base) / "headstudio"


def recent_projects() -> list[Path]:
    """Projects opened or saved last, newest first, those that are still there.

    A list that cannot be read is an empty one: it holds no work of the user's.
    """
    try:
        names = json.loads((config_folder() / "recent.json").read_text("utf-8"))
        paths = [Path(name) for name in names if isinstance(name, str)]
    except (OSError, ValueError, TypeError):
        return []
    return [path for path in paths if os.path.exists(path)][:LONGEST]


def remember_project(path: Path) -> None:
    """Put ``path`` at the head of the list. Raises OSError when the configuration folder cannot be written."""
    path = path.resolve()
    paths = [path, *(other for other in recent_projects() if other != path)][:LONGEST]
    config_folder().mkdir(parents=True, exist_ok=True)
    write_atomically(config_folder() / "recent.json", json.dumps([str(p) for p in paths], indent=1).encode())
