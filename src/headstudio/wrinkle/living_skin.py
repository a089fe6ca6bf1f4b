"""The skin of a head in any expression: the face moves, large wrinkles form, fine ones rise and fall."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from ..head.head import Head, Part
from ..head.mesh import Floats, Ints, TriangleMesh
from .creases import Creases
from .face import Face
from .face_settings import FaceSettings
from .fine_wrinkles import FineWrinkles
from .furrow_bed import FurrowBed
from .skin_motion import MovedSkin, SkinMotion
from .tissue_thickness import painted_thickness, thickness_of


@dataclass(frozen=True, eq=False)
class SkinSurface:
    """What stays the same in every expression of a skin.

    head: at rest. bed: the skin refined around its furrows, N vertices, M triangles. fine: its fine wrinkles, or None.
    """

    head: Head
    bed: FurrowBed
    fine: FineWrinkles | None

    @property
    def faces(self) -> Ints:
        """Triangles of the refined skin, (M, 3)."""
        return self.bed.refined.faces

    def mesh(self, positions: Floats) -> TriangleMesh:
        """The refined skin as a mesh at ``positions`` [m], (N, 3)."""
        return TriangleMesh(positions, self.faces)

    @cached_property
    def interpolation(self) -> sparse.csr_array:
        """The matrix, (N, n), from values at the head's vertices to values at all vertices of the refined skin."""
        return self.bed.refined.interpolation(np.arange(len(self.bed.refined.home)))

    def spread(self, values: Floats) -> Floats:
        """Values at the head's vertices, (n,) or (n, d), at all vertices of the refined skin."""
        spread: Floats = self.interpolation @ values
        return spread

    @cached_property
    def rest(self) -> Floats:
        """Every vertex of the refined skin on the head at rest [m], (N, 3)."""
        return self.spread(self.head.skin.vertices)

    @cached_property
    def uv(self) -> Floats:
        """Texture coordinates of every vertex of the refined skin, (N, 2); zero where it is not mapped."""
        layout = self.bed.layout
        whole = np.zeros((len(layout.skin.vertices), 2))
        whole[layout.part.vertices] = layout.texture_map.uv
        return self.spread(whole)

    @cached_property
    def inside(self) -> np.ndarray:
        """Which of the head's vertices lie inside the mapped part and not at its border, (n,)."""
        layout = self.bed.layout
        inside = np.zeros(len(layout.skin.vertices), dtype=bool)
        inside[layout.part.vertices] = True
        inside[layout.skin.faces[~layout.mapped]] = False
        return inside

    @cached_property
    def mapped(self) -> Floats:
        """How far every vertex of the refined skin lies inside the mapped part, 0 at its border to 1, (N,)."""
        return self.spread(self.inside.astype(np.float64))


@dataclass(frozen=True, eq=False)
class LivingSkin(MovedSkin):
    """A skin at one instant with all that belongs to it, head frame.

    surface: what it has in common with every other instant. parts: of the head, moved; one that rests is the head's own
    object.
    """

    surface: SkinSurface
    face: Face
    parts: tuple[Part, ...]


class Skin:
    """One head's skin, ready for any expression."""

    def __init__(self, face: Face, surface: SkinSurface, creases: Creases) -> None:
        """surface: of the head that ``face`` moves. creases: on the bed of this surface."""
        self.face = face
        self.creases = creases
        self.surface = surface
        self._thickness: tuple[object, Floats] | None = None
        self._preset: tuple[str, Floats] | None = None

    @cached_property
    def motion(self) -> SkinMotion:
        """What moves it."""
        surface = self.surface
        growth = surface.fine.growth if surface.fine is not None else None
        return SkinMotion(self.face, self.creases, growth, surface.bed.layout.part.vertices, surface.interpolation)

    def at(self, settings: FaceSettings) -> LivingSkin:
        """The skin with the face as its sliders are set."""
        return self.alive(self.motion.at(settings, self.tissue(settings)), settings)

    def alive(self, moved: MovedSkin, settings: FaceSettings) -> LivingSkin:
        """The skin that its motion has moved so, with these settings."""
        parts = self.face.parts_on(moved.posed, settings)
        return LivingSkin(**vars(moved), surface=self.surface, face=self.face, parts=parts)

    def tissue(self, settings: FaceSettings) -> Floats:
        """Thickness of the tissue under every vertex at rest [m], (n,); found again only when it changes."""
        wanted = (settings.tissue, settings.painted_tissue)
        if self._thickness is None or self._thickness[0] != wanted:
            thickness = self._named_tissue(settings.tissue)
            if settings.painted_tissue is not None:
                thickness = thickness.copy()
                layout = self.surface.bed.layout
                thickness[layout.part.vertices] = painted_thickness(settings.painted_tissue, layout.texture_map)
            self._thickness = (wanted, thickness)
        return self._thickness[1]

    def _named_tissue(self, preset: str) -> Floats:
        """That of a preset, kept: a brush asks for it with every move, and rays under the skin take their time."""
        if self._preset is None or self._preset[0] != preset:
            self._preset = (preset, thickness_of(self.face.head, preset))
        return self._preset[1]
