from __future__ import annotations

import moderngl
import numpy as np
import pytest

from headstudio.resources import shader

COUNT, RADIUS = 40_000, 0.05

ASKING = """#version 330
{included}
in vec3 asked;
out float count;
void main() {{ count = {said}; }}
"""
CROSSED = "crossed_unseen(asked.x, asked.y, asked.z)"
GAIN = "unseen_gain(vec3(asked.x), vec3(asked.z), asked.y).r"


def crossed_unseen(context: moderngl.Context, asked: np.ndarray, said: str = CROSSED) -> np.ndarray:
    """What the shader says of count, count within a radius, and azimuth, (n, 3): (n,)."""
    included = shader("common/hot_spot.glsl").read_text()
    program = context.program(vertex_shader=ASKING.format(included=included, said=said), varyings=["count"])
    given, answer = context.buffer(asked.astype("f4").tobytes()), context.buffer(reserve=4 * len(asked))
    context.simple_framebuffer((4, 4)).use()
    context.vertex_array(program, [(given, "3f", "asked")]).transform(answer, moderngl.POINTS, vertices=len(asked))
    return np.frombuffer(answer.read(), np.float32)


def reached(circles: np.ndarray, azimuth: float, far: float) -> np.ndarray:
    """Which circles, (n, 2), the ray from the origin reaches before it is ``far`` away."""
    along = circles @ [np.cos(azimuth), np.sin(azimuth)]
    aside = circles @ [-np.sin(azimuth), np.cos(azimuth)]
    return (along > 0) & (along < far) & (np.abs(aside) < RADIUS)


@pytest.mark.parametrize("phi", [0.3, 0.8, 1.5, 2.6])
def test_strands_that_would_hide_a_place_do_not_shade_it(gl: moderngl.Context, phi: float) -> None:
    """Against circles strewn at random, of which none stands between the place and the eye."""
    circles = np.random.default_rng(1).uniform(-1.0, 1.0, (COUNT, 2))
    seen = circles[~reached(circles, 0.0, 1.0)]
    density, far = COUNT / 4.0, 0.8
    wanted = reached(seen, phi, far).sum()
    met = 2 * RADIUS * density
    (count,) = crossed_unseen(gl, np.array([[met * far, met * RADIUS, phi]]))
    assert count == pytest.approx(wanted, rel=0.05)
    assert count < met * far


def test_from_where_the_sun_is_nothing_seen_is_in_shadow(gl: moderngl.Context) -> None:
    counts = crossed_unseen(gl, np.array([[3.0, 0.2, 0.0], [3.0, 0.2, np.pi], [0.0, 0.2, 1.0], [3.0, 0.0, 1.0]]))
    np.testing.assert_allclose(counts, [0.0, 3.0, 0.0, 3.0], atol=0.03)


@pytest.mark.parametrize("phi", [0.3, 0.8])
@pytest.mark.parametrize("radii", [2.0, 4.0])
def test_a_strand_that_is_known_to_be_met_there_hides_the_place_or_not(
    gl: moderngl.Context, phi: float, radii: float
) -> None:
    """Against circles so far away on the light's way, which meet it anywhere across."""
    aside = np.linspace(-1, 1, 2001)
    seen = np.abs(radii * np.sin(phi) - aside * np.cos(phi)) > 1.0
    (met,) = crossed_unseen(gl, np.array([[1.0, radii, phi]]), "met_unseen(vec4(asked.x), vec4(asked.y), asked.z).x")
    assert met == pytest.approx(seen.mean(), abs=0.05)


@pytest.mark.parametrize("rate", [0.3, 1.0])
def test_soft_light_from_the_eyes_side_has_met_fewer(gl: moderngl.Context, rate: float) -> None:
    """Against a fine sum over the azimuths."""
    phi = (np.arange(400) + 0.5) / 400 * np.pi / 2
    asked = np.array([[0.5, 0.05, 0.0], [1.0, 0.3, 0.0], [2.0, 0.3, 0.0], [1.0, 0.0, 0.0]])
    asked[:, 2] = rate
    gains = crossed_unseen(gl, asked, GAIN)
    for (met, radius_count, _), gain in zip(asked, gains, strict=True):
        crossed = crossed_unseen(gl, np.stack([np.full(400, met), np.full(400, radius_count), phi], axis=1))
        assert gain == pytest.approx(np.exp(rate * (met - crossed)).mean(), rel=0.03)
    assert gains[3] == pytest.approx(1.0)
    assert gains[1] > gains[0] > 1.0
