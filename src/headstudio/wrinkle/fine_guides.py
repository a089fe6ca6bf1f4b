"""Direction vectors that are there before an artist sets any, from landmarks and shape.

Furrows of the skin cross in diamonds that lie along the relaxed skin tension lines: across the forehead, around the
eyes, down the cheeks, around the neck and the limbs. The two fields lie to both sides of that axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.head import Landmarks
from ..head.mesh import Floats, Ints
from .metric import perpendicular, vertex_metrics
from .texture_map import TextureMap

FIELDS = 2

# Places on the face: landmarks with their weights, how far the axis falls toward the side [degrees below the
# horizontal], and the magnitude m. Those of the left are mirrored to the right.
_PLACES: tuple[tuple[dict[str, float], float, float], ...] = (
    ({"hairline": 1.0}, 0, 0.50),
    ({"hairline": 0.5, "glabella": 0.5}, 0, 0.55),
    ({"hairline": 0.5, "left_eye": 0.5}, 4, 0.55),
    ({"hairline": 0.4, "left_tragus": 0.6}, 20, 0.50),
    ({"glabella": 1.0}, 0, 0.45),
    ({"left_eye": 0.75, "left_tragus": 0.25}, 8, 0.60),
    ({"left_eye": 0.8, "mouth_left": 0.2}, 14, 0.50),
    ({"nasion": 0.5, "nose_tip": 0.5}, 0, 0.35),
    ({"nose_tip": 1.0}, 0, 0.25),
    ({"left_eye": 0.4, "mouth_left": 0.6}, 58, 0.45),
    ({"left_eye": 0.25, "mouth_left": 0.45, "left_tragus": 0.3}, 60, 0.50),
    ({"mouth_left": 0.4, "left_tragus": 0.6}, 66, 0.55),
    ({"mouth_left": 0.6, "nose_tip": 0.4}, 64, 0.40),
    ({"mouth_left": 0.6, "chin": 0.4}, 40, 0.45),
    ({"chin": 1.0}, 0, 0.45),
    ({"chin": 0.5, "left_tragus": 0.5}, 45, 0.55),
    ({"left_tragus": 1.3, "chin": -0.3}, 20, 0.45),
    ({"chin": 0.6, "nape": 0.4}, 0, 0.65),
    ({"left_tragus": 0.4, "nape": 0.6}, 8, 0.60),
    ({"nape": 1.0}, 0, 0.60),
    ({"occiput": 1.0}, 0, 0.40),
)
# Pores: around which landmarks, with their weights, how far they reach [heights of the head], how many at most.
_PORES: tuple[tuple[dict[str, float], float, float], ...] = (
    ({"nose_tip": 1.0}, 0.11, 1.0),
    ({"nasion": 0.4, "nose_tip": 0.6}, 0.09, 0.8),
    ({"left_eye": 0.35, "mouth_left": 0.35, "nose_tip": 0.3}, 0.16, 0.75),
    ({"glabella": 0.6, "hairline": 0.4}, 0.22, 0.3),
    ({"chin": 1.0}, 0.14, 0.4),
)
# Places this far from the mesh belong to another part of the head [heights of the head]; between landmarks they lie under
# the skin.
_FAR = 0.2
# On a limb: how many places, and m there. Skin whose normal lies this near to the side of palm or sole is bare (cosine).
_LIMB_PLACES = 24
_LIMB_MAGNITUDE = 0.55
_BARE_COSINE = 0.35
_BARE_FADE = 0.3


@dataclass(frozen=True, eq=False)
class FineGuides:
    """What the shape of a body part says about its fine wrinkles.

    vertices: where direction vectors are set, (k,). axes: between the two directions, unit, in texture space as seen on
    the skin, (k, 2). magnitudes: m, (k,). furrowed: how much of the depth of furrows there is at every vertex, 0 on
    palms and soles, (n,). pores: how close pores stand at every vertex, 0 to 1, (n,).
    """

    vertices: Ints
    axes: Floats
    magnitudes: Floats
    furrowed: Floats
    pores: Floats

    def vectors(self, texture_map: TextureMap, crossing: float) -> Floats:
        """The direction vectors of both fields at the vertices, in texture space, (2, k, 2).

        crossing: the angle between the fields on the skin [rad].
        """
        metrics = vertex_metrics(texture_map)[self.vertices]
        across = perpendicular(self.axes, metrics)
        fields = []
        for sign in (0.5, -0.5):
            vectors = np.cos(crossing / 2) * self.axes + np.sin(crossing / 2) * 2 * sign * across
            fields.append(self.magnitudes[:, None] * vectors / np.linalg.norm(vectors, axis=1, keepdims=True))
        return np.stack(fields)


def face_guides(texture_map: TextureMap, landmarks: Landmarks) -> FineGuides:
    """Guides of a face or a whole head."""
    placed = [
        (_place(landmarks, weights, mirror), mirror * np.radians(degrees), magnitude)
        for weights, degrees, magnitude in _PLACES
        for mirror in _sides(weights)
    ]
    places, falls, magnitudes = (np.array(column) for column in zip(*placed))
    height = landmarks.crown[1] - landmarks.chin[1]
    vertices, away = _nearest(texture_map, places)
    near = away < _FAR * height
    vertices, falls, magnitudes = vertices[near], falls[near], magnitudes[near]
    normals = texture_map.mesh.vertex_normals[vertices]
    # Around the head to the left as seen from above, and up, along the skin.
    around = _unit(np.cross([0.0, 1.0, 0.0], normals))
    upward = np.cross(normals, around)
    fall = falls[:, None]
    axes = in_texture(texture_map, vertices, np.cos(fall) * around - np.sin(fall) * upward)

    pores = np.zeros(len(texture_map.mesh.vertices))
    for weights, reach, most in _PORES:
        for mirror in _sides(weights):
            away = np.linalg.norm(texture_map.mesh.vertices - _place(landmarks, weights, mirror), axis=1)
            pores = np.maximum(pores, most * np.exp(-((away / (0.6 * reach * height)) ** 2)))
    pores[pores < 0.05] = 0.0
    return FineGuides(vertices, axes, magnitudes, np.ones(len(pores)), pores)


def limb_guides(texture_map: TextureMap, along: Floats, bare: Floats | None = None) -> FineGuides:
    """Guides of a hand, an arm, a foot: diamonds lie around the limb.

    along: direction of the limb, (3,). bare: out of its palm or sole, (3,), where no furrow is; None where there is none.
    """
    mesh = texture_map.mesh
    vertices = _spread_out(texture_map, _LIMB_PLACES)
    normals = mesh.vertex_normals[vertices]
    around = np.cross(along / np.linalg.norm(along), normals)
    # At the tip of a limb no direction leads around it.
    clear = np.linalg.norm(around, axis=1) > 0.3
    vertices, around = vertices[clear], around[clear]
    furrowed = np.ones(len(mesh.vertices))
    if bare is not None:
        facing = mesh.vertex_normals @ (bare / np.linalg.norm(bare))
        furrowed = ((_BARE_COSINE - facing) / _BARE_FADE).clip(0.0, 1.0)
    return FineGuides(
        vertices=vertices,
        axes=in_texture(texture_map, vertices, around),
        magnitudes=np.full(len(vertices), _LIMB_MAGNITUDE),
        furrowed=furrowed,
        pores=np.zeros(len(mesh.vertices)),
    )


def in_texture(texture_map: TextureMap, vertices: Ints, tangents: Floats) -> Floats:
    """Directions along the skin, (k, 3), at vertices, (k,), as unit directions in texture space, (k, 2).

    Through the first triangle of each vertex.
    """
    mesh = texture_map.mesh
    face = np.zeros(len(mesh.vertices), dtype=np.int64)
    face[mesh.faces[::-1]] = np.arange(len(mesh.faces))[::-1, None]
    corners, skin = texture_map.corner_uv[face[vertices]], mesh.vertices[mesh.faces[face[vertices]]]
    plane_edges, skin_edges = corners[:, 1:] - corners[:, :1], skin[:, 1:] - skin[:, :1]
    steps = np.einsum("kj,kji->ki", tangents, np.linalg.pinv(np.linalg.solve(plane_edges, skin_edges)))
    return _unit(steps)


def _sides(weights: dict[str, float]) -> tuple[int, ...]:
    return (1, -1) if any("left" in name for name in weights) else (1,)


def _place(landmarks: Landmarks, weights: dict[str, float], mirror: int) -> Floats:
    """A point between landmarks [m], (3,); mirror -1 takes those of the right instead of the left."""
    names = {name: name if mirror > 0 else name.replace("left", "right") for name in weights}
    return np.sum([weight * getattr(landmarks, names[name]) for name, weight in weights.items()], axis=0)


def _nearest(texture_map: TextureMap, points: Floats) -> tuple[Ints, Floats]:
    """The vertices nearest to points [m], (k, 3), and how far they are [m]: both (k,)."""
    used = np.unique(texture_map.mesh.faces)
    away, found = cKDTree(texture_map.mesh.vertices[used]).query(points)
    return used[found], away


def _spread_out(texture_map: TextureMap, count: int) -> Ints:
    """Vertices spread over texture space, each the one that is farthest from those before."""
    chosen = [int(texture_map.mesh.faces[0, 0])]
    away = np.linalg.norm(texture_map.uv - texture_map.uv[chosen[0]], axis=1)
    unused = np.setdiff1d(np.arange(len(away)), texture_map.mesh.faces)
    for _ in range(count - 1):
        away[unused] = -1.0
        chosen.append(int(away.argmax()))
        away = np.minimum(away, np.linalg.norm(texture_map.uv - texture_map.uv[chosen[-1]], axis=1))
    return np.array(chosen)


def _unit(vectors: Floats) -> Floats:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), np.finfo(float).tiny)
