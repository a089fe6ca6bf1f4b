"""What every shader knows about the frame: one structured dtype, byte for byte the block in common/scene.glsl."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..scene.settings import Look
from .view import View

SCENE_DTYPE = np.dtype(
    [
        ("clip_from_world", "f4", (4, 4)),
        ("light_from_world", "f4", (4, 4)),
        ("eye", "f4", 4),
        ("to_light", "f4", 4),
        ("radiance", "f4", 4),
        ("sky", "f4", 4),
        ("ground", "f4", 4),
        ("head_turn", "f4", 4),
        ("head_shift", "f4", 4),
        ("shadow", "f4", 4),
    ]
)

# A warm light against a cool sky makes skin look alive; the ground sends back a little warmth.
_LIGHT_TINT = np.array([1.0, 0.965, 0.92])
_SKY_TINT = np.array([0.90, 0.97, 1.08])
_GROUND_TINT = np.array([0.50, 0.44, 0.40])


def linear(srgb: tuple[float, float, float]) -> Floats:
    """An sRGB colour, parts 0 to 1, as linear light, (3,) (IEC 61966-2-1)."""
    value = np.asarray(srgb, dtype=np.float64)
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def sky_and_ground(look: Look) -> tuple[Floats, Floats]:
    """Radiance of the sky from above and from below, linear RGB, (3,) each."""
    return look.ambient * _SKY_TINT, look.ambient * _GROUND_TINT


def scene_block(camera: View, light: View, frame: HeadFrame, look: Look) -> NDArray[np.void]:
    """The block for one frame, shape (1,)."""
    block = np.zeros(1, SCENE_DTYPE)
    # GLSL reads matrices by columns.
    block["clip_from_world"] = camera.clip_from_world.T
    block["light_from_world"] = light.clip_from_world.T
    block["eye"][0, :3] = camera.eye
    block["to_light"][0, :3] = -light.forward
    block["radiance"][0, :3] = look.light_strength / np.pi * _LIGHT_TINT
    block["sky"][0, :3], block["ground"][0, :3] = sky_and_ground(look)
    block["head_turn"][0, :3] = frame.rotation.as_rotvec()
    block["head_shift"][0, :3] = frame.translation
    block["shadow"][0] = float(look.shadows), light.far, camera.near, camera.far
    return block
