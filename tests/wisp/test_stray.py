"""No two locks go quite alike."""

import numpy as np

from headstudio.wisp.stray import Stray

from .dressed import body

WAY = np.linspace(0.0, 0.5, 200)


def strays(seed: int = 1, count: int = 2000):
    """How wisps on random roots stray along hair, (W, ways, 3), and their roots."""
    _, scalp, _ = body()
    roots = scalp.points(scalp.random_points(count, np.random.default_rng(7)))
    stray, all_ = Stray.over(roots, seed), np.arange(count)
    return np.stack([stray.at(all_, np.full(count, way)).T for way in WAY], axis=1), roots


def test_no_hair_strays_at_its_root_and_farther_out_by_a_mean_square_of_1():
    strayed, _ = strays()
    assert np.abs(strayed[:, 0]).max() == 0.0
    assert 0.9 < np.mean(np.sum(strayed[:, WAY > 0.1] ** 2, axis=2)) < 1.1


def test_neighbours_stray_together_and_the_two_sides_of_the_head_do_not():
    strayed, roots = strays()
    far = strayed[:, WAY > 0.1]
    apart = np.linalg.norm(roots[:400, None] - roots[None, 400:], axis=2)
    alike = np.einsum("awk,bwk->ab", far[:400], far[400:]) / far.shape[1]
    assert alike[apart < 0.001].mean() > 0.8
    assert abs(alike[apart > 0.1].mean()) < 0.1


def test_it_goes_with_the_seed():
    np.testing.assert_array_equal(strays(1, 20)[0], strays(1, 20)[0])
    assert np.abs(strays(1, 20)[0] - strays(2, 20)[0]).max() > 0.5
