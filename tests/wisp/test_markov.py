"""Synthesised strands resemble their prototype, the less the warmer (Choe, Ko 2005, figure 7)."""

import numpy as np
import pytest

from headstudio.params import ParameterError
from headstudio.wisp.markov import (
    amplitude,
    nearest_window_error,
    synthesise,
    window_size,
    without_loose_end,
)
from headstudio.wisp.masters import CONTROLS_PER_PITCH
from headstudio.wisp.prototypes import from_curve, prototype_of
from headstudio.wisp.settings import PROTOTYPES, WispSettings

TEMPERATURES = (0.01, 0.03, 0.07, 0.12)


def wave(bow: float) -> tuple:
    """A strand as a user might draw it: about six uneven waves along a bow."""
    t = np.linspace(0, 1, 90)
    size = 0.006 * (1 + 0.2 * np.sin(9 * t))
    points = np.stack([bow * t**2 + size * np.sin(40 * t), -0.25 * t, 0.6 * size * np.cos(39 * t)], axis=1)
    return tuple(map(tuple, points.tolist()))


DRAWN = {"drawn straight down": wave(0.0), "drawn in a bow": wave(0.1)}


def settings_of(name: str) -> WispSettings:
    return WispSettings(prototype_curve=DRAWN[name]) if name in DRAWN else WispSettings(prototype=name)


def chain(name: str, temperature: float, seed: int = 5, strands: int = 150, count: int = 80):
    prototype = prototype_of(settings_of(name))
    spacing = prototype.pitch / CONTROLS_PER_PITCH
    samples = prototype.sampled(spacing)
    window = window_size(samples, 0.5 * CONTROLS_PER_PITCH)
    samples = without_loose_end(samples, window)
    rng = np.random.default_rng(seed)
    starts = rng.integers(window, len(samples), strands)
    return samples, window, synthesise(samples, window, temperature, starts, count, rng)


@pytest.mark.parametrize("name", [*PROTOTYPES[1:], *DRAWN])
def test_the_error_is_small_when_cold_and_grows_with_temperature(name):
    errors = []
    for temperature in TEMPERATURES:
        samples, window, strands = chain(name, temperature)
        errors.append(nearest_window_error(strands, samples, window))
    assert errors[0] < 0.05
    assert np.all(np.diff(errors) > 0)


def test_at_a_temperature_of_zero_the_choice_is_the_nearest():
    samples, window, _ = chain("coil", 0.0)
    start = len(samples) - 3
    strand = synthesise(samples, window, 0.0, np.array([start]), 40, np.random.default_rng(0))[0]
    expected = [samples[start - window + k] for k in range(window)]
    for _ in range(40):
        recent = np.array(expected[-window:])
        errors = [np.linalg.norm(recent - samples[k - window : k]) for k in range(window, len(samples))]
        expected.append(samples[window + int(np.argmin(errors))])
    np.testing.assert_allclose(strand, expected[window:], atol=1e-7)


def test_a_warm_choice_has_the_probabilities_of_eq_4():
    """A prototype of two kinds of windows, at distances 0 and d in one of three coordinates from where the chain is."""
    samples = np.zeros((4, 3))
    samples[[1, 2], 0] = 0.9, 1.0
    starts = np.ones(20_000, dtype=np.int64)
    # After 0 come 0.9 (from the window 0), 1.0 (0.9) and 0 (1.0): the distances are 0, 0.9 and 1.
    next_ = synthesise(samples, 1, 0.5, starts, 1, np.random.default_rng(1))[:, 0, 0]
    weight = np.exp(-np.array([0.0, 0.9, 1.0]) / np.sqrt(3) / 0.5)
    share = [np.mean(np.isclose(next_, value)) for value in (0.9, 1.0, 0.0)]
    np.testing.assert_allclose(share, weight / weight.sum(), atol=0.01)


def test_the_same_temperature_means_the_same_for_every_size():
    small = chain("wavy", 0.07)
    samples, window = 100 * small[0], small[1]
    rng = np.random.default_rng(5)
    starts = rng.integers(window, len(samples), 150)
    large = synthesise(samples, window, 0.07, starts, 80, rng)
    np.testing.assert_allclose(large, 100 * small[2], rtol=1e-4, atol=1e-6)


def test_every_detail_is_one_of_the_prototypes():
    samples, _, strands = chain("zigzag", 0.12)
    gap = np.linalg.norm(strands[:5, :, None] - samples, axis=3).min(axis=2)
    assert gap.max() < 1e-6 * amplitude(samples)


def test_nothing_comes_of_nothing():
    still = np.zeros((10, 3))
    strands = synthesise(still, 3, 0.1, np.array([3, 5]), 7, np.random.default_rng(0))
    np.testing.assert_array_equal(strands, np.zeros((2, 7, 3)))


def test_a_prototype_keeps_its_size_and_pitch_when_it_is_drawn_on_a_bow():
    prototype = from_curve(wave(0.1))
    assert prototype.pitch == pytest.approx(0.04, rel=0.15)
    assert amplitude(prototype.sampled(0.002)) == pytest.approx(0.0072, rel=0.3)


@pytest.mark.parametrize("path", [((0, 0, 0),), ((0, 0, 0), (0, 0, 0)), ((0, 0, 0), (0, 0, float("inf")))])
def test_what_is_no_strand_is_no_prototype(path):
    with pytest.raises(ParameterError, match="prototype strand"):
        from_curve(path)


def test_a_straight_line_is_straight_hair():
    assert from_curve(((0, 0, 0), (0, -0.1, 0), (0, -0.3, 0))) is None
    assert prototype_of(WispSettings(prototype="coil", curl_size=0.0)) is None
