"""``headstudio import``: strands of another program, looked at, placed on a head, and written where they are wanted."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from ..io.hair import read_strands, write_strands
from ..scene.builder import Builder
from ..scene.document import Document
from ..wisp.adopt import adopt, place_on_head
from ..wisp.strands import Strands
from .reporting import say, warn, working

_CLEARANCE = 0.0005  # of strands from the skin [m]


def import_hair(path: Path, document: Document, points_per_strand: int | None, out: Path | None) -> None:
    """Print what the file holds and how it was taken; write the hair on the document's head to ``out`` if that is given.

    Raises HairFileError, AdoptError, HeadError, OSError.
    """
    with working(f"reading {path.name}"):
        strands = read_strands(path, points_per_strand, warn)
    for line in describe(strands):
        say(line)
    builder = Builder()
    with working("placing it on the head"):
        head, scalp = builder.head(document.head), builder.scalp(document)
        placement = place_on_head(strands, head, scalp)
        adopted = adopt(strands, placement, head)
        points = adopted.points.copy()
        builder.surroundings(document).keep_outside(points, _CLEARANCE)
    say(placement.note)
    if placement.reversed:
        say("the strands began at their tips and were turned around")
    lifted = int(np.count_nonzero(np.any(points != adopted.points, axis=1)))
    say(f"{lifted:,} of {len(adopted.points):,} points were lifted out of the head")
    if out is not None:
        with working(f"writing {out.name}"):
            write_strands(replace(adopted, points=points), out)
        say(str(out))


def describe(strands: Strands) -> list[str]:
    """Strands in lines of text, in the unit of their file."""
    counts = strands.counts
    fewest, most = int(counts.min()), int(counts.max())
    low, high, lengths = strands.points.min(axis=0), strands.points.max(axis=0), strands.lengths
    known = [name for name, values in (("thickness", strands.radius), ("colour", strands.colour)) if values is not None]
    return [
        f"strands: {strands.count:,}",
        f"points: {len(strands.points):,}, {fewest if fewest == most else f'{fewest} to {most}'} a strand",
        "bounds: " + ", ".join(f"{axis} {a:.4g} to {b:.4g}" for axis, a, b in zip("xyz", low, high)),
        f"lengths: {lengths.min():.4g} to {lengths.max():.4g}, median {np.median(lengths):.4g}",
        f"besides points: {' and '.join(known) or 'nothing'}",
    ]
