"""The brush: what a stroke does to a map."""

import dataclasses

import numpy as np
import pytest

from headstudio.app.brush import FALLOFFS, Brush, BrushStroke, Sheet

# A map on a square of 20 cm in the plane z = 0, a texel every 2 mm.
AT = np.arange(-50, 51) * 0.002
PLACES = np.stack([*np.meshgrid(AT, AT), np.zeros((101, 101))], axis=-1)
SHEET = Sheet(PLACES, 0.0)
GRAY = np.full((101, 101), 0.5)
BRUSH = Brush(mirror=False)


def painted(brush, way, action="raise", before=GRAY):
    stroke = BrushStroke(brush, SHEET, before, action)
    for place in way:
        stroke.move(np.array([*place, 0.0]))
    return stroke.result


@pytest.mark.parametrize("falloff", FALLOFFS)
def test_paint_fades_from_the_middle_to_the_rim(falloff):
    result = painted(dataclasses.replace(BRUSH, falloff=falloff), [(0.0, 0.0)]) - GRAY
    from_middle = result[50, 50:]
    assert from_middle[0] == pytest.approx(BRUSH.strength)
    assert (np.diff(from_middle[:10]) <= 1e-12).all()
    assert (from_middle[AT[50:] > BRUSH.radius + 1e-9] == 0).all()


def test_speed_and_frames_change_nothing():
    slow = painted(BRUSH, [(x, 0.0) for x in np.linspace(-0.05, 0.05, 60)])
    fast = painted(BRUSH, [(-0.05, 0.0), (0.05, 0.0)])
    rubbed = painted(BRUSH, [(-0.05, 0.0), (0.05, 0.0), (-0.05, 0.0)])
    np.testing.assert_allclose(fast, slow, atol=1e-9)
    np.testing.assert_allclose(rubbed, slow, atol=1e-9)


def test_the_mirror_paints_the_other_side():
    way = [(0.03, 0.0), (0.05, 0.04)]
    alone = painted(BRUSH, way)
    both = painted(dataclasses.replace(BRUSH, mirror=True), way)
    assert (alone[:, :40] == 0.5).all()
    np.testing.assert_allclose(both, both[:, ::-1], atol=1e-9)
    np.testing.assert_allclose(both[:, 50:], alone[:, 50:], atol=1e-9)


def test_lowering_takes_away_what_raising_gave_and_stays_in_range():
    way = [(0.0, 0.0), (0.04, 0.0)]
    np.testing.assert_allclose(painted(BRUSH, way) - 0.5, 0.5 - painted(BRUSH, way, "lower"), atol=1e-12)
    assert painted(dataclasses.replace(BRUSH, strength=1.0), way, before=np.full((101, 101), 0.9)).max() == 1.0


def test_smoothing_evens_out_below_the_brush_only():
    noise = np.random.default_rng(0).random((101, 101))
    smooth = painted(dataclasses.replace(BRUSH, strength=1.0), [(0.0, 0.0)], "smooth", noise)
    core = np.hypot(*PLACES[..., :2].transpose(2, 0, 1)) < 0.4 * BRUSH.radius
    outside = np.hypot(*PLACES[..., :2].transpose(2, 0, 1)) > BRUSH.radius
    assert smooth[core].std() < 0.3 * noise[core].std()
    assert (smooth[outside] == noise[outside]).all()
