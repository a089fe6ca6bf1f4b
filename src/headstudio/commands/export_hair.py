"""``headstudio export``: strands of a project, a style or a file, in the format that the ending of the new name chooses."""

from __future__ import annotations

from pathlib import Path

from ..scene.document import Document
from .hair_sources import check_is_hair_file, file_strands, styled, write
from .reporting import say


def export_hair(source: Path | Document, out: Path, points: int | None, points_per_strand: int | None) -> None:
    """Write the strands of a hair file, as they lie in it, or of a document's hairstyle, in the head frame.

    Raises ParameterError, HeadError, HairFileError, OSError.
    """
    check_is_hair_file(out)
    strands = file_strands(source, points_per_strand) if isinstance(source, Path) else styled(source)
    write(strands, out, points)
    say(f"{out}: {strands.count:,} strands")
