"""Several samples a pixel: edges are covered in part, and strands cover as much as they do without."""

from __future__ import annotations

import dataclasses

import moderngl
import numpy as np
import pytest

from headstudio.head.head import Head
from headstudio.head.mesh import Floats
from headstudio.render.renderer import Renderer
from headstudio.render.samples import samples_of
from headstudio.scene.settings import Camera, Look
from headstudio.scene.stage import Stage
from headstudio.wisp.strands import Strands

CAMERA = Camera(distance=0.6, target_y=0.02, azimuth=0.3, elevation=0.1)
SIZE = (120, 120)


def alpha(renderer: Renderer, stage: Stage, look: Look, supersampling: int = 1) -> Floats:
    """How much of every pixel is covered, (height, width)."""
    renderer.render(stage, look, CAMERA, SIZE, supersampling=supersampling)
    targets = renderer._targets
    assert targets is not None
    return np.frombuffer(targets.reduced.read(), np.float16).reshape(*SIZE, 4)[..., 3].astype(float)


@pytest.fixture
def several(gl: moderngl.Context) -> Look:
    if gl.max_samples < 4:
        pytest.skip("this driver has no four samples a pixel")
    return Look(samples="4")


def test_a_driver_is_asked_for_no_more_than_it_has(gl: moderngl.Context) -> None:
    assert samples_of(gl, Look(samples="1")) == 1
    assert samples_of(gl, Look(samples="8")) <= max(gl.max_samples, 1)


def test_edges_of_the_head_are_covered_in_part(renderer: Renderer, egg: Head, several: Look) -> None:
    stage = Stage(egg)
    sharp, smooth, fine = (
        alpha(renderer, stage, Look(samples="1")),
        alpha(renderer, stage, several),
        alpha(renderer, stage, Look(samples="1"), supersampling=4),
    )
    assert np.isin(sharp, (0.0, 1.0)).all()
    edge = (fine > 0.1) & (fine < 0.9)
    assert edge.sum() > 100
    between = (smooth > 0.01) & (smooth < 0.99)
    assert between[edge].mean() > 0.8
    assert np.abs(smooth - fine)[edge].mean() < 0.5 * np.abs(sharp - fine)[edge].mean()
    # Inside and outside nothing is changed.
    assert np.array_equal(smooth[fine == 1.0], sharp[fine == 1.0])


def test_the_skin_has_the_same_light(renderer: Renderer, egg: Head, several: Look) -> None:
    def pixels(look: Look) -> Floats:
        renderer.render(Stage(egg), look, CAMERA, SIZE)
        return renderer.read_pixels().astype(float)

    sharp, smooth = pixels(Look(samples="1")), pixels(several)
    inside = alpha(renderer, Stage(egg), Look(samples="1"), supersampling=4)[::-1] == 1.0
    # But where one part of the head hides another.
    assert (np.abs(smooth - sharp)[inside].max(axis=1) > 1.0).mean() < 0.05
    # At the edge skin has the colour of skin, and not of what lies behind it.
    rim = alpha(renderer, Stage(egg), several)
    part = (rim > 0.2) & (rim < 0.8)
    colour = np.frombuffer(renderer._targets.reduced.read(), np.float16).reshape(*SIZE, 4)[part]  # type: ignore[union-attr]
    assert (colour[:, 0] / colour[:, 3]).min() > 0.02


@pytest.mark.parametrize("samples", ["1", "4"])
@pytest.mark.parametrize("pixels_wide", [0.05, 0.6, 3.3])
def test_strands_cover_their_width(
    renderer: Renderer, egg: Head, several: Look, samples: str, pixels_wide: float
) -> None:
    pixel = 2 * CAMERA.distance * np.tan(CAMERA.field_of_view / 2) / SIZE[1]
    length, count = 0.1, 12
    # Tilted strands side by side in the plane that the camera looks at.
    right = np.array([np.cos(CAMERA.azimuth), 0.0, -np.sin(CAMERA.azimuth)])
    toward = np.array([np.sin(0.3) * np.cos(0.1), np.sin(0.1), np.cos(0.3) * np.cos(0.1)])
    up = np.cross(toward, right)
    along = np.cos(0.4) * up + np.sin(0.4) * right
    start = np.linspace(-0.1, 0.1, count)[:, None] * right - 0.5 * length * along + np.array([0, 0.02, 0])
    points = start[:, None] + np.linspace(0, length, 9)[:, None] * along
    strands = Strands.of_equal_count(
        points.astype(np.float32), radius=np.full((count, 9), 0.5 * pixels_wide * pixel, np.float32)
    )
    look = dataclasses.replace(several, samples=samples, show_head=False, shadow_size=64)
    covered = alpha(renderer, Stage(egg, strands=strands), look).sum()
    assert covered == pytest.approx(count * length / pixel * pixels_wide, rel=0.03)
