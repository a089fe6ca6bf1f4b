"""Texture maps drawn into images."""

from __future__ import annotations

import igl
import numpy as np
import pytest

from headstudio.head.mesh import TriangleMesh
from headstudio.wrinkle.texels import texel_map
from headstudio.wrinkle.texture_map import TextureMap

from .carved_sheets import sheet, tube


def _crooked() -> TextureMap:
    texture_map = sheet(cells=6, low=0.15, high=0.85)
    uv = texture_map.uv + 0.02 * np.random.default_rng(1).standard_normal(texture_map.uv.shape)
    return TextureMap(texture_map.mesh, uv, uv[texture_map.mesh.faces], texture_map.metres, wrapped=False)


def test_every_texel_knows_the_triangle_over_its_centre() -> None:
    texels = texel_map(_crooked(), 90)
    corners = texels.map.corner_uv * 90
    everywhere = np.arange(90 * 90)
    triangle = texels.triangle.ravel()
    weights = _weights(texels.centres(everywhere), corners)
    inside = weights.min(axis=2) > 1e-9
    assert inside.sum(axis=1).max() == 1
    np.testing.assert_array_equal(triangle >= 0, inside.any(axis=1))
    np.testing.assert_array_equal(triangle[inside.any(axis=1)], inside.argmax(axis=1)[inside.any(axis=1)])


def test_a_linear_function_is_spread_exactly() -> None:
    texels = texel_map(_crooked(), 70)
    image = texels.spread(2.0 + texels.map.uv @ [3.0, -5.0])
    rows, columns = np.nonzero(texels.mapped)
    expected = 2.0 + 3.0 * (columns + 0.5) / 70 - 5.0 * (rows + 0.5) / 70
    np.testing.assert_allclose(image[rows, columns], expected, atol=1e-12)
    assert (image[~texels.mapped] == 0).all()


def test_a_wrapped_map_has_no_gap_at_the_seam() -> None:
    texels = texel_map(tube(), 64)
    assert texels.mapped[8:-8].all()
    image = texels.spread(np.cos(2 * np.pi * texels.map.uv[:, 0]))
    expected = np.cos(2 * np.pi * (np.arange(64) + 0.5) / 64)
    np.testing.assert_allclose(image[10:-10], np.tile(expected, (44, 1)), atol=0.03)
    beyond = texels.triangle_at(np.array([[64.5, 30.5], [0.5, 30.5], [-63.5, 30.5], [30.5, -0.5], [30.5, 64.5]]))
    assert beyond[0] == beyond[1] == beyond[2] >= 0
    assert (beyond[3:] == -1).all()


def test_texels_can_be_taken_off_the_mesh() -> None:
    texels = texel_map(sheet(), 32)
    closed = np.zeros((32, 32), dtype=bool)
    closed[:16] = True
    np.testing.assert_array_equal(texels.without(closed).mapped, ~closed)


def test_a_triangle_without_area_is_no_trouble() -> None:
    uv = np.array([[0.1, 0.25], [0.9, 0.25], [0.5, 0.25], [0.5, 0.9]])
    faces = np.array([[0, 2, 1], [0, 1, 3]])
    texture_map = TextureMap(TriangleMesh(np.column_stack([uv, np.zeros(4)]), faces), uv, uv[faces], 1.0, wrapped=False)
    texels = texel_map(texture_map, 40)
    area = igl.doublearea(np.column_stack([uv, np.zeros(4)]), faces)[1] / 2
    assert texels.mapped.sum() / 1600 == pytest.approx(area, rel=0.05)
    assert np.isfinite(texels.spread(np.arange(4.0))).all()


def _weights(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Barycentric coordinates of all points in all triangles, (k, m, 3)."""
    a, b, c = (corners[None, :, k] for k in range(3))
    p = points[:, None]

    def cross(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]

    area = cross(b - a, c - a)
    return np.stack([cross(b - p, c - p), cross(c - p, a - p), cross(a - p, b - p)], axis=2) / area[..., None]
