"""Skin by its age, as parameters of a document: Bando's thesis, figure 2.20, on face and hand.

With age furrows stay at rest, fine wrinkles deepen and lie farther apart, the skin dries, pales and yellows. A preset
sets the parameters it names and leaves the others; of a hand only those of ``fine`` and ``skin`` are to be seen.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ..params import ParameterError, assign
from .document import Document

SKIN_PRESETS: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "child": {
            "wrinkle.age": 0.0,
            "fine.depth": 0.2e-3,
            "fine.unit": 0.15e-3,
            "fine.initial_amplitude": 0.35,
            "fine.pores": 0.3,
            "skin.roughness": 0.44,
            "skin.flush": 1.4,
            "skin.haemoglobin": 0.08,
        },
        "young": {
            "wrinkle.age": 0.2,
            "fine.depth": 0.35e-3,
            "fine.unit": 0.2e-3,
            "fine.initial_amplitude": 0.5,
            "fine.pores": 0.8,
            "skin.roughness": 0.42,
            "skin.flush": 1.0,
        },
        "grown": {
            "wrinkle.age": 0.5,
            "fine.depth": 0.45e-3,
            "fine.unit": 0.22e-3,
            "fine.initial_amplitude": 0.6,
            "fine.pores": 1.0,
            "skin.roughness": 0.45,
            "skin.flush": 1.1,
            "skin.melanin": 0.05,
        },
        "aged": {
            "wrinkle.age": 0.85,
            "fine.depth": 0.65e-3,
            "fine.unit": 0.26e-3,
            "fine.initial_amplitude": 0.8,
            "fine.pores": 1.0,
            "skin.roughness": 0.5,
            "skin.gloss": 0.75,
            "skin.flush": 1.5,
            "skin.haemoglobin": -0.04,
            "skin.melanin": 0.08,
            "skin.creases": 1.2,
        },
        "weathered": {
            "wrinkle.age": 1.0,
            "fine.depth": 0.9e-3,
            "fine.unit": 0.3e-3,
            "fine.initial_amplitude": 0.95,
            "fine.pores": 1.0,
            "fine.pore_depth": 0.12e-3,
            "skin.roughness": 0.52,
            "skin.gloss": 0.8,
            "skin.flush": 1.8,
            "skin.haemoglobin": 0.12,
            "skin.melanin": 0.35,
            "skin.creases": 1.4,
        },
    }
)
"""Values by dotted path, by name, from young to old."""


def with_skin(document: Document, name: str) -> Document:
    """``document`` with one of SKIN_PRESETS. Raises ParameterError for a name that is none."""
    if name not in SKIN_PRESETS:
        raise ParameterError(f"a skin is one of {', '.join(SKIN_PRESETS)}; got {name!r}")
    return assign(document, SKIN_PRESETS[name])
