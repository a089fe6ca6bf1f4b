"""Baked maps against what was baked."""

import numpy as np
import pytest

from headstudio.params import assign
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.wrinkle.bake import Bake, occlusion
from headstudio.wrinkle.face_settings import FaceSettings

SIZE = 256


@pytest.fixture(scope="module")
def skin():
    document = assign(Document(), {"head.source": "mannequin", "fine.texture_size": SIZE, "wrinkle.age": 0.8})
    return Builder().skin(document)


@pytest.fixture(scope="module")
def bake(skin):
    return Bake(skin.surface, SIZE)


def test_large_wrinkles_lie_in_the_image_where_they_lie_on_the_skin(skin, bake):
    living = skin.at(FaceSettings(angry=1.0))
    image = bake._spread(living.skin.height)
    surface = skin.surface
    deep = np.flatnonzero(living.skin.height < 0.8 * living.skin.height.min())
    column, row = (surface.uv[deep] * SIZE).astype(int).T
    around = [
        image[np.clip(row + i, 0, SIZE - 1), np.clip(column + j, 0, SIZE - 1)] for i in (-1, 0, 1) for j in (-1, 0, 1)
    ]
    assert (np.min(around, axis=0) < 0.5 * living.skin.height[deep]).mean() > 0.9


def test_an_expression_deepens_what_it_creases(skin, bake):
    rest, angry = (bake.weight(skin.at(face)) for face in (FaceSettings(), FaceSettings(angry=1.0)))
    assert rest.min() >= 0
    assert angry.max() <= 1
    assert angry.max() > rest.max() + 0.1


def test_normals_are_unit_and_point_outward(skin, bake):
    baked = bake.at(skin.at(FaceSettings(smile=1.0)))
    assert np.allclose(np.linalg.norm(baked.normals, axis=2), 1, atol=1e-5)
    assert baked.normals[..., 2].min() > 0
    assert baked.mapped.mean() > 0.4


def test_fine_wrinkles_of_another_size_are_refused(skin):
    with pytest.raises(ValueError, match="256 texels cannot be baked into 128"):
        Bake(skin.surface, 128)


def test_occlusion_of_planes_slopes_grooves_and_ridges():
    texel, ramp = 1e-4, np.tile(np.arange(200.0) * 5e-5, (200, 1))
    assert occlusion(np.zeros((50, 50)), texel, False).min() == pytest.approx(1.0)
    assert occlusion(ramp, texel, False)[90:110, 90:110].min() == pytest.approx(1.0)
    across = np.abs(np.arange(200) - 100) * texel
    groove = np.tile(-1e-3 * np.exp(-((across / 5e-4) ** 2)), (200, 1))
    shaded = occlusion(groove, texel, False)[100]
    assert shaded[100] < 0.8
    assert shaded[10] > 0.98
    assert occlusion(-groove, texel, False)[100, 100] == pytest.approx(1.0)
    assert occlusion(2 * groove, texel, False)[100, 100] < shaded[100]
