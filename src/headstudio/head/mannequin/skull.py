"""The large forms: braincase, forehead, cheekbones, jaw and chin."""

from __future__ import annotations

from ..mesh import Floats
from .fields import bump, cone, ellipsoid, join
from .lines import Lines, Section

HEAD = Lines(
    [
        Section(149, 0, -12, 0, 0),
        Section(141, 37, -12, 37, -55),
        Section(126, 57.5, -13, 71, -77, 0, 0.07),
        Section(106, 70, -15, 92, -89, 0.07, 0.12),
        Section(85, 75, -16, 99.5, -92, 0.12, 0.12),
        Section(65, 75.5, -16, 100.5, -92.5, 0.17, 0.12),
        Section(50, 74, -12, 95.5, -91, 0.17, 0.07),
        Section(35, 71, -2, 90.5, -87, 0.17, 0),
        Section(18, 68.5, 10, 92, -80, 0.15, 0),
        Section(0, 66.5, 14, 95, -70, 0.09, 0),
        Section(-18, 62.5, 14, 97, -58, 0.07, 0),
        Section(-36, 55.5, 14, 97, -30, 0, 0),
        Section(-48, 47.5, 24, 96, 4, 0, 0.12),
        Section(-57, 39, 42, 96.5, 32, 0, 0.12),
        Section(-64, 28.5, 57, 93.5, 48, 0, 0.12),
        Section(-69, 16.5, 68, 87.5, 60, 0, 0.12),
        Section(-73, 0, 74, 0, 0),
    ]
)


def skull(p: Floats) -> Floats:
    """Head without eyes, nose, lips and ears, for points with x >= 0 [mm]."""
    head = HEAD(p)
    head = join(head, ellipsoid(p, (40, 11, 46), (22, 17, 32), (0, 28, 0)), 34)  # cheekbone
    head = join(head, ellipsoid(p, (36, -20, 52), (20, 30, 27), (0, 30, 0)), 26)  # cheek
    head = join(head, cone(p, (0, 54.5, 85.5), (32, 60.5, 72.5), 11, 11), 30)  # brow ridge
    head = join(head, ellipsoid(p, (0, -24, 70), (31, 29, 35.5)), 26)  # the barrel of the teeth
    head = join(head, ellipsoid(p, (0, -58, 86), (17, 12, 13)), 18)  # chin
    return head + 2.5 * bump(p, (68, 58, 58), (18, 26, 22))  # hollow of the temple
