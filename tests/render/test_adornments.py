from __future__ import annotations

import dataclasses

import moderngl
import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.head.mesh import TriangleMesh
from headstudio.render.renderer import Renderer
from headstudio.scene.settings import Camera, Look
from headstudio.scene.stage import Stage
from headstudio.wisp.adornment import Adornment

from .stages import egg_head

LOOK = Look(tone_map="none")
SIZE = (96, 96)


def red_ball(place: tuple[float, float, float], radius: float = 0.02) -> Adornment:
    ball = trimesh.creation.icosphere(subdivisions=3, radius=radius)
    return Adornment(TriangleMesh(np.array(ball.vertices) + place, np.array(ball.faces)), (0.9, 0.0, 0.0))


def picture(renderer: Renderer, stage: Stage, look: Look = LOOK) -> np.ndarray:
    renderer.render(stage, look, Camera(azimuth=0.0, elevation=0.0, distance=0.8), SIZE)
    return renderer.read_pixels().astype(int)


def red(pixels: np.ndarray) -> np.ndarray:
    return (pixels[..., 0] > 60) & (pixels[..., 0] > 4 * pixels[..., 1])


@pytest.fixture(scope="module")
def head():
    return egg_head()


@pytest.fixture
def renderer(gl: moderngl.Context) -> Renderer:
    return Renderer(gl)


def test_an_adornment_is_seen_before_the_head_and_not_behind_it(renderer, head):
    before = red(picture(renderer, Stage(head, adornments=(red_ball((0.0, 0.1, 0.12)),))))
    behind = red(picture(renderer, Stage(head, adornments=(red_ball((0.0, 0.1, -0.12)),))))
    assert 10 < before.sum() < 400
    assert behind.sum() == 0


def test_it_turns_with_the_head_and_hides_with_the_hair(renderer, head):
    stage = Stage(head, adornments=(red_ball((0.0, 0.1, 0.14)),))
    at_rest = np.argwhere(red(picture(renderer, stage)))[:, 1].mean()
    turn = HeadFrame(rotation=Rotation.from_rotvec([0.0, 0.6, 0.0]))
    turned = np.argwhere(red(picture(renderer, dataclasses.replace(stage, frame=turn))))[:, 1].mean()
    assert turned > at_rest + 5
    assert not red(picture(renderer, stage, dataclasses.replace(LOOK, show_hair=False))).any()


def test_it_casts_its_shadow_on_the_head(renderer, head):
    look = dataclasses.replace(LOOK, light_azimuth=0.0, light_height=1.2)
    stage = Stage(head, adornments=(red_ball((0.0, 0.13, 0.115), 0.025),))
    bare, worn = picture(renderer, Stage(head), look), picture(renderer, stage, look)
    shadow = (worn.sum(axis=2) < 0.8 * bare.sum(axis=2)) & ~red(worn)
    unlit = dataclasses.replace(look, shadows=False)
    without = (
        picture(renderer, stage, unlit).sum(axis=2) < 0.8 * picture(renderer, Stage(head), unlit).sum(axis=2)
    ) & ~red(worn)
    assert shadow.sum() > 2 * without.sum() + 20


def test_what_is_taken_off_is_gone(renderer, head):
    picture(renderer, Stage(head, adornments=(red_ball((0.0, 0.1, 0.12)),)))
    assert np.array_equal(picture(renderer, Stage(head)), picture(Renderer(renderer.context), Stage(head)))
