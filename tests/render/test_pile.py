"""Light in piles of strands: the shader's closed forms against photons followed one by one."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest

from headstudio.head.mesh import Floats
from headstudio.render.fibre import ABSORPTIONS, AZIMUTHS, SINES, Fibre, Sent, fibre_tables, followed, pile, sent_on
from headstudio.resources import shader

PHOTONS = 20_000
CODED = np.linspace(0.0, 0.98, ABSORPTIONS)

ASKING = """#version 330
{included}
in vec4 asked;
out vec2 said;
void main() {{
    Pile here = pile(vec3(asked.x), vec3(asked.y));
    said = vec2(let_through_by(here, asked.z).r, going_on(here, asked.z - asked.w, closed_by(here, asked.w)).r);
}}
"""


def let_through(context: moderngl.Context, asked: Floats) -> Floats:
    """What the shader says comes through and is there of light, for forward, back, the count, and the count behind, (n, 4)."""
    included = shader("common/pile.glsl").read_text()
    program = context.program(vertex_shader=ASKING.format(included=included), varyings=["said"])
    given, answer = context.buffer(asked.astype("f4").tobytes()), context.buffer(reserve=8 * len(asked))
    context.simple_framebuffer((4, 4)).use()
    context.vertex_array(program, [(given, "4f", "asked")]).transform(answer, moderngl.POINTS, vertices=len(asked))
    return np.frombuffer(answer.read(), np.float32).reshape(-1, 2)


def photons(place: int, count: float, scatterings: int) -> tuple[float, float]:
    """Of light that comes straight on, what passes a layer of ``count`` upright strands and what comes back, where no photon is
    followed over more than so many strands. They stand at random, side by side: only azimuths matter.
    """
    rng = np.random.default_rng(5)
    lobes = fibre_tables(Fibre()).around[place, SINES // 2].sum(axis=1)
    albedo = lobes.sum() * 2 * np.pi / AZIMUTHS
    likely = np.cumsum(lobes) / lobes.sum()
    depth, heading = np.zeros(PHOTONS), np.zeros(PHOTONS)  # azimuth of the way, 0 being straight on
    weight, through, sent_back = 1.0, 0.0, 0.0
    for _ in range(scatterings + 1):
        depth = depth + np.cos(heading) * rng.exponential(size=len(depth))
        through += weight * (depth > count).sum() / PHOTONS
        sent_back += weight * (depth < 0).sum() / PHOTONS
        inside = (depth >= 0) & (depth <= count)
        depth, heading = depth[inside], heading[inside]
        # phi runs from where the light comes from: pi is straight on.
        turned = np.pi - (np.searchsorted(likely, rng.random(len(depth))) + rng.random(len(depth))) / AZIMUTHS * np.pi
        heading = heading + turned * rng.choice([-1, 1], len(depth))
        weight *= albedo
    return through, sent_back


def test_a_layer_lets_through_what_kubelka_and_munk_say(gl: moderngl.Context) -> None:
    forward, back, count = (part.ravel() for part in np.meshgrid([0.1, 0.5, 0.7], [0.05, 0.2], [0.3, 1.0, 4.0]))
    said = let_through(gl, np.stack([forward, back, count, np.zeros(len(count))], axis=1))
    # K and S of their paper; the layer ends at something black.
    a = 1 + (1 - forward - back) / back
    b = np.sqrt(a * a - 1)
    wanted = b / (a * np.sinh(b * back * count) + b * np.cosh(b * back * count))
    np.testing.assert_allclose(said[:, 0], wanted, atol=1e-5)
    np.testing.assert_allclose(said[:, 1], wanted, atol=1e-5)


@pytest.mark.parametrize("place", [0, 2, 6])
@pytest.mark.parametrize("count", [0.5, 1.5, 3.0])
def test_strands_turn_light_so_little_that_it_goes_on_straight(gl: moderngl.Context, place: int, count: float) -> None:
    """White, fair and brown hair: what comes through is within .05 of the light, not at a rate pi / 2 as large."""
    coded = CODED[place]
    sent = sent_on(fibre_tables(Fibre()), np.full(1, coded / (1 - coded)))
    asked = np.array([[sent.forward[0], sent.back[0], times * count, 0.0] for times in (1.0, np.pi / 2)])
    straight, roundabout = let_through(gl, asked)[:, 0]
    through, _ = photons(place, count, 60)
    assert straight == pytest.approx(through, abs=0.05)
    assert abs(roundabout - through) > abs(straight - through)


@pytest.mark.parametrize("place", [0, 2])
@pytest.mark.parametrize("count", [1.0, 4.0, 8.0])
def test_ways_that_end_take_what_photons_say_that_are_followed_no_longer(place: int, count: float) -> None:
    """Of white and of fair hair: what comes back."""
    bounces = 12
    _, wanted = photons(place, count, bounces + 1)
    _, all_ = photons(place, count, 300)
    coded = CODED[place]
    sent = sent_on(fibre_tables(Fibre()), np.full(1, coded / (1 - coded)), followed(bounces))

    def sent_back(sent: Sent) -> float:
        rate, endless = pile(sent)
        both_ways = np.exp(-2 * rate * count)
        return float((endless * (1 - both_ways) / (1 - endless**2 * both_ways))[0])

    kept = 2 * sent_back(sent.less) - sent_back(sent.less.less)
    assert kept / sent_back(sent) == pytest.approx(wanted / all_, abs=0.15 if place == 0 else 0.06)
    assert followed(10**6) == pytest.approx(1.0, abs=1e-5)
