"""Laying a body part out by projection: on a plane, or rolled off a cylinder (Bando's thesis, section 2.4)."""

from __future__ import annotations

from dataclasses import dataclass

import igl
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.linalg import splu

from ..head.mesh import Floats, Ints, TriangleMesh

_UP = np.array([0.0, 1.0, 0.0])


class TextureMapError(ValueError):
    """A body part that cannot be laid out in texture space. The message is one line for the user."""


@dataclass(frozen=True, eq=False)
class Layout:
    """Where vertices lie in the plane, in metres and before they are fitted into the unit square.

    places: (n, 2). turns: per corner of the mesh, how many times ``period`` is added to its x so that every triangle is
    whole, (m, 3). period: once around the cylinder [m]; 0 on a plane.
    """

    places: Floats
    turns: Ints
    period: float = 0.0

    def corners(self, faces: Ints) -> Floats:
        """Every triangle in one piece, (m, 3, 2)."""
        corners = self.places[faces]
        corners[..., 0] += self.turns * self.period
        return corners


def border_cycles(faces: Ints) -> list[Ints]:
    """The vertices along every hole and open end, in order, the surface on the left."""
    loops = [np.array(loop, dtype=np.int64) for loop in igl.boundary_loop_all(np.ascontiguousarray(faces))]
    half_edges = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    known = half_edges @ [int(faces.max()) + 1, 1]
    return [loop if np.isin(loop[0] * (int(faces.max()) + 1) + loop[1], known) else loop[::-1] for loop in loops]


def project_on_plane(mesh: TriangleMesh, toward: Floats | None = None) -> Layout:
    """Seen from far away, the side that faces ``toward``, (3,), in front; without it the mean normal.

    The y axis is up where that can be. Raises TextureMapError for a closed mesh: it has no front.
    """
    normal = np.einsum("ij,i->j", mesh.face_normals, mesh.face_areas) if toward is None else np.asarray(toward)
    length = np.linalg.norm(normal)
    if not len(border_cycles(mesh.faces)) or length <= 1e-6 * mesh.face_areas.sum():
        raise TextureMapError("a closed surface has no planar map; select a part of it")
    normal = normal / length
    up = _UP if abs(normal[1]) < 0.9 else np.array([0.0, 0.0, -np.sign(normal[1])])
    right = np.cross(up, normal)
    right /= np.linalg.norm(right)
    places = mesh.vertices @ np.stack([right, np.cross(normal, right)], axis=1)
    return Layout(places, np.zeros_like(mesh.faces))


def roll_off_cylinder(mesh: TriangleMesh, axis: Floats | None = None, along: Floats | None = None) -> Layout:
    """Angle and height about an axis, angles times the mean radius, seen from outside.

    axis: a point on it [m], (3,); without it the middle of the bounding box. along: its direction, (3,); without it
    up. A part that does not go around the axis is cut nowhere. The seam of one that does lies behind (-z).

    Raises TextureMapError when the axis passes through the surface itself.
    """
    local = _about_axis(mesh, axis, along)
    around, jumps = _around(local, mesh.faces)
    if jumps.sum(axis=1).any():
        raise TextureMapError("the axis of the cylinder passes through the surface; open this part of the body there")
    turns = np.concatenate([np.zeros((len(mesh.faces), 1), dtype=np.int64), np.cumsum(jumps[:, :2], axis=1)], axis=1)
    turns -= turns.min(axis=1, keepdims=True)
    radius = float(np.average(np.hypot(local[:, 0], local[:, 2])[mesh.faces].mean(axis=1), weights=mesh.face_areas))
    period = 2 * np.pi * radius
    layout = Layout(np.stack([around * period, local[:, 1]], axis=1), turns, period)
    return layout if _goes_around(mesh, layout) else _unrolled(mesh, layout)


def axis_is_free(mesh: TriangleMesh, axis: Floats, along: Floats) -> bool:
    """Whether a surface can be rolled off an axis: whether that passes through no triangle."""
    _, jumps = _around(_about_axis(mesh, axis, along), mesh.faces)
    return not jumps.sum(axis=1).any()


def _about_axis(mesh: TriangleMesh, axis: Floats | None, along: Floats | None) -> Floats:
    """Vertices from an axis that points up the second of three coordinates, with the front along the third, (n, 3)."""
    middle = mesh.bounds.mean(axis=0) if axis is None else np.asarray(axis, dtype=np.float64)
    up = _UP if along is None else np.asarray(along, dtype=np.float64) / np.linalg.norm(along)
    front = np.array([0.0, 0.0, 1.0]) if abs(up[2]) < 0.9 else np.array([0.0, -np.sign(up[2]), 0.0])
    front = front - (front @ up) * up
    front /= np.linalg.norm(front)
    local: Floats = (mesh.vertices - middle) @ np.stack([np.cross(up, front), up, front], axis=1)
    return local


def _around(local: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """How far around the axis vertices are, (n,), once around being 1 with the front at one half; and per corner of the
    faces how often the way to the next one passes the seam, (m, 3)."""
    around = (np.arctan2(local[:, 0], local[:, 2]) / (2 * np.pi) + 0.5) % 1.0
    steps = around[np.roll(faces, -1, axis=1)] - around[faces]
    return around, -np.round(steps).astype(np.int64)


def loop_steps(layout: Layout, loop: Ints) -> Floats:
    """From every vertex of a border loop to the next, the short way around the cylinder, (k, 2)."""
    steps = np.roll(layout.places[loop], -1, axis=0) - layout.places[loop]
    if layout.period:
        steps[:, 0] -= layout.period * np.round(steps[:, 0] / layout.period)
    return steps


def winding(layout: Layout, loop: Ints) -> int:
    """How often a border loop goes around the cylinder."""
    return int(np.rint(loop_steps(layout, loop)[:, 0].sum() / layout.period)) if layout.period else 0


def _goes_around(mesh: TriangleMesh, layout: Layout) -> bool:
    """Whether a part is a tube around the axis. Raises TextureMapError when only one of its ends is open."""
    windings = [winding(layout, loop) for loop in border_cycles(mesh.faces)]
    if sorted(w for w in windings if w) not in ([], [-1, 1]):
        raise TextureMapError("this part of the body does not wind once around its axis, with an opening at either end")
    return any(windings)


def _unrolled(mesh: TriangleMesh, layout: Layout) -> Layout:
    """A part that does not go around, cut free of the seam: neighbours are joined from one triangle outward."""
    count = len(mesh.vertices)
    after, before = mesh.faces[:, [1, 2, 0]].ravel(), mesh.faces.ravel()
    turn = (np.roll(layout.turns, -1, axis=1) - layout.turns).ravel()
    level = _levels(count, before, after, turn)
    places = layout.places + np.stack([level * layout.period, np.zeros(count)], axis=1)
    return Layout(places, np.zeros_like(mesh.faces))


def _levels(count: int, start: Ints, end: Ints, turn: Ints) -> Floats:
    """Whole numbers whose differences along the edges are ``turn``, (count,): they exist when no loop goes around."""
    edge = np.arange(len(start))
    both = np.concatenate([edge, edge]), np.concatenate([end, start])
    difference = coo_array((np.repeat([1.0, -1.0], len(edge)), both), shape=(len(edge), count)).tocsc()[:, 1:]
    levels = splu((difference.T @ difference).tocsc()).solve(difference.T @ turn.astype(np.float64))
    return np.concatenate([[0.0], np.rint(levels)])
