"""Hair that was groomed in another program: placed on the head, and shown in the place of the styled hair."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..head.head import Head
from ..head.mesh import Ints
from ..params import switch
from .adopt import Placement, adopt
from .adornment import adorn
from .colour import strand_colours
from .deform import DeformReport
from .hairdo import Hairdo
from .outlines import Outlines
from .settings import HairColourSettings, WispSettings
from .strands import Singles, Strands
from .styling_settings import StylingSettings
from .surroundings import Surroundings

_CLEARANCE = 0.0005  # of strands from the skin [m]
# Half the thickness of hair [m]; what a file says beyond this is in no unit that could be guessed.
_THINNEST, _THICKEST = 2e-6, 1e-3
_SHADES = 16  # of a strand from root to tip, where the file has no colours


@dataclass(frozen=True, eq=False)
class Groom:
    """Strands of a file as they are in it, in its unit and axes. name: of the file. Compared by content."""

    name: str
    strands: Strands

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        return isinstance(other, Groom) and self.name == other.name and _same(self.strands, other.strands)

    def __hash__(self) -> int:
        return hash((self.name, self.strands.count, len(self.strands.points)))


@dataclass(frozen=True)
class GroomSettings:
    """Hair of another program. hair: the strands that take the place of the styled hair, or None."""

    reroot: bool = switch(
        True, "Roots on the skin", "Every strand is moved so that its root lies on the skin; its tip stays where it is."
    )
    lift: bool = switch(True, "Out of the head", "Points of strands below the skin are moved straight out to it.")
    hair: Groom | None = field(default=None)


def _same(one: Strands, other: Strands) -> bool:
    pairs = ((getattr(one, name), getattr(other, name)) for name in ("points", "first", "radius", "colour"))
    return all(a is b or (a is not None and b is not None and np.array_equal(a, b)) for a, b in pairs)


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


def lay_on_head(
    strands: Strands, placement: Placement, head: Head, surroundings: Surroundings, groom: GroomSettings
) -> tuple[Strands, int]:
    """The strands of a file in the head frame [m], as ``groom`` asks for, and how many points were moved out of the head."""
    placed = adopt(strands, placement, head, reroot=groom.reroot)
    if not groom.lift:
        return placed, 0
    points = surroundings.keep_outside(placed.points.copy(), _CLEARANCE)
    return replace(placed, points=points), int(np.count_nonzero(np.any(points != placed.points, axis=1)))


def mixed(strands: Strands) -> Strands:
    """The same strands in an order by chance, so that the first of them are a thinned picture of all."""
    return strands.picked(np.random.default_rng(0).permutation(strands.count))


def groomed_hairdo(
    strands: Strands,
    count: int,
    surroundings: Surroundings,
    wisp: WispSettings,
    colour: HairColourSettings,
    styling: StylingSettings,
) -> Hairdo:
    """The first ``count`` of ``strands`` on the head, which are ``mixed``, as a hairdo.

    What the file does not say about shafts and colours is as it is for styled hair, and so are accessories.
    """
    shown = strands.picked(np.arange(min(count, strands.count)))
    along = _along(shown)
    radius = shown.radius
    if radius is None or not _THINNEST < np.median(radius) < _THICKEST:
        radius = (wisp.shaft_root + (wisp.shaft_tip - wisp.shaft_root) * along).astype(np.float32)
    colours = shown.colour
    if colours is None:
        shades = strand_colours(colour, np.zeros(shown.count, dtype=np.int64), 1, _SHADES)
        colours = shades[np.repeat(np.arange(shown.count), shown.counts), np.rint(along * (_SHADES - 1)).astype(int)]
    wisps = np.zeros(shown.count, dtype=np.int32)
    made = replace(shown, radius=radius, colour=colours, wisp=wisps, stands_for=strands.count / max(shown.count, 1))
    worn = adorn(styling.accessories, (), surroundings)
    return Hairdo(made, _NO_WISPS, np.zeros((0, 1, 3), dtype=np.float32), DeformReport(0, 0, 0), worn)


def _along(strands: Strands) -> Singles:
    """The place of every point on its strand, 0 at the root and 1 at the tip, (p,)."""
    strand: Ints = np.repeat(np.arange(strands.count), strands.counts)
    place = (np.arange(len(strands.points)) - strands.first[strand]) / (strands.counts - 1)[strand]
    return place.astype(np.float32)


_NO_WISPS = Outlines(
    roots=np.zeros((0, 3)),
    segment=0.01,
    counts=np.zeros(0, dtype=np.int64),
    frames=np.zeros((0, 1, 3, 3)),
    radii=np.zeros((0, 2)),
    strands=np.zeros(0, dtype=np.int64),
)
