"""Soft light as nine numbers, and what curtains of strands make of it."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest

from headstudio.head.mesh import Floats, TriangleMesh
from headstudio.render.fibre import Fibre, Sent, pile
from headstudio.render.sky import sphere_directions
from headstudio.render.sky_light import Sky, SkyLight, SkyPrograms
from headstudio.render.soft_light import irradiance, terms, weights
from headstudio.render.strand_detail import FINE, StrandSurvey
from headstudio.render.strand_hair import StrandHair, StrandMaterial, StrandPrograms
from headstudio.render.strand_picture import StrandScene, strand_picture
from headstudio.render.view import perspective_view
from headstudio.wisp.strands import Strands

SKY = Sky(np.ones(3), np.ones(3), np.array([0.0, 1.0, 0.0]))
RADIUS, WIDE, THICK = 1e-4, 0.06, 0.02


def pairs(count: int) -> Floats:
    half = sphere_directions(2 * count)[:count]
    return np.stack([half, -half], axis=1).reshape(-1, 3)


def curtain(count: float, seed: int = 1) -> Strands:
    """Upright strands, side by side and one behind the other at random, so many of which a ray along z meets."""
    strands = int(count * WIDE / RADIUS)
    x, z = np.random.default_rng(seed).uniform(-1, 1, (2, strands)) * [[WIDE], [THICK / 2]]
    y = np.linspace(-0.1, 0.1, 7)
    places = np.stack(np.broadcast_arrays(x[:, None], y, z[:, None]), axis=-1)
    return Strands.of_equal_count(places.astype(np.float32), radius=np.full((strands, 7), RADIUS, np.float32))


def far_away() -> TriangleMesh:
    return TriangleMesh(np.array([[9.0, 9.0, 9.0], [9.0, 9.01, 9.0], [9.01, 9.0, 9.0]]), np.array([[0, 1, 2]]))


@pytest.mark.parametrize("count", [6, 16])
def test_light_of_the_second_degree_is_found_again(count: int) -> None:
    directions, wanted = pairs(count), np.random.default_rng(1).normal(size=9)
    np.testing.assert_allclose((terms(directions) @ wanted) @ weights(directions), wanted, atol=1e-9)


@pytest.mark.parametrize("count", [3, 5, 16])
def test_even_light_is_even(count: int) -> None:
    np.testing.assert_allclose(weights(pairs(count)).sum(axis=0), np.eye(9)[0], atol=1e-9)


def test_irradiance_is_the_integral_over_the_half_above() -> None:
    rng = np.random.default_rng(2)
    numbers = np.concatenate([[2.0], rng.normal(scale=0.3, size=8)])
    light = np.zeros((1, 8, 4))
    light[0, :3], light[0, 3:6], light[0, 6, :3] = numbers[:4], numbers[4:8], numbers[8]
    normal = np.array([[0.36, 0.48, 0.8]])
    directions = sphere_directions(20_000)
    falls = np.maximum(directions @ normal[0], 0.0) * (terms(directions) @ numbers)
    np.testing.assert_allclose(irradiance(light, normal)[0], falls.mean() * 4 * np.pi, rtol=2e-3)


def test_in_a_curtain_light_comes_straight_from_both_sides(gl: moderngl.Context) -> None:
    """It has no slope: what comes by the shortest ways is in its bend."""
    programs, strands, body = StrandPrograms(gl), curtain(3.0), far_away()
    hair = StrandHair(gl, programs, StrandSurvey(strands), strands.count, FINE)
    sky_light = SkyLight(gl, SkyPrograms(gl), programs.opacity, body.vertices, body.faces, FINE)
    hair.see_from_sky(sky_light)
    sky_light.see_body(np.zeros((3, 3)))
    sent = Sent(np.full(3, 0.5), np.full(3, 0.1))
    rng = np.random.default_rng(3)
    places = rng.uniform(-1, 1, (400, 3)) * [0.03, 0.04, 0.0]
    light = sky_light.gather(places, SKY, sent).mean(axis=0)
    (rate, _, _), _ = pile(sent)
    directions = pairs(FINE.pairs)
    # A ray aside meets more of them; one along the strands none, but there is none such.
    met = 1.5 * np.linalg.norm(directions[:, [0, 2]], axis=1) / np.maximum(np.abs(directions[:, 2]), 1e-3)
    wanted = np.exp(-rate * met) @ weights(directions)
    red = np.concatenate([light[0], light[3], light[6, :1]])
    straight, aside = terms(np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]))
    assert straight @ red == pytest.approx(straight @ wanted, rel=0.15)
    assert straight @ red > 1.4 * red[0]
    assert aside @ red < 0.6 * red[0]
    assert np.abs(red[1:4]).max() < 0.1 * red[0]


@pytest.mark.parametrize("count", [1.0, 3.0])
def test_white_hair_in_an_even_sky_is_as_bright_as_that(gl: moderngl.Context, count: float) -> None:
    scene = StrandScene(
        strands=curtain(count), meshes=[far_away()], material=StrandMaterial(Fibre(), (0.0, 0.0, 0.0)),
        diffuse=np.zeros(3), sun_direction=np.array([0.0, 1.0, 0.0]), sun=np.zeros(3), sky=np.full(3, 0.5),
    )  # fmt: skip
    picture = strand_picture(
        gl, scene, perspective_view(np.array([0.0, 0.0, 0.6]), np.zeros(3), np.radians(5), 1.0), 32
    )
    assert picture is not None
    assert picture.mean() == pytest.approx(0.5, rel=0.08)
