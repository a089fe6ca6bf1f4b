"""Strands that come from elsewhere find their place on a head: unit and axes are guessed, roots brought to the scalp."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import permutations, product

import numpy as np

from ..head.head import Head
from ..head.locate import locator
from ..head.mesh import Floats
from ..head.scalp import Scalp
from .strands import Strands

_UNITS = (("metres", 1.0), ("decimetres", 0.1), ("inches", 0.0254), ("centimetres", 0.01), ("millimetres", 0.001))
# Roots that lie on average this near to the scalp are where they belong [m].
_IN_PLACE = 0.008
# More than this, and whatever the file holds does not grow on this head [m].
_ASTRAY = 0.012
_SAMPLE = 600
_REFINEMENTS = 12
_AXES = "XYZ"


class AdoptError(ValueError):
    """Strands that fit the head in no way. The message is one line for the user."""


@dataclass(frozen=True, eq=False)
class Placement:
    """How the strands of a file stand on a head.

    matrix: the file's coordinates to the head frame, 4 x 4 for column vectors. root_distance: median distance of the
    roots from the scalp then [m]. reversed: the strands of the file begin at their tips. note: what was guessed.
    """

    matrix: Floats
    root_distance: float
    reversed: bool
    note: str


def place_on_head(strands: Strands, head: Head, scalp: Scalp) -> Placement:
    """Find out how the strands of a file stand: in the frame of the head's own file, in the head frame, or in any unit
    and with any axes. Raises AdoptError when they fit in no way."""
    ends = _Ends.of(strands)
    known = [("the coordinates of the head's own file", head.from_file)] if head.from_file is not None else []
    for name, matrix in (*known, ("the head's coordinates, metres", np.eye(4))):
        distance, turned = ends.distance(matrix, scalp)
        if distance <= _IN_PLACE:
            return Placement(matrix, distance, turned, f"{name}: the roots lie {1000 * distance:.1f} mm from the scalp")
    best = min(
        (_refined(ends, name, start, scalp) for name, start in _guesses(ends, scalp)),
        key=lambda placement: placement.root_distance + ends.falls(placement, head),
    )
    if best.root_distance > _ASTRAY:
        raise AdoptError(
            "the strands fit this head in no unit and no axes: "
            f"their roots stay {100 * best.root_distance:.0f} cm from the scalp"
        )
    return best


def adopt(strands: Strands, placement: Placement, head: Head, *, reroot: bool = True) -> Strands:
    """The strands in the head frame [m], root first, each moved so that its root lies on the skin if ``reroot`` says so.

    The move fades along the strand: the root is brought home, the tip stays where it was.
    """
    points = strands.points @ placement.matrix[:3, :3].T + placement.matrix[:3, 3]
    scale = float(np.cbrt(abs(np.linalg.det(placement.matrix[:3, :3]))))
    if placement.reversed:
        strands = _reversed(strands)
        points = points[_reversal(strands)]
    radius = None if strands.radius is None else strands.radius * np.float32(scale)
    strands = replace(strands, points=points.astype(np.float32), radius=radius)
    return _rerooted(strands, head) if reroot else strands


def _rerooted(strands: Strands, head: Head) -> Strands:
    points, first = strands.points.astype(np.float64), strands.first[:-1]
    on_skin, _ = locator(head.skin).nearest(points[first])
    home = on_skin.blend(head.skin.vertices, head.skin.faces) - points[first]
    strand = np.repeat(np.arange(strands.count), strands.counts)
    along = (np.arange(len(points)) - first[strand]) / (strands.counts - 1)[strand]
    moved = points + (1.0 - along)[:, None] * home[strand]
    return replace(strands, points=moved.astype(np.float32))


@dataclass(frozen=True, eq=False)
class _Ends:
    """A sample of strands by their two ends, (k, 3) each, in the file's coordinates."""

    roots: Floats
    tips: Floats

    @classmethod
    def of(cls, strands: Strands) -> _Ends:
        chosen = np.unique(np.linspace(0, strands.count - 1, min(_SAMPLE, strands.count)).astype(np.int64))
        points = strands.points.astype(np.float64)
        return cls(points[strands.first[chosen]], points[strands.first[chosen + 1] - 1])

    def distance(self, matrix: Floats, scalp: Scalp) -> tuple[float, bool]:
        """Median distance of roots from the scalp [m], and whether the other ends are the roots."""
        nearest = locator(scalp.patch).nearest
        by_end = [float(np.median(nearest(_apply(matrix, end))[1])) for end in (self.roots, self.tips)]
        return min(by_end), by_end[1] < by_end[0]

    def falls(self, placement: Placement, head: Head) -> float:
        """How much speaks against a placement [m]: hair that hangs upward, or that hides the face."""
        roots, tips = (_apply(placement.matrix, end) for end in (self.roots, self.tips))
        if placement.reversed:
            roots, tips = tips, roots
        rise = np.mean((tips - roots)[:, 1]) / max(float(np.mean(np.linalg.norm(tips - roots, axis=1))), 1e-9)
        face = head.landmarks.nose_tip
        hidden = np.mean((np.linalg.norm((tips - face)[:, :2], axis=1) < 0.05) & (tips[:, 2] > face[2] - 0.02))
        return 0.004 * float(rise) + 0.02 * float(hidden)


