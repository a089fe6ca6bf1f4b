"""The hair texture: a strip of many fine strands, made by code from a seed.

The strip repeats across the hair (u) and does not repeat along it (v: root to tip). Every billboard shows its own
window of it, so that no two billboards carry the same strands. Red is the opacity of the strands, green their tone
(how light a strand is, 0.5 being the colour of the hair).

Written into the tree, and committed, by ``python -m headstudio.render.strand_texture assets/textures/strands.png``.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import gaussian_filter1d

from ..head.mesh import Floats

WIDTH, HEIGHT = 1024, 256
STRIP_WIDTH = 0.113
"""How wide the strip is on the hair [m]: strands are as thick in wide billboards as in narrow ones."""

STRANDS = 720
WISPS = 180
LOCKS = 45
SEED = 7
ENDS = 0.6
"""Strands end in the rows behind this part of the strip (common/strands.glsl)."""

_OVERSAMPLING = 4
_LOOSE = 0.15  # of the strands end where they like, the others where their lock does
_POINT = 0.3  # how thin a lock is at its end, as a part of what it is before


def strand_texture(seed: int = SEED) -> NDArray[np.uint8]:
    """Opacity, tone and nothing, shape (HEIGHT, WIDTH, 3); row 0 is the rootward end.

    Strands gather in wisps of a few, and these in locks, as hair does: each is what is seen from its own distance, when a
    billboard is only a dozen pixels wide or a hundred. A strand is there or not, up to its end. Hair thins out because its
    locks run to a point and end in different places, and not because it becomes a haze: over skin that would be a stain.
    """
    rng = np.random.default_rng(seed)
    wisp_of, lock_of = np.arange(STRANDS) % WISPS, np.arange(STRANDS) % WISPS % LOCKS
    lock_centre = (np.arange(LOCKS) + rng.uniform(-0.3, 0.3, LOCKS)) / LOCKS
    lock_wave = _waves(rng, LOCKS, sigma=60, size=0.35 / LOCKS)
    wisp_wave = _waves(rng, WISPS, sigma=45, size=0.22 / LOCKS)
    strand_wave = _waves(rng, STRANDS, sigma=45, size=0.08 / LOCKS)
    wisp_aside = rng.normal(0, 0.30 / LOCKS, WISPS)[:, None] + wisp_wave
    aside = wisp_aside[wisp_of] + rng.normal(0, 0.08 / LOCKS, STRANDS)[:, None] + strand_wave

    v = (np.arange(HEIGHT) + 0.5) / HEIGHT
    lock_end = rng.uniform(ENDS + 0.12, 1.0, LOCKS)[lock_of]
    loose = rng.uniform(size=STRANDS) < _LOOSE
    end = np.where(loose, rng.uniform(ENDS, 1.0, STRANDS), lock_end - rng.exponential(0.06, STRANDS))[:, None]
    ended = np.clip((v - ENDS) / (lock_end[:, None] - ENDS), 0, 1)
    aside *= np.where(loose[:, None], 1.0, 1.0 - (1.0 - _POINT) * ended**2)
    centres = lock_centre[lock_of, None] + lock_wave[lock_of] + aside

    pointed = np.clip((end - v) / 0.08, 0, 1)
    half_width = rng.lognormal(np.log(1.5 / WIDTH), 0.25, STRANDS)[:, None] * np.sqrt(pointed)

    tones = [rng.normal(0, spread, count) for count, spread in ((LOCKS, 0.13), (WISPS, 0.12), (STRANDS, 0.11))]
    tone = np.clip(0.5 + tones[0][lock_of] + tones[1][wisp_of] + tones[2], 0.08, 0.95)
    opacity = rng.uniform(0.85, 1.0, STRANDS)[:, None] * (pointed > 0)
    # The frontmost strand wins a texel; strands deep in their lock get less light.
    height = 0.5 * (rng.uniform(0, 1, WISPS)[wisp_of] + rng.uniform(0, 1, STRANDS))
    tone = np.minimum(tone * (0.72 + 0.4 * height), 1.0)
    return _rasterised(centres % 1.0, half_width, opacity, tone, height)


def _waves(rng: np.random.Generator, count: int, sigma: float, size: float) -> Floats:
    """Smooth random curves along v with standard deviation ``size``, shape (count, HEIGHT)."""
    noise = gaussian_filter1d(rng.normal(size=(count, 2 * HEIGHT)), sigma, axis=1)[:, HEIGHT // 2 : -HEIGHT // 2]
    return noise * (size / noise.std())


def _rasterised(
    centres: Floats, half_width: Floats, opacity: Floats, tone: Floats, height: Floats
) -> NDArray[np.uint8]:
    """Strands as an image, (HEIGHT, WIDTH, 3).

    centres, half_width [widths of the image] and opacity: (strands, rows). tone, height: (strands,).
    """
    columns = WIDTH * _OVERSAMPLING
    order = np.argsort(height)
    reach = int(np.ceil(half_width.max() * columns)) + 1
    offsets = np.arange(-reach, reach + 1)
    image = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    empty_tone = float(np.average(tone))
    for row in range(HEIGHT):
        middle = np.rint(centres[order, row] * columns).astype(int)
        distance = np.abs(offsets[None, :]) / columns / np.maximum(half_width[order, row], 1e-9)[:, None]
        inside = distance < 1
        texels = (middle[:, None] + offsets[None, :])[inside] % columns
        strand = np.broadcast_to(np.arange(len(order))[:, None], inside.shape)[inside]
        front = np.full(columns, -1)
        np.maximum.at(front, texels, strand)
        covered = front >= 0
        alpha = np.where(covered, opacity[order[front], row], 0.0)
        tones = np.where(covered, tone[order[front]], empty_tone)
        alpha = alpha.reshape(WIDTH, _OVERSAMPLING)
        weight = alpha + 1e-3
        image[row, :, 0] = np.rint(255 * alpha.mean(axis=1))
        image[row, :, 1] = np.rint(255 * (tones.reshape(WIDTH, _OVERSAMPLING) * weight).sum(1) / weight.sum(1))
    return image


def main() -> None:
    """Write the texture to the path given on the command line."""
    Image.fromarray(strand_texture()).save(Path(sys.argv[1]), optimize=True)


if __name__ == "__main__":
    main()
