"""What is drawn of a living skin: what stays the same in every pose, and what a pose changes, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints, TriangleMesh
from ..wrinkle.face import WIDEST_JAW
from ..wrinkle.fine_wrinkles import FineWrinkles
from ..wrinkle.limb_skin import LimbSkin, PosedLimb
from ..wrinkle.living_skin import LivingSkin, SkinSurface
from ..wrinkle.refinement import unique_edges
from ..wrinkle.vectors import unit
from .detail import Surface, casting_shadows, neighbours_together
from .skin_paint import paint
from .skin_values import limb_values, shown_values

MOST_HIDDEN = 0.95
"""Of the sky, at rest: an eye that is closed may open, and some light comes back from the deepest walls."""

BLOOD_MEAN = 0.35
"""How much blood is painted where skin is neither flushed nor pale."""

# What counts as the surroundings of a place in a furrow [m].
_BESIDE = 0.003
# Fine wrinkles fade out over this much of the skin at the border of their map [m].
_FADE = 0.015
# Blotches of blood under the skin: sizes [m], how many waves of each, and how deep they are.
_BLOTCH_SIZES = (0.045, 0.025, 0.014)
_BLOTCH_WAVES = 12
_BLOTCH_DEPTH = 0.06
_BLOTCH_SEED = 5
# So many times curvature is evened out along edges: it is that of the face, not of a triangle.
_EVENED = 8


@dataclass(frozen=True, eq=False)
class SkinShape:
    """What stays the same of a skin that is drawn: N vertices, M triangles.

    surface: as it is at rest; what is painted on it decides how detailed it is drawn. shadow_faces: over the same
    vertices. uv: texture coordinates, (N, 2). mapped: how far inside the map, 0 at its border to 1, (N,). turning: how
    far the skin turns with the head, (N,). curvature: of the skin at rest, positive where it bulges [1/m], (N,).
    painted: hidden from the sky, lips, brows and blood, 0 to 1, (N, 4). fine: wrinkles of the map, or None.
    """

    surface: Surface
    shadow_faces: Ints
    uv: Floats
    mapped: Floats
    turning: Floats
    curvature: Floats
    painted: Floats
    fine: FineWrinkles | None


@dataclass(frozen=True, eq=False)
class SkinPose:
    """A skin at one instant. positions [m] and unit normals, (N, 3). amplitudes: of both fine fields, (N, 2). hidden: by
    the walls of furrows or of the mouth, 0 to 1, (N,). value: of what the look shows on the skin, else of its expansion,
    0 to 1, (N,)."""

    positions: Floats
    normals: Floats
    amplitudes: Floats
    hidden: Floats
    value: Floats


@dataclass(frozen=True, eq=False)
class HeadShape:
    """What the skins of one head have in common, whatever their furrows: values at the head's n vertices, (n, ...)."""

    shadow_faces: Ints
    normals: Floats
    mapped: Floats
    curvature: Floats
    painted: Floats


def head_shape(surface: SkinSurface, hidden: Floats) -> HeadShape:
    """Of the head of a skin. hidden: of the sky, of every vertex of the head's skin, (n,)."""
    head, skin = surface.head, surface.head.skin
    lips, brows, flush = paint(head).T
    return HeadShape(
        shadow_faces=casting_shadows(skin),
        normals=skin.vertex_normals,
        mapped=faded_in(skin.vertices, surface.inside),
        curvature=curvature_of(skin),
        painted=np.column_stack([np.minimum(hidden, MOST_HIDDEN), lips, brows, uneven_blood(skin.vertices, flush)]),
    )


def shape_of(surface: SkinSurface, head: HeadShape) -> SkinShape:
    """The shape of a head's living skin."""
    painted = surface.spread(head.painted)
    faces = neighbours_together(surface.faces, surface.rest)
    return SkinShape(
        surface=Surface(faces, surface.rest, unit(surface.spread(head.normals)), painted, surface.bed.on_lines),
        shadow_faces=head.shadow_faces,
        uv=surface.uv,
        mapped=surface.spread(head.mapped),
        turning=surface.spread(surface.head.head_weight),
        curvature=surface.spread(head.curvature),
        painted=painted,
        fine=surface.fine,
    )


def limb_shape_of(skin: LimbSkin, hidden: Floats) -> SkinShape:
    """The shape of a limb's skin. hidden: of the sky, of every vertex of the limb, (n,)."""
    limb, source = skin.limb, skin.source
    on_map = np.zeros(len(source))
    on_map[skin.mapped] = 1.0
    # Where the map is cut, but not where it ends, skin goes on.
    inside = np.ones(len(limb.vertices))
    inside[source[on_map == 0]] = 0.0
    none = np.zeros(len(limb.vertices))
    painted = np.column_stack([np.minimum(hidden, MOST_HIDDEN), none, none, uneven_blood(limb.vertices, none)])
    return SkinShape(
        surface=Surface(
            neighbours_together(skin.opened.faces, skin.opened.vertices),
            skin.opened.vertices,
            limb.vertex_normals[source],
            painted[source],
            skin.lines,
        ),
        shadow_faces=casting_shadows(skin.opened),
        uv=skin.uv,
        mapped=faded_in(limb.vertices, inside)[source] * on_map,
        turning=np.zeros(len(source)),
        curvature=curvature_of(limb)[source],
        painted=painted[source],
        fine=skin.fine,
    )


