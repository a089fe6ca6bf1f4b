"""Eyelids: skin that turns about the middle of the eyeball, and never enters it.

The opening is what of the ball is seen from the front, column by column. A lid turns about the axis of the eye that runs
from side to side, which keeps its distance from the ball, and the skin beside it follows less and less.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ..head.eyes import eyeball
from ..head.head import Landmarks, Part
from ..head.locate import locator
from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.rows import row_dot
from ..head.smooth import smoothstep
from .vectors import scaled, unit

# Lids turn as one up to this distance, and what is farther than the second rests.
_THICK = (1.3, 2.0)
# Before the middle of the ball lids turn, fully so from this distance on, in its radii; behind it skin rests.
_FRONT = 0.3
# How far beyond its margin a lid takes skin along [rad], the upper and the lower one.
_FOLLOWING = np.radians([42.0, 34.0])
# Where closed lids meet: this part of the opening above the lower one.
_MEETING = 0.28
# Skin stays at least this far from the middle, if it was so at rest.
_CLEAR = 1.05
# Half as wide as this part of the height of the head is an eye that is not there.
_USUAL = 0.06
_COLUMNS = np.linspace(-0.98, 0.98, 50)
_ANGLES = np.radians(np.linspace(-80.0, 80.0, 161))


@dataclass(frozen=True, eq=False)
class Lids:
    """The lids of one eye.

    centre: of the ball, shape (3,) [m]. left, up, forward: unit axes of the eye. vertices: those of the skin that lids
    move or that lie near the ball, (k,). fall: how far down each of them turns when the upper lid closes, rise: how far
    up when the lower one does [rad], (k,). clearance: how near to the centre each may come [m], (k,). top, bottom: angles
    of the margins over the columns of the eye [rad], (50,).
    """

    centre: Floats
    left: Floats
    up: Floats
    forward: Floats
    vertices: Ints
    fall: Floats
    rise: Floats
    clearance: Floats
    top: Floats
    bottom: Floats

    @property
    def largest_fall(self) -> float:
        """How far the upper lid turns to close, where the eye is open widest [rad]."""
        return float(self.fall.max())

    @property
    def largest_rise(self) -> float:
        """How far the lower lid turns to close, where the eye is open widest [rad]."""
        return float(self.rise.max())

    def turns(self, upper: float, lower: float) -> Floats:
        """How far each vertex turns down [rad], (k,). upper, lower: 1 where the lids meet, 0 at rest, below 0 wider."""
        return turned_down(self.fall, self.rise, upper, lower)

    def margin_beside(self, roots: Floats) -> tuple[Floats, Floats]:
        """How far the margin falls and rises where lashes have their roots, (k, 3) [m], when its lid closes [rad], (k,)
        each, as ``fall`` and ``rise`` do of the skin."""
        column, angle, _ = _polar(roots - self.centre, (self.left, self.up, self.forward))
        top, bottom = np.interp(column, _COLUMNS, self.top), np.interp(column, _COLUMNS, self.bottom)
        is_upper, opening = angle > 0.5 * (top + bottom), top - bottom
        return np.where(is_upper, (1.0 - _MEETING) * opening, 0.0), np.where(is_upper, 0.0, _MEETING * opening)

    def turned(self, points: Floats, turn: Floats) -> Floats:
        """Points, (k, 3), turned down about the middle of the eye by ``turn`` [rad], (k,)."""
        axes = np.stack([self.up, self.forward])
        height, ahead = axes @ (points - self.centre).T
        sine, less = np.sin(turn), np.cos(turn) - 1.0
        change = np.stack([less * height - sine * ahead, less * ahead + sine * height], axis=1)
        turned: Floats = points + change @ axes
        return turned

    def cleared(self, points: Floats) -> Floats:
        """Points, (k, 3), pushed straight out of the ball where they have come too near."""
        away = points - self.centre
        near = np.flatnonzero(row_dot(away, away) < self.clearance**2)
        cleared = points.copy()
        cleared[near] = self.centre + scaled(unit(away[near]), self.clearance[near])
        return cleared


def turned_down(fall: Floats, rise: Floats, upper: float, lower: float) -> Floats:
    """How far points turn down that fall and rise so far when lids close [rad], (k,); see ``Lids.turns``."""
    return min(upper, 1.0) * fall - min(lower, 1.0) * rise


def usual_eye(marks: Landmarks, side: str) -> Part:
    """Where an eye of usual size would be behind the lids of one side ("left" or "right") of a head that has none."""
    pupil = marks.left_eye if side == "left" else marks.right_eye
    forward = np.array([0.0, 0.0, 1.0])
    radius = _USUAL * float(marks.crown[1] - marks.chin[1])
    return eyeball(pupil - radius * forward, forward, radius)


def find_lids(skin: TriangleMesh, marks: Landmarks, eye: Part) -> Lids | None:
    """The lids of an eye, or None where skin leaves no opening before it. ``eye`` has a centre and an axis."""
    if eye.centre is None or eye.axis is None:
        raise ValueError("lids are found around an eyeball, which has a centre and an axis")
    left, up, forward = _axes(marks, eye.axis)
    margins = _margins(skin, eye.centre, eye.radius, (left, up, forward))
    if margins is None:
        return None
    upper, lower = margins
    away = skin.vertices - eye.centre
    near = np.nonzero(np.linalg.norm(away, axis=1) < _THICK[1] * eye.radius)[0]
    away = away[near]
    column, angle, distance = _polar(away, (left, up, forward))
    ahead = away @ forward
    top, bottom = np.interp(column, _COLUMNS, upper), np.interp(column, _COLUMNS, lower)
    meeting = bottom + _MEETING * (top - bottom)
    thick = smoothstep((_THICK[1] - distance / eye.radius) / (_THICK[1] - _THICK[0])) * smoothstep(
        ahead / eye.radius / _FRONT
    )
    above = thick * smoothstep(1.0 - (angle - top) / _FOLLOWING[0])
    below = thick * smoothstep(1.0 - (bottom - angle) / _FOLLOWING[1])
    # A point in the opening itself (a caruncle, the floor of a slit) goes with the lid that it is nearer to.
    is_upper = angle > 0.5 * (top + bottom)
    return Lids(
        eye.centre,
        left,
        up,
        forward,
        near,
        fall=np.where(is_upper, above, 0.0) * (top - meeting),
        rise=np.where(is_upper, 0.0, below) * (meeting - bottom),
        clearance=np.where(distance < eye.radius, 0.0, np.minimum(distance, _CLEAR * eye.radius)),
        top=upper,
        bottom=lower,
    )


def _polar(away: Floats, axes: tuple[Floats, Floats, Floats]) -> tuple[Floats, Floats, Floats]:
    """Column, which is the sine of the angle to the left, angle up [rad] and distance [m] from the middle, (k,) each."""
    left, up, forward = axes
    distance = np.linalg.norm(away, axis=1)
    return away @ left / np.maximum(distance, 1e-9), np.arctan2(away @ up, away @ forward), distance


def _axes(marks: Landmarks, axis: Floats) -> tuple[Floats, Floats, Floats]:
    left = marks.left_eye - marks.right_eye
    left = left - (left @ axis) * axis
    left = left / np.linalg.norm(left)
    return left, np.cross(axis, left), axis


def _margins(
    skin: TriangleMesh, centre: Floats, radius: float, axes: tuple[Floats, Floats, Floats]
) -> tuple[Floats, Floats] | None:
    """The angles of the upper and the lower margin in every column [rad], (50,) each; equal beside the opening."""
    left, up, forward = axes
    level = np.sqrt(1.0 - _COLUMNS**2)[:, None, None]
    around = np.sin(_ANGLES)[:, None] * up + np.cos(_ANGLES)[:, None] * forward
    ball = centre + radius * (_COLUMNS[:, None, None] * left + level * around).reshape(-1, 3)
    met = locator(skin).first_hit(ball, np.broadcast_to(forward, ball.shape))
    is_open = np.isinf(met).reshape(len(_COLUMNS), len(_ANGLES))
    start, end = _longest_runs(is_open)
    seen = np.nonzero(end > start)[0]
    if len(seen) < 3:
        return None
    # The opening is the columns around the widest one; a gap beside it is none of its own.
    widest = seen[(end - start)[seen].argmax()]
    breaks = np.nonzero(np.diff(seen) > 1)[0]
    piece = next(part for part in np.split(seen, breaks + 1) if widest in part)
    lower = gaussian_filter1d(_ANGLES[start[piece]], 1.0, mode="nearest")
    upper = gaussian_filter1d(_ANGLES[end[piece] - 1], 1.0, mode="nearest")
    corners = 0.5 * (upper + lower)[[0, -1]]
    inside = np.isin(np.arange(len(_COLUMNS)), piece)
    beside = np.interp(np.arange(len(_COLUMNS)), piece[[0, -1]], corners)
    tops, bottoms = beside.copy(), beside
    tops[inside], bottoms[inside] = upper, lower
    return tops, bottoms


def _longest_runs(flags: Floats) -> tuple[Ints, Ints]:
    """First and one past last index of the longest run of True in each row, (r,) each; equal where there is none."""
    position = np.arange(flags.shape[1])
    last_closed = np.maximum.accumulate(np.where(flags, -1, position), axis=1)
    length = np.where(flags, position - last_closed, 0)
    end = length.argmax(axis=1)
    longest = length[np.arange(len(flags)), end]
    return end + 1 - longest, np.where(longest > 0, end + 1, end + 1 - longest)
