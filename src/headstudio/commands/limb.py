"""``headstudio limb``: a hand, an arm or a foot with its wrinkles, as a picture."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..head.head import HeadError
from ..head.limbs import makehuman_foot, makehuman_hand
from ..head.mesh import Floats, TriangleMesh
from ..head.rig import BodyPart, is_hand
from ..head.rigged import load_rigged
from ..params import ParameterError, assign
from ..render.view import fitting
from ..scene.document import Document
from ..wrinkle.hand import Hand
from ..wrinkle.hand_settings import HandSettings
from ..wrinkle.joint_furrows import joint_furrows
from ..wrinkle.limb_map import long_side, share_of_largest_piece, with_map
from ..wrinkle.wrinkled_limb import WrinkledLimb
from .pictures import Photographer, Size, check_is_picture, save_picture
from .reporting import say, warn, working

LIMBS = ("hand", "arm", "foot")
# How much of what is looked at from close by is seen [m].
_CLOSE = 0.042
# A map that comes with a limb serves when its largest piece holds this part of the skin: only there are fine wrinkles.
_MAPPED = 0.95


def limb(
    document: Document, which: str, hand: HandSettings, wrinkles: bool, size: Size, out: Path, near: str | None = None
) -> None:
    """Write a picture of a limb: "hand", "arm", "foot", or what a GLB file holds.

    near: the joint whose back the picture shows from close by; None for the whole limb.

    Raises HeadError, ParameterError, RenderError, TextureMapError, OSError.
    """
    check_is_picture(out)
    with working("reading the limb"):
        part = _part(document, which)
    posable = part.rig is not None and is_hand(part.rig.names)
    if not posable and which not in LIMBS:
        warn(f"{which} has no skeleton of a hand: it stays as it is, without lines on its joints")
    posed = Hand(part).pose(hand) if posable else part.skin.vertices
    with working("laying out the skin"):
        limb_skin = part.skin if share_of_largest_piece(part.skin) > _MAPPED else _laid_out(part, posable)
    strength = 2.0 * document.head.age if wrinkles and document.wrinkle.shown else 0.0
    fine = assign(document, {"fine.on": wrinkles and document.fine.on}).fine
    along, bare = _directions(which, posable, part.skin)
    with working("wrinkling the skin"):
        furrows = joint_furrows(part, document.fine.seed) if strength > 0 and posable else ()
        skin = WrinkledLimb(limb_skin, furrows, fine, along=along, bare=bare, strength=min(strength, 2.0))
        shown = skin.at(posed)
    camera = fitting(document.camera, shown.positions, size[0] / size[1])
    if near is not None:
        x, y, z = (float(value) for value in posed[_back_of(part, near)])
        distance = 0.5 * _CLOSE / math.tan(0.5 * camera.field_of_view)
        camera = replace(camera, target_x=x, target_y=y, target_z=z, distance=distance)
    document = replace(document, camera=camera)
    photographer = Photographer(size)
    photographer.renderer.render_limb(shown, document.look, document.camera, size, 2, document.skin)
    save_picture(photographer.renderer.read_pixels(), out)
    say(str(out))


def _back_of(part: BodyPart, joint: str) -> int:
    """The vertex of the skin on the back (+Z) over a joint. Raises HeadError for a joint that is not there."""
    if part.rig is None:
        raise HeadError(f"{part.name} has no skeleton, and so no joint {joint!r}")
    away = np.linalg.norm((part.skin.vertices - part.rig.at(joint))[:, :2], axis=1)
    return int(np.where(part.skin.vertex_normals[:, 2] > 0, away, np.inf).argmin())


def _laid_out(part: BodyPart, posable: bool) -> TriangleMesh:
    """The skin with a map of its own; a hand is opened for it, so that no finger hides another."""
    return with_map(part.skin, Hand(part).pose(HandSettings(pose="open")) if posable else None)


def _directions(which: str, posable: bool, skin: TriangleMesh) -> tuple[Floats, Floats | None]:
    """Along a limb and out of its palm or sole, where no fine wrinkle is, (3,) each; None where nobody knows."""
    if which == "foot":
        return np.array([0.0, 0.0, 1.0]), np.array([0.0, -1.0, 0.0])
    if posable:
        return np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, -1.0])
    return long_side(skin), None


def _part(document: Document, which: str) -> BodyPart:
    age, masculine = document.head.age, document.head.masculine
    if which == "foot":
        return makehuman_foot(age, masculine)
    if which in LIMBS:
        return makehuman_hand(age, masculine, arm=which == "arm")
    if not which.lower().endswith(".glb"):
        raise ParameterError(f"a limb is {', '.join(LIMBS)}, or what a .glb file holds; got {which!r}")
    return load_rigged(Path(which))
