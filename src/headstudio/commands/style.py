"""``headstudio style`` and ``headstudio styles``: a hairstyle as a picture, as strands or as a project."""

from __future__ import annotations

from pathlib import Path

from ..io.hair import WRITABLE
from ..params import ParameterError, assign
from ..scene.document import Document
from ..scene.project import SUFFIX, save_project
from ..scene.styles import load_style, style_names
from .documents import animate
from .hair_sources import styled, write
from .pictures import Photographer, Size, save_picture
from .reporting import say


def styles() -> None:
    """Print every style that ships, a line each, its name first."""
    for name in style_names():
        style = load_style(name)
        say(f"{name}: {style.title}. {style.description}")


def style(document: Document, out: Path, size: Size, points: int | None) -> None:
    """Style the hair of a document and write it: as a picture (.png), a project, or strands in any format.

    Raises ParameterError, HeadError, HairFileError, RenderError, OSError.
    """
    suffix = out.suffix.lower()
    document = assign(document, {"look.hair_as": "strands"})
    if suffix == SUFFIX:
        save_project(document, out)
    elif suffix == ".png":
        photographer = Photographer(size)
        save_picture(photographer.final(animate(document).stage(), document, size), out)
    elif suffix in WRITABLE:
        write(styled(document), out, points)
    else:
        endings = ", ".join((".png", SUFFIX, *WRITABLE))
        raise ParameterError(f"a style is written to {endings}; got {out.name!r}")
    say(str(out))
