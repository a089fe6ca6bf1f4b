"""How skin reflects and scatters light, and what colour it has: figures against closed forms, shaders against numpy."""

from __future__ import annotations

import dataclasses

import moderngl
import numpy as np
import pytest

from headstudio.head.mesh import Floats
from headstudio.render import lafortune
from headstudio.render.scattering import STEEPEST, VARIANCES, WEIGHTS, lit_around, scattering_table, scattering_taps
from headstudio.render.skin_body import lafortune_uniforms
from headstudio.render.skin_colour import HAEMOGLOBIN, MELANIN, skin_colour
from headstudio.resources import shader
from headstudio.scene.settings import Look
from headstudio.scene.skin_settings import MONK_TONES, SkinSettings

UP = np.array([0.0, 0.0, 1.0])


def directions(count: int, seed: int) -> Floats:
    """Directions away from the skin."""
    found = np.random.default_rng(seed).normal(size=(count, 3))
    found[:, 2] = np.abs(found[:, 2])
    return found / np.linalg.norm(found, axis=1, keepdims=True)


def test_lafortune_at_the_normal_is_the_printed_sum() -> None:
    expected = (
        lafortune.DIFFUSE / np.pi + 0.380123**3.685044 * np.array([1, 0, 0]) + 0.857998**64.208486 * np.array([1, 0, 0])
    )
    found = lafortune.reflection(UP, UP)
    assert found[0] == pytest.approx(expected[0], rel=1e-12)
    # Lobe 1 has negative bases there, which count as nothing.
    assert (lafortune.lobes(UP, UP)[0] == 0).all()


def test_lafortune_is_reciprocal_and_positive() -> None:
    u, v = directions(500, 1), directions(500, 2)
    np.testing.assert_allclose(lafortune.reflection(u, v), lafortune.reflection(v, u), rtol=1e-13)
    assert (lafortune.lobes(u, v) >= 0).all()
    assert (lafortune.reflection(u, v) > lafortune.DIFFUSE / np.pi - 1e-12).all()


@pytest.mark.parametrize("degrees", [0, 30, 60, 75])
def test_measured_skin_sends_back_less_than_it_gets(degrees: float) -> None:
    """Up to 75 degrees; the fit itself gains energy when light grazes, since nothing was measured there."""
    angle = np.radians(degrees)
    sent = lafortune.albedo(np.array([np.sin(angle), 0.0, np.cos(angle)]))
    assert (sent > lafortune.DIFFUSE).all()
    assert (sent < 1).all()


def test_shader_reflects_as_numpy_does(gl: moderngl.Context) -> None:
    u, v = directions(300, 3), directions(300, 4)
    gl.includes["common/lafortune.glsl"] = shader("common/lafortune.glsl").read_text()
    program = gl.program(
        vertex_shader="""#version 330
        #include "common/lafortune.glsl"
        in vec3 u, v;
        out vec3 reflected;
        void main() { reflected = lafortune_lobes(u, v, vec3(0.0, 0.0, 1.0)); }""",
        varyings=["reflected"],
    )
    for name, rows in lafortune_uniforms().items():
        program[name].value = rows  # type: ignore[union-attr]
    asked = gl.buffer(np.concatenate([u, v], axis=1).astype(np.float32).tobytes())
    answer = gl.buffer(reserve=12 * len(u))
    gl.simple_framebuffer((4, 4)).use()
    gl.vertex_array(program, [(asked, "3f 3f", "u", "v")]).transform(answer, moderngl.POINTS)
    found = np.frombuffer(answer.read(), np.float32).reshape(-1, 3)
    np.testing.assert_allclose(found, lafortune.lobes(u, v).sum(axis=1), rtol=2e-4, atol=1e-5)


def test_flat_skin_is_lit_by_the_cosine_and_bent_skin_keeps_the_light() -> None:
    angle = np.linspace(0, np.pi, 400)
    flat = lit_around(angle, np.zeros(400))
    np.testing.assert_allclose(flat, np.maximum(np.cos(angle), 0)[:, None].repeat(3, axis=1), atol=2e-3)
    bent = lit_around(angle, np.full(400, STEEPEST))
    # Scattering moves light around the bend; it neither makes nor takes any.
    np.testing.assert_allclose(bent.mean(axis=0), flat.mean(axis=0), rtol=3e-3)
    past = bent[angle > 1.75]
    assert (past[:, 0] > past[:, 1]).all()
    assert (past[:, 1] >= past[:, 2] - 1e-6).all()


def test_scattering_agrees_with_the_integral_around_a_cylinder() -> None:
    radius, turn = 0.004, np.linspace(-np.pi, np.pi, 20001)
    arc = radius * turn[:, None]
    profile = np.exp(-(arc**2) / (2 * VARIANCES)) / np.sqrt(2 * np.pi * VARIANCES) @ WEIGHTS
    for angle in (0.3, 1.2, 1.7, 2.2):
        light = np.maximum(np.cos(angle + turn), 0)[:, None] * profile
        expected = light.sum(axis=0) * radius * (turn[1] - turn[0])
        np.testing.assert_allclose(lit_around(np.array(angle), np.array(1 / radius)), expected, atol=2e-3)


def test_weights_of_every_colour_add_up_to_one() -> None:
    np.testing.assert_allclose(WEIGHTS.sum(axis=0), 1.0, atol=1e-9)
    assert scattering_table(16, 4).shape == (4, 16, 3)


@pytest.mark.parametrize("pigments", sorted(MELANIN))
def test_pigments_add_up_in_densities(pigments: str) -> None:
    """Equation 2.6: c = b - m a_m - h a_h, where densities are negative logarithms."""
    look, bare = Look(), SkinSettings(pigments=pigments)
    full = dataclasses.replace(bare, melanin=0.7, haemoglobin=0.4)
    gained = -np.log(skin_colour(full, look)) + np.log(skin_colour(bare, look))
    np.testing.assert_allclose(gained, 0.7 * MELANIN[pigments] + 0.4 * HAEMOGLOBIN, rtol=1e-9)
    assert np.linalg.norm(MELANIN[pigments]) == pytest.approx(1.0, abs=1e-3)


def test_monk_tones_go_from_light_to_dark() -> None:
    colours = np.array([skin_colour(SkinSettings(tone=f"monk {k}"), Look()) for k in range(1, len(MONK_TONES) + 1)])
    brightness = colours @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(brightness[3:]) < 0).all()
    assert brightness[0] > 0.8
    assert brightness[-1] < 0.03


def test_taps_share_out_all_the_light_and_red_goes_the_farthest() -> None:
    distances, shares = scattering_taps()
    np.testing.assert_allclose(shares[0] + 2 * shares[1:].sum(axis=0), 1.0, atol=1e-9)
    assert distances[0] == 0
    assert (np.diff(distances) > 0).all()
    variance = 2 * (distances[:, None] ** 2 * shares).sum(axis=0)
    assert variance[0] == pytest.approx(VARIANCES @ WEIGHTS[:, 0], rel=0.35)
    assert variance[0] > variance[1] > variance[2]
