"""``headstudio limb``: a hand, an arm or a foot with its wrinkles, as a picture."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..head.limbs import makehuman_foot, makehuman_hand
from ..head.rig import BodyPart
from ..head.rigged import load_rigged
from ..params import ParameterError, assign
from ..scene.document import Document
from ..wrinkle.hand import Hand
from ..wrinkle.hand_settings import HandSettings
from ..wrinkle.joint_furrows import joint_furrows
from ..wrinkle.wrinkled_limb import WrinkledLimb
from .pictures import Photographer, Size, check_is_picture, save_picture
from .reporting import say, working

LIMBS = ("hand", "arm", "foot")
# Room for the limb in the picture, in lengths of its longest side.
_ROOM = 1.15


def limb(document: Document, which: str, hand: HandSettings, wrinkles: bool, size: Size, out: Path) -> None:
    """Write a picture of a limb: "hand", "arm", "foot", or a rigged hand in a GLB file.

    Raises HeadError, ParameterError, RenderError, OSError.
    """
    check_is_picture(out)
    with working("reading the limb"):
        part = _part(document, which)
    posed = Hand(part).pose(hand) if part.rig is not None else part.skin.vertices
    if part.skin.corner_uv is None:
        raise ParameterError(f"{which} has no texture coordinates, which wrinkles are laid out on")
    strength = 2.0 * document.head.age if wrinkles and document.wrinkle.shown else 0.0
    fine = assign(document, {"fine.on": wrinkles and document.fine.on}).fine
    # A hand's fingers point along +Y and its back along +Z; the sole of a foot looks down.
    bare = np.array([0.0, -1.0, 0.0]) if which == "foot" else np.array([0.0, 0.0, -1.0])
    along = np.array([0.0, 0.0, 1.0]) if which == "foot" else np.array([0.0, 1.0, 0.0])
    with working("wrinkling the skin"):
        furrows = joint_furrows(part, document.fine.seed) if strength > 0 else ()
        skin = WrinkledLimb(part.skin, furrows, fine, along=along, bare=bare, strength=min(strength, 2.0))
        shown = skin.at(posed)
    low, high = shown.positions.min(axis=0), shown.positions.max(axis=0)
    x, y, z = 0.5 * (low + high)
    distance = 0.5 * _ROOM * float(np.linalg.norm(high - low)) / math.tan(0.5 * document.camera.field_of_view)
    document = assign(
        document,
        {"camera.target_x": x, "camera.target_y": y, "camera.target_z": z, "camera.distance": distance},
    )
    photographer = Photographer(size)
    photographer.renderer.render_limb(shown, document.look, document.camera, size, 2, document.skin)
    save_picture(photographer.renderer.read_pixels(), out)
    say(str(out))


def _part(document: Document, which: str) -> BodyPart:
    age, masculine = document.head.age, document.head.masculine
    if which == "foot":
        return makehuman_foot(age, masculine)
    if which in LIMBS:
        return makehuman_hand(age, masculine, arm=which == "arm")
    if not which.lower().endswith(".glb"):
        raise ParameterError(f"a limb is {', '.join(LIMBS)}, or a rigged hand in a .glb file; got {which!r}")
    return load_rigged(Path(which))
