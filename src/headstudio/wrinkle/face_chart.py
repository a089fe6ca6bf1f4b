"""The face chart: one flat face that all heads share, so that furrows move from head to head through the landmarks.

The chart is the front of an average head rolled off a cylinder about the skull, which bends back into the neck: x to the
person's left and y upward [m], both zero at the nasion. A smooth map (polyharmonic splines) that takes the chart's
landmarks to those of a head takes a furrow there. What a head hides under its jaw, nose and lips has its place, too: the
rolled face is unfolded, so that chart and skin are one to one.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import RBFInterpolator

from ..head.head import Head
from ..head.locate import Locator
from ..head.mesh import Floats, Ints
from ..head.rows import row_dot
from ..head.smooth import smoothstep
from .bezier import BezierChain, fit_stroke
from .furrow import Furrow
from .one_to_one import signed_areas
from .skin_layout import SkinLayout
from .unfolding import unfolded

# Landmarks of the chart [m], from MakeHuman's adults and the mannequin.
_MIDDLE = {
    "hairline": (0.0, 0.060),
    "glabella": (0.0, 0.013),
    "nasion": (0.0, 0.0),
    "nose_tip": (0.0, -0.038),
    "chin": (0.0, -0.108),
}
_LEFT = {
    ("left_eye", "right_eye"): (0.033, -0.003),
    ("mouth_left", "mouth_right"): (0.0235, -0.068),
    ("left_tragus", "right_tragus"): (0.145, -0.026),
}
# The neck's axis: reached this far below the chin, this far in front of the nape [heights of the head].
_NECK_LEVEL, _NECK_RADIUS = 0.1, 0.22
# A furrow is carried over by samples this close [m], and fitted again to within this [m].
_SPACING = 5e-4
_TOLERANCE, _NARROWEST = 5e-5, 0.03
# Rays that look for what is hidden start this far from the axis of the skull [m], and count as met this far before it.
_OUTSIDE, _BEFORE = 0.5, 2e-5
# A point this far beside the rolled face [m] is off it.
_BESIDE = 1e-6
# Rounds that invert the map, and the error they are to leave [m].
_INVERSION_ROUNDS, _INVERSION_ERROR = 60, 1e-7


class FaceChart:
    """The face chart of one head. layout: its skin and the map of its face."""

    def __init__(self, head: Head, layout: SkinLayout) -> None:
        self.layout = layout
        marks = head.landmarks
        ears = 0.5 * (marks.left_tragus + marks.right_tragus)
        height = marks.crown[1] - marks.chin[1]
        # Where the axis leaves the skull's and where it reaches the neck's [m]: levels, and its depth there.
        mouth = 0.5 * (marks.mouth_left + marks.mouth_right)
        self._bend = float(mouth[1]), float(marks.chin[1] - _NECK_LEVEL * height)
        self._depths = float(ears[2]), float(marks.nape[2] + _NECK_RADIUS * height)
        self._radius = float(marks.glabella[2] - ears[2])
        chart, names = _chart_landmarks()
        rolled = self._rolled(np.array([getattr(marks, name) for name in names]))
        self._to_head = RBFInterpolator(chart, rolled, kernel="cubic")
        self._to_chart = RBFInterpolator(rolled, chart, kernel="cubic")
        mesh = layout.part.mesh
        self._skin = Locator(mesh.vertices, mesh.faces)
        self._places = unfolded(mesh, self._rolled(mesh.vertices), self._hidden())
        self._plane = Locator(self._places, mesh.faces)

    def on_skin(self, chart: Floats) -> Floats:
        """Points of the skin [m], (k, 3), at points of the chart [m], (k, 2); nan where the face does not reach."""
        mesh = self.layout.part.mesh
        found, beside = self._plane.nearest(self._to_head(chart))
        return np.where((beside < _BESIDE)[:, None], found.blend(mesh.vertices, mesh.faces), np.nan)

    def from_skin(self, points: Floats) -> Floats:
        """Points of the chart [m], (k, 2), for points of the skin [m], (k, 3)."""
        found, _ = self._skin.nearest(points)
        rolled = found.blend(self._places, self.layout.part.mesh.faces)
        chart = self._to_chart(rolled)
        for _ in range(_INVERSION_ROUNDS):
            error = rolled - self._to_head(chart)
            if np.abs(error).max(initial=0.0) < _INVERSION_ERROR:
                break
            # Each map is nearly the other's inverse, so what is missing is carried over as a small step.
            chart = chart + self._to_chart(rolled + error) - self._to_chart(rolled)
        return chart

    def to_texture(self, furrow: Furrow) -> Furrow | None:
        """A furrow of the chart in the texture space of this head; None when less than half of it meets the face.

        What lies off the face is left out: the neck of a bust may end early. A furrow that comes to an eye or the mouth
        goes on behind it.
        """
        places = _sampled(furrow.chain, 1.0)
        skin = self.on_skin(places)
        # Where the chart is narrow, little of it is much skin.
        far = np.nan_to_num(np.linalg.norm(np.diff(skin, axis=0), axis=1))
        if far.max(initial=0.0) > 2.0 * _SPACING:
            skin = self.on_skin(_between(places, np.maximum(np.ceil(far / _SPACING), 1.0).astype(np.int64)))
        on_face = np.isfinite(skin[:, 0])
        if on_face.sum() < max(0.5 * len(skin), 2):
            return None
        return self.stroke_in_texture(furrow, skin[on_face])

    def to_chart(self, furrow: Furrow) -> Furrow:
        """A furrow of this head's texture space on the chart."""
        found, _ = self.layout.locate(_sampled(furrow.chain, self.layout.texture_map.metres))
        mesh = self.layout.part.mesh
        return self.stroke_on_chart(furrow, found.blend(mesh.vertices, mesh.faces))

    def stroke_in_texture(self, furrow: Furrow, skin: Floats) -> Furrow:
        """``furrow`` along points of the skin [m], (k, 3), in texture space. Raises ValueError for less than two points."""
        texture_map = self.layout.texture_map
        found, _ = self._skin.nearest(skin)
        uv = np.einsum("ki,kij->kj", found.weights, texture_map.corner_uv[found.faces])
        if texture_map.wrapped:
            uv[:, 0] = np.unwrap(uv[:, 0], period=1.0)
        return replace(furrow, controls=_controls(uv, _TOLERANCE / texture_map.metres))

    def stroke_on_chart(self, furrow: Furrow, skin: Floats) -> Furrow:
        """``furrow`` along points of the skin [m], (k, 3), on the chart. Raises ValueError for less than two points."""
        chart = self.from_skin(skin)
        steps, far = (np.linalg.norm(np.diff(line, axis=0), axis=1) for line in (chart, skin))
        # Where the chart is narrow, little of it is much skin.
        narrow = float((steps / np.maximum(far, _SPACING * 1e-3)).min(initial=1.0))
        return replace(furrow, controls=_controls(chart, _TOLERANCE * max(narrow, _NARROWEST)))

    def _rolled(self, points: Floats) -> Floats:
        """Arc length around the skull and height [m], (k, 2)."""
        local = points - self._axis_at(points[:, 1])
        return np.stack([self._radius * np.arctan2(local[:, 0], local[:, 2]), points[:, 1]], axis=1)

    def _hidden(self) -> np.ndarray:
        """Which triangles show their back to a ray towards the axis, or have others in front of them, (m,)."""
        mesh = self.layout.part.mesh
        middle = mesh.vertices[mesh.faces].mean(axis=1)
        rolled = self._rolled(middle)
        angle = rolled[:, 0] / self._radius
        outward = np.stack([np.sin(angle), np.zeros_like(angle), np.cos(angle)], axis=1)
        starts = self._axis_at(rolled[:, 1]) + _OUTSIDE * outward
        away = row_dot(starts - middle, outward)
        behind = self._skin.first_hit(starts, -outward) < away - _BEFORE
        return behind | (signed_areas(self._rolled(mesh.vertices)[mesh.faces]) <= 0)

    def _axis_at(self, levels: Floats) -> Floats:
        """Points of the axis at levels [m], (k,): between the ears, and farther back in the neck, (k, 3)."""
        depth = self._depths[0] + (self._depths[1] - self._depths[0]) * smoothstep(levels, *self._bend)
        return np.stack([np.zeros_like(levels), levels, depth], axis=1)


