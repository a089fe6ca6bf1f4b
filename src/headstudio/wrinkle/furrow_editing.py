"""What an artist does to a furrow by hand: draw it, take it by its handles, cut it finer, turn it to the other side.

Everything happens on the face chart (see face_chart.py) and returns another furrow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..head.mesh import Floats
from .bezier import fit_stroke
from .default_furrows import default_furrows
from .furrow import Controls, Furrow

STROKE_TOLERANCE = 5e-4
"""How far a drawn furrow may pass from the stroke [m]: what a hand can hold steady."""

# Handles on both sides of a joint belong together when they lie within this angle of a line (cosine).
_SMOOTH = np.cos(np.radians(8))
_SAMPLES = 32


def drawn_furrow(stroke: Floats, age: float, taken: Sequence[Furrow] = ()) -> Furrow:
    """A furrow along a stroke of the chart [m], (k, 2), as deep and wide as the default one nearest to it is at ``age``.

    taken: the furrows that are there; it gets a name that none of them has. Raises ValueError for a stroke without two
    distinct points.
    """
    controls = _as_tuples(fit_stroke(stroke, STROKE_TOLERANCE).controls)
    furrows = default_furrows(age)
    away = [np.linalg.norm(_line(furrow) - stroke.mean(axis=0), axis=1).min() for furrow in furrows]
    model = furrows[int(np.argmin(away))]
    return replace(model, name=free_name(model.region, taken), controls=controls)


def free_name(stem: str, taken: Sequence[Furrow]) -> str:
    """``stem`` with the first number that makes it a name no furrow of ``taken`` has."""
    names = {furrow.name for furrow in taken}
    return next(name for k in range(1, len(names) + 2) if (name := f"{stem} new {k}") not in names)


def with_control(furrow: Furrow, index: int, place: Floats) -> Furrow:
    """The control point ``index`` moved to ``place``, (2,) [m].

    A point of the curve takes the handles beside it along; a handle turns the one across a smooth joint with it.
    """
    controls = furrow.chain.controls.copy()
    shift = place - controls[index]
    if index % 3 == 0:
        controls[max(index - 1, 0) : index + 2] += shift
        return replace(furrow, controls=_as_tuples(controls))
    joint, across = (index - 1, index - 2) if index % 3 == 1 else (index + 1, index + 2)
    if 0 < joint < len(controls) - 1:
        before, other = controls[index] - controls[joint], controls[across] - controls[joint]
        lengths = float(np.linalg.norm(before) * np.linalg.norm(other))
        turned = place - controls[joint]
        if -(before @ other) > _SMOOTH * lengths and np.linalg.norm(turned) > 0:
            controls[across] = controls[joint] - turned * np.linalg.norm(other) / np.linalg.norm(turned)
    controls[index] = place
    return replace(furrow, controls=_as_tuples(controls))


def shifted(furrow: Furrow, by: Floats) -> Furrow:
    """The whole furrow moved by ``by``, (2,) [m]."""
    return replace(furrow, controls=_as_tuples(furrow.chain.controls + by))


def with_point(furrow: Furrow, place: Floats) -> Furrow:
    """One more point of the curve where it is nearest to ``place``, (2,) [m]; its course stays (de Casteljau)."""
    t, points = furrow.chain.sampled(4 * _SAMPLES)
    # At a joint there is a point already: the new one stays off it.
    nearest = float(t[np.linalg.norm(points - place, axis=1).argmin()])
    piece = min(int(nearest), furrow.chain.count - 1)
    u = float(np.clip(nearest - piece, 0.05, 0.95))
    controls = furrow.chain.controls
    a, b, c, d = controls[3 * piece : 3 * piece + 4]
    ab, bc, cd = a + u * (b - a), b + u * (c - b), c + u * (d - c)
    abc, bcd = ab + u * (bc - ab), bc + u * (cd - bc)
    middle = abc + u * (bcd - abc)
    split = np.concatenate([controls[: 3 * piece + 1], [ab, abc, middle, bcd, cd], controls[3 * piece + 3 :]])
    return replace(furrow, controls=_as_tuples(split))


def without_point(furrow: Furrow, index: int) -> Furrow | None:
    """The furrow without its point ``index`` of the curve, a multiple of 3; None when nothing would be left of it.

    What lies on both sides becomes one curve that runs as near to the old course as it can.
    """
    controls, last = furrow.chain.controls, len(furrow.chain.controls) - 1
    if furrow.chain.count == 1:
        return None
    if index == 0:
        kept = controls[3:]
    elif index == last:
        kept = controls[:-3]
    else:
        # As long as both curves together, a handle reaches as much farther.
        before, after = np.linalg.norm(controls[[index - 3, index + 3]] - controls[index], axis=1)
        share = np.clip(before / np.maximum(before + after, 1e-12), 0.1, 0.9)
        start, end = controls[index - 3], controls[index + 3]
        first = start + (controls[index - 2] - start) / share
        second = end + (controls[index + 2] - end) / (1 - share)
        kept = np.concatenate([controls[: index - 2], [first, second], controls[index + 3 :]])
    return replace(furrow, controls=_as_tuples(kept))


def mirrored(furrow: Furrow, taken: Sequence[Furrow] = ()) -> Furrow:
    """The furrow on the other side of the face; "left" in its name becomes "right".

    taken: the furrows that are there, so that two never have one name.
    """
    turns = {"left": "right", "right": "left"}
    name = " ".join(turns.get(word, word) for word in furrow.name.split(" "))
    if name == furrow.name or any(other.name == name for other in taken):
        name = free_name(furrow.region or "furrow", taken)
    return replace(
        furrow,
        name=name,
        controls=tuple((-x, y) for x, y in furrow.controls),
        section=furrow.section[::-1],
    )


def _line(furrow: Furrow) -> Floats:
    return furrow.chain.sampled(_SAMPLES)[1]


def _as_tuples(controls: Floats) -> Controls:
    return tuple((float(x), float(y)) for x, y in controls)
