"""Neck, shoulders and chest, down to the cut."""

from __future__ import annotations

from ..mesh import Floats
from .fields import carve, cone, ellipsoid, join, meet, tube
from .lines import Lines, Section

CUT = -232.0  # height of the plane the bust stands on [mm]

NECK = Lines(
    [
        Section(70, 0, -30, 0, 0),
        Section(30, 44, -30, 14, -74),
        Section(0, 50, -26, 22, -72),
        Section(-30, 53, -26, 26, -68),
        Section(-60, 53, -27, 26, -71),
        Section(-95, 56, -31, 22, -82),
        Section(-130, 66, -38, 16, -98),
        Section(-160, 80, -44, 14, -108),
    ]
)


def neck(p: Floats) -> Floats:
    """The column of the neck with the muscles that turn the head."""
    muscle = tube(p, [(55, 2, -24), (47, -50, -4), (30, -100, 10), (12, -142, 12)], [8, 10, 9, 6])
    return join(NECK(p), muscle, 14)


def torso(p: Floats) -> Floats:
    """Trapezius, shoulders, collar bones and the upper chest."""
    chest = ellipsoid(p, (0, -235, -36), (172, 110, 88))
    slope = tube(p, [(20, -62, -60), (58, -100, -58), (110, -128, -50), (165, -150, -44)], [34, 34, 34, 34])
    chest = join(chest, slope, 50)
    chest = join(chest, ellipsoid(p, (166, -184, -42), (40, 58, 46)), 40)  # deltoid
    chest = join(chest, tube(p, [(10, -146, 16), (60, -146, 20), (110, -136, -2), (160, -132, -30)], [6, 5, 5, 6]), 22)
    chest = carve(chest, ellipsoid(p, (0, -142, 28), (8, 12, 14)), 20)  # notch above the breastbone
    return meet(chest, ellipsoid(p, (0, -130, -30), (212, 140, 150)), 30)
