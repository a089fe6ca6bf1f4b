"""The mannequin as a head: clay to triangles, and the names of its points."""

from __future__ import annotations

from functools import cache

import igl
import numpy as np

from ..head import Head, Landmarks, Part
from ..mesh import Floats, Ints, TriangleMesh
from .bust import CUT
from .eyes import EYE, EYE_AXIS, EYE_RADIUS
from .polygonise import polygonise
from .sculpture import sculpture

_MM = 1e-3
_MIRROR = np.array([-1.0, 1.0, 1.0])


@cache
def mannequin() -> Head:
    """The built-in head, made once by this project's own code: no file is read.

    Exactly symmetric, closed but for one loop in the plane the bust stands on.
    """
    half_vertices, half_faces = polygonise(sculpture, (0, CUT, -160), (220, 165, 150), 3.2)
    half_vertices = _onto_surface(_onto_surface(half_vertices))
    vertices, faces = _mirrored(half_vertices, half_faces)
    skin = TriangleMesh(vertices * _MM, faces, _chart(vertices, faces))
    return Head(
        name="mannequin",
        skin=skin,
        head_weight=_head_weight(vertices),
        landmarks=_landmarks(skin),
        parts=(_eye(EYE), _eye(EYE * _MIRROR)),
        notes=("built-in mannequin, adult of no sex, after ANSUR II and the NIOSH survey of 2003",),
    )


def _gradient(points: Floats, step: float = 0.05) -> Floats:
    offsets = step * np.eye(3)
    ahead = sculpture((points[:, None, :] + offsets).reshape(-1, 3)).reshape(-1, 3)
    behind = sculpture((points[:, None, :] - offsets).reshape(-1, 3)).reshape(-1, 3)
    return (ahead - behind) / (2.0 * step)


def _onto_surface(points: Floats) -> Floats:
    """One Newton step to the surface; points on the middle plane and on the cut stay in those planes."""
    slope = _gradient(points)
    slope[points[:, 0] < 1e-9, 0] = 0.0
    slope[points[:, 1] < CUT + 1e-9, 1] = 0.0
    step = sculpture(points) / np.maximum(np.einsum("ij,ij->i", slope, slope), 0.2)
    moved = points - np.clip(step[:, None] * slope, -1.0, 1.0)
    moved[:, 0] = np.maximum(moved[:, 0], 0.0)
    return moved


def _mirrored(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """A half and its mirror image, joined along the middle plane."""
    middle = vertices[:, 0] < 1e-9
    twin = np.arange(len(vertices))
    twin[~middle] = len(vertices) + np.arange(np.count_nonzero(~middle))
    both = np.concatenate([vertices, vertices[~middle] * _MIRROR])
    return both, np.concatenate([faces, twin[faces[:, ::-1]]])


def _chart(vertices: Floats, faces: Ints) -> Floats:
    """Cylindrical texture coordinates with a seam at the back, shape (m, 3, 2)."""
    corners = vertices[faces]
    left = corners[..., 0].sum(axis=1) > 0
    angle = np.arctan2(np.abs(corners[..., 0]), corners[..., 2]) / (2.0 * np.pi)
    u = np.where(left[:, None], 0.5 + angle, 0.5 - angle)
    low, high = vertices[:, 1].min(), vertices[:, 1].max()
    return np.stack([u, (corners[..., 1] - low) / (high - low)], axis=-1)


def _head_weight(vertices: Floats) -> Floats:
    """1 above the jaw, 0 below the collar, smooth along the neck, which leans forward."""
    along = vertices[:, 1] - 0.35 * vertices[:, 2]
    t = np.clip((along + 115.0) / 90.0, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def _landmarks(skin: TriangleMesh) -> Landmarks:
    named = {
        "crown": (0, 149, -12),
        "hairline": (0, 112, 84),
        "glabella": (0, 56, 103),
        "nasion": (0, 43, 98),
        "nose_tip": (0, 3, 124),
        "chin": (0, -71, 84),
        "nape": (0, -25, -70),
        "occiput": (0, 58, -92),
        "left_tragus": (73, 20, 0),
        "mouth_left": (24.7, -28.6, 92),
    }
    points = np.array(list(named.values()), dtype=float) * _MM
    _, _, near = igl.point_mesh_squared_distance(points, skin.vertices, skin.faces)
    at = dict(zip(named, near))
    at["right_tragus"] = at["left_tragus"] * _MIRROR
    at["mouth_right"] = at["mouth_left"] * _MIRROR
    at["left_eye"] = (EYE + EYE_RADIUS * EYE_AXIS) * _MM
    at["right_eye"] = at["left_eye"] * _MIRROR
    return Landmarks(**at)


def _eye(centre: Floats) -> Part:
    """A ball of 48 by 24 quads around the axis of the eye."""
    import trimesh

    ball = trimesh.creation.uv_sphere(radius=EYE_RADIUS, count=(24, 48))
    vertices = (np.asarray(ball.vertices) + centre) * _MM
    axis = EYE_AXIS * np.sign([centre[0], 1.0, 1.0])
    return Part("eye", TriangleMesh(vertices, ball.faces), centre * _MM, axis, EYE_RADIUS * _MM)