def _guesses(ends: _Ends, scalp: Scalp) -> Iterator[tuple[str, Floats]]:
    """Every way to lay the axes and every unit that gives the roots about the size of the scalp, as starts."""
    target = scalp.patch.vertices
    middle, spread = target.mean(axis=0), float(np.sqrt(target.var(axis=0).sum()))
    for end in (ends.roots, ends.tips):
        centre, size = end.mean(axis=0), float(np.sqrt(end.var(axis=0).sum()))
        if size <= 0:
            continue
        name, metres = min(_UNITS, key=lambda unit: abs(np.log(size * unit[1] / spread)))
        if not 0.6 < size * metres / spread < 1.6:
            name, metres = "an unknown unit", spread / size
        for rotation, axes in _rotations():
            matrix = np.eye(4)
            matrix[:3, :3] = metres * rotation
            matrix[:3, 3] = middle - matrix[:3, :3] @ centre
            yield f"guessed: {name}, {axes}", matrix


def _rotations() -> Iterator[tuple[Floats, str]]:
    """The 24 turns of a cube, each with the file's axes that it takes to up and to the face."""
    for order, signs in product(permutations(range(3)), product((1.0, -1.0), repeat=3)):
        rotation = np.zeros((3, 3))
        rotation[range(3), order] = signs
        if np.linalg.det(rotation) > 0:
            up, face = ("+-"[int(signs[row] < 0)] + _AXES[order[row]] for row in (1, 2))
            yield rotation, f"{up} is up, the face looks along {face}"


def _refined(ends: _Ends, name: str, start: Floats, scalp: Scalp) -> Placement:
    """The start, moved so that its roots come to lie on the scalp: iterated closest points, by translation alone."""
    _, turned = ends.distance(start, scalp)
    end = ends.tips if turned else ends.roots
    matrix = start.copy()
    tree = locator(scalp.patch)
    for _ in range(_REFINEMENTS):
        placed = _apply(matrix, end)
        on_scalp, _ = tree.nearest(placed)
        matrix[:3, 3] += np.mean(on_scalp.blend(scalp.patch.vertices, scalp.patch.faces) - placed, axis=0)
    distance, turned = ends.distance(matrix, scalp)
    return Placement(matrix, distance, turned, f"{name}; the roots lie {1000 * distance:.1f} mm from the scalp")


def _apply(matrix: Floats, points: Floats) -> Floats:
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def _reversal(strands: Strands) -> np.ndarray:
    """Index that turns every strand around."""
    strand = np.repeat(np.arange(strands.count), strands.counts)
    return strands.first[strand] + strands.first[strand + 1] - 1 - np.arange(len(strands.points))


def _reversed(strands: Strands) -> Strands:
    index = _reversal(strands)
    return replace(
        strands,
        points=strands.points[index],
        radius=None if strands.radius is None else strands.radius[index],
        colour=None if strands.colour is None else strands.colour[index],
    )
