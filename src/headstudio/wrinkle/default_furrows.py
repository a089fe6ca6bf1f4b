"""The wrinkles most faces get, on the face chart, and how they come with age.

Paths are laid along the skin tension lines that anatomy shows: square to the muscle below each of them. Depths and
widths are within the thesis' 2 to 12 mm for the face and, for fine creases of the lids, below. Depths are at full
amplitude: skin that shrinks by a tenth to a third, as faces do, shows that part of them.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from .bezier import fit_stroke
from .furrow import Furrow

_MM = 1e-3
_TOLERANCE = 1e-4
REGIONS = ("forehead", "glabella", "eye corner", "under eye", "nose", "nasolabial", "marionette", "chin", "neck")


class _Kind(NamedTuple):
    """A region's depth and width [mm], the age at which it begins to stay at rest, and its r at full age."""

    depth: float
    width: float
    onset: float
    oldest: float


_KINDS = {
    "forehead": _Kind(4.4, 2.1, 0.10, 0.33),
    "glabella": _Kind(5.0, 2.0, 0.15, 0.28),
    "eye corner": _Kind(5.0, 1.3, 0.10, 0.18),
    "under eye": _Kind(2.6, 1.5, 0.20, 0.25),
    "nose": _Kind(4.0, 1.2, 0.35, 0.12),
    "nasolabial": _Kind(8.0, 3.0, 0.00, 0.22),
    "marionette": _Kind(6.0, 2.6, 0.30, 0.22),
    "chin": _Kind(5.0, 2.6, 0.20, 0.22),
    "neck": _Kind(4.0, 2.2, 0.20, 0.28),
}

# Name: region, scale of depth, points [mm] from left to right or from the top down. "left" ones have a mirror image.
_PATHS: dict[str, tuple[str, float, list[tuple[float, float]]]] = {
    "forehead 1": (
        "forehead",
        0.8,
        [(46, 30), (34, 33), (20, 31), (6, 28), (-9, 27.5), (-24, 31), (-38, 32), (-47, 29)],
    ),
    "forehead 2": (
        "forehead",
        1.0,
        [(52, 36), (37, 41), (20, 40), (4, 37.5), (-13, 37), (-29, 40), (-43, 40.5), (-53, 36)],
    ),
    "forehead 3": ("forehead", 0.9, [(46, 46), (30, 50), (13, 48.5), (-3, 46.8), (-20, 48.5), (-36, 50), (-48, 46)]),
    "forehead 4": ("forehead", 0.6, [(33, 57), (18, 59), (3, 57.5), (-12, 56.5), (-27, 58.5)]),
    "glabella left": ("glabella", 1.0, [(7.5, 29), (8.0, 22), (7.0, 14), (8.0, 8)]),
    "glabella centre": ("glabella", 0.7, [(-9, 1.5), (-4, 0), (1, -0.5), (5, 0.2), (9.5, 1.5)]),
    "eye corner 1 left": ("eye corner", 0.8, [(58, 0), (64, 4.5), (71, 11), (77, 18)]),
    "eye corner 2 left": ("eye corner", 1.0, [(57, -4), (65, -2.5), (74, 0), (82, 4.5)]),
    "eye corner 3 left": ("eye corner", 1.0, [(57, -8), (64, -10), (73, -12.5), (82, -13)]),
    "eye corner 4 left": ("eye corner", 0.8, [(54, -12), (61, -17), (69, -23), (76, -29)]),
    "under eye 1 left": ("under eye", 0.8, [(20, -12), (26, -15.5), (35, -17), (44, -15.5), (50, -12)]),
    "under eye 2 left": ("under eye", 1.0, [(16, -12), (20, -18), (28, -23.5), (38, -25.5), (47, -24)]),
    "nose 1 left": ("nose", 1.0, [(3.5, -4), (7, -7), (10.5, -12), (12.5, -17)]),
    "nose 2 left": ("nose", 0.8, [(4, -10), (8, -13.5), (11.5, -18.5), (13.5, -23)]),
    "nasolabial left": (
        "nasolabial",
        1.0,
        [(21, -32), (23.5, -40), (28, -49.5), (32.5, -59), (34.5, -68), (33.5, -75)],
    ),
    "marionette left": ("marionette", 1.0, [(27, -72), (28.5, -78), (29.5, -85), (29, -92), (27.5, -97)]),
    "chin": ("chin", 1.0, [(16, -90), (9, -86.5), (0, -85.2), (-9, -86.5), (-16, -90)]),
    "neck 1": ("neck", 0.8, [(92, -122), (64, -128), (33, -133), (2, -134), (-29, -132), (-61, -128), (-88, -123)]),
    "neck 2": ("neck", 1.0, [(100, -137), (70, -144), (36, -150), (0, -152), (-37, -150.5), (-72, -145), (-103, -138)]),
}


def default_furrows(age: float) -> tuple[Furrow, ...]:
    """The furrow set of a face on the face chart; age: 0 young, 1 old.

    Young skin shows furrows only while it shrinks (r near 0); with age they get deeper, wider and stay at rest.
    """
    furrows = []
    for name, (region, part, _) in _PATHS.items():
        kind = _KINDS[region]
        grown = np.clip((age - kind.onset) / (1 - kind.onset), 0.0, 1.0)
        furrow = Furrow(
            name=name,
            region=region,
            depth=float(part * kind.depth * (0.65 + 0.45 * age) * _MM),
            width=float(kind.width * (0.9 + 0.25 * age) * _MM),
            initial=float(kind.oldest * grown**1.2),
            controls=_controls(name, 1.0),
        )
        furrows.append(furrow)
        if name.endswith("left"):
            furrows.append(
                Furrow(
                    name.replace("left", "right"),
                    region,
                    furrow.depth,
                    furrow.width,
                    furrow.initial,
                    _controls(name, -1.0),
                )
            )
    return tuple(furrows)


@lru_cache(maxsize=128)
def _controls(name: str, side: float) -> tuple[tuple[float, float], ...]:
    """A path as Bezier curves on the chart [m], mirrored for side -1."""
    points = np.array(_PATHS[name][2]) * _MM
    steps = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    smooth = CubicSpline(steps, points, bc_type="natural")(np.linspace(0.0, steps[-1], 60))
    chain = fit_stroke(smooth * [side, 1.0], _TOLERANCE)
    return tuple((float(x), float(y)) for x, y in chain.controls)
