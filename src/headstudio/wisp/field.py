"""The styling force field Phi: which way hair is to flow at every place (Choe, Ko 2005, sections 3.1 and 6.1)."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ..head.mesh import Floats
from ..head.rows import row_unit
from ..head.smooth import smoothstep
from .ears import before_ears, over_ears
from .force import ForceField
from .grid import Grid
from .strokes import follow_strokes
from .styling_settings import StylingSettings
from .surroundings import Surroundings

# Fields are smooth over the breadth of a lock, and an artist drags their weights: coarse nodes keep that quick [m].
_SPACING = 0.02


@lru_cache(maxsize=4)
def force_field(styling: StylingSettings, surroundings: Surroundings) -> ForceField:
    """The weighted sum of the presets around a head, bent by the strokes."""
    grid = Grid.over(surroundings.low, surroundings.high, _SPACING)
    places = surroundings.proportions.measure(grid.nodes)
    total = np.zeros((grid.size, 3))
    for name, preset in PRESETS.items():
        weight = getattr(styling, name)
        if weight:
            total += weight * preset(places, styling)
    if styling.off_shoulders:
        total += styling.off_shoulders * _off_shoulders(places, grid, surroundings)
    if styling.close:
        total += styling.close * _close(places, grid, surroundings)
    if styling.strokes:
        total = follow_strokes(total, grid, styling.strokes, surroundings.proportions, styling.stroke_reach)
    return ForceField(grid, np.ascontiguousarray(total.T, dtype=np.float32))


def _along(places: Floats, x: float, y: float, z: float) -> Floats:
    return np.broadcast_to(np.array([x, y, z]), places.shape)


def _fade(value: Floats, start: float, end: float) -> Floats:
    """1 before ``start``, 0 after ``end``, smooth between, as a column."""
    return smoothstep(value, end, start)[:, None]


def _gravity(places: Floats, styling: StylingSettings) -> Floats:
    return _along(places, 0, -1, 0)


def _back(places: Floats, styling: StylingSettings) -> Floats:
    # Around the skull as a comb goes: up the forehead, back over the top, and down behind it. Lower down it keeps hair off
    # the face, and behind the head nothing pulls any more, so that what was combed back can fall. Before an ear it goes up,
    # to pass above it.
    over = np.where(places[:, 2] > 0.0, 1.0, 1.0 - _fade(places[:, 1], -0.8, -0.3)[:, 0])
    way = np.stack([0 * places[:, 0], over * places[:, 2], -np.maximum(places[:, 1], 0.4)], axis=1)
    way[:, 1] += before_ears(places)
    return _fade(-places[:, 2], 0.3, 1.1) * row_unit(way, otherwise=np.zeros_like(way))


_WHORL = (0.3, 0.7)  # where hair that is combed forward begins, in half depths behind the middle of the head
_PRESSED = 0.6  # how steeply hair that is combed over the forehead is led to it


def _forward(places: Floats, styling: StylingSettings) -> Floats:
    # As a comb goes: over the top to the front, and down the forehead, pressed to it.
    fall, rise = np.maximum(places[:, 2], 0.0), np.clip(places[:, 1], 0.2, None)
    press = _PRESSED * np.minimum(fall, 1.0) * np.maximum(1.0 - rise, 0.0)
    way = np.stack([0 * places[:, 0], -fall, rise - press], axis=1)
    before_ears = _fade(np.abs(places[:, 0]), 0.5, 1.0) * (1.0 - _fade(places[:, 1], -0.4, 0.0))
    # What grows behind the whorl is combed back from it, or it would stand up there and fold over.
    before_whorl = _fade(-places[:, 2], *_WHORL)
    return before_ears * before_whorl * way / np.linalg.norm(way, axis=1, keepdims=True)


def _left(places: Floats, styling: StylingSettings) -> Floats:
    return _fade(places[:, 0], 0.7, 1.6) * _along(places, 1, 0, 0)


def _right(places: Floats, styling: StylingSettings) -> Floats:
    return _fade(-places[:, 0], 0.7, 1.6) * _along(places, -1, 0, 0)


def _up(places: Floats, styling: StylingSettings) -> Floats:
    return _along(places, 0, 1, 0)


def _spiky(places: Floats, styling: StylingSettings) -> Floats:
    return places / np.maximum(np.linalg.norm(places, axis=1, keepdims=True), 0.3)


def _blown(places: Floats, styling: StylingSettings) -> Floats:
    # Gusts: slow waves across the wind, of lengths that never meet, lift some locks and press others down.
    heading = styling.blown_heading
    wind = np.array([np.sin(heading), 0.0, np.cos(heading)])
    across = np.array([np.cos(heading), 0.0, -np.sin(heading)])
    side, height, run = places @ across, places[:, 1], places @ wind
    sway = 0.30 * np.sin(2.3 * height + 1.7 * run) + 0.2 * np.sin(3.7 * side - 2.9 * run + 1.0)
    lift = 0.35 * np.sin(2.9 * side + 1.3 * run + 0.5) + 0.2 * np.sin(4.3 * height - 2.1 * run)
    return wind + sway[:, None] * across + np.outer(0.25 + lift, [0.0, 1.0, 0.0])


def _parted(places: Floats, styling: StylingSettings) -> Floats:
    side = np.tanh(_beside_parting(places, styling) / 0.12)
    on_top = 1.0 - _fade(places[:, 1], 0.1, 0.6)
    # As a comb goes: to the side, and down where the skull goes down.
    over = np.maximum(side * places[:, 0], 0.0)
    way = np.stack([side * np.maximum(places[:, 1], 0.3), -0.2 * over, 0 * side], axis=1)
    return on_top * np.abs(side)[:, None] * row_unit(way, otherwise=np.zeros_like(way))


def _beside_parting(places: Floats, styling: StylingSettings) -> Floats:
    """How far to the left of the parting places are, (k,). From the top of the head on it runs back to the whorl."""
    behind = np.clip(-places[:, 2], 0.0, 1.0)
    return places[:, 0] - styling.parting * (1.0 - 0.6 * behind**1.5)


def _off_face(places: Floats, styling: StylingSettings) -> Floats:
    # Hair goes to the side of the parting that it comes from: across the forehead, not against itself.
    side = np.tanh(_beside_parting(places, styling) / 0.1)[:, None]
    # Sideways before the forehead; beside it hair has arrived.
    arrived = 1.0 - _fade(side[:, 0] * places[:, 0], 0.4, 1.0)
    before_face = (1.0 - _fade(places[:, 2], 0.1, 0.7)) * _fade(np.abs(places[:, 0]), 0.95, 1.3)
    below_hairline = _fade(places[:, 1], 0.8, 1.2)
    return (
        before_face
        * below_hairline
        * ((1.0 - arrived) * side * np.array([0.85, 0.0, 0.0]) + np.array([0.0, 0.0, -0.35]))
    )


def _inward(places: Floats, styling: StylingSettings) -> Floats:
    from_neck = places * np.array([1.0, 0.0, 1.0])
    reach = np.linalg.norm(from_neck, axis=1, keepdims=True)
    return -_fade(places[:, 1], -0.6, 0.0) * from_neck / np.maximum(reach, 0.5)


# Hair nearer to the shoulders than this lies on them, and hair farther off hangs free [m]; and so low it may meet them, in
# half heights of the head.
_LYING, _LOW = (0.008, 0.05), (-1.5, -1.0)
# Over the ridge: how strongly, and from how small a part of the slope's normal along the face to how large a one.
_OVER, _UNDECIDED, _CREST = 1.2, 0.04, 0.5
# Of the slope to the side hair follows so much beside the neck, and so much less it is held against it farther out, in half
# breadths of the head.
_FANS, _HELD, _BESIDE_HEAD = 0.3, 1.1, (0.7, 1.3)
# Below the shoulders: how strongly hair is drawn to breast and back that hangs beside them, how far off [m], how low.
_LEANS, _OFF_BODY, _BELOW = 0.4, (0.005, 0.02, 0.05, 0.1), (-2.0, -1.5)


def _off_shoulders(places: Floats, grid: Grid, surroundings: Surroundings) -> Floats:
    """Shoulders carry hair from where it comes near: other hair lies below, so it bends along them before it is there.

    It goes on over the breast or down the back, whichever way the slope is, fans out a little, and not more: a thread would
    slide straight down, and hair is held by other hair. Farther down it lies against the body.
    """
    off, outward = surroundings.distance_and_gradient_anywhere(grid.nodes)
    upward = np.clip(outward[:, 1:2], 0.0, 1.0)
    carried = upward * outward
    carried[:, 0] *= (_FANS + _HELD) * _fade(np.abs(places[:, 0]), *_BESIDE_HEAD)[:, 0] - _HELD
    forward = outward[:, 2]
    carried[:, 2] += _OVER * upward[:, 0] * np.tanh(forward / _UNDECIDED) * np.exp(-((forward / _CREST) ** 2))
    beside = (1.0 - _fade(off, *_OFF_BODY[:2])) * _fade(off, *_OFF_BODY[2:]) * _fade(places[:, 1], *_BELOW)
    leans = _LEANS * beside * (1.0 - upward**2) * outward
    return _fade(off, *_LYING) * _fade(places[:, 1], *_LOW) * carried - leans


# Hair that hangs beside the face is drawn to it between these heights, in half heights of the head, from so far behind on, in
# half depths of it, the more the farther off the skin it hangs, and from nowhere else [m].
_HANGS, _BESIDE_FACE, _CLOSES = (-1.6, -1.1, 0.2, 0.9), (-0.4, 0.1), (0.004, 0.03, 0.08, 0.14)


def _close(places: Floats, grid: Grid, surroundings: Surroundings) -> Floats:
    """Hair clings to the hair below it, and so to temple, cheek and throat, and does not hang plumb from where the head is
    widest. What lies over an ear stays there, and behind it hair falls over the nape.
    """
    off, outward = surroundings.distance_and_gradient_anywhere(grid.nodes)
    level = outward * np.array([1.0, 0.0, 1.0])
    beside = (1.0 - _fade(places[:, 1], *_HANGS[:2])) * _fade(places[:, 1], *_HANGS[2:])
    beside *= (1.0 - over_ears(places)[:, None]) * (1.0 - _fade(places[:, 2], *_BESIDE_FACE))
    return -beside * (1.0 - _fade(off, *_CLOSES[:2])) * _fade(off, *_CLOSES[2:]) * level


PRESETS: dict[str, Callable[[Floats, StylingSettings], Floats]] = {
    "gravity": _gravity,
    "back": _back,
    "forward": _forward,
    "left": _left,
    "right": _right,
    "up": _up,
    "spiky": _spiky,
    "blown": _blown,
    "parted": _parted,
    "off_face": _off_face,
    "inward": _inward,
}
"""The presets by the name of their weight; places are in proportions of the head, (k, 3), as are the vectors (k, 3)."""
