"""Details of master strands: which way curls turn, and where they begin."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from headstudio.wisp.masters import synthesise_details
from headstudio.wisp.settings import WispSettings

from .dressed import body, hair


def curls(**settings):
    """Outlines, and details of curls on them, (W, n, 3)."""
    outlines = hair(body()[1], 300)
    offsets = synthesise_details(outlines, WispSettings(prototype="loose curl", temperature=0.0, **settings)).offsets
    return outlines, offsets


def turns(offsets):
    """Which way each curl turns about its outline, -1 or 1, (W,)."""
    x, y = offsets[..., 0], offsets[..., 1]
    return np.sign((x[:, :-1] * y[:, 1:] - x[:, 1:] * y[:, :-1]).sum(axis=1))


def test_curls_turn_either_way_and_mostly_as_their_neighbours():
    outlines, offsets = curls()
    way = turns(offsets)
    assert 0.3 < (way > 0).mean() < 0.7
    neighbour = cKDTree(outlines.roots).query(outlines.roots, k=2)[1][:, 1]
    assert (way == way[neighbour]).mean() > 0.7


def test_aligned_curls_all_turn_one_way():
    assert len(np.unique(turns(curls(alignment=1.0)[1]))) == 1


def test_curls_begin_sooner_and_later():
    _, offsets = curls(straight_roots=0.06, alignment=1.0)
    size = np.linalg.norm(offsets, axis=2)
    grown = (size > 0.5 * size.max(axis=1, keepdims=True)).argmax(axis=1)
    assert grown.max() > 1.8 * grown.min()


@pytest.mark.parametrize("straight", [0.0, 0.05])
def test_no_curl_stands_off_its_root(straight):
    _, offsets = curls(straight_roots=straight)
    np.testing.assert_allclose(offsets[:, 0], 0.0, atol=1e-9)


def test_curls_of_one_lock_are_larger_than_those_of_another_all_along_it():
    _, alike = curls(straight_roots=0.0)
    _, various = curls(straight_roots=0.0, curl_variety=0.4)
    half = alike.shape[1] // 2

    def spread(offsets):
        """How far sizes differ from lock to lock, and how nearly the halves of a lock agree."""
        halves = offsets[:, 1:half], offsets[:, half:]
        sizes = [np.log(np.linalg.norm(part[..., :2], axis=2).max(axis=1)) for part in halves]
        return np.std(sizes[1]), np.corrcoef(*sizes)[0, 1]

    assert spread(various)[0] > spread(alike)[0] + 0.2
    assert spread(various)[1] > 0.9
