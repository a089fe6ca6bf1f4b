"""Hair that has come over the scalp lies on what is rooted there."""

from __future__ import annotations

import numpy as np
import pytest

from headstudio.wisp.layers import Layers

from .dressed import body


@pytest.fixture(scope="module")
def scalp():
    return body()[1]


@pytest.fixture(scope="module")
def surroundings():
    return body()[2]


@pytest.fixture(scope="module")
def layers(scalp, surroundings):
    return Layers.over(scalp, surroundings)


def test_a_way_counts_over_the_scalp_and_neither_over_the_forehead_nor_far_off_the_head(layers, scalp, surroundings):
    uv = np.array([(0.5, 0.4), (0.3, 0.5), (0.5, 0.8)])
    roots, normals = scalp.points(uv), scalp.normals(uv)
    assert layers.passed(roots).min() > 0.9
    assert layers.passed(roots + 0.01 * normals).min() > 0.9
    assert layers.passed(roots + 0.06 * normals).max() == 0.0
    face = surroundings.proportions.place(np.array([(0.0, 0.1, 1.05), (0.0, -0.6, 1.1)]))
    assert layers.passed(face).max() == 0.0


def test_hair_lies_the_higher_the_farther_it_has_come_and_on_none_far_down(layers):
    way = np.array([0.0, 0.01, 0.05, 0.15, 0.4])
    heights = layers.heights(way, np.full(5, 0.1))
    assert heights[0] == 0.0
    assert np.all(np.diff(heights[:4]) > 0)
    assert heights[4] == heights[3]
    assert np.all(layers.heights(way, np.full(5, 0.3)) == 0.0)
