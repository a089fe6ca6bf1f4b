from __future__ import annotations

import dataclasses

import moderngl
import numpy as np
import pytest
from PIL import Image

from headstudio.head.frame import HeadFrame
from headstudio.head.mesh import Floats
from headstudio.lcp.model import HairModel
from headstudio.render import hair_light
from headstudio.render.light_billboards import LEAST_SINE, light_billboards, opacity_scale
from headstudio.render.renderer import Renderer
from headstudio.render.strand_levels import LIGHT_LEVEL
from headstudio.render.strands import CurveBuilder
from headstudio.render.targets import light_targets
from headstudio.render.view import light_view
from headstudio.resources import asset
from headstudio.scene.settings import Camera, Look
from headstudio.scene.stage import HairOnStage, Stage

from .sequential_light import reduced, sequential_light


def received(renderer: Renderer, count: int) -> Floats:
    """Light on the particles and the part that comes past the objects, (n, 2)."""
    assert renderer._hair is not None
    texels = np.frombuffer(renderer._hair.light.received.read(), np.float32)
    return texels.reshape(-1, 4)[:count, :2].astype(np.float64)


@pytest.fixture
def drawn_billboards(monkeypatch: pytest.MonkeyPatch) -> list[np.ndarray]:
    seen: list[np.ndarray] = []

    def remember(*arguments: object) -> np.ndarray:
        seen.append(light_billboards(*arguments))  # type: ignore[arg-type]
        return seen[-1]

    monkeypatch.setattr(hair_light, "light_billboards", remember)
    return seen


@pytest.mark.parametrize("show_head", [True, False])
def test_light_on_particles_is_that_of_the_sequential_algorithm(
    renderer: Renderer, stage: Stage, look: Look, camera: Camera, drawn_billboards: list[np.ndarray], show_head: bool
) -> None:
    look = dataclasses.replace(look, show_head=show_head)
    renderer.render(stage, look, camera, (64, 64))
    assert stage.hair is not None
    light, lit = received(renderer, stage.hair.model.count).T
    with Image.open(asset("textures/strands.png")) as image:
        opacity = np.asarray(image)[..., 0] / 255.0
    wanted, wanted_map = sequential_light(drawn_billboards[0], lit, reduced(opacity, LIGHT_LEVEL), look.shadow_size)
    assert 0.05 < wanted.mean() < 0.8  # there is something to get wrong
    assert np.abs(light - wanted).mean() < 0.02 * wanted.mean()
    assert renderer._maps is not None
    light_map = np.frombuffer(renderer._maps.map.read(), np.float16).astype(float).reshape(wanted_map.shape)
    assert np.abs(light_map - wanted_map)[wanted_map < 1].mean() < 0.01
    if show_head:
        assert (lit < 0.5).any()  # hair behind the head
        assert (lit == 1).any()
    else:
        assert (lit == 1).all()


@pytest.mark.parametrize("batch", [20, 300, 10_000])
def test_light_does_not_depend_on_the_batches(
    renderer: Renderer, stage: Stage, look: Look, camera: Camera, monkeypatch: pytest.MonkeyPatch, batch: int
) -> None:
    assert stage.hair is not None
    renderer.render(stage, look, camera, (64, 64))
    usual = received(renderer, stage.hair.model.count)
    monkeypatch.setattr(hair_light, "BATCH", batch)
    renderer.render(stage, look, camera, (64, 64))
    assert np.abs(received(renderer, stage.hair.model.count) - usual).max() < 0.01


def test_softened_light_is_the_mean_over_linked_particles(
    renderer: Renderer, stage: Stage, look: Look, camera: Camera
) -> None:
    assert stage.hair is not None
    renderer.render(stage, look, camera, (64, 64))
    model = stage.hair.model
    light = received(renderer, model.count)[:, 0]
    assert renderer._hair is not None
    softened = np.frombuffer(renderer._hair.light.softened.read(), np.float32).reshape(-1, 4)[: model.count]
    root, tip = model.links.T
    for part, of, to in ((0, tip, root), (2, root, tip)):
        degree = np.bincount(of, minlength=model.count)
        mean = np.bincount(of, light[to], model.count) / np.maximum(degree, 1)
        wanted = np.where(degree > 0, 0.5 * (light + mean), light)
        np.testing.assert_allclose(softened[:, part], wanted, atol=1e-5)
    np.testing.assert_allclose(softened[:, 1], 0.5 * (softened[:, 0] + softened[:, 2]), atol=1e-6)


def test_opacity_grows_as_the_sine_falls_and_stays_bounded() -> None:
    cosine = np.cos(np.radians([90, 60, 30, 5, 0]))
    opacity = opacity_scale(cosine, 0.2)
    np.testing.assert_allclose(opacity[:3], 0.2 / np.sin(np.radians([90, 60, 30])))
    np.testing.assert_allclose(opacity[3:], 0.2 / LEAST_SINE)
    assert opacity_scale(np.array([0.999]), 0.9)[0] == 1.0


def test_billboards_come_nearest_to_the_light_first(hair_model: HairModel, look: Look) -> None:
    hair = HairOnStage(hair_model, hair_model.rest_positions, hair_model.rest_directions)
    curves = CurveBuilder(hair_model).curves(hair, HeadFrame(), 0.03)
    light = light_view(look, np.zeros(3), 0.4)
    boards = light_billboards(curves, hair_model, np.zeros(hair_model.count), light, look, 256)
    assert (np.diff(boards["depth"]) >= 0).all()
    particle = boards["particle"].astype(int)
    np.testing.assert_array_equal(np.sort(particle), np.arange(hair_model.count))
    clip = hair_model.rest_positions[particle] @ light.clip_from_world[:3, :3].T + light.clip_from_world[:3, 3]
    np.testing.assert_allclose(boards["centre"], (clip[:, :2] * 0.5 + 0.5) * 256, atol=1e-3)
    np.testing.assert_allclose(boards["depth"], clip[:, 2] * 0.5 + 0.5, atol=1e-6)


def test_without_shadows_everybody_has_all_the_light(
    renderer: Renderer, stage: Stage, look: Look, camera: Camera, gl: moderngl.Context
) -> None:
    assert stage.hair is not None
    renderer.render(stage, dataclasses.replace(look, shadows=False), camera, (64, 64))
    np.testing.assert_array_equal(received(renderer, stage.hair.model.count), 1.0)


def test_stripes_of_the_light_map_are_gone_where_it_is_soft(gl: moderngl.Context) -> None:
    """Strands that particles are drawn with are made up, and throw no stripes on a face; whole locks throw a shadow."""
    maps = light_targets(gl, 512)
    column = np.arange(512)
    stripes, half = np.where(column % 4 < 2, 0.2, 0.8), np.where(column < 256, 0.0, 1.0)
    for values, wanted in ((stripes, np.full(128, 0.5)), (half, np.where(np.arange(128) < 64, 0.0, 1.0))):
        maps.map.write(np.tile(values, (512, 1)).astype(np.float16).tobytes())
        Renderer(gl)._soften_light(maps)
        soft = np.frombuffer(maps.soft.read(), np.float16).reshape(128, 128).astype(float)
        near_edge = np.isin(np.arange(128), (63, 64)) if values is half else np.zeros(128, bool)
        np.testing.assert_allclose(soft[:, ~near_edge], np.tile(wanted, (128, 1))[:, ~near_edge], atol=0.01)
        assert ((soft[:, near_edge] > 0.2) & (soft[:, near_edge] < 0.8)).all()
