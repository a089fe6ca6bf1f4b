"""How hair length varies over the scalp: the gray image L(u, v) of Bando et al. 2006, section 3.2."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import map_coordinates

from .mesh import Floats
from .scalp_settings import GrayImage
from .smooth import smoothstep

SIZE = 256


def preset(name: str) -> GrayImage:
    """The named length map, 256 x 256: one of LENGTH_MAPS."""
    centre = (np.arange(SIZE) + 0.5) / SIZE
    u, v = np.meshgrid(centre, centre)
    return GrayImage(_PRESETS[name](u, v).astype(np.float32))


def sample(image: GrayImage, uv: Floats) -> Floats:
    """The image at points of the square, (k, 2), bilinearly between pixel centres as a texture is: (k,)."""
    rows, columns = image.pixels.shape
    at = np.stack([uv[:, 1] * rows - 0.5, uv[:, 0] * columns - 0.5])
    return map_coordinates(image.pixels.astype(np.float64), at, order=1, mode="nearest")


def _off_middle(u: Floats) -> Floats:
    """How far from the middle line, 0 in the middle and 1 at the ears."""
    return np.abs(2 * u - 1)


def _even(u: Floats, v: Floats) -> Floats:
    return np.ones_like(u)


def _fringe(u: Floats, v: Floats) -> Floats:
    # Over the forehead hair grows toward the face: what stands further back may be longer by the way it has to go.
    over_forehead = 0.2 + 0.45 * smoothstep(v, 0.05, 0.35) + 0.35 * smoothstep(v, 0.3, 0.55)
    beside = smoothstep(_off_middle(u), 0.35, 0.75)
    return over_forehead + (1 - over_forehead) * beside


def _long_back(u: Floats, v: Floats) -> Floats:
    return 0.04 + 0.96 * smoothstep(v, 0.3, 0.65)


def _bob(u: Floats, v: Floats) -> Floats:
    # Cut at one height: hair that starts higher on the head is longer.
    height = np.sin(np.pi * v) * (1 - 0.5 * _off_middle(u) ** 2)
    return np.minimum(0.45 + 0.35 * height, _fringe(u, v))


def _short(u: Floats, v: Floats) -> Floats:
    # Longest on top, tapering to the forehead, the ears and the nape.
    rim = np.maximum(
        0.6 * (1 - smoothstep(v, 0.0, 0.25)), np.maximum(smoothstep(_off_middle(u), 0.3, 0.9), smoothstep(v, 0.5, 0.95))
    )
    return 0.25 - 0.15 * rim


_PRESETS = {"even": _even, "fringe": _fringe, "long back": _long_back, "bob": _bob, "short": _short}
