"""The lower jaw: a hinge in front of the ears that takes chin, lower lip, lower teeth and tongue along.

How much of its turn a point of the skin takes is 1 where the jawbone carries it and 0 where the skull does; between them
it spreads over the surface as a harmonic function, led along the lips. These meet in space and not on the surface, which
goes from one to the other around the inside of the mouth (head/mouth.py).
"""

from __future__ import annotations

from dataclasses import dataclass

import igl
import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu
from scipy.spatial.transform import Rotation

from ..head.head import Head, Part
from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.mouth import lines_mouth
from ..head.sight import lip_seam, seen_from_front
from ..head.smooth import smoothstep

# The hinge lies in front of the ear hole by this part of the height of the head.
_HINGE_FORWARD = 0.05
# Angles about the hinge [rad], down from it, beside where the lips meet: skull above, jaw below; and below the chin, where
# the jaw ends and where the neck begins.
_CHEEK = np.radians([-12.0, 10.0])
_THROAT = np.radians([4.0, 60.0])
# The neck begins so far from the hinge, in distances of the chin.
_NECK = 1.6
# Skin nearer to the hinge than this part of the way to the chin slides over the jaw.
_CARRIED_FROM = 0.55
# While the mouth opens the joint glides forward, per radian, as a part of the height of the head.
_GLIDE = 0.06
# Lips are led at this distance from the seam, in half widths of the mouth: in the middle each by its own bone, towards the
# corners, which hang between the bones, ever more by both, so that an open mouth is round.
_LIP = 0.07, 0.3
# What is hidden from the front by more than this [m] is no outside of a lip.
_HIDDEN = 0.0008
# Keeps pieces of the skin that touch neither bone where they are.
_LOOSE = 1e-9


@dataclass(frozen=True, eq=False)
class Jaw:
    """The hinge and who follows it.

    hinge: a point on its axis, shape (3,) [m]. axis: unit direction of the axis to the person's left, shape (3,). glide:
    how far the joint moves per radian, shape (3,) [m]. weight: share of the turn that every vertex of the skin takes, 0
    to 1, shape (n,). lining: which vertices line the mouth, shape (n,).
    """

    hinge: Floats
    axis: Floats
    glide: Floats
    weight: Floats
    lining: NDArray[np.bool_]

    def opened(self, vertices: Ints, points: Floats, angle: float) -> Floats:
        """The skin's ``vertices``, (k,), which are now at ``points``, (k, 3), with the jaw open by ``angle`` [rad]."""
        return self.turned(points, self.weight[vertices], angle)

    def turned(self, points: Floats, weight: Floats, angle: float) -> Floats:
        """Points, (k, 3), turned open by ``angle`` [rad] times their weight, (k,)."""
        turn = Rotation.from_rotvec((angle * weight)[:, None] * self.axis)
        opened: Floats = self.hinge + turn.apply(points - self.hinge) + (angle * weight)[:, None] * self.glide
        return opened


def find_jaw(head: Head) -> Jaw:
    """The jaw of a head, from its landmarks and the seam between its lips."""
    marks = head.landmarks
    height = float(marks.crown[1] - marks.chin[1])
    across = marks.left_tragus - marks.right_tragus
    axis = across / np.linalg.norm(across)
    forward = np.cross(axis, np.array([0.0, 1.0, 0.0]))
    forward = forward / np.linalg.norm(forward)
    hinge = 0.5 * (marks.left_tragus + marks.right_tragus) + _HINGE_FORWARD * height * forward
    glide = _GLIDE * height * forward
    weight = smoothstep(_spread(head.skin, _carried(head, hinge, axis)))
    return Jaw(hinge, axis, glide, weight, lines_mouth(head.skin, marks))


def lower_share(part: Part, jaw_level: float) -> Floats:
    """Which vertices of teeth, (k,), belong to the lower jaw: those of the rows whose middle lies below a level [m]."""
    pieces = igl.connected_components(igl.adjacency_matrix(part.mesh.faces))[1]
    levels = np.bincount(pieces, part.mesh.vertices[:, 1]) / np.bincount(pieces)
    return (levels[pieces] < jaw_level).astype(np.float64)


def _carried(head: Head, hinge: Floats, axis: Floats) -> Floats:
    """How far the jawbone takes every vertex along, (n,): 0 for what the skull keeps, 1 for what the jaw does, between them
    for lips; nan for what hangs between all these."""
    marks, points = head.landmarks, head.skin.vertices
    seam = lip_seam(head.skin, marks)
    forward = np.cross(axis, np.array([0.0, 1.0, 0.0]))
    away = points - hinge
    ahead, down = away @ forward, -away[:, 1]
    angle = np.arctan2(down, ahead)
    mouth, chin = 0.5 * (marks.mouth_left + marks.mouth_right) - hinge, marks.chin - hinge
    corner_angle = np.arctan2(-mouth[1], mouth @ forward)
    chin_angle = np.arctan2(-chin[1], chin @ forward)
    distance = np.hypot(ahead, down) / np.hypot(chin @ forward, chin[1])
    far = distance > _CARRIED_FROM

    skull = (ahead < 0) | (angle < corner_angle + _CHEEK[0]) | (angle > chin_angle + _THROAT[1]) | (distance > _NECK)
    jawbone = far & (angle > corner_angle + _CHEEK[1]) & (angle < chin_angle + _THROAT[0])
    carried = np.where(skull, 0.0, np.where(jawbone, 1.0, np.nan))
    half_width = 0.5 * (seam[-1, 0] - seam[0, 0])
    beside = np.abs(points[:, 0] - 0.5 * (seam[-1, 0] + seam[0, 0])) / half_width
    index = np.nonzero((beside < 1.0) & (np.abs(angle - corner_angle) < 2.0 * _CHEEK[1]) & far)[0]
    over = (points[index, 1] - np.interp(points[index, 0], seam[:, 0], seam[:, 1])) / half_width
    outside = points[index, 2] > seen_from_front(head.skin, points[index, :2]) - _HIDDEN
    parting = 1.0 - beside[index] ** 3
    # Neither bone holds what lines the mouth: it hangs between the lips.
    carried[index[~outside]] = np.nan
    lip = outside & (np.abs(over) > _LIP[0]) & (np.abs(over) < _LIP[1])
    carried[index[lip]] = 0.5 - 0.5 * (np.sign(over) * parting)[lip]
    return carried


def _spread(skin: TriangleMesh, held: Floats) -> Floats:
    """The harmonic function that is as ``held`` where that is a number, (n,)."""
    ends = np.concatenate([skin.faces[:, [0, 1]], skin.faces[:, [1, 2]], skin.faces[:, [2, 0]]])
    lengths = np.linalg.norm(skin.vertices[ends[:, 0]] - skin.vertices[ends[:, 1]], axis=1)
    near = 1.0 / np.maximum(lengths, 0.02 * lengths.mean())
    count = len(skin.vertices)
    weights = sparse.coo_array((np.tile(near, 2), (ends.ravel("F"), ends[:, ::-1].ravel("F"))), shape=(count, count))
    laplacian = (sparse.diags_array(weights.sum(axis=1) + _LOOSE * near.mean()) - weights).tocsr()
    free = np.nonzero(np.isnan(held))[0]
    value = np.nan_to_num(held)
    rows = laplacian[free]
    value[free] = splu(rows[:, free].tocsc()).solve(-rows @ value)
    return value
