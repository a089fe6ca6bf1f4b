"""A hand, an arm or a foot with large wrinkles on its joints and fine ones all over, in any pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import igl
import numpy as np
from scipy.spatial import cKDTree

from ..head.locate import Locator
from ..head.mesh import Floats, TriangleMesh
from ..head.repair import face_components
from .bezier import fit_stroke
from .body_part import BodyPart, extract, split_at_seams
from .creases import Creases
from .fine_settings import FineSettings
from .furrow import Furrow
from .furrow_bed import prepare_bed
from .joint_furrows import SkinFurrow
from .limb_skin import LimbSkin, PosedLimb, filling_the_square, grow_limb_skin
from .refined_mesh import RefinedMesh
from .skin_layout import SkinLayout
from .texture_map import TextureMap

_TOLERANCE = 2e-4  # of curves through the points of a furrow [m]
_WHOLE = 1.0 - 1e-9
# Furrows end this far from where the map is cut open [m]: skin is not laid out around a cut. Fewer points are no furrow.
_FROM_CUTS = 0.003
_FEWEST = 5


class WrinkledLimb:
    """The skin of a limb that was refined around its furrows; what stays the same in every pose is made once.

    skin: what is drawn, see LimbSkin. Raises ValueError for a limb without texture coordinates.
    """

    skin: LimbSkin

    def __init__(
        self,
        limb: TriangleMesh,
        furrows: Sequence[SkinFurrow],
        fine: FineSettings,
        *,
        along: Floats,
        bare: Floats | None = None,
        strength: float = 1.0,
        fineness: float = 0.4,
    ) -> None:
        """along, bare: directions of the limb and out of its palm or sole, (3,). strength: multiplies every depth."""
        layout = _layout(limb)
        cuts = cKDTree(_border(layout.texture_map.mesh))
        laid = [laid for furrow in furrows if (laid := _laid(furrow, layout, cuts)) is not None]
        bed = prepare_bed(layout, laid, fineness)
        self._creases = Creases(bed, strength=strength)
        refined = bed.refined
        assert limb.corner_uv is not None  # split_at_seams has looked
        rest = TriangleMesh(refined.vertices, refined.faces, _refined_corners(refined, limb.corner_uv))
        self.skin = grow_limb_skin(rest, fine, along, bare, known_good=True, on_lines=bed.on_lines)

    def at(self, posed: Floats) -> PosedLimb:
        """The wrinkled skin of the limb whose own vertices are at ``posed`` [m], (n, 3)."""
        return self.skin.at(self._creases.displaced(posed).positions)


def _layout(limb: TriangleMesh) -> SkinLayout:
    """The largest piece of the limb's own texture map."""
    opened = split_at_seams(limb)
    piece = face_components(opened.mesh.faces)
    largest = np.flatnonzero(piece == np.bincount(piece, opened.mesh.face_areas).argmax())
    part = extract(opened.mesh, largest)
    on_limb = BodyPart(part.mesh, opened.vertices[part.vertices], opened.faces[part.faces])
    return SkinLayout(limb, on_limb, filling_the_square(part.mesh))


def _laid(furrow: SkinFurrow, layout: SkinLayout, cuts: cKDTree) -> Furrow | None:
    """The furrow in texture space, as far as it keeps away from the cuts of the map; None where little is left."""
    map_: TextureMap = layout.texture_map
    found, distance = Locator(map_.mesh.vertices, map_.mesh.faces).nearest(furrow.points)
    clear = (cuts.query(furrow.points)[0] > _FROM_CUTS) & (distance < _TOLERANCE)
    runs = [run for run in np.split(np.arange(len(clear)), np.flatnonzero(np.diff(clear)) + 1) if clear[run].all()]
    kept = max(runs, key=len, default=np.zeros(0, dtype=np.int64))
    if len(kept) < _FEWEST:
        return None
    uv = np.einsum("ki,kij->kj", found.weights[kept], map_.corner_uv[found.faces[kept]])
    chain = fit_stroke(uv, _TOLERANCE / map_.metres)
    return replace(furrow.furrow, controls=tuple(map(tuple, chain.controls.tolist())))


def _border(mesh: TriangleMesh) -> Floats:
    """Points along the border of a mesh, close together [m], (k, 3)."""
    ends = mesh.vertices[igl.boundary_facets(mesh.faces)[0]]
    part = np.linspace(0.0, 1.0, 6)[:, None, None]
    points: Floats = (ends[:, 0] + part * (ends[:, 1] - ends[:, 0])).reshape(-1, 3)
    return points


def _refined_corners(refined: RefinedMesh, corner_uv: Floats) -> Floats:
    """Texture coordinates at the corners of refined triangles, (M, 3, 2), from those of the coarse ones.

    A vertex on an edge may be at home in the triangle beside: its weights belong to the corners that both share, and a
    cut of the map along that edge stays a cut. One that was moved away from both keeps what it has at home.
    """
    corner, coarse = refined.faces, refined.coarse.faces
    own, wanted = coarse[refined.home[corner]], coarse[refined.parent]
    shared = own[..., :, None] == wanted[:, None, None, :]
    weights = np.einsum("kci,kcij->kcj", refined.weights[corner], shared)
    inside = np.einsum("kci,kij->kcj", weights, corner_uv[refined.parent])
    at_home = np.einsum("kci,kcij->kcj", refined.weights[corner], corner_uv[refined.home[corner]])
    uv: Floats = np.where((weights.sum(axis=2) > _WHOLE)[..., None], inside, at_home)
    return uv
