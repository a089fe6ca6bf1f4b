from itertools import combinations, pairwise

import numpy as np
import pytest

from headstudio.wisp.braiding import braid_word, crossings, plait
from headstudio.wisp.hairdressing import queues_of
from headstudio.wisp.operations import Braid
from headstudio.wisp.paths import hang, off_skin, outward, sideways

from .dressed import body, hair, styled, weight

PERIOD = 0.08


def straight(periods: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    path = np.zeros((int(periods * 60) + 1, 3))
    path[:, 1] = -np.linspace(0, periods * PERIOD, len(path))
    return path, np.broadcast_to([1.0, 0, 0], path.shape), np.broadcast_to([0, 0, 1.0], path.shape)


def test_a_plait_of_three_alternates_between_its_two_generators():
    path, side, front = straight(5)
    inner = slice(20, -20)
    locks = plait(path, side, front, 3, 0.015, 0.008, PERIOD)
    word = braid_word(locks[:, inner], path[inner], side[inner], front[inner])
    assert {letter[0] for letter in word} == {0, 1}
    assert all(a[0] != b[0] and a[1] == -b[1] for a, b in pairwise(word))


@pytest.mark.parametrize("periods", [2, 5, 8])
def test_three_locks_cross_six_times_a_period(periods):
    path, side, front = straight(periods)
    locks = plait(path, side, front, 3, 0.015, 0.008, PERIOD)
    # The ends are gathered, where no lock is beside another: up to a crossing at each.
    assert crossings(locks, path, side, front) == pytest.approx(6 * periods, abs=2)


@pytest.mark.parametrize("groups", [4, 5, 6, 7])
def test_more_locks_wind_around_each_other_without_touching(groups):
    path, side, front = straight(4)
    locks = plait(path, side, front, groups, 0.015, 0.008, PERIOD)
    inner = slice(60, -60)
    for a, b in combinations(range(groups), 2):
        assert np.linalg.norm(locks[a, inner] - locks[b, inner], axis=1).min() > 0.0015
        pair = crossings(locks[[a, b]][:, inner], path[inner], side[inner], front[inner])
        whole = braid_word(locks[[a, b]][:, inner], path[inner], side[inner], front[inner])
        assert len(whole) >= 3
        assert pair <= len(whole)
    assert crossings(locks, path, side, front) >= 4 * groups


def test_locks_that_only_sway_make_no_braid():
    path, side, front = straight(4)
    sway = 0.01 * np.sin(2 * np.pi * np.arange(len(path)) / 60)[:, None] * side
    locks = np.stack([path + sway, path - sway + 0.004 * front, path + 0.03 * side])
    assert len(braid_word(locks, path, side, front)) > 4
    assert crossings(locks, path, side, front) <= 1


def test_two_groups_are_no_braid():
    with pytest.raises(ValueError, match="three groups"):
        plait(*straight(1), 2, 0.01, 0.01, PERIOD)


@pytest.mark.parametrize("groups", [3, 5])
def test_the_hair_itself_is_braided(groups):
    """The middles of the groups of wisps, as they lie, cross as often as the paths they were led on."""
    _, scalp, surroundings = body()
    rest = hair(scalp, 150, 0.6)
    braid = Braid(groups=groups, length=0.6)
    laid, report = styled(rest, operations=(braid,))
    assert max(queue.too_short for queue in report.queues) < 0.4 * 150 / groups
    queues = queues_of(braid, surroundings, weight(), 0.6)
    uv = scalp.locate(rest.roots)
    paths = np.stack([queue.constraints[1].trajectory for queue in queues])
    middle = paths.mean(axis=0) if groups % 2 else paths[0]
    inner = middle[8:-8]
    side, front = sideways(surroundings, inner)
    locks = np.stack([mean_curve(laid.joints[queue.wisps(uv)], inner) for queue in queues])
    led = crossings(paths[:, 8:-8], inner, side, front)
    assert led >= 10
    assert crossings(locks, inner, side, front) == pytest.approx(led, abs=2)


def mean_curve(joints: np.ndarray, path: np.ndarray) -> np.ndarray:
    """Where a group of wisps passes each point of ``path``: the mean of its strands where they cross the plane there."""
    tangent = np.gradient(path, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    fine = np.concatenate([(1 - t) * joints[:, :-1] + t * joints[:, 1:] for t in np.linspace(0, 1, 9)[:-1]], axis=1)
    means = []
    for place, direction in zip(path, tangent):
        offset = fine - place
        through = (np.abs(offset @ direction) < 0.002) & (np.linalg.norm(offset, axis=2) < 0.05)
        means.append(fine[through].mean(axis=0))
    return np.array(means)


def test_a_rope_that_hangs_beside_the_neck_comes_to_lie_on_the_body():
    surroundings = body()[2]
    knot = off_skin(surroundings, surroundings.proportions.place(np.array([[0.0, 0.0, -1.05]])), 0.015)
    rope = hang(surroundings, weight(), knot[0], outward(surroundings, knot)[0], 0.3, 0.015)
    distance = surroundings.distance(rope)
    assert distance.min() > 0.013
    assert distance[-20:].max() < 0.03
