"""The lower jaw: a hinge in front of the ears that takes chin, lower lip, lower teeth and tongue along.

How much of its turn a point of the skin takes is 1 where the jawbone carries it and 0 where the skull does; between them
it spreads over the surface as a harmonic function. Upper and lower lip meet in space and not on the surface, so a mouth
that is open in the mesh parts, and one that is a groove stretches at the bottom of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import igl
import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.ndimage import median_filter
from scipy.sparse.linalg import splu
from scipy.spatial.transform import Rotation

from ..head.head import Head, Landmarks, Part
from ..head.locate import locator
from ..head.mesh import Floats, Ints, TriangleMesh

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
# The seam between the lips is looked for within this part of the half width of the mouth, above and below the corners.
_SEAM_REACH = 0.45
_COLUMNS = 25
_LEVELS = 61
# A lip belongs to its bone beyond this distance from the seam, and in this middle part of it; both in half widths of the
# mouth. The corners hang between the bones.
_LIP_MARGIN = 0.07
_LIP_MIDDLE = 0.6
# What is hidden from the front by more than this [m] is no outside of a lip.
_HIDDEN = 0.0008
# Skin stretched between the lips goes back by this part of how far they part.
_HOLLOW = 0.8
# So many times how deep the mouth is, is evened out along edges.
_EVENED = 10
# Keeps pieces of the skin that touch neither bone where they are.
_LOOSE = 1e-9


Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Jaw:
    """The hinge and who follows it.

    hinge: a point on its axis, shape (3,) [m]. axis: unit direction of the axis to the person's left, shape (3,). glide:
    how far the joint moves per radian, shape (3,) [m]. weight: share of the turn that every vertex of the skin takes, 0
    to 1, shape (n,). hollow: how far back skin between the lips goes per radian, shape (n,) [m]: what is stretched
    between them in a mouth that is only a groove is the inside of the mouth. inside: the same evened out along edges, (n,)
    [m]: triangles there are stretched into spikes, and shade must not show them.
    """

    hinge: Floats
    axis: Floats
    glide: Floats
    weight: Floats
    hollow: Floats
    inside: Floats

    def opened(self, vertices: Ints, points: Floats, angle: float) -> Floats:
        """The skin's ``vertices``, (k,), which are now at ``points``, (k, 3), with the jaw open by ``angle`` [rad]."""
        back = self.glide / np.linalg.norm(self.glide)
        return self.turned(points, self.weight[vertices], angle) - (angle * self.hollow[vertices])[:, None] * back

    def drawn_in(self, angle: float) -> Floats:
        """How far behind the lips every vertex of the skin has gone with the jaw open by ``angle`` [rad]: [m], (n,)."""
        return angle * self.inside

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
    weight = _spread(head.skin, *_carried(head, hinge, axis))
    hollow = _hollow(head, hinge, weight)
    return Jaw(hinge, axis, glide, weight, hollow, _evened(head.skin, hollow))


def lip_seam(skin: TriangleMesh, marks: Landmarks) -> Floats:
    """Where the lips meet as seen from the front: points (x, y) from the right corner to the left [m], (25, 2)."""
    x = np.linspace(marks.mouth_right[0], marks.mouth_left[0], _COLUMNS)
    share = np.linspace(0.0, 1.0, _COLUMNS)
    corner = (1 - share) * marks.mouth_right[1] + share * marks.mouth_left[1]
    reach = _SEAM_REACH * 0.5 * float(np.linalg.norm(marks.mouth_left - marks.mouth_right))
    offset = np.linspace(-reach, reach, _LEVELS)
    across = np.stack(np.broadcast_arrays(x[:, None], corner[:, None] + offset), axis=2)
    depth = _seen_from_front(skin, across.reshape(-1, 2)).reshape(_COLUMNS, _LEVELS)
    # The lips meet in the deepest hollow between two bulges.
    below = np.maximum.accumulate(depth, axis=1)
    above = np.maximum.accumulate(depth[:, ::-1], axis=1)[:, ::-1]
    hollow = np.minimum(below, above) - depth
    found = np.where(hollow.max(axis=1) > 0, offset[hollow.argmax(axis=1)], 0.0)
    found[[0, -1]] = 0.0
    return np.stack([x, corner + median_filter(found, 5, mode="nearest")], axis=1)


