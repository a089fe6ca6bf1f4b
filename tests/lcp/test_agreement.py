"""The real-time solver beside the reference: the tips of a shaken head of hair, region by region."""

import math
import os
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from headstudio.lcp.grow import grow_hair
from headstudio.lcp.implicit import ImplicitSolver
from headstudio.lcp.leapfrog import LeapfrogSolver
from headstudio.lcp.settings import DynamicsSettings, HairSettings
from headstudio.scene.motion import YAW, about_axis, swing

from .test_solvers import shaken

SECONDS = 2.0 if os.environ.get("HEADSTUDIO_SLOW") else 0.4
VIGOROUS = about_axis(YAW, swing(math.radians(40), 2.0))
FREE = DynamicsSettings()
STIFF = replace(FREE, bending_scale=1.0, hold=3.0)


def tips_of_regions(hair, states):
    """Mean positions of the tips of each sixteenth of the scalp square that has any, (steps, regions, 3)."""
    tips = (np.bincount(hair.links[:, 0], minlength=hair.count) == 0) & ~hair.fixed
    region = np.clip((4 * hair.coordinates[:, :2]).astype(int), 0, 3) @ [1, 4]
    positions = np.array([state.positions for state in states])
    return np.stack([positions[:, tips & (region == r)].mean(axis=1) for r in np.unique(region[tips])], axis=1)


def root_mean_square(way):
    """Over the steps of ways, (steps, regions, 3), region by region."""
    return np.sqrt(np.mean(np.sum(way**2, axis=-1), axis=0))


@pytest.mark.slow
@pytest.mark.parametrize("tuning", [FREE, STIFF], ids=["free", "stiff"])
def test_the_real_time_solver_agrees_with_the_reference(dome, ball, tuning):
    """Tips of each region differ by at most 20 % of their own motion."""
    hair = grow_hair(dome, ball, HairSettings(particles=100, length=0.2))
    exact, quick = (
        tips_of_regions(hair, shaken(hair, ball, tuning, SECONDS, VIGOROUS, solver))
        for solver in (LeapfrogSolver, ImplicitSolver)
    )
    motion = root_mean_square(exact - exact.mean(axis=0))
    assert motion.min() > 0.003
    assert (root_mean_square(quick - exact) / motion).max() < 0.2


def test_hair_of_any_bending_stiffness_moves_the_same_in_long_steps(dome, ball):
    """Ten times the bending stiffness of the beam is too fast for an explicit step: it is part of the solution."""
    hair = grow_hair(dome, ball, HairSettings(particles=500, length=0.2))
    tuning = replace(FREE, stiffness=10.0)
    fine, quick = (
        tips_of_regions(hair, shaken(hair, ball, tuning, 0.4, VIGOROUS, partial(ImplicitSolver, parts=parts)))
        for parts in (24, 2)
    )
    error, motion = root_mean_square(quick - fine), root_mean_square(fine - fine.mean(axis=0))
    assert motion.min() > 0.003
    assert np.linalg.norm(error) < 0.1 * np.linalg.norm(motion)
