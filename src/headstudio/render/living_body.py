"""A head whose skin lives: its face moves, and so do its eyes, teeth and lashes."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.frame import HeadFrame
from ..head.head import Head
from ..scene.settings import Look
from ..wrinkle.face import Face
from ..wrinkle.face_settings import FaceSettings
from ..wrinkle.living_skin import LivingSkin, SkinSurface
from .body_parts import BodyParts
from .hair_ground import Growth, ground_cover, same_ground
from .head_shade import HeadShade, shade_of_head
from .skin_body import SkinBody, SkinPrograms
from .skin_shape import MOST_HIDDEN, HeadShape, head_shape, pose_of, shape_of, smooth_pose_of
from .targets import Size
from .view import View


class LivingBody(SkinBody):
    """A living skin and the parts of its head; made once per ``SkinSurface``."""

    def __init__(
        self,
        context: moderngl.Context,
        programs: SkinPrograms,
        surface: SkinSurface,
        face: Face,
        known: LivingBody | None = None,
    ) -> None:
        """face: that moves the skin. known: one that was drawn before, of which the same head or the same fine wrinkles are
        taken over."""
        self.surface = surface
        self.head = surface.head
        same_head = known is not None and known.head is self.head
        self._shade: HeadShade = (
            known._shade if known and same_head else shade_of_head(context, self.head, _mouth_open(face))
        )
        same_map = known is not None and known.surface.bed.layout is surface.bed.layout
        self._of_head: HeadShape = known._of_head if known and same_map else head_shape(surface, self._shade.skin)
        super().__init__(context, programs, shape_of(surface, self._of_head), self.head.skin, known)
        self._mouth_shade = surface.spread(self._shade.mouth)
        parts_hidden = [np.minimum(part, MOST_HIDDEN) for part in self._shade.parts]
        self._parts: BodyParts = (
            known._parts if known and same_head else BodyParts(context, programs.part, self.head, parts_hidden)
        )
        self._shown: tuple[LivingSkin, str] | None = None
        self._shown_smooth: tuple[LivingSkin, str] | None = None

    def set_roots(self, growth: Growth) -> None:
        """Cover the skin that ``growth`` grows from; sent again only for other roots."""
        if not same_ground(growth, self.growth):
            self.cover(self.surface.spread(ground_cover(self.head, growth)))
        self.growth = growth

    def look_from(self, view: View, frame: HeadFrame, size: Size) -> None:
        """Be as detailed as the next picture needs, of so many pixels (width, height), of the head at ``frame``."""
        super().look_from(view, frame, size)
        self._parts.look_from(view, frame.translation, size[1])

    def pose(self, skin: LivingSkin, look: Look) -> None:
        """Take the pose of ``skin``, of this body's surface; sent again only for another object or other figures shown."""
        wanted = (skin, look.skin_shows)
        if self._shown != wanted:
            self._parts.move(skin.parts)
            self.take(pose_of(skin, look.skin_shows, self._mouth_shade))
            self._shown = wanted
        if look.split > 0 and self._shown_smooth != wanted:
            self.take_smooth(smooth_pose_of(skin, look.skin_shows, self._mouth_shade))
            self._shown_smooth = wanted

    def draw_parts(self, look: Look) -> None:
        """Eyes, teeth and lashes into the framebuffer in use; texture 0 is the shadow map, 1 the light map."""
        self._parts.draw(look)


def _mouth_open(face: Face) -> Head:
    return face.posed_head(face.pose(FaceSettings(jaw_open=1.0)))
