"""Fine wrinkles of a body part: what is built from settings, over seams, and as skin moves."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

from headstudio.head.load import load_head
from headstudio.head.scalp_settings import GrayImage
from headstudio.wrinkle.body_part import BodyPart, extract
from headstudio.wrinkle.fine_guides import FineGuides, face_guides, limb_guides
from headstudio.wrinkle.fine_settings import DirectionVector, FineSettings
from headstudio.wrinkle.fine_wrinkles import FineWrinkles, direction_vectors, grow_fine_wrinkles
from headstudio.wrinkle.height_field import normal_map
from headstudio.wrinkle.mapping import map_face
from headstudio.wrinkle.pores import dimples
from headstudio.wrinkle.seams import SharedSkin
from headstudio.wrinkle.texels import texel_map
from headstudio.wrinkle.texture_map import TextureMap

from .carved_sheets import crossings, sheet, tube

SETTINGS = FineSettings(texture_size=160, unit=0.3e-3)


def _guides(texture_map: TextureMap, magnitude: float = 0.6, degrees: float = 0.0) -> FineGuides:
    """One axis everywhere."""
    count = len(texture_map.uv)
    axis = [math.cos(math.radians(degrees)), math.sin(math.radians(degrees))]
    return FineGuides(np.array([0]), np.array([axis]), np.array([magnitude]), np.ones(count), np.zeros(count))


@pytest.fixture(scope="module")
def wrinkles() -> FineWrinkles:
    texture_map = sheet()
    return grow_fine_wrinkles(texture_map, SETTINGS, _guides(texture_map))


def test_two_fields_cross_at_the_angle_that_is_set(wrinkles: FineWrinkles) -> None:
    first, second = (field.directions for field in wrinkles.fields)
    np.testing.assert_allclose(np.arccos((first * second).sum(axis=1)), SETTINGS.crossing, atol=1e-6)
    assert wrinkles.heights.shape == (2, 160, 160)
    assert wrinkles.heights.dtype == np.float32
    assert np.corrcoef(wrinkles.heights.reshape(2, -1))[0, 1] < 0.2


def test_heights_are_metres_below_the_skin(wrinkles: FineWrinkles) -> None:
    assert -1e-8 < wrinkles.heights.max() <= 0
    deepest = SETTINGS.depth * 0.6**2
    assert -deepest <= wrinkles.heights.min() < -0.7 * deepest


def test_furrows_follow_the_compression_across_them(wrinkles: FineWrinkles) -> None:
    rest = wrinkles.texels.map.mesh.vertices
    np.testing.assert_allclose(wrinkles.growth.amplitudes(rest), 0.5)
    # The fields lie 37 degrees to both sides of u. Skin that shrinks in v shrinks both alike.
    across = wrinkles.growth.amplitudes(rest * [1, 0.8, 1])
    np.testing.assert_allclose(across[:, 0], across[:, 1], atol=1e-9)
    assert (across > 0.53).all()
    # Skin that shrinks square to the first field deepens the first one, and hardly the other.
    along = wrinkles.fields[0].directions[0]
    square = np.array([-along[1], along[0]])
    squeezed = rest.copy()
    squeezed[:, :2] -= 0.2 * (rest[:, :2] @ square)[:, None] * square
    shrinkage = wrinkles.growth.shrinkage(squeezed)
    np.testing.assert_allclose(shrinkage[:, 0], 0.2, atol=1e-6)
    turned = SETTINGS.crossing
    np.testing.assert_allclose(shrinkage[:, 1], 1 - math.hypot(math.sin(turned), 0.8 * math.cos(turned)), atol=1e-6)
    stretched = wrinkles.growth.amplitudes(2 * rest - squeezed)
    assert (stretched[:, 0] < 0.45).all()


def test_the_same_settings_give_the_same_skin(wrinkles: FineWrinkles) -> None:
    texture_map = sheet()
    again = grow_fine_wrinkles(texture_map, SETTINGS, _guides(texture_map))
    np.testing.assert_array_equal(again.heights, wrinkles.heights)
    other = grow_fine_wrinkles(texture_map, replace(SETTINGS, seed=2), _guides(texture_map))
    assert not np.array_equal(other.heights, wrinkles.heights)


def test_the_artists_vectors_take_the_place_of_the_guides() -> None:
    texture_map = sheet()
    vectors = (DirectionVector(1, 0.1, 0.1, 0.0, 0.4), DirectionVector(1, 0.9, 0.9, 0.4, 0.0))
    settings = replace(SETTINGS, vectors=vectors, strength=1.5)
    first, second = direction_vectors(texture_map, settings, _guides(texture_map))
    plain, _ = direction_vectors(texture_map, SETTINGS, _guides(texture_map))
    np.testing.assert_allclose(first, 1.5 * plain)
    at = [np.linalg.norm(texture_map.uv - place, axis=1).argmin() for place in ([0.1, 0.1], [0.9, 0.9])]
    np.testing.assert_allclose(second[at], [[0.0, 0.6], [0.6, 0.0]])


def test_painted_strength_and_bare_skin_have_no_furrows() -> None:
    texture_map = sheet()
    half = np.ones((2, 2), dtype=np.float32)
    half[:, 0] = 0
    painted = grow_fine_wrinkles(texture_map, replace(SETTINGS, painted_strength=GrayImage(half)), _guides(texture_map))
    assert (painted.heights[:, :, :38] == 0).all()
    assert (painted.heights[:, :, 120:] < 0).any()
    bare = replace(_guides(texture_map), furrowed=(texture_map.uv[:, 1] > 0.5).astype(float))
    palm = grow_fine_wrinkles(texture_map, SETTINGS, bare)
    assert (palm.heights[:, :60] == 0).all()
    assert all((carved.segments.starts[:, 1] > 60).all() for carved in palm.carved)
    assert all(carved.occupied.all() for carved in palm.carved)


def _neighbours() -> tuple[BodyPart, TextureMap, BodyPart, TextureMap]:
    """Two halves of one sheet that share two columns of squares, and lie moved in their maps by 48 of 160 texels."""
    skin = sheet(cells=20)
    middle = skin.uv[skin.mesh.faces, 0].mean(axis=1)
    parts = [extract(skin.mesh, np.flatnonzero(side)) for side in (middle < 0.55, middle > 0.45)]
    maps = []
    for part, shift in zip(parts, (0.0, -0.3)):
        uv = skin.uv[part.vertices] + [shift, 0.0]
        maps.append(TextureMap(part.mesh, uv, uv[part.mesh.faces], skin.metres, wrapped=False))
    return parts[0], maps[0], parts[1], maps[1]


@pytest.fixture(scope="module")
def halves() -> tuple[FineWrinkles, FineWrinkles, SharedSkin]:
    first_part, first_map, second_part, second_map = _neighbours()
    shared = SharedSkin.of_parts(first_part, second_part)
    first = grow_fine_wrinkles(first_map, SETTINGS, _guides(first_map, degrees=20))
    second = grow_fine_wrinkles(second_map, SETTINGS, _guides(second_map, degrees=-30), (first, shared))
    return first, second, shared


def test_neighbours_agree_on_the_shared_strip_to_the_last_texel(
    halves: tuple[FineWrinkles, FineWrinkles, SharedSkin],
) -> None:
    first, second, shared = halves
    strip = shared.strip(second.texels)
    rows, columns = np.nonzero(strip)
    assert len(rows) > 2000
    theirs = first.heights[:, rows, columns + 48]
    assert (theirs < 0).any()
    np.testing.assert_allclose(second.heights[:, rows, columns], theirs, rtol=0, atol=1e-10)


def test_directions_are_copied_and_furrows_go_on_over_the_seam(
    halves: tuple[FineWrinkles, FineWrinkles, SharedSkin],
) -> None:
    first, second, shared = halves
    shared_first = np.unique(first.texels.map.mesh.faces[shared.first])
    shared_second = np.unique(second.texels.map.mesh.faces[shared.second])
    for mine, theirs in zip(second.fields, first.fields):
        np.testing.assert_allclose(mine.vectors[shared_second], theirs.vectors[shared_first], atol=1e-12)
    for carved, origin in zip(second.carved, first.carved):
        assert crossings(carved.segments) == 0
        border = 160 * 0.55 - 48
        over = (carved.segments.starts[:, 0] < border) & (carved.segments.ends[:, 0] > border)
        left = (origin.segments.ends[:, 0] > 160 * 0.55) & (origin.segments.reach == 1)
        assert over.sum() >= 0.8 * left.sum() > 5
        inside = carved.segments.starts[:, 0] > border + 1
        assert carved.segments[inside].furrows.size > 100


def test_parts_without_common_skin_have_no_seam() -> None:
    skin = sheet()
    with pytest.raises(ValueError, match="share no skin"):
        SharedSkin.of_parts(extract(skin.mesh, np.arange(10)), extract(skin.mesh, np.arange(20, 30)))


def test_a_tube_has_furrows_around_it_but_none_on_its_bare_side() -> None:
    texture_map = tube()
    guides = limb_guides(texture_map, np.array([0.0, 1.0, 0.0]), bare=np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(np.abs(guides.axes), np.tile([1.0, 0.0], (len(guides.axes), 1)), atol=0.02)
    limb = grow_fine_wrinkles(texture_map, SETTINGS, guides)
    front, back = np.abs(limb.heights[:, 30:-30, :5]).max(), np.abs(limb.heights[:, 30:-30, 70:90]).max()
    assert front == 0
    assert back > 0.2 * SETTINGS.depth * 0.55**2


def test_furrows_are_of_one_size_on_the_skin_however_it_is_mapped() -> None:
    squeezed = sheet(cells=16, metres=0.1)
    uv = squeezed.uv.copy()
    uv[:, 0] = uv[:, 0] ** 2
    mesh = squeezed.mesh.moved(np.column_stack([squeezed.uv * 0.1, np.zeros(len(uv))]))
    texture_map = TextureMap(mesh, uv, uv[mesh.faces], 0.1, wrapped=False)
    carved = grow_fine_wrinkles(
        texture_map, replace(SETTINGS, unit=1e-3, texture_size=256), _guides(texture_map)
    ).carved[0]
    units = carved.segments.units
    x = carved.segments.starts[:, 0] / 256
    right, left = units[(x > 0.7) & (x < 0.9)], units[(x > 0.1) & (x < 0.2)]
    # du / dx is 2 sqrt(u), and the unit follows its square root: the other axis is as it was.
    assert right.mean() / left.mean() == pytest.approx((0.8 / 0.15) ** 0.25, rel=0.05)
    assert units.min() >= 1.0


def test_pores_keep_apart_and_stay_where_they_belong() -> None:
    texels = texel_map(sheet(), 256)
    density = (texels.map.uv[:, 0] > 0.5).astype(float)
    height = dimples(texels, density, diameter=np.full(len(density), 4.0), depth=5e-5, rng=np.random.default_rng(1))
    assert height.dtype == np.float32
    assert -5e-5 <= height.min() < -2e-5
    assert (height[:, :100] == 0).all()
    assert (height[:, 180:] < 0).mean() > 0.03
    inner = height[1:-1, 1:-1]
    around = np.stack([height[1 + i : 255 + i, 1 + j : 255 + j] for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j])
    bottoms = np.argwhere((inner < around.min(axis=0)) & (inner < -1e-5))
    nearest = cKDTree(bottoms).query(bottoms, k=2)[0][:, 1]
    assert len(bottoms) > 100
    assert nearest.min() > 2.6 * 4 - 2
    none = dimples(texels, 0 * density, diameter=np.full(len(density), 4.0), depth=1.0, rng=np.random.default_rng(1))
    assert not none.any()


def test_a_slope_has_the_normal_of_a_slope() -> None:
    columns, rows = np.meshgrid(np.arange(8), np.arange(6))
    normals = normal_map((0.5e-3 * columns - 0.25e-3 * rows).astype(np.float32), 1e-3, wrapped=False)
    np.testing.assert_allclose(normals[2, 3], np.array([-0.5, 0.25, 1]) / math.sqrt(1 + 0.25 + 0.0625), rtol=1e-5)
    wave = np.tile(np.sin(2 * np.pi * np.arange(32) / 32), (4, 1)).astype(np.float32)
    around = normal_map(wave, 1.0, wrapped=True)
    np.testing.assert_allclose(around[:, 0], around[:, 16] * [-1, 1, 1], atol=1e-6)
    assert abs(around[0, 0, 0]) > 0.15


@pytest.fixture(scope="module")
def face() -> tuple[TextureMap, FineGuides]:
    head = load_head("mannequin")
    _, texture_map = map_face(head)
    return texture_map, face_guides(texture_map, head.landmarks)


def test_a_face_is_covered_by_two_fields_from_its_landmarks(face: tuple[TextureMap, FineGuides]) -> None:
    texture_map, guides = face
    first, second = direction_vectors(texture_map, FineSettings(), guides)
    magnitude = np.linalg.norm(first, axis=1)
    used = np.unique(texture_map.mesh.faces)
    assert np.quantile(magnitude[used], 0.02) > 0.12
    assert magnitude[used].max() <= 0.8
    angle = np.degrees(np.arccos((first * second).sum(axis=1) / magnitude / np.linalg.norm(second, axis=1)))
    assert np.median(angle[used]) == pytest.approx(74, abs=12)
    assert guides.pores.max() > 0.9
    assert (guides.pores[used] == 0).mean() > 0.3


def test_the_guides_of_a_face_are_symmetric(face: tuple[TextureMap, FineGuides]) -> None:
    texture_map, guides = face
    places = texture_map.mesh.vertices[guides.vertices]
    mirrored = cKDTree(places).query(places * [-1, 1, 1])[1]
    np.testing.assert_allclose(guides.magnitudes[mirrored], guides.magnitudes)
    np.testing.assert_allclose(guides.axes[mirrored] * [1, -1], guides.axes, atol=0.25)
