from __future__ import annotations

import moderngl
import numpy as np
from PIL import Image

from headstudio.render.strand_levels import StrandLevels
from headstudio.render.strand_texture import ENDS, HEIGHT, WIDTH, strand_texture
from headstudio.resources import asset


def test_shipped_texture_is_what_the_code_makes() -> None:
    with Image.open(asset("textures/strands.png")) as image:
        shipped = np.asarray(image)
    assert shipped.shape == (HEIGHT, WIDTH, 3)
    made = strand_texture()
    assert np.abs(shipped.astype(int) - made).max() <= 1


def test_strands_repeat_across_go_on_and_come_to_an_end() -> None:
    opacity = strand_texture()[..., 0].astype(float)
    across = np.abs(np.diff(opacity, axis=1)).mean()
    assert np.abs(opacity[:, 0] - opacity[:, -1]).mean() < 2 * across
    rows = opacity.mean(axis=1)
    on = rows[: int(ENDS * HEIGHT)]
    assert np.ptp(on) < 0.2 * on.mean()
    assert rows[-1] < 0.05 * on.mean()
    # Fine across the hair, smooth along it.
    assert across > 3 * np.abs(np.diff(opacity, axis=0)).mean()


def test_hair_thins_out_strand_by_strand_and_not_as_a_haze() -> None:
    opacity = strand_texture()[..., 0] / 255.0
    thin = opacity[int(0.85 * HEIGHT) : int(0.95 * HEIGHT)]
    # A texel at the edge of a strand is covered in part, one inside it altogether.
    assert 0.05 < thin.mean() < 0.3
    assert np.median(thin[thin > 0.0]) > 0.5


def test_no_level_is_finer_than_the_pixels_it_is_for(gl: moderngl.Context) -> None:
    """What is finer than a pixel would come out as beads on strands that run aslant."""
    levels = StrandLevels(gl)._levels
    assert len(levels) > 6
    for k, level in enumerate(levels):
        opacity = np.frombuffer(level.read(alignment=1), np.uint8).reshape(level.height, level.width, 2)[..., 0] / 255.0
        pixels = WIDTH / 2 ** (k / 2)  # along the whole strip
        waves = np.abs(np.fft.rfft(opacity, axis=1)) ** 2
        assert level.width >= 2 * pixels or k < 2
        assert waves[:, int(0.9 * pixels) :].sum() < 0.01 * waves[:, 1:].sum()
