"""What a pose does to the skin of a head, in the order of Bando's thesis, chapter 2: muscles and tissue (2.5.2), shrinkage
and furrows (2.5.3), fine-scale wrinkles (2.6.4).

This needs no map, no image and no mesh that is drawn; so it is small enough to be sent to another process.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..head.mesh import Floats, Ints
from .at_once import at_once
from .creases import Creases, WrinkledSkin
from .face import Face
from .face_settings import FaceSettings
from .fine_growth import FineGrowth


@dataclass(frozen=True, eq=False)
class MovedSkin:
    """A skin at one instant, head frame.

    skin: positions, normals and displacement of the refined skin. amplitudes: of both fine fields at its vertices, (N, 2).
    expansion: how much larger than at rest it is around each, 1 at rest, (N,). posed: the head's own vertices before they
    wrinkle [m], (n, 3). jaw: how far it is open [rad].
    """

    skin: WrinkledSkin
    amplitudes: Floats
    expansion: Floats
    posed: Floats
    jaw: float


@dataclass(frozen=True, eq=False)
class SkinMotion:
    """Moves one skin. fine: of its fine wrinkles, over the vertices ``part`` of the head's, (k,); None where there are none.
    interpolation: from the head's vertices to those of the refined skin, (N, n)."""

    face: Face
    creases: Creases
    fine: FineGrowth | None
    part: Ints
    interpolation: sparse.csr_array

    def at(self, settings: FaceSettings, tissue: Floats) -> MovedSkin:
        """The skin with the face as its sliders are set. tissue: its thickness under the head's vertices [m], (n,)."""
        posed, jaw = self.face.skin_at(settings, tissue)
        skin, (amplitudes, expansion) = at_once(
            lambda: self.creases.displaced(posed),
            lambda: (self._fine_amplitudes(posed), self.interpolation @ self.face.expansion(posed)),
        )
        return MovedSkin(skin, amplitudes, expansion, posed, jaw)

    def _fine_amplitudes(self, posed: Floats) -> Floats:
        """Of both fine fields at the vertices of the refined skin, (N, 2), for posed positions of the head's [m], (n, 3)."""
        amplitudes = np.ones((len(posed), 2))
        if self.fine is not None:
            amplitudes[self.part] = self.fine.amplitudes(posed[self.part])
        spread: Floats = self.interpolation @ amplitudes
        return spread
