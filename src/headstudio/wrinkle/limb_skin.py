"""The skin of a hand, an arm or a foot with fine wrinkles, in any pose: Bando's thesis, section 2.6 and figures 2.16 to 2.19.

A limb comes with texture coordinates of its own, cut where no projection could do without. The skin is opened along
these cuts: what is one vertex of the limb may be two of its skin, which always lie at the same place.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.repair import face_components
from .body_part import extract, split_at_seams
from .fine_guides import limb_guides
from .fine_settings import FineSettings
from .fine_wrinkles import FineWrinkles, grow_fine_wrinkles
from .mapping import own_coordinates
from .shape import amplitude
from .texture_map import TextureMap
from .tissue import TissueLift

# Empty border around the map, as a part of the unit square.
_MARGIN = 0.02


@dataclass(frozen=True, eq=False)
class LimbSkin:
    """What stays the same of a limb's skin in every pose.

    limb: at rest, n vertices. opened: the same, cut open along its texture coordinates, k vertices; source: which of the
    limb's vertex each of them is, (k,). mapped: those of them that are on the map, (j,), in the order of ``fine``'s.
    uv: texture coordinates, zero off the map, (k, 2). lines: which of the opened skin's vertices are on lines of furrows.
    """

    limb: TriangleMesh
    opened: TriangleMesh
    source: Ints
    mapped: Ints
    uv: Floats
    fine: FineWrinkles | None
    tissue: TissueLift
    lines: Ints

    def at(self, posed: Floats) -> PosedLimb:
        """The skin of the limb whose vertices are at ``posed`` [m], (n, 3)."""
        amplitudes, shrinkage = np.ones((len(self.source), 2)), np.zeros((len(self.source), 2))
        if self.fine is not None:
            shrinkage[self.mapped] = self.fine.growth.shrinkage(posed[self.source[self.mapped]])
            amplitudes = amplitude(shrinkage, self.fine.initial_amplitude)
        expansion = np.ones(len(posed))
        expansion[self.tissue.vertices] = self.tissue.expansion(posed)
        # Opened along its cuts the skin would be shaded as if it ended there.
        normals = self.limb.moved(posed).vertex_normals
        return PosedLimb(self, posed[self.source], normals[self.source], amplitudes, shrinkage, expansion[self.source])


@dataclass(frozen=True, eq=False)
class PosedLimb:
    """A limb at one instant. positions [m] and unit normals of the opened skin, (k, 3). amplitudes: of both fine fields,
    and shrinkage across their furrows, (k, 2). expansion: over the area at rest, (k,)."""

    skin: LimbSkin
    positions: Floats
    normals: Floats
    amplitudes: Floats
    shrinkage: Floats
    expansion: Floats


def grow_limb_skin(
    limb: TriangleMesh,
    settings: FineSettings,
    along: Floats,
    bare: Floats | None = None,
    *,
    known_good: bool = False,
    on_lines: Ints | None = None,
) -> LimbSkin:
    """The skin of ``limb`` at rest, with fine wrinkles on the largest piece of its map.

    along, bare: directions of the limb and out of its palm or sole, (3,), see ``limb_guides``. known_good: its map is a
    finer one of a map that is one to one. on_lines: its vertices on lines of furrows. Raises ValueError for a mesh without
    texture coordinates, TextureMapError for some that are not one to one.
    """
    opened = split_at_seams(limb)
    piece = face_components(opened.mesh.faces)
    largest = np.flatnonzero(piece == np.bincount(piece, opened.mesh.face_areas).argmax())
    part = extract(opened.mesh, largest)
    texture_map = filling_the_square(part.mesh, known_good=known_good)
    fine = grow_fine_wrinkles(texture_map, settings, limb_guides(texture_map, along, bare)) if settings.on else None
    uv = np.zeros((len(opened.vertices), 2))
    uv[part.vertices] = texture_map.uv
    lines = np.flatnonzero(np.isin(opened.vertices, [] if on_lines is None else on_lines))
    return LimbSkin(limb, opened.mesh, opened.vertices, part.vertices, uv, fine, TissueLift(limb, spread=0.0), lines)


def filling_the_square(mesh: TriangleMesh, *, known_good: bool = False) -> TextureMap:
    """The mesh's own map, scaled evenly so that it fills the unit square. Raises TextureMapError."""
    corners = mesh.corner_uv
    if corners is None:
        raise ValueError("this mesh has no texture coordinates of its own")
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    scale = (1.0 - 2.0 * _MARGIN) / (high - low).max()
    placed = 0.5 + scale * (corners - 0.5 * (low + high))
    return own_coordinates(TriangleMesh(mesh.vertices, mesh.faces, placed), known_good=known_good)
