"""The mannequin as a head: metres, weights, eyes and the names of its points."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import igl
import numpy as np
import trimesh
from scipy.spatial import cKDTree

from ..head import Head, Landmarks, Part
from ..mesh import Floats, TriangleMesh
from ..mouth import with_mouth
from ..neck import Neck
from .anthropometry import measured
from .eyes import EYE, EYE_AXIS, EYE_RADIUS
from .skin import charted, mirrored, sculpted_half

_MM = 1e-3
# It begins at the line from chin to nape and ends at the collar.
_RISE = float(np.hypot(1.0, 0.35))
_NECK = Neck(np.array([0.0, 1.0, 0.35]) / _RISE, -54.0 * _MM / _RISE, 74.0 * _MM / _RISE)
_MIRROR = np.array([-1.0, 1.0, 1.0])


@cache
def mannequin() -> Head:
    """The built-in head, made by this project's own code: no file is read. Made once, then kept.

    An adult of neither sex in particular (see ``anthropometry``), with a mouth that opens.
    """
    head = closed_bust()
    return _symmetric(with_mouth(replace(head, notes=(_description(head),))))


def _symmetric(head: Head) -> Head:
    """The head with vertices that are images of one another but for some micrometres moved until they are."""
    points = head.skin.vertices
    twin = cKDTree(points).query(points * _MIRROR)[1]
    return replace(head, skin=head.skin.moved(0.5 * (points + points[twin] * _MIRROR)))


@cache
def closed_bust() -> Head:
    """The mannequin with its lips still closed: exactly symmetric, closed but for one loop in the plane the bust stands on."""
    vertices, faces = sculpted_half()
    vertices, faces, chart = mirrored(vertices, faces, charted(vertices, faces))
    skin = TriangleMesh(vertices * _MM, faces, chart)
    return Head(
        name="mannequin",
        skin=skin,
        neck=_NECK,
        landmarks=_landmarks(skin),
        parts=(_eye(EYE, EYE_AXIS), _eye(EYE * _MIRROR, EYE_AXIS * _MIRROR)),
    )


def _description(head: Head) -> str:
    size = {name: f"{1e3 * value:.0f} mm" for name, value in measured(head).items()}
    return (
        f"built-in mannequin after adult means of ANSUR II and NIOSH 2003: head {size['head_length']} long and "
        f"{size['head_breadth']} broad, pupils {size['interpupillary']} apart"
    )


def _landmarks(skin: TriangleMesh) -> Landmarks:
    """Extremes of the middle line, and points of the sculpture laid onto the skin."""
    middle = skin.vertices[skin.vertices[:, 0] == 0.0]
    front, back = middle[middle[:, 2] > 0.02], middle[middle[:, 2] < -0.02]

    def extreme(line: Floats, direction: tuple[int, int, int], low: float, high: float) -> Floats:
        line = line[(line[:, 1] > low) & (line[:, 1] < high)]
        return line[np.argmax(line @ direction)]

    sides = np.array([(74.0, 20.0, 0.0), (24.5, -29.2, 96.5)]) * _MM
    _, _, (tragus, mouth) = igl.point_mesh_squared_distance(sides, skin.vertices, skin.faces)
    pupil = (EYE + EYE_RADIUS * EYE_AXIS) * _MM
    return Landmarks(
        crown=extreme(middle, (0, 1, 0), 0.1, 0.2),
        hairline=front[np.argmin(np.abs(front[:, 1] - 0.112))],
        glabella=extreme(front, (0, 0, 1), 0.05, 0.064),
        nasion=extreme(front, (0, 0, -1), 0.034, 0.05),
        nose_tip=extreme(front, (0, 0, 1), -0.01, 0.02),
        chin=extreme(front[front[:, 2] > 0.06], (0, -1, 0), -0.09, -0.05),
        nape=back[np.argmin(np.abs(back[:, 1] + 0.03))],
        occiput=extreme(back, (0, 0, -1), 0.02, 0.12),
        left_tragus=tragus,
        right_tragus=tragus * _MIRROR,
        left_eye=pupil,
        right_eye=pupil * _MIRROR,
        mouth_left=mouth,
        mouth_right=mouth * _MIRROR,
    )


def _eye(centre: Floats, axis: Floats) -> Part:
    ball = trimesh.creation.uv_sphere(radius=EYE_RADIUS, count=(24, 48))
    mesh = TriangleMesh((np.asarray(ball.vertices) + centre) * _MM, np.asarray(ball.faces))
    return Part("eye", mesh, centre * _MM, axis, EYE_RADIUS * _MM)
