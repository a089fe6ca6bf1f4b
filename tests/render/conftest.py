"""One renderer and one little scene for a whole module."""

from __future__ import annotations

import moderngl
import pytest

from headstudio.head.head import Head
from headstudio.lcp.model import HairModel
from headstudio.render.renderer import Renderer
from headstudio.scene.settings import Camera, Look
from headstudio.scene.stage import Stage

from .stages import egg_head, falling_hair, stage_with


@pytest.fixture(scope="session")
def egg() -> Head:
    return egg_head()


@pytest.fixture(scope="session")
def hair_model() -> HairModel:
    return falling_hair()


@pytest.fixture(scope="session")
def stage(egg: Head, hair_model: HairModel) -> Stage:
    return stage_with(egg, hair_model)


@pytest.fixture(scope="session")
def look() -> Look:
    return Look(shadow_size=256)


@pytest.fixture(scope="session")
def camera() -> Camera:
    return Camera(distance=0.6, target_y=0.02)


@pytest.fixture
def renderer(gl: moderngl.Context) -> Renderer:
    return Renderer(gl)