def lower_share(part: Part, jaw_level: float) -> Floats:
    """Which vertices of teeth, (k,), belong to the lower jaw: those of the rows whose middle lies below a level [m]."""
    pieces = igl.connected_components(igl.adjacency_matrix(part.mesh.faces))[1]
    levels = np.bincount(pieces, part.mesh.vertices[:, 1]) / np.bincount(pieces)
    return (levels[pieces] < jaw_level).astype(np.float64)


def _carried(head: Head, hinge: Floats, axis: Floats) -> tuple[Mask, Mask]:
    """Which vertices the skull keeps, and which the jawbone takes along: two masks, (n,) each."""
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
    half_width = 0.5 * (seam[-1, 0] - seam[0, 0])
    beside = np.abs(points[:, 0] - 0.5 * (seam[-1, 0] + seam[0, 0])) / half_width
    index = np.nonzero((beside < 1.0) & (np.abs(angle - corner_angle) < 2.0 * _CHEEK[1]) & far)[0]
    over = (points[index, 1] - np.interp(points[index, 0], seam[:, 0], seam[:, 1])) / half_width
    outside = points[index, 2] > _seen_from_front(head.skin, points[index, :2]) - _HIDDEN
    held = outside & (beside[index] < _LIP_MIDDLE)
    # Neither bone holds what lines the mouth: it hangs between the lips.
    lining = index[~outside]
    skull[lining] = jawbone[lining] = False
    skull[index[held & (over > _LIP_MARGIN)]] = True
    jawbone[index[held & (over < -_LIP_MARGIN)]] = True
    return skull, jawbone & ~skull


def _seen_from_front(skin: TriangleMesh, across: Floats) -> Floats:
    """How far forward the skin reaches at each (x, y), (k, 2) [m], (k,); its hindmost point where it has a hole."""
    back, front = skin.bounds[:, 2] + [0.0, 0.1]
    starts = np.column_stack([across, np.full(len(across), front)])
    met = locator(skin).first_hit(starts, np.broadcast_to([0.0, 0.0, -1.0], starts.shape))
    return np.maximum(front - met, back)


def _hollow(head: Head, hinge: Floats, weight: Floats) -> Floats:
    """How far back skin goes per radian [m], (n,): most half way between the lips, nothing at the corners."""
    marks = head.landmarks
    middle = 0.5 * (marks.mouth_left + marks.mouth_right)
    half_width = 0.5 * float(np.linalg.norm(marks.mouth_left - marks.mouth_right))
    away = (head.skin.vertices - middle) / half_width
    beside, over = np.clip(np.abs(away[:, 0]), 0.0, 1.0), np.clip(np.abs(away[:, 1]) / _SEAM_REACH, 0.0, 1.0)
    between = 4.0 * weight * (1.0 - weight)
    lever = float(np.linalg.norm(middle - hinge))
    hollow: Floats = _HOLLOW * lever * between * (1.0 - beside**2) ** 2 * (1.0 - over**4)
    return hollow


def _evened(skin: TriangleMesh, values: Floats) -> Floats:
    """Values at the vertices, (n,), each time the mean of their own and that of their neighbours."""
    neighbours = igl.adjacency_matrix(skin.faces)
    degree = np.maximum(np.asarray(neighbours.sum(axis=1)).ravel(), 1)
    for _ in range(_EVENED):
        values = 0.5 * (values + (neighbours @ values) / degree)
    return values


def _spread(skin: TriangleMesh, skull: Mask, jawbone: Mask) -> Floats:
    """The harmonic function that is 0 on one set of vertices and 1 on the other, smoothed at both ends, (n,)."""
    ends = np.concatenate([skin.faces[:, [0, 1]], skin.faces[:, [1, 2]], skin.faces[:, [2, 0]]])
    lengths = np.linalg.norm(skin.vertices[ends[:, 0]] - skin.vertices[ends[:, 1]], axis=1)
    near = 1.0 / np.maximum(lengths, 0.02 * lengths.mean())
    count = len(skin.vertices)
    weights = sparse.coo_array((np.tile(near, 2), (ends.ravel("F"), ends[:, ::-1].ravel("F"))), shape=(count, count))
    laplacian = (sparse.diags_array(weights.sum(axis=1) + _LOOSE * near.mean()) - weights).tocsr()
    value = jawbone.astype(np.float64)
    free = np.nonzero(~(skull | jawbone))[0]
    rows = laplacian[free]
    value[free] = splu(rows[:, free].tocsc()).solve(-rows @ value)
    return value * value * (3.0 - 2.0 * value)
