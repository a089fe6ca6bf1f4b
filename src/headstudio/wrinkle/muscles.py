"""The three kinds of facial muscle, each as a field of displacements (Waters 1987).

A field says where the points of the skin go per unit of contraction, toward what the muscle is fixed to; contracting a
muscle adds that multiple of its field. So a face is a sum of fields, and the order of its muscles does not matter.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..head.mesh import Floats


class Muscle(Protocol):
    """What moves skin."""

    def field(self, points: Floats) -> Floats:
        """Displacements of points [m], (n, 3), per unit of contraction [m], (n, 3)."""
        ...


@dataclass(frozen=True, eq=False)
class LinearMuscle:
    """Fibres that spread from one point on the bone into a cone of skin: Waters 1987, the linear muscle.

    origin: where it is fixed, shape (3,) [m]. insertion: where it enters the skin, shape (3,) [m]; it gives the axis of
    the cone. fade_start, fade_end: the paper's Rs and Rf, between which the pull fades [m]. zone: angle between the axis
    and the border of the cone [rad], below a right angle.
    """

    origin: Floats
    insertion: Floats
    fade_start: float
    fade_end: float
    zone: float

    def field(self, points: Floats) -> Floats:
        """p - o times (1 - cos(angle) / cos(zone)), which points to the origin inside the cone, times the fading."""
        away = points - self.origin
        distance = np.linalg.norm(away, axis=1)
        axis = (self.insertion - self.origin) / np.linalg.norm(self.insertion - self.origin)
        cosine = np.divide(away @ axis, distance, out=np.ones_like(distance), where=distance > 0)
        pull = np.minimum(1.0 - cosine / np.cos(self.zone), 0.0)
        return (pull * fading(distance, self.fade_start, self.fade_end))[:, None] * away


@dataclass(frozen=True, eq=False)
class SheetMuscle:
    """Parallel fibres fixed along a line: Waters 1987, the sheet muscle.

    origin: middle of the line that it is fixed along, shape (3,) [m]. insertion: where the middle fibre enters the skin.
    across: unit direction of the line, shape (3,). half_width: from the middle fibre to the outermost [m]. fade_start,
    fade_end: distances from the line between which the pull fades [m].

    A unit of contraction shortens fibres by their whole length. The pull fades out over the outer part of the width, and
    over twice the width in depth, so that a sheet on the brow leaves the back of the head alone.
    """

    origin: Floats
    insertion: Floats
    across: Floats
    half_width: float
    fade_start: float
    fade_end: float

    # Where the pull starts to fade, as a part of the half width.
    _FULL = 0.4

    def field(self, points: Floats) -> Floats:
        """Along the fibres toward the line, by the distance from it times the fading."""
        along = (self.insertion - self.origin) / np.linalg.norm(self.insertion - self.origin)
        across = self.across - (self.across @ along) * along
        across = across / np.linalg.norm(across)
        away = points - self.origin
        distance = np.maximum(away @ along, 0.0)
        beside, below = np.abs(away @ across), np.abs(away @ np.cross(along, across))
        width = fading(beside, self._FULL * self.half_width, self.half_width)
        depth = fading(below, self.half_width, 2.0 * self.half_width)
        pull = distance * fading(distance, self.fade_start, self.fade_end) * width * depth
        return -pull[:, None] * along


@dataclass(frozen=True, eq=False)
class SphincterMuscle:
    """Fibres around an opening, drawn together to its middle: Waters 1987, the sphincter muscle.

    centre: middle of the opening, shape (3,) [m]. across, up: unit directions of the axes of the ellipse, shape (3,).
    half_width, half_height: its semi-axes lx and ly [m]. depth: how far before and behind the opening it acts [m].
    draw: how much of the way to the middle a unit of contraction draws skin across and up. protrusion: how far forward
    it pushes the middle [m], as lips that are pursed.
    """

    centre: Floats
    across: Floats
    up: Floats
    half_width: float
    half_height: float
    depth: float
    draw: tuple[float, float] = (1.0, 1.0)
    protrusion: float = 0.0

    def field(self, points: Floats) -> Floats:
        """Toward the middle, by 1 - sqrt(ly^2 x^2 + lx^2 y^2) / (lx ly) inside the ellipse."""
        forward = np.cross(self.across, self.up)
        away = points - self.centre
        x, y, z = away @ self.across, away @ self.up, away @ forward
        inside = np.maximum(1.0 - np.hypot(x / self.half_width, y / self.half_height), 0.0)
        pull = inside * fading(np.abs(z), 0.5 * self.depth, self.depth)
        return (
            -(pull * self.draw[0] * x)[:, None] * self.across
            - (pull * self.draw[1] * y)[:, None] * self.up
            + (pull * self.protrusion)[:, None] * forward
        )


def fading(distance: Floats, start: float, end: float) -> Floats:
    """1 up to ``start``, then a quarter of a cosine down to 0 at ``end``, shape (n,): the radial law of Waters 1987."""
    faded = np.cos(0.5 * np.pi * np.clip((distance - start) / (end - start), 0.0, 1.0))
    return np.where(distance < end, faded, 0.0)
