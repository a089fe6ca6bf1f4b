"""Strands from whatever a command line names: a project, a style that ships, or a file of another program."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ..io.hair import READABLE, WRITABLE, read_strands, write_strands
from ..params import ParameterError
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.project import SUFFIX, load_project, new_project
from ..scene.styles import load_style, style_names
from ..wisp.resample import resampled
from ..wisp.sample_strand import sample_strand
from ..wisp.strands import Strands
from .reporting import warn, working


def hair_document(source: str | None) -> Document:
    """The document of a project, NAME.headstudio, or of a style by its name; None: the default.

    Raises ParameterError, ProjectError, OSError.
    """
    if source is not None and source not in style_names():
        if not source.endswith(SUFFIX):
            raise ParameterError(
                f"{source!r} is neither a project, NAME{SUFFIX}, nor a style; headstudio styles lists them"
            )
        project = load_project(Path(source))
    else:
        project = new_project()
    for warning in project.warnings:
        warn(warning)
    return load_style(source).on(project.document) if source in style_names() else project.document


def is_hair_file(source: str) -> bool:
    """Whether the name is that of strands in another program's format."""
    return Path(source).suffix.lower() in READABLE


def styled(document: Document) -> Strands:
    """All strands of a document's hairstyle. Raises HeadError, ParameterError."""
    with working("styling the hair"):
        return Builder().hairdo(document).strands


def file_strands(path: Path, points_per_strand: int | None = None) -> Strands:
    """Strands of a file as they are in it. Raises HairFileError, OSError."""
    with working(f"reading {path.name}"):
        return read_strands(path, points_per_strand, warn)


def with_prototype(document: Document, path: Path) -> Document:
    """The document with a strand of a hair file as the prototype. Raises HairFileError, OSError."""
    return replace(document, wisp=replace(document.wisp, prototype_curve=sample_strand(file_strands(path))))


def write(strands: Strands, out: Path, points: int | None = None) -> None:
    """Write strands, with ``points`` points each if that is given. Raises HairFileError, OSError."""
    with working(f"writing {out.name}"):
        write_strands(strands if points is None else resampled(strands, points), out)


def check_is_hair_file(out: Path) -> None:
    """Raise ParameterError for a name that no hair is written under, before the work begins."""
    if out.suffix.lower() not in WRITABLE:
        raise ParameterError(f"hair is written to {', '.join(WRITABLE)}; got {out.name!r}")
