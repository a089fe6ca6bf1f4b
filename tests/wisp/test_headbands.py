"""A band presses hair under it, where it is, and nothing else."""

import numpy as np

from headstudio.wisp.accessories import Band
from headstudio.wisp.headbands import Headband

from .dressed import body

BAND = Band(lift=0.008, width=0.016)


def on_top(count):
    """The part of a path of ``count`` points that lies on the top of the head, far from ears."""
    return slice(count // 3, -(count // 3))


def bristles(band, surroundings, height):
    """Straight strands that stand on the skin under the top of the band and far from it, and which are under it."""
    top = on_top(len(band.path))
    away = surroundings.gradient(band.path)
    foot = band.path - band.room[:, None] * away
    feet = np.concatenate([foot[top], foot[top] + [0.0, 0.0, -0.09]])
    aways = np.concatenate([away[top]] * 2)
    along = height * np.linspace(0.1, 1.0, 24)[:, None]
    strands = feet[:, None] + along * aways[:, None]
    return strands.astype(np.float32), np.arange(len(feet)) < len(feet) // 2


def test_hair_under_a_band_is_lower_than_it_and_hair_beside_it_stays():
    surroundings = body()[2]
    band = Headband.of(BAND, surroundings)
    strands, under = bristles(band, surroundings, 0.02)
    pressed = band.pressed(strands.copy(), np.zeros(len(strands), dtype=np.int64))
    heights = surroundings.distance(pressed[under].reshape(-1, 3)).reshape(-1, 24)
    assert (surroundings.distance(strands[under, -1]) > 0.012).all()
    assert (heights < band.room[on_top(len(band.path)), None] + 0.001).all()
    assert heights.min() > 0
    assert np.array_equal(pressed[~under], strands[~under])


def test_hair_well_below_a_band_hardly_moves():
    surroundings = body()[2]
    band = Headband.of(BAND, surroundings)
    strands, under = bristles(band, surroundings, 0.004)
    pressed = band.pressed(strands.copy(), np.zeros(len(strands), dtype=np.int64))
    assert np.linalg.norm(pressed - strands, axis=2)[under].max() < 0.0005
