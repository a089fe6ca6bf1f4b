"""Toward the border of the scalp hair is finer."""

import numpy as np

from headstudio.wisp.hairline import fineness

from .dressed import body


def roots_and_distances():
    scalp = body()[1]
    roots = scalp.points(scalp.random_points(3000, np.random.default_rng(1)))
    border = np.concatenate(scalp.curves)
    return scalp, roots, np.linalg.norm(roots[:, None] - border, axis=2).min(axis=1)


def test_hair_is_finer_the_nearer_to_the_border():
    scalp, roots, distance = roots_and_distances()
    part = fineness(scalp, roots, 0.02, seed=1)
    assert np.all(part[distance > 0.04] == 1.0)
    means = [part[(distance >= a) & (distance < a + 0.007)].mean() for a in (0.0, 0.007, 0.014, 0.021)]
    assert np.all(np.diff(means) > 0)
    assert means[0] < 0.5
    # No line: side by side some are fine and some are not.
    assert part[np.abs(distance - 0.01) < 0.002].std() > 0.1


def test_a_hairline_of_no_breadth_leaves_all_hair_alike():
    scalp, roots, _ = roots_and_distances()
    assert np.all(fineness(scalp, roots, 0.0, seed=1) == 1.0)
    assert fineness(scalp, roots[:0], 0.01, seed=1).shape == (0,)
