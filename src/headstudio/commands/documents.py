"""From the words of a command line to a document and a motion."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..io.take_csv import read_take
from ..params import ParameterError, assign, parse_assignments
from ..scene.animation import Animation
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.motion import Motion, head_motion
from ..scene.project import Project, load_project, new_project
from ..scene.skin_presets import with_skin
from ..scene.styles import load_style
from ..scene.views import seen_from
from .reporting import warn, working


def open_document(
    project: Path | None,
    assignments: Sequence[str],
    preset: str | None = None,
    skin: str | None = None,
    **chosen: Any,
) -> Document:
    """The project, or a new document, with the hair of a style that ships, skin by its age and parameters replaced.

    ``chosen`` are options such as ``head_source="mannequin"`` (None: not given), named by the parameter's path with
    ``_`` for the dot after its part. ``assignments`` are words like "lcp.friction=2" and have the last word. Raises
    ParameterError, ProjectError, OSError.
    """
    if project is not None:
        start = load_project(project)
    elif chosen.get("head_source") is None:
        start = new_project()
    else:
        start = Project(Document())
    for warning in start.warnings:
        warn(warning)
    document = start.document if preset is None else load_style(preset).on(start.document)
    document = document if skin is None else with_skin(document, skin)
    given = {name.replace("_", ".", 1): value for name, value in chosen.items() if value is not None}
    return assign(document, given | parse_assignments(list(assignments)))


def head_source(word: str | None) -> str | None:
    """A head named on the command line; a file by its full path, so that a project still finds it from elsewhere."""
    return os.path.abspath(word) if word is not None and os.path.isfile(word) else word


def parse_counts(words: str) -> tuple[int, ...]:
    """``500,2000`` as numbers. Raises ParameterError."""
    try:
        return tuple(int(word) for word in words.split(","))
    except ValueError:
        raise ParameterError(f"counts are whole numbers with commas between, 500,2000; got {words!r}") from None


def choose_motion(document: Document, word: str | None) -> tuple[Document, Motion]:
    """The document with the motion called ``word``, and that motion; a word that ends in .csv is a recorded one."""
    if word is not None and word.lower().endswith(".csv"):
        return assign(document, {"motion.kind": "rest"}), read_take(Path(word))
    if word is not None:
        document = assign(document, {"motion.kind": word})
    return document, head_motion(document.motion)


def choose_view(document: Document, view: str | None) -> Document:
    """The document seen from a view by name; None leaves its camera. Raises ParameterError."""
    return document if view is None else replace(document, camera=seen_from(document.camera, view))


def animate(document: Document, builder: Builder | None = None) -> Animation:
    """What ``document`` shows, by a builder that may have some of it ready. Raises HeadError, ParameterError."""
    with working("growing the hair"):
        return Animation(builder or Builder(), document)
