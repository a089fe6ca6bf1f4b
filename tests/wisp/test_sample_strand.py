"""Lengths of strands, and a strand from elsewhere as the prototype."""

import numpy as np
import pytest

from headstudio.wisp.prototypes import from_curve
from headstudio.wisp.sample_strand import sample_strand
from headstudio.wisp.strands import Strands


def coil(length, points, radius=0.004, pitch=0.02):
    along = np.linspace(0, length, points)
    turn = 2 * np.pi * along / pitch
    return np.stack([radius * np.cos(turn), 1.0 - along, radius * np.sin(turn)], axis=1)


def packed(*strands):
    return Strands(np.concatenate(strands), np.cumsum([0, *map(len, strands)]))


def test_lengths_are_those_of_each_strand_by_itself():
    strands = [coil(0.1, 40), coil(0.2, 2), coil(0.05, 17)]
    expected = [np.linalg.norm(np.diff(points, axis=0), axis=1).sum() for points in strands]
    np.testing.assert_allclose(packed(*strands).lengths, expected, rtol=1e-6)


@pytest.mark.parametrize("unit", [1.0, 100.0, 1000.0])
def test_the_middle_strand_is_taken_in_metres_from_its_root(unit):
    strands = packed(*(unit * coil(length, 30) for length in (0.05, 0.4, 0.2)))
    path = np.array(sample_strand(strands))
    wanted = coil(0.2, 30)
    np.testing.assert_allclose(path, wanted - wanted[0], atol=1e-6)


def test_a_finely_sampled_strand_keeps_its_curl_through_fewer_points():
    path = sample_strand(packed(coil(0.12, 600)))
    assert len(path) == 48
    prototype = from_curve(path)
    assert prototype.pitch == pytest.approx(0.02, rel=0.1)
    reach = np.linalg.norm(prototype.details(np.linspace(0.03, 0.09, 200))[:, :2], axis=1)
    np.testing.assert_allclose(reach, 0.004, rtol=0.12)
