"""Furrows with a cross section of their own, and a depth that swells along them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from headstudio.wrinkle.creases import Creases
from headstudio.wrinkle.cross_profile import section, section_slope, strands_reach
from headstudio.wrinkle.furrow import decode_furrows, encode_furrows
from headstudio.wrinkle.furrow_bed import prepare_bed
from headstudio.wrinkle.furrow_editing import mirrored
from headstudio.wrinkle.shape import bounded_shape
from headstudio.wrinkle.skin_layout import SkinLayout
from headstudio.wrinkle.swell import swell_shares, swelling

from .skins import flat_map, line_between, sheet

STRANDS = ((0.0, 0.6, 1.0), (0.7, 0.5, 0.8), (-2.5, -0.2, 1.2))
ACROSS = np.linspace(-0.03, 0.03, 60001)


def test_without_strands_a_section_is_the_shape_of_the_thesis():
    assert np.array_equal(section(ACROSS, 2e-3, 1e-3, ()), bounded_shape(np.abs(ACROSS), 2e-3, 1e-3))
    assert strands_reach(()) == 8.0


def test_whatever_its_strands_a_section_has_no_volume():
    height = section(ACROSS, 2e-3, 1.5e-3, STRANDS)
    assert abs(np.trapezoid(height, ACROSS)) < 1e-6 * np.trapezoid(np.abs(height), ACROSS)
    assert np.flatnonzero(height)[0] > np.searchsorted(ACROSS, -strands_reach(STRANDS) * 1.5e-3) - 2


def test_the_slope_of_a_section_is_that_of_differences():
    slope = section_slope(ACROSS, 2e-3, 1.5e-3, STRANDS)
    difference = np.gradient(section(ACROSS, 2e-3, 1.5e-3, STRANDS), ACROSS)
    # At the sharp floors differences see both walls.
    assert np.mean(np.abs(slope - difference) < 1e-3) > 0.999


def test_a_swell_goes_through_its_values_and_is_smooth():
    values = (0.2, 1.0, 0.6, 0.9)
    part = np.linspace(0, 1, 3001)
    swell, change = swelling(part, values)
    assert swell[::1000] == pytest.approx(values)
    assert np.allclose(change[1:-1], np.gradient(swell, part)[1:-1], atol=0.02)
    assert swelling(part, ())[0].max() == 1.0
    assert np.allclose(swell_shares(part, 5)[0].sum(axis=1), 1.0)


def test_the_skin_follows_strands_and_swell():
    flat = sheet(cells=40)
    furrow = line_between((0.2, 0.5), (0.8, 0.5), depth=1e-3, width=3e-3, taper=0.1)
    furrow = replace(furrow, strands=((0.5, 1.0, 1.0),), swell=(1.0, 0.5, 1.0))
    bed = prepare_bed(SkinLayout.of_map(flat_map(flat)), [furrow])
    height = Creases(bed).displaced(flat.vertices).height
    points = bed.refined.vertices
    middle = np.abs(points[:, 0] - 0.05) < 2e-3
    lowest = points[middle][height[middle].argmin()]
    # Half a width to the left of a line that runs towards +x.
    assert lowest[1] == pytest.approx(0.05 + 1.5e-3, abs=4e-4)
    assert height[middle].min() == pytest.approx(-0.5e-3, rel=0.05)
    assert height.min() < -0.7e-3


def test_strands_and_swell_are_kept_and_mirrored():
    furrow = replace(line_between((0, 0), (0.02, 0.01)), strands=STRANDS, swell=(0.5, 1.0))
    assert decode_furrows(encode_furrows([furrow])) == (furrow,)
    assert mirrored(furrow).strands == tuple((-offset, depth, width) for offset, depth, width in STRANDS)


@pytest.mark.parametrize(
    "wrong", ['"strands": [[0, 1]]', '"strands": [[0, 1, 0]]', '"swell": [1e9]', '"swell": ["a"]', '"strands": 3']
)
def test_damaged_strands_are_refused(wrong):
    with pytest.raises(ValueError, match="damaged furrow 1"):
        decode_furrows(f'[{{"controls": [[0, 0], [1, 0], [2, 0], [3, 0]], {wrong}}}]'.encode())
