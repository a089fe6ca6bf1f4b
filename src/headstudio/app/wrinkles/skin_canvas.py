"""Where a tool for wrinkles works: on the head or in its texture space, with the same gestures."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import igl
import numpy as np
from imgui_bundle import ImVec2Like, imgui
from numpy.typing import NDArray

from ...head.frame import HeadFrame
from ...head.locate import SurfacePoints, barycentric
from ...head.mesh import Floats
from .. import theme
from ..picking import View
from .face_places import FacePlaces

DASH = 4.0  # length of a dash and of the gap after it, in widths of the line
AWAY = -1e4  # where points behind the camera are put


@dataclass(frozen=True)
class Touch:
    """The mouse on a canvas: where, in window units, and which keys are held."""

    x: float
    y: float
    ctrl: bool = False
    shift: bool = False


class SkinCanvas(ABC):
    """A picture of the face that can be touched. faces: its places. scale: window units for one of a plain screen."""

    faces: FacePlaces
    scale: float

    @abstractmethod
    def on_screen(self, places: SurfacePoints) -> Floats:
        """Where places are in the window, (k, 2)."""

    @abstractmethod
    def seen(self, places: SurfacePoints) -> NDArray[np.bool_]:
        """Which places are on the side that is seen, (k,)."""

    @abstractmethod
    def under(self, x: float, y: float) -> SurfacePoints | None:
        """The place under a point of the window; None beside the mapped part of the face."""

    def nearest(self, places: SurfacePoints, touch: Touch, reach: float) -> int | None:
        """The one of ``places`` that is seen nearest to the mouse, within ``reach`` of a plain screen; None for none."""
        if not len(places.faces):
            return None
        away = np.linalg.norm(self.on_screen(places) - [touch.x, touch.y], axis=1)
        away[~self.seen(places)] = np.inf
        best = int(away.argmin())
        return best if away[best] <= reach * self.scale else None


class HeadCanvas(SkinCanvas):
    """The face as the viewport shows it. positions: of the whole skin now [m], (n, 3). corner: of the picture in the window."""

    def __init__(
        self,
        faces: FacePlaces,
        view: View,
        frame: HeadFrame,
        positions: Floats,
        corner: tuple[float, float] = (0.0, 0.0),
        scale: float = 1.0,
    ) -> None:
        self.faces, self.scale = faces, scale
        self._view, self._frame, self._positions = view, frame, positions
        self._corner = np.array(corner)

    def on_screen(self, places: SurfacePoints) -> Floats:
        """Projected by the camera; those behind it far away."""
        points = self._frame.to_world(self.faces.posed(places, self._positions))
        return np.nan_to_num(self._view.project(points), nan=AWAY) + self._corner

    def seen(self, places: SurfacePoints) -> NDArray[np.bool_]:
        """Skin that faces the camera."""
        points = self._frame.to_world(self.faces.posed(places, self._positions))
        normals = self._frame.rotation.apply(self.faces.normals(places))
        seen: NDArray[np.bool_] = np.einsum("ij,ij->i", normals, self._view.eye - points) > 0
        return seen

    def under(self, x: float, y: float) -> SurfacePoints | None:
        """The first skin on the ray, as the face is now."""
        ray = self._view.ray(x - self._corner[0], y - self._corner[1]).to_head(self._frame)
        skin = self.faces.head.skin
        hits = igl.ray_mesh_intersect(ray.origin, ray.direction, self._positions, skin.faces)
        if not hits:
            return None
        face, distance, *_ = min(hits, key=lambda hit: hit[1])
        own = int(self.faces.own_face[int(face)])
        if own < 0:
            return None
        corners = self._positions[skin.faces[int(face)]]
        return SurfacePoints(np.array([own]), barycentric(ray.at(distance)[None], corners[None]))


def draw_line(
    drawing: imgui.ImDrawList, points: Floats, seen: NDArray[np.bool_], colour: int, width: float, *, edge: float = 0.0
) -> None:
    """A line in the window, (k, 2), as far as it is seen; ``edge``: how far a dark rim reaches beyond it."""
    turns = np.flatnonzero(np.diff(seen.astype(np.int8))) + 1
    for start, end in zip([0, *turns], [*turns, len(points)]):
        if not seen[start]:
            continue
        run = as_points(points[start:end])
        if edge:
            drawing.add_polyline(run, theme.packed(theme.GROUND, 0.55), width + 2 * edge, 0)
        drawing.add_polyline(run, colour, width, 0)


def draw_dashes(drawing: imgui.ImDrawList, points: Floats, seen: NDArray[np.bool_], colour: int, width: float) -> None:
    """A line in the window, (k, 2), as far as it is seen, in dashes a few widths long over a dark rim."""
    if len(points) < 2:
        return
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    arc = np.concatenate([[0.0], np.cumsum(lengths)])
    dash = DASH * width
    for start in np.arange(0.0, arc[-1], 2 * dash):
        ends = np.array([start, min(start + dash, arc[-1])])
        at = np.sort(np.concatenate([ends, arc[(arc > ends[0]) & (arc < ends[1])]]))
        if not seen[np.clip(np.searchsorted(arc, at), 0, len(seen) - 1)].all():
            continue
        run = as_points(np.stack([np.interp(at, arc, points[:, k]) for k in range(2)], axis=1))
        drawing.add_polyline(run, theme.packed(theme.GROUND, 0.6), 2.2 * width, 0)
        drawing.add_polyline(run, colour, width, 0)


def as_points(points: Floats) -> list[ImVec2Like]:
    """Points of the window, (k, 2), for a draw list."""
    return [(float(x), float(y)) for x, y in points]
