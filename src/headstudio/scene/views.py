"""The views everybody asks for by name."""

from __future__ import annotations

import math
from dataclasses import replace

from ..params import ParameterError
from .settings import Camera

# Azimuth and elevation of the camera [rad]; left and right are the person's own.
VIEWS: dict[str, tuple[float, float]] = {
    "front": (0.0, 0.0),
    "three-quarter": (math.radians(35), math.radians(8)),
    "side": (math.pi / 2, 0.0),
    "left": (math.pi / 2, 0.0),
    "right": (-math.pi / 2, 0.0),
    "back": (math.pi, 0.0),
    "top": (0.0, math.radians(89)),
}


def seen_from(camera: Camera, view: str) -> Camera:
    """The same target at the same distance from one of VIEWS. Raises ParameterError for another word."""
    if view not in VIEWS:
        raise ParameterError(f"a view is one of {', '.join(VIEWS)}; got {view!r}")
    azimuth, elevation = VIEWS[view]
    return replace(camera, azimuth=azimuth, elevation=elevation)
