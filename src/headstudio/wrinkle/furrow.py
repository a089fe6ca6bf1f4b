"""A large wrinkle as an artist specifies it: where it runs, how deep, how wide, how much of it is there at rest."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ..params import ParameterError, number, parameters_of, switch, text
from .bezier import BezierChain
from .cross_profile import Section

Controls = tuple[tuple[float, float], ...]
_LISTS = ("controls", "section", "swell")


@dataclass(frozen=True)
class Furrow:
    """One large wrinkle: Bando's thesis, section 2.5.

    controls: control points of a chain of cubic Bezier curves, 3 k + 1 of them, on the face chart (see face_chart.py) or in
    texture space, whatever it is used with. section: its cross section, see cross_profile.py; none: it is (2.1). swell:
    how much of the depth is there at evenly spaced places from its start to its end; none: all of it everywhere. Raises
    ValueError for control points that are no chain.
    """

    name: str = text("furrow", "Name", "What this wrinkle is called.")
    region: str = text("", "Region", "The part of the face it belongs to, such as forehead.")
    depth: float = number(
        2e-3, "Depth", "m", 0.0, 0.015, "d: how deep the furrow is at full amplitude.", shown="mm", live=True
    )
    width: float = number(
        2e-3, "Width", "m", 2e-4, 0.02, "w: where the furrow meets the level of the skin; the bulge is highest at 2 w.",
        shown="mm", log=True,
    )  # fmt: skip
    initial: float = number(
        0.1,
        "At rest",
        "",
        0.0,
        1.0,
        "r: the amplitude when the skin is at rest; 0 shows only when it shrinks.",
        live=True,
    )
    controls: Controls = ((0.0, 0.0), (0.003, 0.0), (0.006, 0.0), (0.009, 0.0))
    taper: float = number(
        0.2,
        "Taper",
        "",
        0.02,
        0.5,
        "The part of its length that a furrow takes to come to full depth at either end; never less than 4 widths.",
    )

    adds: bool = switch(
        False,
        "Adds up",
        "Where it crosses others its depth is added to theirs, as in a scan; else the skin is as deep as the deeper one.",
        live=True,
    )
    section: Section = ()
    swell: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        chain = BezierChain(self.controls)  # type: ignore[arg-type]  # checks shape and numbers
        object.__setattr__(self, "controls", tuple((float(x), float(y)) for x, y in chain.controls))

    @property
    def chain(self) -> BezierChain:
        """Where the furrow runs."""
        return BezierChain(self.controls)  # type: ignore[arg-type]


def encode_furrows(furrows: Iterable[Furrow]) -> bytes:
    """A furrow set as JSON, a furrow a line; lengths in metres."""
    rows = [json.dumps(dataclasses.asdict(furrow), allow_nan=False) for furrow in furrows]
    return ("[\n" + ",\n".join(" " + row for row in rows) + "\n]\n").encode() if rows else b"[]\n"


def decode_furrows(content: bytes) -> tuple[Furrow, ...]:
    """A furrow set from JSON. Raises ValueError with a phrase for the user."""
    try:
        rows = json.loads(content)
    except (ValueError, RecursionError):
        raise ValueError("is no furrow set") from None
    if not isinstance(rows, list):
        raise ValueError("is no list of furrows")
    return tuple(_furrow(row, k) for k, row in enumerate(rows, 1))


def _furrow(row: Any, number_: int) -> Furrow:
    known = parameters_of(Furrow)
    if not isinstance(row, dict) or "controls" not in row or not set(row) <= {*known, *_LISTS}:
        raise ValueError(f"does not describe its furrow {number_} by {', '.join(known)} and controls")
    try:
        values = {key: known[key].check(row[key], key) for key in row if key not in _LISTS}
        controls = tuple((float(x), float(y)) for x, y in row["controls"])
        if not all(math.isfinite(c) for point in controls for c in point):
            raise ValueError("the control points of a curve are finite numbers")
        section = tuple(float(height) for height in row.get("section", ()))
        if len(section) > 199 or not all(abs(height) <= 50 for height in section):
            raise ValueError("a cross section has at most 199 control heights within 50 times the depth")
        swell = tuple(float(part) for part in row.get("swell", ()))
        if not all(abs(part) <= 50 for part in swell):
            raise ValueError("a furrow swells to at most 50 times its depth")
        return Furrow(**values, controls=controls, section=section, swell=swell)
    except (ParameterError, TypeError, ValueError, OverflowError) as problem:
        raise ValueError(f"has a damaged furrow {number_}: {problem}") from None
