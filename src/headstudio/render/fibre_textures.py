"""The scattering of a fibre on the graphics card: its tables as textures, made once and kept while hair comes and goes."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats
from .fibre import Fibre, fibre_tables


class FibreTextures:
    """The tables of the fibre that was wanted last."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._fibre: Fibre | None = None
        self._textures: list[moderngl.Texture | moderngl.Texture3D] = []

    def bind(self, fibre: Fibre, first_unit: int) -> dict[str, object]:
        """Bind the tables of ``fibre`` to four units from ``first_unit`` on; returns the uniforms of common/fibre.glsl."""
        if fibre != self._fibre:
            self._make(fibre)
        for k, texture in enumerate(self._textures):
            texture.use(first_unit + k)
        return {
            "around_table": first_unit, "spread_table": first_unit + 1, "back_table": first_unit + 2,
            "forward_table": first_unit + 3,
            "variances": tuple(fibre.variances),
            "tilt_cos": tuple(np.cos(fibre.tilts)),
            "tilt_sin": tuple(np.sin(fibre.tilts)),
        }  # fmt: skip

    def _make(self, fibre: Fibre) -> None:
        tables = fibre_tables(fibre)
        back, forward = (self._plane(part) for part in np.split(tables.turned, 2, axis=2))
        self._textures = [self._volume(tables.around), self._volume(tables.spread), back, forward]
        self._fibre = fibre

    def _plane(self, values: Floats) -> moderngl.Texture:
        height, width, parts = values.shape
        plane = self._context.texture((width, height), parts, values.astype("f4", order="C"), dtype="f4")
        plane.repeat_x = plane.repeat_y = False
        return plane

    def _volume(self, values: Floats) -> moderngl.Texture3D:
        depth, height, width, parts = values.shape
        volume = self._context.texture3d((width, height, depth), parts, values.astype("f2", order="C"), dtype="f2")
        volume.repeat_x = volume.repeat_y = volume.repeat_z = False
        return volume
