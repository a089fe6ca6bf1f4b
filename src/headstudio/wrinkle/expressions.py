"""Named expressions: which muscles contract, which of MakeHuman's units take part, and what jaw, lids and eyes do."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Expression:
    """One expression at full strength, alike on both sides.

    contractions: by name of the muscle, in its own unit; below 0 a muscle lengthens. units: strengths of MakeHuman's
    expression units, by name, with SIDE where there is one unit for each side. jaw: how far it opens [rad]. upper_lid,
    lower_lid: 1 where the lids would meet, below 0 wider than at rest. gaze_down: how far the eyes look down [rad].
    """

    contractions: Mapping[str, float] = field(default_factory=dict)
    units: Mapping[str, float] = field(default_factory=dict)
    jaw: float = 0.0
    upper_lid: float = 0.0
    lower_lid: float = 0.0
    gaze_down: float = 0.0


EXPRESSIONS: Mapping[str, Expression] = {
    "thinking": Expression(
        contractions={
            "lateral corrugator": 0.6,
            "depressor supercilii": 0.12,
            "procerus": 0.2,
            "orbicularis oculi": 0.08,
            "orbicularis oris": 0.3,
            "mentalis": 0.35,
            "angular depressor": 0.08,
        },
        units={
            "eyebrows-SIDE-down": 0.6,
            "mouth-compression": 0.5,
            "mouth-pursing": 0.25,
            "nose-compression": 0.2,
        },
        upper_lid=0.1,
        lower_lid=0.3,
        gaze_down=math.radians(-5),
    ),
    "smile": Expression(
        contractions={
            "zygomatic minor": 1.35,
            "zygomatic major": 0.15,
            "risorius": 0.2,
            "labi nasi": 0.3,
            "orbicularis oculi": 0.25,
            "frontalis outer": 0.1,
        },
        units={"mouth-corner-puller": 0.8, "mouth-retraction": 0.2, "nose-SIDE-dilatation": 0.2},
        upper_lid=0.1,
        lower_lid=0.5,
    ),
    "troubled": Expression(
        contractions={
            "frontalis inner": 1.6,
            "secondary frontalis": 0.35,
            "lateral corrugator": 0.35,
            "angular depressor": 0.22,
            "mentalis": 0.35,
        },
        units={"eyebrows-SIDE-inner-up": 1.0, "mouth-depression": 0.6},
        upper_lid=0.08,
    ),
    "angry": Expression(
        contractions={
            "lateral corrugator": 0.9,
            "procerus": 0.55,
            "depressor supercilii": 0.3,
            "inner labi nasi": 0.5,
            "labi nasi": 0.5,
            "angular depressor": 0.12,
            "orbicularis oris": 0.12,
        },
        units={
            "eyebrows-SIDE-down": 1.0,
            "nose-SIDE-elevation": 0.6,
            "nose-SIDE-dilatation": 0.6,
            "mouth-depression": 0.4,
            "mouth-compression": 0.5,
        },
        upper_lid=-0.05,
        lower_lid=0.25,
    ),
    "surprise": Expression(
        contractions={
            "frontalis": 0.24,
            "frontalis inner": 0.8,
            "frontalis outer": 0.15,
            "orbicularis oris": 0.32,
            "inner labi nasi": 0.15,
        },
        units={"eyebrows-SIDE-up": 1.0},
        jaw=math.radians(12),
        upper_lid=-0.25,
        lower_lid=-0.1,
    ),
    "squint": Expression(
        contractions={
            "orbicularis oculi": 0.35,
            "lateral corrugator": 0.4,
            "depressor supercilii": 0.2,
            "procerus": 0.25,
            "labi nasi": 0.3,
            "zygomatic major": 0.2,
        },
        units={"eyebrows-SIDE-down": 0.7, "nose-SIDE-elevation": 0.4, "nose-compression": 0.3},
        upper_lid=0.25,
        lower_lid=0.6,
    ),
    "look_down": Expression(
        contractions={"frontalis": -0.03},
        gaze_down=math.radians(26),
    ),
}
"""By the name that their sliders have; neutral is none of them. The thesis shows the first, third, fourth and the
smile (figures 2.10 to 2.13)."""

FACES: Mapping[str, Mapping[str, float]] = {
    "neutral": {},
    "thinking": {"thinking": 1.0},
    "smiling": {"smile": 1.0},
    "troubled": {"troubled": 1.0},
    "angry": {"angry": 1.0},
    "surprised": {"surprise": 1.0},
    "squinting": {"squint": 1.0},
    "looking-down": {"look_down": 1.0},
}
"""Faces to start from, those of the thesis (figures 2.10 to 2.13) and more, as sliders."""

BLINK = Expression(upper_lid=1.0, lower_lid=1.0, contractions={"orbicularis oculi": 0.1})
JAW_OPEN = Expression(jaw=math.radians(18))
