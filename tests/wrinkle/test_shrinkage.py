"""Equation 2.3 on sheets whose deformation is known, and figure 2.17 in numbers."""

import numpy as np
import pytest

from headstudio.wrinkle.metric import perpendicular, vertex_metrics
from headstudio.wrinkle.shrinkage import shrinkage_gauge

from .skins import flat_map, sheet

ANGLES = np.radians([0, 11, 30, 45, 62, 77, 90, 120, 155])


def shrinkage_at(angle: float, deformation: np.ndarray, measure="three edges", stretch=(8.0, 8.0), jitter=0.25):
    """s at every vertex of a sheet for furrows along an angle on the skin."""
    flat = sheet(12, jitter=jitter)
    texture_map = flat_map(flat, stretch)
    count = len(flat.vertices)
    along = np.array([np.cos(angle), np.sin(angle)]) * stretch
    across = perpendicular(np.tile(along, (count, 1)), vertex_metrics(texture_map))
    gauge = shrinkage_gauge(texture_map, np.arange(count), across, measure)
    posed = flat.vertices.copy()
    posed[:, :2] = flat.vertices[:, :2] @ deformation.T
    return gauge.shrinkage(posed)


@pytest.mark.parametrize("stretch", [(8.0, 8.0), (8.0, 3.0)])
@pytest.mark.parametrize(
    "deformation", [np.diag([0.7, 1.0]), np.diag([1.4, 1.0]), np.diag([0.8, 1.25]), np.array([[1.0, 0.4], [0.0, 0.9]])]
)
def test_an_evenly_deformed_sheet(deformation, stretch):
    for angle in ANGLES:
        across = np.array([-np.sin(angle), np.cos(angle)])
        wanted = 1 - np.linalg.norm(deformation @ across)
        assert np.abs(shrinkage_at(angle, deformation, stretch=stretch) - wanted).max() < 1e-9


def test_rest_is_zero_and_size_does_not_matter():
    for measure in ("three edges", "two edges"):
        assert np.abs(shrinkage_at(0.3, np.eye(2), measure)).max() < 1e-12
        assert np.allclose(shrinkage_at(0.3, 0.6 * np.eye(2), measure), 0.4)


def test_two_edges_are_the_printed_formula():
    """On a plain grid the triangle ahead of (1, 1) / 2 has the edges (1, 0) and (1, 1); ahead of (0, 1): (0, 1), (1, 1)."""
    squeeze = np.diag([0.5, 1.0])
    grid = shrinkage_at(np.radians(90), squeeze, "two edges", jitter=0.0)  # d_p is (-1, 0) or (1, 0)
    assert np.allclose(grid, 0.5)
    slanted = np.arctan2(-1.0, 0.5)  # d_p along (1, 0.5): half of (1, 0), half of (1, 1)
    diagonal = np.sqrt((0.25 + 1) / 2)
    kept = 1 / (0.5 / 0.5 + 0.5 / diagonal)
    inner = shrinkage_at(slanted, squeeze, "two edges", jitter=0.0).reshape(13, 13)[1:-1, 1:-1]
    assert np.allclose(inner, 1 - kept)


def test_furrows_across_the_motion_deepen_and_furrows_along_it_stay():
    """Figure 2.17: the same patch squeezed from the side, and from above."""
    sideways, down = np.diag([0.75, 1.0]), np.diag([1.0, 0.75])
    upright, level = np.radians(90), 0.0
    assert np.allclose(shrinkage_at(upright, sideways), 0.25)
    assert np.abs(shrinkage_at(level, sideways)).max() < 1e-12
    assert np.allclose(shrinkage_at(level, down), 0.25)
    assert np.abs(shrinkage_at(upright, down)).max() < 1e-12


def test_a_sheet_bent_without_stretch_does_not_shrink_along_its_axis():
    flat = sheet(40)
    texture_map = flat_map(flat)
    radius = 0.05
    angle = flat.vertices[:, 0] / radius
    rolled = np.stack([radius * np.sin(angle), flat.vertices[:, 1], radius * np.cos(angle)], axis=1)
    count = len(flat.vertices)
    for across in ([1.0, 0.0], [0.0, 1.0]):
        gauge = shrinkage_gauge(texture_map, np.arange(count), np.tile(across, (count, 1)))
        assert np.abs(gauge.shrinkage(rolled)).max() < 2e-3


def test_a_part_of_a_skin_is_measured_by_the_skins_positions():
    flat = sheet(6)
    count = len(flat.vertices)
    places = np.random.default_rng(3).permutation(2 * count)[:count]
    gauge = shrinkage_gauge(
        flat_map(flat), np.arange(count), np.tile([1.0, 0.3], (count, 1)), skin_vertices=places, skin_count=2 * count
    )
    posed = np.full((2 * count, 3), np.nan)
    posed[places] = flat.vertices * 0.8
    assert np.allclose(gauge.shrinkage(posed), 0.2)
