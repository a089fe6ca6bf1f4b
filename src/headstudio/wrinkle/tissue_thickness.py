"""How thick the tissue under the skin of a face is: presets from anatomy, and painted maps."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator
from scipy.spatial import cKDTree

from ..head.head import Head
from ..head.length_maps import sample
from ..head.locate import locator
from ..head.mesh import Floats, TriangleMesh
from ..head.scalp_settings import GrayImage
from .muscle_set import carried_face_points
from .texture_map import TextureMap

MAX_THICKNESS = 0.02
"""What white means in a painted map [m]."""

# Of an average adult [m], at points of the face of 1994, its middle and its right: thin on forehead, nose and lids,
# thick in the cheeks and beside the mouth.
_THICKNESS = (
    ((0.0, 5.5, 7.9), 0.0030),
    ((-2.2, 5.2, 7.4), 0.0030),
    ((0.0, 3.5, 8.2), 0.0040),
    ((-2.2, 3.7, 8.0), 0.0045),
    ((-3.9, 3.0, 6.2), 0.0045),
    ((0.0, 1.6, 8.5), 0.0015),
    ((0.0, 0.0, 9.3), 0.0025),
    ((-0.95, 0.0, 8.4), 0.0030),
    ((-2.0, 2.5, 7.4), 0.0008),
    ((-2.0, 1.6, 7.4), 0.0012),
    ((-2.1, 0.7, 7.6), 0.0050),
    ((-3.3, 0.6, 6.8), 0.0055),
    ((-1.9, -0.9, 7.9), 0.0070),
    ((-3.2, -1.6, 6.6), 0.0080),
    ((-1.1, -1.3, 8.3), 0.0060),
    ((-1.9, -2.3, 7.6), 0.0065),
    ((0.0, -1.5, 8.7), 0.0050),
    ((0.0, -3.2, 8.3), 0.0050),
    ((-1.7, -3.6, 7.4), 0.0065),
    ((0.0, -4.6, 7.6), 0.0060),
    ((-3.7, -3.2, 4.8), 0.0060),
    ((-4.5, 0.5, 2.5), 0.0050),
    ((0.0, -5.6, 5.0), 0.0060),
    ((0.0, 9.0, 3.0), 0.0030),
)
_BUILD = {"average": 1.0, "lean": 0.6, "full": 1.5}
_NEIGHBOURS = 6
# Skin that looks at skin nearer than this [m] lines a mouth, a nostril or a lid: no tissue lies under it.
_LINING = 0.03
_LINING_LEVEL = 0.25


def thickness_of(head: Head, preset: str) -> Floats:
    """The thickness of the named preset under every vertex of the skin [m], (n,)."""
    places, depth = zip(*_THICKNESS)
    points, index = carried_face_points(head.landmarks, places)
    values = np.array(depth)[index]
    distance, near = cKDTree(points).query(head.skin.vertices, k=_NEIGHBOURS)
    weight = 1.0 / np.maximum(distance, 1e-4) ** 3
    smooth = (weight * values[near]).sum(axis=1) / weight.sum(axis=1)
    return _BUILD[preset] * smooth * _outside(head.skin)


def painted_thickness(image: GrayImage, texture: TextureMap) -> Floats:
    """The thickness that a painted map gives every vertex of the mesh of ``texture`` [m], (n,)."""
    return MAX_THICKNESS * sample(image, texture.uv)


def as_image(thickness: Floats, texture: TextureMap, size: int = 256) -> GrayImage:
    """A thickness per vertex [m], (n,), as a map to go on painting from; beside the mesh the nearest vertex answers."""
    centre = (np.arange(size) + 0.5) / size
    at = np.stack(np.meshgrid(centre, centre), axis=-1)
    values = LinearNDInterpolator(texture.uv, thickness)(at)
    empty = np.isnan(values)
    values[empty] = NearestNDInterpolator(texture.uv, thickness)(at[empty])
    return GrayImage((values / MAX_THICKNESS).astype(np.float32))


def _outside(skin: TriangleMesh) -> Floats:
    """1 on the outside of the body, 0 on what lines its openings, smooth between, (n,)."""
    normals = skin.vertex_normals
    ahead = locator(skin).first_hit(skin.vertices + 1e-4 * normals, normals)
    open_sky = (ahead > _LINING).astype(np.float64)
    for _ in range(3):
        total = np.bincount(skin.faces.ravel(), np.repeat(open_sky[skin.faces].mean(axis=1), 3), len(open_sky))
        open_sky = total / np.maximum(np.bincount(skin.faces.ravel(), minlength=len(open_sky)), 1)
    return np.clip((open_sky - _LINING_LEVEL) / (1.0 - _LINING_LEVEL), 0.0, 1.0)
