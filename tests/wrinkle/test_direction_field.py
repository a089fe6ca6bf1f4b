"""Direction vectors between those that are given, and the laws."""

from __future__ import annotations

import igl
import numpy as np
import pytest

from headstudio.head.mesh import TriangleMesh
from headstudio.wrinkle.direction_field import DirectionField, interpolate
from headstudio.wrinkle.laws import LAWS
from headstudio.wrinkle.texels import texel_map
from headstudio.wrinkle.texture_map import TextureMap

from .carved_sheets import sheet


def test_given_vectors_stay_and_the_others_have_least_spring_energy() -> None:
    texture_map = sheet(cells=10)
    rng = np.random.default_rng(3)
    vertices = rng.choice(len(texture_map.uv), 5, replace=False)
    given = rng.standard_normal((5, 2))
    field = interpolate(texture_map, vertices, given)
    np.testing.assert_allclose(field[vertices], given)

    springs = -igl.cotmatrix(texture_map.mesh.vertices, texture_map.mesh.faces)
    energy = np.trace(field.T @ (springs @ field))
    for _ in range(5):
        other = field + 1e-2 * rng.standard_normal(field.shape)
        other[vertices] = given
        assert np.trace(other.T @ (springs @ other)) > energy
    # Nothing lies outside of what is given.
    assert field.max() <= given.max() + 1e-6
    assert field.min() >= given.min() - 1e-6


def test_a_vertex_named_twice_takes_the_mean_and_a_piece_without_any_the_mean_of_all() -> None:
    one = sheet(cells=3)
    count = len(one.uv)
    mesh = TriangleMesh(
        np.concatenate([one.mesh.vertices, one.mesh.vertices + np.array([1.0, 0.0, 0.0])]),
        np.concatenate([one.mesh.faces, one.mesh.faces + count]),
    )
    uv = np.concatenate([0.4 * one.uv, 0.4 * one.uv + 0.5])
    texture_map = TextureMap(mesh, uv, uv[mesh.faces], 1.0, wrapped=False)
    field = interpolate(texture_map, np.array([2, 2]), np.array([[1.0, 0.0], [0.0, 0.5]]))
    np.testing.assert_allclose(field, np.tile([0.5, 0.25], (2 * count, 1)), atol=1e-6)


def test_the_field_between_vertices_is_that_of_the_triangle() -> None:
    texels = texel_map(sheet(cells=4), 64)
    vectors = 0.1 + texels.map.uv @ np.array([[0.5, 0.1], [-0.05, 0.4]])
    points = np.random.default_rng(0).uniform(1, 63, (200, 2))
    sample = DirectionField(texels, vectors, 1 + texels.map.uv[:, 0]).at(points)
    expected = 0.1 + points / 64 @ np.array([[0.5, 0.1], [-0.05, 0.4]])
    length = np.linalg.norm(expected, axis=1)
    # A point in a texel that two triangles share may lie a little outside of its own.
    np.testing.assert_allclose(sample.directions, expected / length[:, None], atol=0.02)
    np.testing.assert_allclose(sample.magnitudes, length, atol=0.01)
    np.testing.assert_allclose(sample.units, 1 + points[:, 0] / 64, atol=0.02)
    assert np.median(np.abs(sample.magnitudes - length)) < 1e-12


def test_magnitudes_end_at_one_and_a_field_of_none_leads_along_u() -> None:
    texels = texel_map(sheet(cells=2), 16)
    points = np.array([[3.0, 4.0], [9.0, 9.0]])
    strong = DirectionField(texels, np.tile([0.0, 3.0], (9, 1))).at(points)
    np.testing.assert_allclose(strong.magnitudes, 1.0)
    np.testing.assert_allclose(strong.directions, [[0, 1], [0, 1]])
    none = DirectionField(texels, np.zeros((9, 2)))
    np.testing.assert_allclose(none.at(points).directions, [[1, 0], [1, 0]])
    np.testing.assert_allclose(none.directions, np.tile([1.0, 0.0], (9, 1)))


@pytest.mark.parametrize(
    ("name", "magnitude", "expected"),
    [
        ("printed", 0.0, (30, 0.5, 4, 0, 0, 1)),
        ("printed", 0.5, (20, 0.3, 5, 0.25, 1, 7)),
        ("printed", 0.52, (19, 0.292, 5.04, 0.2704, 1.04, 7.24)),
        ("printed", 1.0, (10, 0.1, 6, 1, 2, 13)),
        ("longer where strong", 0.0, (10, 0.5, 4, 0, 0, 1)),
        ("longer where strong", 1.0, (30, 0.1, 6, 1, 2, 13)),
    ],
)
def test_the_laws_are_those_of_equation_2_5(name: str, magnitude: float, expected: tuple[float, ...]) -> None:
    law = LAWS[name].at(np.array([magnitude]))
    found = (law.segments, law.wander, law.length, law.depth, law.width, law.spacing)
    np.testing.assert_allclose(np.concatenate(found), expected)
