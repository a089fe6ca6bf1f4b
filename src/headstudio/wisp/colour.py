"""The colour of every strand, drawn from distributions of hue, saturation and value (Choe, Ko 2005, section 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints
from ..head.smooth import smoothstep
from .melanin import NATURAL, melanin_colour
from .settings import HairColourSettings

Singles = NDArray[np.float32]

# Hair without pigment is not white as paper.
_UNPIGMENTED = np.array([0.62, 0.62, 0.60])


def mean_colour(settings: HairColourSettings) -> Floats:
    """The mean colour of the hair, sRGB, (3,)."""
    if settings.pigment == "dyed":
        return np.array(settings.dye)
    if settings.pigment == "melanin":
        return encode_srgb(_with_cuticle(melanin_colour(settings.eumelanin, settings.pheomelanin)))
    return encode_srgb(_with_cuticle(melanin_colour(*NATURAL[settings.pigment])))


def strand_hsv(settings: HairColourSettings, wisp: Ints, wisps: int) -> Floats:
    """Hue, saturation and value of every strand, (n, 3): three independent distributions about the mean colour.

    wisp: which wisp each strand belongs to, (n,), of ``wisps``. A channel is the mean, plus what its distribution draws
    for the strand, plus what it draws for the wisp. Hue goes around the circle from 0 to 1; the others stay there.
    """
    hsv = np.broadcast_to(hsv_of_rgb(mean_colour(settings)), (len(wisp), 3)).copy()
    of_strand, of_wisp = (np.random.default_rng([settings.seed, 10 + k]) for k in range(2))
    for channel, name in enumerate(("hue", "saturation", "value")):
        distribution = getattr(settings, f"{name}_distribution")
        hsv[:, channel] += getattr(settings, f"{name}_spread") * _draw(distribution, of_strand.spawn(1)[0], len(wisp))
        by_wisp = getattr(settings, f"wisp_{name}_spread") * _draw(distribution, of_wisp.spawn(1)[0], wisps)
        hsv[:, channel] += by_wisp[wisp]
    hsv[:, 0] %= 1.0
    hsv[:, 1:] = np.clip(hsv[:, 1:], 0.0, 1.0)
    return hsv


def strand_colours(settings: HairColourSettings, wisp: Ints, wisps: int, points: int) -> Singles:
    """Linear RGB at every point of every strand, (n, points, 3), from root to tip. ``wisp`` and ``wisps`` as above.

    Streaks are whole wisps whose mean is another colour, gray strands have none; both keep their strand's variation of
    value. The tips turn to their own colour.
    """
    hsv = strand_hsv(settings, wisp, wisps)
    shade = hsv[:, 2:] - hsv_of_rgb(mean_colour(settings))[2]
    rgb = rgb_of_hsv(hsv)
    rng = np.random.default_rng([settings.seed, 12])
    streak = (rng.random(wisps) < settings.streaks)[wisp]
    rgb[streak] = np.clip(np.array(settings.streak_colour) + shade[streak], 0.0, 1.0)
    gray = np.random.default_rng([settings.seed, 13]).random(len(wisp)) < settings.gray
    rgb[gray] = np.clip(encode_srgb(_UNPIGMENTED) + shade[gray], 0.0, 1.0)
    root = decode_srgb(rgb).astype(np.float32)
    along = np.linspace(0.0, 1.0, points)
    turn = smoothstep(along, settings.tip_start, max(1.0, settings.tip_start + 1e-6))
    turned = (settings.tip_amount * turn).astype(np.float32)
    colours = np.empty((len(wisp), points, 3), dtype=np.float32)
    colours[:] = root[:, None]
    if settings.tip_amount > 0:
        tip = decode_srgb(np.clip(np.array(settings.tip_colour) + shade, 0.0, 1.0)).astype(np.float32)
        colours += turned[:, None] * (tip - root)[:, None]
    return colours


def _draw(distribution: str, rng: np.random.Generator, count: int) -> Floats:
    """Numbers of mean zero, (count,): with standard deviation 1, or even from -1 to 1."""
    return rng.standard_normal(count) if distribution == "gaussian" else rng.uniform(-1.0, 1.0, count)


def _with_cuticle(reflectance: Floats) -> Floats:
    """The colour with the part of light that returns before it meets pigment: no hair is black as a hole."""
    return 0.004 + (1 - 0.004) * np.minimum(reflectance, _UNPIGMENTED)


def decode_srgb(values: Floats) -> Floats:
    """sRGB as linear light, any shape."""
    return np.where(values <= 0.04045, values / 12.92, ((np.maximum(values, 0.04045) + 0.055) / 1.055) ** 2.4)


def encode_srgb(values: Floats) -> Floats:
    """Linear light as sRGB, any shape."""
    return np.where(values <= 0.0031308, 12.92 * values, 1.055 * np.maximum(values, 0.0031308) ** (1 / 2.4) - 0.055)


def hsv_of_rgb(rgb: Floats) -> Floats:
    """Hue, saturation and value, each 0 to 1, of one colour, (3,)."""
    red, green, blue = rgb
    value, span = float(rgb.max()), float(np.ptp(rgb))
    if span == 0:
        return np.array([0.0, 0.0, value])
    sector = ((green - blue) / span, 2 + (blue - red) / span, 4 + (red - green) / span)[int(rgb.argmax())]
    return np.array([sector / 6 % 1.0, span / value, value])


def rgb_of_hsv(hsv: Floats) -> Floats:
    """Colours, (n, 3), of hue, saturation and value, (n, 3)."""
    hue, saturation, value = hsv.T[:, :, None]
    sector = (6 * hue + np.array([5.0, 3.0, 1.0])) % 6
    return value * (1 - saturation * np.clip(np.minimum(sector, 4 - sector), 0.0, 1.0))