def _chart_landmarks() -> tuple[Floats, list[str]]:
    """Landmarks of the chart [m], (k, 2), and their names."""
    names = [*_MIDDLE, *(name for pair in _LEFT for name in pair)]
    sides = [(side * x, y) for x, y in _LEFT.values() for side in (1.0, -1.0)]
    return np.array([*_MIDDLE.values(), *sides]), names


def _sampled(chain: BezierChain, metres: float) -> Floats:
    """Points of a chain, some half a millimetre apart, (k, 2); ``metres`` is the length of its unit."""
    hull = np.linalg.norm(np.diff(chain.controls, axis=0), axis=1).sum() * metres
    return chain.sampled(int(np.clip(hull / _SPACING / chain.count, 8, 400)))[1]


def _between(points: Floats, counts: Ints) -> Floats:
    """Points on a line, (k, 2), with so many steps between each two and the next, (k - 1,)."""
    # The line is passed at one step a unit, and each step of it in so many.
    place = np.interp(np.arange(counts.sum() + 1), np.append(0, np.cumsum(counts)), np.arange(len(points)))
    return np.stack([np.interp(place, np.arange(len(points)), points[:, k]) for k in (0, 1)], axis=1)


def _controls(points: Floats, tolerance: float) -> tuple[tuple[float, float], ...]:
    return tuple((float(x), float(y)) for x, y in fit_stroke(points, tolerance).controls)
