"""``headstudio wrinkle --infer``: furrows proposed from how the skin of a face shrinks."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ..params import ParameterError, assign
from ..scene.builder import Builder
from ..scene.document import Document
from ..wrinkle.face import Face
from ..wrinkle.face_creases import face_layout
from ..wrinkle.inference import propose_furrows
from .furrow_files import FURROW_SUFFIXES, keep_furrows
from .pictures import Size
from .reporting import say, working
from .wrinkle import wrinkle

# A picture shows the proposals as fine lines, all of them at rest [m].
_LINE = 1.2e-3


def infer_furrows(document: Document, out: Path, size: Size) -> None:
    """Propose furrows for the head of a document and keep them in ``out``: .headstudio, .json, or drawn on the face, .png.

    Raises HeadError, ParameterError, OSError.
    """
    suffix = out.suffix.lower()
    if suffix not in (*FURROW_SUFFIXES, ".png"):
        raise ParameterError(f"proposals are kept in {', '.join(FURROW_SUFFIXES)} or drawn in .png; got {out.name!r}")
    with working("watching the skin in every expression"):
        head = Builder().head(document.head)
        furrows = propose_furrows(Face(head), face_layout(head))
    for furrow in furrows:
        say(
            f"{furrow.name}: {1e3 * furrow.depth:.1f} mm deep, {1e3 * furrow.width:.1f} mm wide, r {furrow.initial:.2f}"
        )
    if suffix == ".png":
        drawn = tuple(replace(furrow, depth=_LINE, width=_LINE, initial=1.0) for furrow in furrows)
        shown = replace(
            document, wrinkle=replace(document.wrinkle, furrows=drawn, strength=1.0, breadth=1.0, shown=True)
        )
        wrinkle(assign(shown, {"fine.on": False}), out, size, framed=True)
        return
    keep_furrows(replace(document, wrinkle=replace(document.wrinkle, furrows=furrows)), out)
