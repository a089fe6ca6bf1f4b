"""``headstudio import``: strands of another program, looked at, placed on a head, and written where they are wanted."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ..io.hair import read_strands, write_strands
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.project import SUFFIX, save_project
from ..wisp.adopt import place_on_head
from ..wisp.groom import Groom, describe, lay_on_head
from .reporting import say, warn, working


def import_hair(path: Path, document: Document, points_per_strand: int | None, out: Path | None) -> None:
    """Print what the file holds and how it was taken; write the hair on the document's head to ``out`` if that is given: as
    hair, or as a project with this hair.

    Raises HairFileError, AdoptError, HeadError, OSError.
    """
    with working(f"reading {path.name}"):
        strands = read_strands(path, points_per_strand, warn)
    for line in describe(strands):
        say(line)
    builder = Builder()
    document = replace(document, groom=replace(document.groom, hair=Groom(path.name, strands)))
    with working("placing it on the head"):
        head = builder.head(document.head)
        placement = place_on_head(strands, head, builder.scalp(document))
        lying, lifted = lay_on_head(strands, placement, head, builder.surroundings(document), document.groom)
    say(placement.note)
    if placement.reversed:
        say("the strands began at their tips and were turned around")
    say(f"{lifted:,} of {len(lying.points):,} points were lifted out of the head")
    if out is not None:
        with working(f"writing {out.name}"):
            if out.suffix == SUFFIX:
                save_project(replace(document, look=replace(document.look, hair_as="strands")), out)
            else:
                write_strands(lying, out)
        say(str(out))
