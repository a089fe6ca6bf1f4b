"""The document: everything an artist decides, and nothing that follows from it.

It is immutable. A user action makes another document; whatever is shown, simulated or written is built from it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from ..head.scalp_settings import ScalpSettings
from ..lcp.settings import DynamicsSettings, HairSettings, WindSettings
from ..wisp.groom import GroomSettings
from ..wisp.settings import FacialHairSettings, HairColourSettings, WispSettings
from ..wisp.styling_settings import StylingSettings
from ..wrinkle.face_settings import FaceSettings
from ..wrinkle.fine_settings import FineSettings
from ..wrinkle.settings import WrinkleSettings
from .settings import Camera, HeadSettings, Look, MotionSettings
from .skin_settings import SkinSettings


@dataclass(frozen=True)
class Document:
    """One head with its hair, motion, look and camera. The dotted path of a parameter is PART.FIELD."""

    head: HeadSettings = field(default_factory=HeadSettings)
    scalp: ScalpSettings = field(default_factory=ScalpSettings)
    hair: HairSettings = field(default_factory=HairSettings)
    lcp: DynamicsSettings = field(default_factory=DynamicsSettings)
    wind: WindSettings = field(default_factory=WindSettings)
    wisp: WispSettings = field(default_factory=WispSettings)
    styling: StylingSettings = field(default_factory=StylingSettings)
    groom: GroomSettings = field(default_factory=GroomSettings)
    beard: FacialHairSettings = field(default_factory=FacialHairSettings)
    colour: HairColourSettings = field(default_factory=HairColourSettings)
    face: FaceSettings = field(default_factory=FaceSettings)
    wrinkle: WrinkleSettings = field(default_factory=WrinkleSettings)
    fine: FineSettings = field(default_factory=FineSettings)
    skin: SkinSettings = field(default_factory=SkinSettings)
    motion: MotionSettings = field(default_factory=MotionSettings)
    look: Look = field(default_factory=Look)
    camera: Camera = field(default_factory=Camera)
