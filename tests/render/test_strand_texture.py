from __future__ import annotations

import numpy as np
from PIL import Image

from headstudio.render.strand_texture import HEIGHT, WIDTH, strand_texture
from headstudio.resources import asset


def test_shipped_texture_is_what_the_code_makes() -> None:
    with Image.open(asset("textures/strands.png")) as image:
        shipped = np.asarray(image)
    assert shipped.shape == (HEIGHT, WIDTH, 3)
    made = strand_texture()
    assert np.abs(shipped.astype(int) - made).max() <= 1


def test_strands_repeat_across_and_end_along() -> None:
    opacity = strand_texture()[..., 0].astype(float)
    across = np.abs(np.diff(opacity, axis=1)).mean()
    assert np.abs(opacity[:, 0] - opacity[:, -1]).mean() < 2 * across
    assert opacity[[0, -1]].mean() < 0.2 * opacity[HEIGHT // 2].mean()
    # Fine across the hair, smooth along it.
    assert across > 3 * np.abs(np.diff(opacity, axis=0)).mean()
