"""Furrows with a cross section of their own, and a depth that swells along them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import BSpline

from headstudio.wrinkle.creases import Creases
from headstudio.wrinkle.cross_profile import SPACING, section_height, section_reach, section_shares, section_slope
from headstudio.wrinkle.furrow import decode_furrows, encode_furrows
from headstudio.wrinkle.furrow_bed import prepare_bed
from headstudio.wrinkle.furrow_editing import mirrored
from headstudio.wrinkle.shape import bounded_shape
from headstudio.wrinkle.skin_layout import SkinLayout
from headstudio.wrinkle.swell import swell_shares, swelling

from .skins import flat_map, line_between, sheet

SECTION = (0.1, 0.3, -0.5, -1.2, -0.7, 0.2, 0.4)
ACROSS = np.linspace(-0.03, 0.03, 60001)


def test_without_heights_a_section_is_the_shape_of_the_thesis():
    assert np.array_equal(section_height(ACROSS, 2e-3, 1e-3, ()), bounded_shape(np.abs(ACROSS), 2e-3, 1e-3))
    assert section_reach(()) == 8.0


def test_a_section_is_the_b_spline_of_its_control_heights():
    width, count = 1.5e-3, len(SECTION)
    # Three more heights on both sides, of nothing.
    knots = SPACING * width * (np.arange(count + 10) - 0.5 * (count + 9))
    spline = BSpline(knots, np.pad(SECTION, 3), 3, extrapolate=False)
    expected = 2e-3 * np.nan_to_num(spline(ACROSS))
    height = section_height(ACROSS, 2e-3, width, SECTION)
    assert np.allclose(height, expected, atol=1e-12)
    assert np.allclose(section_shares(ACROSS, width, count) @ SECTION, expected / 2e-3, atol=1e-9)
    assert np.abs(ACROSS[height != 0]).max() == pytest.approx(section_reach(SECTION) * width, rel=1e-3)


def test_the_slope_of_a_section_is_that_of_differences():
    slope = section_slope(ACROSS, 2e-3, 1.5e-3, SECTION)
    difference = np.gradient(section_height(ACROSS, 2e-3, 1.5e-3, SECTION), ACROSS)
    assert np.allclose(slope, difference, atol=1e-3)


def test_a_swell_goes_through_its_values_and_is_smooth():
    values = (0.2, 1.0, 0.6, 0.9)
    part = np.linspace(0, 1, 3001)
    swell, change = swelling(part, values)
    assert swell[::1000] == pytest.approx(values)
    assert np.allclose(change[1:-1], np.gradient(swell, part)[1:-1], atol=0.02)
    assert swelling(part, ())[0].max() == 1.0
    assert np.allclose(swell_shares(part, 5)[0].sum(axis=1), 1.0)


def test_the_skin_follows_section_and_swell():
    flat = sheet(cells=40)
    furrow = line_between((0.2, 0.5), (0.8, 0.5), depth=1e-3, width=3e-3, taper=0.1)
    # A valley 1 deep whose floor is two places to the left.
    furrow = replace(furrow, section=(0.0, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0, -1.0, 0.0), swell=(1.0, 0.5, 1.0))
    bed = prepare_bed(SkinLayout.of_map(flat_map(flat)), [furrow])
    height = Creases(bed).displaced(flat.vertices).height
    points = bed.refined.vertices
    middle = np.abs(points[:, 0] - 0.05) < 2e-3
    lowest = points[middle][height[middle].argmin()]
    # The line runs towards +x.
    assert lowest[1] == pytest.approx(0.05 + 2 * SPACING * 3e-3, abs=4e-4)
    assert height[middle].min() == pytest.approx(-0.5e-3, rel=0.05)
    assert height.min() < -0.7e-3


def test_section_and_swell_are_kept_and_mirrored():
    furrow = replace(line_between((0, 0), (0.02, 0.01)), section=SECTION, swell=(0.5, 1.0))
    assert decode_furrows(encode_furrows([furrow])) == (furrow,)
    assert mirrored(furrow).section == SECTION[::-1]


@pytest.mark.parametrize(
    "wrong", ['"section": [[0, 1]]', '"section": [1e9]', '"swell": [1e9]', '"swell": ["a"]', '"section": 3']
)
def test_damaged_sections_are_refused(wrong):
    with pytest.raises(ValueError, match="damaged furrow 1"):
        decode_furrows(f'[{{"controls": [[0, 0], [1, 0], [2, 0], [3, 0]], {wrong}}}]'.encode())