def pose_of(skin: LivingSkin, shows: str, mouth: Floats) -> SkinPose:
    """A living skin as it is drawn; ``shows`` is ``Look.skin_shows``. mouth: what it hides while it is shut, (N,)."""
    hidden = 1.0 - (1.0 - hidden_in_creases(skin.skin.height)) * (1.0 - hidden_in_mouth(mouth, skin.jaw))
    return SkinPose(skin.skin.positions, skin.skin.normals, skin.amplitudes, hidden, shown_values(shows, skin))


def smooth_pose_of(skin: LivingSkin, shows: str, mouth: Floats) -> SkinPose:
    """The same skin without a wrinkle."""
    surface = skin.surface
    normals = unit(surface.spread(surface.head.skin.moved(skin.posed).vertex_normals))
    hidden = hidden_in_mouth(mouth, skin.jaw)
    return SkinPose(surface.spread(skin.posed), normals, np.zeros((len(normals), 2)), hidden, shown_values(shows, skin))


def limb_pose_of(limb: PosedLimb, shows: str) -> SkinPose:
    """A limb as it is drawn."""
    values = limb_values(shows, limb)
    return SkinPose(limb.positions, limb.normals, limb.amplitudes, np.zeros(len(limb.positions)), values)


def uneven_blood(points: Floats, flush: Floats) -> Floats:
    """How much blood lies under the skin, 0 to 1 with BLOOD_MEAN where it is as everywhere, (n,).

    points: of the skin at rest [m], (n, 3). flush: where more shows through, 0 to 1, (n,). Blotches are waves that cross
    at random, and the same on every run.
    """
    rng = np.random.default_rng(_BLOTCH_SEED)
    blotches = np.zeros(len(points))
    for size in _BLOTCH_SIZES:
        directions = rng.normal(size=(_BLOTCH_WAVES, 3))
        waves = 2 * np.pi / size * directions / np.linalg.norm(directions, axis=1, keepdims=True)
        blotches += np.cos(points @ waves.T + rng.uniform(0, 2 * np.pi, _BLOTCH_WAVES)).sum(axis=1)
    blotches /= np.sqrt(0.5 * _BLOTCH_WAVES * len(_BLOTCH_SIZES))
    return np.clip(BLOOD_MEAN + (1 - BLOOD_MEAN) * flush + _BLOTCH_DEPTH * blotches, 0.0, 1.0)


def order_of_use(faces: Ints, count: int) -> Ints:
    """All of ``count`` vertices as triangles, (m, 3), first need them, those that none needs last: (count,).

    Where vertices that are used together lie together, fewer of them are worked out twice.
    """
    order, first = np.unique(faces, return_index=True)
    used: Ints = order[np.argsort(first, kind="stable")]
    return np.concatenate([used, np.setdiff1d(np.arange(count), order)])


def faded_in(rest: Floats, mapped: Floats) -> Floats:
    """From 0 where the skin is not mapped to 1 at some distance from there, (N,). rest: positions [m], (N, 3). mapped:
    above 0 where it is, (N,)."""
    outside = rest[mapped <= 0]
    if len(outside) == 0:
        return np.ones(len(rest))
    inside = np.flatnonzero(mapped > 0)
    fade = np.zeros(len(rest))
    fade[inside] = np.minimum(cKDTree(outside).query(rest[inside], distance_upper_bound=_FADE)[0] / _FADE, 1.0)
    return fade


def curvature_of(mesh: TriangleMesh) -> Floats:
    """Mean curvature at every vertex, positive where the surface bulges [1/m], (n,), over some triangles around."""
    edges, _ = unique_edges(mesh.faces)
    a, b = edges.T
    along = mesh.vertices[b] - mesh.vertices[a]
    turn = mesh.vertex_normals[b] - mesh.vertex_normals[a]
    bend = np.einsum("ij,ij->i", turn, along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-12)
    count = len(mesh.vertices)
    ends, ones = np.concatenate([edges, edges[:, ::-1]]), np.ones(2 * len(edges))
    neighbours = sparse.csr_array((ones, (ends[:, 0], ends[:, 1])), shape=(count, count))
    degree = np.maximum(neighbours.sum(axis=1), 1.0)
    curvature = np.bincount(ends[:, 0], np.concatenate([bend, bend]), minlength=count) / degree
    for _ in range(_EVENED):
        curvature = 0.5 * (curvature + (neighbours @ curvature) / degree)
    return curvature


def hidden_in_mouth(shut: Floats, jaw: float) -> Floats:
    """How much of the light misses what a mouth hides, 0 to 1, (n,), with the jaw open by an angle [rad]. shut: the same
    of a mouth that is shut, (n,). Most of the light comes with the first part of the way."""
    way = min(jaw / WIDEST_JAW, 1.0)
    hidden: Floats = shut * (1.0 - way) ** 2
    return hidden


def hidden_in_creases(height: Floats) -> Floats:
    """How much of the light from all around misses a displaced skin for the skin beside it, 0 to 1, (N,).

    height: displacement along the normals [m], (N,). A furrow takes as much as its bulges give (eq. 2.2), so that around a
    place the mean of the displacement is nothing, and what lies below lies below its surroundings. As deep as these are
    wide is taken for a groove with walls of 45 degrees, which hides a third of the sky.
    """
    hidden: Floats = 1.0 - 1.0 / np.sqrt(1.0 + (np.minimum(height, 0.0) / _BESIDE) ** 2)
    return hidden
