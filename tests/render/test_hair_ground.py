"""The ground between the roots of hair."""

import numpy as np
import pytest

from headstudio.head.head import Head
from headstudio.lcp.model import HairModel
from headstudio.render.hair_ground import ground_colour, ground_cover, same_ground
from headstudio.render.scene_block import linear
from headstudio.render.skin_paint import scalp_cover
from headstudio.scene.settings import Look
from headstudio.wisp.strands import Strands

SHAFT = 4e-5


def crop(head: Head, per_metre: float, stands_for: float = 1.0) -> Strands:
    """Short strands straight up on every face of the upper half of ``head``, ``per_metre`` to the square metre."""
    rng = np.random.default_rng(2)
    skin = head.skin
    up = skin.vertices[skin.faces][:, :, 1].min(axis=1) > 0.05
    areas = skin.face_areas * up
    count = int(areas.sum() * per_metre / stands_for)
    face = rng.choice(len(areas), count, p=areas / areas.sum())
    weights = rng.dirichlet([1.0, 1.0, 1.0], count)
    roots = np.einsum("ij,ijk->ik", weights, skin.vertices[skin.faces[face]])
    points = roots[:, None] + np.array([0.0, 0.01])[None, :, None] * [0.0, 1.0, 0.0]
    made = Strands.of_equal_count(points.astype(np.float32), np.full((count, 2), SHAFT, np.float32))
    return Strands(made.points, made.first, made.radius, stands_for=stands_for)


def test_particles_cover_the_scalp_as_ever(egg: Head, hair_model: HairModel) -> None:
    np.testing.assert_array_equal(ground_cover(egg, hair_model), scalp_cover(egg, hair_model))
    assert (ground_cover(egg, None) == 0).all()


def test_strands_cover_the_skin_by_how_densely_they_stand(egg: Head) -> None:
    top, bottom = np.argmax(egg.skin.vertices[:, 1]), np.argmin(egg.skin.vertices[:, 1])
    covers = [ground_cover(egg, crop(egg, dense)) for dense in (2e5, 5e5, 1.5e6)]
    assert np.all(np.diff([cover[top] for cover in covers]) > 0)
    for cover in covers:
        assert cover[bottom] == 0
        assert 0 <= cover.min() <= cover.max() < 1


def test_a_thinned_picture_of_hair_covers_as_much(egg: Head) -> None:
    inside = egg.skin.vertices[:, 1] > 0.08
    whole, thinned = ground_cover(egg, crop(egg, 1e6)), ground_cover(egg, crop(egg, 1e6, stands_for=5.0))
    assert thinned[inside].mean() == pytest.approx(whole[inside].mean(), rel=0.1)


def test_the_ground_has_the_colour_of_the_roots(egg: Head) -> None:
    bare, look = crop(egg, 1e5), Look()
    colours = np.tile(np.array([[0.2, 0.1, 0.05], [0.9, 0.9, 0.9]], np.float32), (bare.count, 1))
    coloured = Strands(bare.points, bare.first, bare.radius, colours)
    np.testing.assert_allclose(ground_colour(coloured, look), [0.2, 0.1, 0.05], rtol=1e-5)
    pink = Strands(bare.points, bare.first, bare.radius, 0 * colours + np.array([0.5, 0.02, 0.1], np.float32))
    red, green, blue = ground_colour(pink, look)
    assert red == pytest.approx(0.5)
    assert 0.1 < blue / red < green / red < 0.5
    np.testing.assert_array_equal(ground_colour(bare, look), linear(look.hair_colour))
    assert same_ground(bare, coloured)
    assert not same_ground(bare, None)
