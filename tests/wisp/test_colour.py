"""Colours against their distributions, and melanin."""

import colorsys

import numpy as np
import pytest
from scipy import stats

from headstudio.wisp.colour import (
    decode_srgb,
    encode_srgb,
    hsv_of_rgb,
    mean_colour,
    rgb_of_hsv,
    strand_colours,
    strand_hsv,
)
from headstudio.wisp.melanin import NATURAL, melanin_colour
from headstudio.wisp.settings import PIGMENTS, HairColourSettings

COUNT = 20_000
WISPS = 400
WISP = np.random.default_rng(1).integers(0, WISPS, COUNT)
CHANNELS = ("hue", "saturation", "value")
# A mean in the middle of the cone, so that nothing is clipped.
PLAIN = {f"{level}{channel}_spread": 0.0 for level in ("", "wisp_") for channel in CHANNELS}


def settings(**values) -> HairColourSettings:
    return HairColourSettings(**{"pigment": "dyed", "dye": (0.5, 0.4, 0.25), **PLAIN, **values})


@pytest.mark.parametrize("channel", range(3))
@pytest.mark.parametrize(("distribution", "law"), [("uniform", stats.uniform(-1, 2)), ("gaussian", stats.norm())])
@pytest.mark.parametrize("level", ["", "wisp_"])
def test_every_channel_follows_its_distribution(channel, distribution, law, level):
    name = CHANNELS[channel]
    spread = 0.03
    chosen = settings(**{f"{name}_distribution": distribution, f"{level}{name}_spread": spread})
    hsv = strand_hsv(chosen, WISP, WISPS)
    mean = hsv_of_rgb(mean_colour(chosen))
    away = (hsv - mean) / spread
    away[:, 0] = ((hsv[:, 0] - mean[0] + 0.5) % 1 - 0.5) / spread
    sampled = away[:, channel] if level == "" else away[np.unique(WISP, return_index=True)[1], channel]
    assert stats.kstest(sampled, law.cdf).pvalue > 0.01
    others = [k for k in range(3) if k != channel]
    np.testing.assert_allclose(away[:, others], 0, atol=1e-9)


def test_channels_strands_and_wisps_vary_independently():
    spreads = dict.fromkeys(PLAIN, 0.02)
    hsv = strand_hsv(settings(**spreads), WISP, WISPS)
    assert np.abs(np.corrcoef(hsv.T) - np.eye(3)).max() < 0.1
    of_wisp = np.array([hsv[np.equal(WISP, k), 2].mean() for k in range(WISPS)])
    assert of_wisp.std() == pytest.approx(0.02, rel=0.15)
    assert (hsv[:, 2] - of_wisp[WISP]).std() == pytest.approx(0.02, rel=0.05)


def test_without_spread_all_strands_have_the_dye():
    colours = strand_colours(settings(), WISP[:50], WISPS, 4)
    np.testing.assert_allclose(
        colours, np.broadcast_to(decode_srgb(np.array([0.5, 0.4, 0.25])), colours.shape), rtol=1e-5
    )


def test_spreads_out_of_range_stay_colours():
    wild = settings(**dict.fromkeys(PLAIN, 0.5), tip_amount=1.0, streaks=0.5, gray=0.5)
    colours = strand_colours(wild, WISP, WISPS, 4)
    assert 0 <= colours.min() <= colours.max() <= 1


def test_fewer_strands_have_the_same_colours():
    chosen = HairColourSettings(gray=0.3, streaks=0.2)
    np.testing.assert_array_equal(
        strand_colours(chosen, WISP[:500], WISPS, 3), strand_colours(chosen, WISP, WISPS, 3)[:500]
    )


def test_tips_turn_to_their_colour_and_roots_do_not():
    chosen = settings(tip_amount=1.0, tip_start=0.5, tip_colour=(1.0, 0.0, 0.0))
    colours = strand_colours(chosen, WISP[:10], WISPS, 9)
    np.testing.assert_allclose(colours[:, -1], np.tile([1.0, 0.0, 0.0], (10, 1)), atol=1e-6)
    np.testing.assert_allclose(colours[:, :5], np.broadcast_to(colours[:, :1], (10, 5, 3)))


def test_streaks_are_whole_wisps_and_gray_strands_are_a_share_of_all():
    streaked = strand_colours(settings(streaks=0.3, streak_colour=(0.0, 0.0, 1.0)), WISP, WISPS, 2)[:, 0]
    blue = streaked[:, 2] > 0.9
    by_wisp = np.array([blue[np.equal(WISP, k)].mean() for k in range(WISPS)])
    assert set(np.unique(by_wisp)) == {0.0, 1.0}
    assert by_wisp.mean() == pytest.approx(0.3, abs=0.07)
    gray = strand_colours(settings(gray=0.4), WISP, WISPS, 2)[:, 0]
    assert (np.ptp(gray, axis=1) < 0.05).mean() == pytest.approx(0.4, abs=0.02)


def test_hsv_goes_there_and_back_as_the_standard_library_says():
    rgb = np.random.default_rng(2).random((100, 3))
    hsv = np.array([hsv_of_rgb(colour) for colour in rgb])
    np.testing.assert_allclose(hsv, [colorsys.rgb_to_hsv(*colour) for colour in rgb], atol=1e-12)
    np.testing.assert_allclose(rgb_of_hsv(hsv), rgb, atol=1e-12)
    np.testing.assert_allclose(hsv_of_rgb(np.array([0.4, 0.4, 0.4])), [0, 0, 0.4])
    np.testing.assert_allclose(decode_srgb(encode_srgb(rgb)), rgb, atol=1e-12)


def test_more_pigment_is_darker_and_pheomelanin_is_redder():
    shades = np.array([melanin_colour(c, 0.0) for c in (0.0, 0.1, 0.5, 1.0, 3.0)])
    assert np.all(np.diff(shades.sum(axis=1)) < 0)
    np.testing.assert_allclose(shades[0], 1.0)
    brown, red = melanin_colour(0.3, 0.0), melanin_colour(0.0, 0.3 * 0.419 / 0.187)
    assert brown[0] == pytest.approx(red[0])
    assert red[2] / red[0] < brown[2] / brown[0]


def test_natural_colours_go_from_black_to_white():
    light = {name: mean_colour(HairColourSettings(pigment=name)).sum() for name in PIGMENTS if name in NATURAL}
    order = ("black", "dark brown", "brown", "light brown", "dark blonde", "blonde", "platinum", "white")
    assert np.all(np.diff([light[name] for name in order]) > 0)
    assert set(NATURAL) | {"melanin", "dyed"} == set(PIGMENTS)
