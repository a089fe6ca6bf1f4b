"""Rows of teeth in the place of coarser ones."""

import numpy as np
import pytest

from headstudio.head.mesh import TriangleMesh
from headstudio.head.teeth import TEETH, along_arch, dental_row
from headstudio.render.skin_paint import dental_arch


def coarse_row(upper):
    """A band along half an ellipse, 64 mm wide and 45 mm deep, whose edge lies 4 mm nearer to the other row in front."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 40)
    plan = np.column_stack([0.032 * np.sin(angle), 0.044 + 0.045 * np.cos(angle)])
    ahead = np.cos(angle)
    gum, edge = -0.014 + 0.002 * ahead, -0.022 - 0.004 * ahead
    if not upper:
        gum, edge = -0.06 - gum, -0.06 - edge
    rings = [np.column_stack([plan[:, 0], level, plan[:, 1]]) for level in (gum, edge)]
    k = np.arange(39)
    faces = np.concatenate([np.column_stack([k, k + 1, k + 41]), np.column_stack([k, k + 41, k + 40])])
    return TriangleMesh(np.concatenate(rings), faces)


@pytest.mark.parametrize("upper", [True, False])
def test_a_row_fills_the_place_of_the_coarse_one(upper):
    coarse = coarse_row(upper)
    row = dental_row(coarse, upper)
    np.testing.assert_allclose(row.bounds, coarse.bounds, atol=1.2e-3)
    np.testing.assert_allclose(row.vertices[:, 0].sum(), 0.0, atol=1e-9)
    # The outer gum, where the grid begins, looks out of the arch.
    grid = row.vertices.reshape(-1, 13, 3), row.vertex_normals.reshape(-1, 13, 3)
    out = (grid[0][4:-4, 2] - [0.0, 0.0, 0.044]) * [1.0, 0.0, 1.0]
    assert (np.einsum("ij,ij->i", grid[1][4:-4, 2], out) > 0).all()


@pytest.mark.parametrize("upper", [True, False])
def test_there_are_fourteen_crowns_wider_behind_than_in_front(upper):
    row = dental_row(coarse_row(upper), upper)
    sign = 1.0 if upper else -1.0
    level = sign * row.vertices.reshape(-1, 13, 3)[:, 6, 1]
    gaps = 1 + np.flatnonzero((level[1:-1] > level[:-2]) & (level[1:-1] > level[2:]))
    assert len(gaps) == TEETH - 1
    middles = row.vertices.reshape(-1, 13, 3)[gaps, 6]
    widths = np.linalg.norm(np.diff(middles, axis=0), axis=1)
    assert widths[0] > 1.2 * widths[len(widths) // 2]
    assert 0.004 < widths.min() < widths.max() < 0.013


def test_lines_between_teeth_are_drawn_where_the_teeth_meet():
    row = dental_row(coarse_row(True), True)
    outer = row.vertices.reshape(-1, 13, 3)[1:-1, 0]
    tooth = np.linspace(0, TEETH, len(outer) + 2)[1:-1]
    found = dental_arch(row)[13:-13].reshape(-1, 13)[:, 0]
    np.testing.assert_allclose(found, along_arch(tooth), atol=0.01)
    assert len(outer) == len(found)
