"""The large forms: braincase, forehead, cheekbones, jaw and chin."""

from __future__ import annotations

from ..mesh import Floats
from .fields import bump, cone, ellipsoid, join
from .lines import Lines, Section

HEAD = Lines(
    [
        Section(149, 0, -12, 0, 0),
        Section(140, 39, -12, 36, -58),
        Section(125, 58, -13, 69, -78, 2.0, 2.1),
        Section(105, 70, -15, 90, -89, 2.1, 2.2),
        Section(85, 75, -16, 98.5, -92, 2.2, 2.2),
        Section(65, 75.5, -16, 101, -92, 2.3, 2.2),
        Section(50, 74, -12, 100, -90, 2.3, 2.1),
        Section(35, 71, -2, 96, -86, 2.3, 2.0),
        Section(18, 68.5, 10, 95, -79, 2.2, 2.0),
        Section(0, 65, 14, 96, -70, 2.1, 2.0),
        Section(-18, 60, 14, 98, -58, 2.0, 2.0),
        Section(-36, 53, 14, 98, -30, 2.0, 2.0),
        Section(-48, 45.5, 24, 97, 0, 2.0, 2.2),
        Section(-58, 36, 42, 98, 30, 2.0, 2.2),
        Section(-66, 23, 60, 95, 52, 2.0, 2.2),
        Section(-71.5, 0, 70, 0, 0),
    ]
)


def skull(p: Floats) -> Floats:
    """Head without eyes, nose, lips and ears, for points with x >= 0 [mm]."""
    head = HEAD(p)
    head = join(head, ellipsoid(p, (46, 12, 56), (19, 14, 24), (0, 38, 0)), 24)  # cheekbone
    head = join(head, cone(p, (0, 54, 88), (30, 58, 80), 13, 11), 26)  # brow ridge
    head = join(head, ellipsoid(p, (0, -27, 72), (30, 26, 33)), 26)  # the barrel of the teeth
    head = join(head, ellipsoid(p, (0, -58, 86), (17, 12, 14)), 18)  # chin
    head += 3.0 * bump(p, (66, 60, 62), (20, 26, 22))  # temple
    return head
