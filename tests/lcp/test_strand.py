"""The strand of a particle: slack within its length, and a spring beyond it that long steps follow."""

import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from headstudio.lcp.contact import Touching
from headstudio.lcp.implicit import ImplicitSolver
from headstudio.lcp.settings import DynamicsSettings
from headstudio.lcp.strand import Strands
from headstudio.scene.motion import YAW, about_axis, swing

from .dome import hanging_chain, no_body
from .test_solvers import shaken

LENGTHS = np.array([-0.002, 0.05, 0.1])
UP = np.array([0.0, 1.0, 0.0])


STILL = np.zeros((3, 3))


def over_floor(positions, distance=np.inf):
    """All three particles so high over a floor; without, in the air."""
    return Touching(positions, np.full(3, distance), np.tile(UP, (3, 1)), STILL, np.full(3, 0.006))


@pytest.fixture(scope="module")
def chain():
    return hanging_chain(3, arc_length=LENGTHS)


def reaching(chain, *shares):
    """Particles that many times their length away from the root, each its own way."""
    ways = np.array([[0.0, -1.0, 0.0], [0.6, 0.0, -0.8]])
    return chain.root_points + np.vstack([np.zeros(3), np.outer(LENGTHS[1:], [1]) * np.array(shares)[:, None] * ways])


def test_slack_strands_do_not_pull(chain):
    assert len(Strands(chain).taut(STILL, over_floor(reaching(chain, 0.999, 0.5))).which) == 0


def test_a_taut_strand_pulls_home_with_three_times_its_weight_for_a_hundredth(chain):
    hold = Strands(chain).taut(STILL, over_floor(reaching(chain, 1.01, 1.02)))
    np.testing.assert_array_equal(hold.which, [1, 2])
    pull = np.array([[0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]]) * np.array([[30.0], [60.0]]) * chain.mass[1:, None]
    np.testing.assert_allclose(hold.forces(), pull, rtol=1e-9)


def test_its_stiffness_is_the_slope_of_its_pull(chain):
    strands, dx = Strands(chain), 1e-7
    hold = strands.taut(STILL, over_floor(reaching(chain, 1.01, 1.02)))
    for i, along in zip(hold.which, hold.direction, strict=True):
        across = np.cross(along, [0.3, 0.5, 0.7])
        across /= np.linalg.norm(across)
        for way, slope in ((along, hold.stiffness_along), (across, hold.stiffness_across)):
            moved = reaching(chain, 1.01, 1.02)
            moved[i] += dx * way
            change = (strands.taut(STILL, over_floor(moved)).forces() - hold.forces())[i - 1] / dx
            np.testing.assert_allclose(change, -slope[i - 1] * way, atol=1e-4 * hold.stiffness_along[i - 1])


def test_hair_on_the_body_is_drawn_along_it(chain):
    """The root lies below and beside, the floor between them."""
    away = chain.root_points + np.array([[0.0, 0.0, 0.0], [0.0, 0.01, 0.06], [0.03, 0.01, 0.0]])
    on_floor, above = (Strands(chain).taut(STILL, over_floor(away, height)) for height in (0.0, 0.01))
    np.testing.assert_array_equal(on_floor.which, [1])
    np.testing.assert_allclose(on_floor.forces(), [[0.0, 0.0, -np.linalg.norm(above.forces())]])
    assert above.forces()[0, 1] < 0


def test_root_particles_have_no_strand(chain):
    far = chain.root_points + 1.0
    assert 0 not in Strands(chain).taut(STILL, over_floor(far)).which


@pytest.mark.parametrize("bending_scale", [0.1, 1.0])
def test_hair_that_is_shaken_taut_is_followed_in_second_order(hair, bending_scale):
    """Twice as many parts leave a quarter of the error. A hard stop at the end of the reach left half of it."""
    tuning = DynamicsSettings(bending_scale=bending_scale, interactions=False, stiffness=0.0)
    motion = about_axis(YAW, swing(math.radians(40), 2.0))

    def path(parts):
        solver = partial(ImplicitSolver, parts=parts, tolerance=1e-6)
        return np.array([state.positions for state in shaken(hair, no_body(), tuning, 0.6, motion, solver)])

    exact = path(16)
    coarse, fine = (np.linalg.norm(path(parts) - exact) for parts in (2, 4))
    reach = np.linalg.norm(exact - hair.root_points, axis=2)[:, ~hair.fixed] / hair.arc_length[~hair.fixed]
    assert np.mean(reach > 1.0) > 0.05
    assert coarse / fine > 3.0
    assert coarse < 0.03 * np.linalg.norm(exact - exact.mean(axis=0))


def test_longer_strands_swing_more_slowly():
    square = Strands(replace(hanging_chain(3, arc_length=LENGTHS))).square_frequency
    assert square[0] == 0
    assert square[1] == pytest.approx(2 * square[2])
