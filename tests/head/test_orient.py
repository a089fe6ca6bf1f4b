"""Up, forward and size, from the shape alone."""

from itertools import permutations, product

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.head.orient import find_stance
from headstudio.head.symmetry import mirror_planes, sample_surface
from headstudio.head.units import guess_unit

from .zoo import UP, bare, cube, egg, human, moved, neckless, open_cap, plane, sphere


def axis_rotations():
    """The 24 rotations that map axes onto axes."""
    for order, signs in product(permutations(range(3)), product((1, -1), repeat=3)):
        matrix = np.eye(3)[list(order)] * np.array(signs)[:, None]
        if np.linalg.det(matrix) > 0:
            yield Rotation.from_matrix(matrix)


@pytest.mark.parametrize("number", range(24))
def test_axes_are_found_whatever_they_are(number):
    rotation = list(axis_rotations())[number]
    head = neckless(human()) if number % 2 else bare(human().skin)
    stance = find_stance(moved(head, rotation, scale=1 + number, shift=(3, -7, 11)))
    np.testing.assert_allclose(stance.rotation @ rotation.as_matrix(), np.eye(3), atol=1e-9)
    assert stance.axes is not None
    true_height = (human().landmarks.crown - human().landmarks.chin)[1] * (1 + number)
    assert stance.height == pytest.approx(true_height, rel=0.06)


def test_axes_have_names():
    stance = find_stance(moved(bare(human().skin), Rotation.from_euler("x", 90, degrees=True)))
    assert stance.axes == ("+Z", "-Y")


def test_head_that_stands_askew_is_set_upright():
    rotation = Rotation.from_euler("xyz", [35, -50, 20], degrees=True)
    stance = find_stance(moved(bare(human().skin), rotation))
    turned = stance.rotation @ rotation.as_matrix()
    assert stance.axes is None
    assert np.degrees(Rotation.from_matrix(turned).magnitude()) < 6


def test_head_that_is_bowed_a_little_keeps_its_axes():
    assert find_stance(moved(bare(human().skin), Rotation.from_euler("x", 6, degrees=True))).axes == ("+Y", "+Z")


@pytest.mark.parametrize(("age", "masculine"), [(0, 0), (1, 0), (0, 1), (1, 1)])
def test_all_humans_match_the_standard_silhouette(age, masculine):
    assert find_stance(bare(human(age, masculine).skin)).misfit < 0.025


@pytest.mark.parametrize("shape", [sphere, cube, egg, plane, open_cap])
def test_what_is_no_head_has_no_stance(shape):
    assert find_stance(shape()) is None


def test_mirror_plane_of_an_askew_head():
    rotation = Rotation.from_rotvec([0.4, 1.1, -0.7])
    points = sample_surface(moved(bare(human().skin), rotation, shift=(1, 2, 3)), 4000)
    plane_found = mirror_planes(points, 1)[0]
    assert abs(plane_found.normal @ rotation.apply([1.0, 0, 0])) > np.cos(np.radians(0.5))
    assert plane_found.offset == pytest.approx(plane_found.normal @ [1.0, 2, 3], abs=0.002)
    assert plane_found.error < 0.005


def test_mirroring_twice_changes_nothing():
    plane_found = mirror_planes(sample_surface(egg(), 1000), 1)[0]
    points = np.random.default_rng(0).normal(size=(5, 3))
    np.testing.assert_allclose(plane_found.mirrored(plane_found.mirrored(points)), points, atol=1e-12)
    assert not np.allclose(plane_found.mirrored(points), points)


@pytest.mark.parametrize(
    ("height", "unit", "metres"),
    [
        (212, "millimetres", 0.001),
        (21.2, "centimetres", 0.01),
        (8.4, "inches", 0.0254),
        (2.1, "decimetres", 0.1),
        (0.2, "metres", 1),
    ],
)
def test_units(height, unit, metres):
    found = guess_unit(height)
    assert found.metres == metres
    assert unit in found.note


def test_head_of_no_human_size_is_scaled_and_said_so():
    found = guess_unit(1.0)
    assert found.metres == pytest.approx(0.21)
    assert "unknown" in found.note


def test_samples_lie_on_the_surface_in_proportion_to_area():
    points = sample_surface(cube(), 6000)
    np.testing.assert_allclose(np.abs(points).max(axis=1), 0.5, atol=1e-12)
    top = (points @ UP > 0.5 - 1e-9).mean()
    assert top == pytest.approx(1 / 6, abs=0.02)
