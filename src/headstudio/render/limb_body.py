"""A hand, an arm or a foot, drawn as the skin of a head is."""

from __future__ import annotations

import moderngl

from ..scene.settings import Look
from ..wrinkle.limb_skin import LimbSkin, PosedLimb
from .skin_body import SkinBody, SkinPrograms
from .skin_shape import limb_pose_of, limb_shape_of
from .sky import hidden_from_sky


class LimbBody(SkinBody):
    """The skin of a limb; made once per ``LimbSkin``."""

    def __init__(self, context: moderngl.Context, programs: SkinPrograms, skin: LimbSkin) -> None:
        self.skin = skin
        limb = skin.limb
        hidden = hidden_from_sky(context, limb, limb.vertices, limb.vertex_normals)
        super().__init__(context, programs, limb_shape_of(skin, hidden), limb)
        self._shown: tuple[PosedLimb, str] | None = None

    def pose(self, limb: PosedLimb, look: Look) -> None:
        """Take a pose of this skin; sent again only for another object or other figures shown."""
        if self._shown != (limb, look.skin_shows):
            self.take(limb_pose_of(limb, look.skin_shows))
            self._shown = (limb, look.skin_shows)
