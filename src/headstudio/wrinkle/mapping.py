"""From a body part to texture space (Bando's thesis, section 2.4)."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ..head.head import Head
from ..head.mesh import Floats, TriangleMesh
from ..head.repair import face_components
from .body_part import BodyPart, body_part, face_part, head_part
from .one_to_one import signed_areas, why_not_one_to_one
from .projection import Layout, TextureMapError, axis_is_free, project_on_plane, roll_off_cylinder
from .relaxation import relax as relax_springs
from .texture_map import TextureMap

METHODS = ("planar", "cylindrical", "uv")

# Empty border around what is mapped, as a part of the unit square.
_MARGIN = 0.02
# From the nape to the middle of the neck [heights of the head]: the first that keeps within it. Some necks are slim.
_NECK_RADII = (0.25, 0.2, 0.15, 0.1, 0.05)
# What has less than this part of its area in the map is at the bottom of a pocket.
_POCKET = 1e-3


def map_to_texture(
    mesh: TriangleMesh,
    method: str = "planar",
    relax: bool = True,
    *,
    toward: Floats | None = None,
    axis: Floats | None = None,
    along: Floats | None = None,
) -> TextureMap:
    """Lay a body part out in the unit square, one to one and with its topology kept.

    mesh: one connected piece with a border (a face, a limb); see body_part.py for cutting one out. method: "planar"
    (seen from ``toward``, (3,), the mean normal by default), "cylindrical" (rolled off an axis through the point
    ``axis`` [m], (3,), in the direction ``along``, (3,); up through the middle by default; a tube wraps around at u = 1,
    a part that does not go around the axis does not) or "uv" (the mesh's own texture coordinates, left as they are).
    relax: smooth the projection by spring energy.

    Raises TextureMapError for a surface that has no such map, ValueError for another method.
    """
    if method not in METHODS:
        raise ValueError(f"a map is one of {', '.join(METHODS)}; got {method!r}")
    if not len(mesh.faces):
        raise TextureMapError("this part of the body has no triangles")
    if method == "uv":
        return own_coordinates(mesh)
    if face_components(mesh.faces).max() > 0:
        raise TextureMapError("this part of the body is in several pieces; map each by itself")
    layout = project_on_plane(mesh, toward) if method == "planar" else roll_off_cylinder(mesh, axis, along)
    note = f"{method} projection"
    if relax:
        relaxed = relax_springs(mesh, layout)
        layout, note = relaxed.layout, f"{note}, {relaxed.note}"
    else:
        trouble = why_not_one_to_one(mesh, layout)
        if trouble:
            raise TextureMapError(f"the {method} projection alone is not one to one ({trouble}); relax it")
    return fitted(mesh, layout, note)


@lru_cache(maxsize=2)
def map_face(head: Head) -> tuple[BodyPart, TextureMap]:
    """The face of a head, rolled off a cylinder about the skull and relaxed.

    A pocket, as a socket with no eye in it, has a border that is too short for all that hangs on it: its floor would be a
    point of the map, where lengths mean nothing. It is left out.
    """
    part = face_part(head)
    while True:
        texture_map = _face_map(head, part)
        shown = signed_areas(texture_map.corner_uv) * texture_map.metres**2 > _POCKET * part.mesh.face_areas
        if shown.all():
            return part, texture_map
        kept = np.zeros(len(head.skin.faces), dtype=bool)
        kept[part.faces[shown]] = True
        part = body_part(head.skin, kept)


def _face_map(head: Head, part: BodyPart) -> TextureMap:
    # The axis runs through the middle of neck and skull: it leans forward, as heads do.
    skull, marks = _between_ears(head), head.landmarks
    height = marks.crown[1] - marks.chin[1]
    ways = [skull - (marks.nape * [0, 1, 1] + [0, 0, radius * height]) for radius in _NECK_RADII]
    along = next((way for way in ways if axis_is_free(part.mesh, skull, way)), ways[0])
    return map_to_texture(part.mesh, "cylindrical", axis=skull, along=along)


@lru_cache(maxsize=2)
def map_head(head: Head) -> tuple[BodyPart, TextureMap]:
    """All the skin of a head but the crown, rolled off a cylinder; the seam runs down behind and wraps around."""
    part = head_part(head)
    return part, map_to_texture(part.mesh, "cylindrical", axis=_between_ears(head))


def _between_ears(head: Head) -> Floats:
    ears = 0.5 * (head.landmarks.left_tragus + head.landmarks.right_tragus)
    return np.array([0.0, ears[1], ears[2]])


def fitted(mesh: TriangleMesh, layout: Layout, note: str) -> TextureMap:
    """The layout moved and scaled into the square, angles kept where they can be."""
    low, high = layout.places.min(axis=0), layout.places.max(axis=0)
    room = 1.0 - 2.0 * _MARGIN
    if layout.period:
        # Once around is the whole width. What is longer than wide is shortened to fit.
        scale = np.array([1.0 / layout.period, min(1.0 / layout.period, room / (high[1] - low[1]))])
        middle = np.array([0.0, 0.5 - 0.5 * scale[1] * (low[1] + high[1])])
        turned = np.floor(layout.places[:, 0] * scale[0]).astype(np.int64)
        uv = layout.places * scale + middle
        uv[:, 0] -= turned
        uv = np.minimum(uv, np.nextafter(1.0, 0.0))
        turns = layout.turns + turned[mesh.faces]
        turns -= turns.min(axis=1, keepdims=True)
    else:
        scale = np.full(2, room / (high - low).max())
        uv = layout.places * scale + (0.5 - 0.5 * scale * (low + high))
        turns = layout.turns
    corners = uv[mesh.faces]
    corners[..., 0] += turns
    return _texture_map(mesh, uv, corners, wrapped=layout.period > 0, note=note)


def own_coordinates(mesh: TriangleMesh, *, known_good: bool = False) -> TextureMap:
    """The map that a mesh brings with it; ``known_good``: from one that was found to be one to one, and not looked at again.

    Raises TextureMapError for coordinates that are missing, cut, outside the unit square or not one to one.
    """
    if mesh.corner_uv is None:
        raise TextureMapError("this mesh has no texture coordinates of its own")
    uv = np.empty((len(mesh.vertices), 2))
    uv[mesh.faces] = mesh.corner_uv
    cut = int((np.abs(uv[mesh.faces] - mesh.corner_uv).max(axis=(1, 2)) > 1e-6).sum())
    if cut:
        raise TextureMapError(f"the mesh's own texture coordinates are cut at {cut:,} triangles; split it at its seams")
    if uv.min() < 0 or uv.max() > 1:
        raise TextureMapError("the mesh's own texture coordinates leave the unit square")
    trouble = "" if known_good else why_not_one_to_one(mesh, Layout(uv, np.zeros_like(mesh.faces)))
    if trouble:
        raise TextureMapError(f"the mesh's own texture coordinates are not one to one: {trouble}")
    uv = np.minimum(uv, np.nextafter(1.0, 0.0))
    return _texture_map(mesh, uv, uv[mesh.faces], wrapped=False, note="the mesh's own texture coordinates")


def _texture_map(mesh: TriangleMesh, uv: Floats, corners: Floats, *, wrapped: bool, note: str) -> TextureMap:
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    covered = 0.5 * np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]).sum()
    metres = float(np.sqrt(mesh.face_areas.sum() / covered))
    return TextureMap(mesh, uv, corners, metres, wrapped, note)
