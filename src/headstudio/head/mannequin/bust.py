"""Neck, shoulders and chest, down to the cut."""

from __future__ import annotations

from ..mesh import Floats
from .fields import Tube, carve, ellipsoid, join, meet, shaped
from .lines import Lines, Section

CUT = -232.0  # height of the plane the bust stands on [mm]

COLUMN = Lines(
    [
        Section(70, 0, -30, 0, 0),
        Section(30, 44, -30, 14, -74),
        Section(0, 50, -26, 22, -70),
        Section(-30, 52, -26, 27, -68),
        Section(-60, 52, -28, 26, -72),
        Section(-95, 55, -32, 21, -84),
        Section(-130, 64, -38, 15, -96),
        Section(-160, 78, -44, 14, -104),
    ]
)
STERNOCLEIDOMASTOID = Tube([(55, 2, -24), (47, -50, -4), (30, -100, 9), (12, -144, 10)], [8, 10, 8, 5])
TRAPEZIUS = Tube([(18, -50, -58), (52, -100, -60), (104, -136, -54), (160, -156, -46)], [14, 22, 26, 30])
CLAVICLE = Tube([(10, -150, 13), (60, -151, 13), (108, -145, -9), (152, -142, -34)], [5, 5, 5, 6])


def _muscle(p: Floats, body: Floats) -> Floats:
    return join(body, STERNOCLEIDOMASTOID(p), 16)


def _shoulders(p: Floats, body: Floats) -> Floats:
    chest = join(ellipsoid(p, (0, -240, -38), (168, 110, 84)), TRAPEZIUS(p), 60)
    chest = join(chest, ellipsoid(p, (158, -188, -42), (38, 56, 46)), 44)  # deltoid
    chest = join(chest, CLAVICLE(p), 30)
    chest = carve(chest, ellipsoid(p, (0, -144, 28), (8, 12, 16)), 22)  # notch above the breastbone
    chest = meet(chest, ellipsoid(p, (0, -130, -30), (204, 140, 150)), 30)
    return join(body, chest, 34)


def bust(p: Floats, head: Floats) -> Floats:
    """``head`` on its neck and shoulders, for points with x >= 0 [mm]."""
    body = shaped(p, COLUMN(p), (-1, -175, -60), (85, 45, 45), _muscle)
    body = shaped(p, body, (-1, -400, -400), (400, 10, 400), _shoulders)
    return join(head, body, 22)
