from __future__ import annotations

import ctypes
import ctypes.util
import dataclasses
from collections.abc import Callable

import moderngl
import numpy as np
import pytest

from headstudio.head.frame import HeadFrame
from headstudio.head.head import Head
from headstudio.lcp.model import HairModel
from headstudio.render.context import RenderError
from headstudio.render.renderer import Renderer
from headstudio.scene.settings import Camera, Look
from headstudio.scene.stage import HairOnStage, Overlays, Stage

from .stages import model_of, stage_with

SIZE = (96, 96)


def test_same_stage_same_picture_bit_for_bit(
    gl: moderngl.Context, renderer: Renderer, stage: Stage, look: Look, camera: Camera
) -> None:
    renderer.render(stage, look, camera, SIZE)
    first = renderer.read_pixels()
    renderer.render(stage, look, camera, SIZE)
    np.testing.assert_array_equal(renderer.read_pixels(), first)
    other = Renderer(gl)
    other.render(stage, dataclasses.replace(look, hair_opacity=0.2, ribbons=1), camera, (50, 40))
    other.render(stage, look, camera, SIZE)
    np.testing.assert_array_equal(other.read_pixels(), first)


def test_every_change_of_a_frame_is_seen(renderer: Renderer, stage: Stage, look: Look, camera: Camera) -> None:
    assert stage.hair is not None
    renderer.render(stage, look, camera, SIZE)
    before = renderer.read_pixels()
    hair = stage.hair
    lifted = dataclasses.replace(hair, positions=hair.positions + np.array([0.0, 0.02, 0.0]))
    changes: list[tuple[Stage, Look, Camera]] = [
        (dataclasses.replace(stage, hair=lifted), look, camera),
        (dataclasses.replace(stage, frame=HeadFrame(translation=np.array([0.02, 0, 0]))), look, camera),
        (stage, dataclasses.replace(look, hair_colour=(0.9, 0.2, 0.1)), camera),
        (stage, dataclasses.replace(look, skin_colour=(0.2, 0.1, 0.1)), camera),
        (stage, dataclasses.replace(look, shadows=False), camera),
        (stage, dataclasses.replace(look, show_hair=False), camera),
        (stage, dataclasses.replace(look, show_head=False), camera),
        (stage, dataclasses.replace(look, ribbons=5), camera),
        (stage, dataclasses.replace(look, billboard_stretch=3.0), camera),
        (stage, look, dataclasses.replace(camera, azimuth=1.0)),
    ]
    for change in changes:
        renderer.render(*change, SIZE)
        assert (renderer.read_pixels() != before).any(), change
        renderer.render(stage, look, camera, SIZE)
        np.testing.assert_array_equal(renderer.read_pixels(), before)


def test_picture_is_upright_and_has_its_size(renderer: Renderer, stage: Stage, look: Look) -> None:
    camera = Camera(distance=0.8, azimuth=0.0, elevation=0.0, target_y=-0.2)
    bald = dataclasses.replace(look, show_hair=False, background=(0.0, 0.0, 0.0))
    for size in ((96, 64), (31, 77), (96, 64)):
        texture = renderer.render(stage, bald, camera, size)
        pixels = renderer.read_pixels()
        assert texture.size == size
        assert pixels.shape == (size[1], size[0], 3)
    # The camera looks below the head, so that the head is in the upper half.
    assert pixels[:32].mean() > 4 * pixels[32:].mean()


def test_hair_is_dark_where_it_shadows_itself(renderer: Renderer, stage: Stage, look: Look, camera: Camera) -> None:
    camera = dataclasses.replace(camera, azimuth=np.pi)
    renderer.render(stage, look, camera, SIZE)
    shadowed = renderer.read_pixels()
    renderer.render(stage, dataclasses.replace(look, shadows=False), camera, SIZE)
    assert shadowed.mean() < renderer.read_pixels().mean() - 3


def test_hair_casts_its_shadow_on_the_head(
    renderer: Renderer, egg: Head, hair_model: HairModel, look: Look, camera: Camera
) -> None:
    """A curtain of hair beside the face, towards the light, and seen from the other side."""
    look = dataclasses.replace(look, light_azimuth=np.pi / 2, light_height=0.0)
    camera = dataclasses.replace(camera, azimuth=0.0, elevation=0.0)
    x, y = np.meshgrid(np.linspace(-0.06, 0.1, 16), np.linspace(-0.03, 0.13, 16))
    curtain = np.column_stack([np.full(x.size, 0.25), y.ravel(), x.ravel()])
    model = model_of(curtain, np.tile([0.0, -1.0, 0.0], (len(curtain), 1)), np.full(len(curtain), 0.1), curtain + 5)
    renderer.render(stage_with(egg, model), look, camera, SIZE)
    under_hair = renderer.read_pixels()[40:56, 54:62].mean()
    renderer.render(Stage(egg), look, camera, SIZE)
    assert under_hair < 0.85 * renderer.read_pixels()[40:56, 54:62].mean()


def test_head_hides_the_hair_behind_it(renderer: Renderer, egg: Head, look: Look) -> None:
    behind = np.array([[0.0, 0.05, -0.3]])
    model = model_of(behind, np.array([[0.0, -1.0, 0.0]]), np.array([0.1]), behind)
    camera = Camera(distance=0.8, azimuth=0.0, elevation=0.0, target_y=0.05)
    look = dataclasses.replace(look, shadows=False)
    renderer.render(stage_with(egg, model), look, camera, SIZE)
    with_hair = renderer.read_pixels()
    renderer.render(Stage(egg), look, camera, SIZE)
    np.testing.assert_array_equal(with_hair, renderer.read_pixels())


@pytest.mark.parametrize("count", [0, 1, 2])
def test_hardly_any_hair(renderer: Renderer, egg: Head, look: Look, camera: Camera, count: int) -> None:
    at = np.array([[0.0, 0.17, 0.0], [0.0, 0.18, 0.0]])[:count]
    model = model_of(at, np.tile([0.0, 1.0, 0.0], (count, 1)), np.array([-0.01, 0.0])[:count], at)
    renderer.render(stage_with(egg, model), look, camera, SIZE)
    assert renderer.read_pixels().std() > 5


@pytest.mark.parametrize("toward_eye", [True, False])
def test_no_view_of_a_strand_gives_a_nan(
    renderer: Renderer, egg: Head, look: Look, camera: Camera, toward_eye: bool
) -> None:
    """Hair exactly along the line of sight, along the light, and turned by 180 degrees."""
    from headstudio.render.view import camera_view, light_view

    direction = (camera_view(camera, 1.0) if toward_eye else light_view(look, np.zeros(3), 0.3)).forward
    at = np.array([[0.0, 0.02, 0.0], [0.01, 0.2, 0.0]])
    model = model_of(at, np.tile(direction, (2, 1)), np.array([0.1, 0.1]), at)
    turned = Stage(egg, hair=HairOnStage(model, at, -model.rest_directions))
    for stage in (stage_with(egg, model), turned):
        renderer.render(stage, look, camera, SIZE)
        assert renderer._targets is not None
        linear = np.frombuffer(renderer._targets.colour.read(), np.float16)
        assert np.isfinite(linear).all()


def test_overlays_lie_on_top(renderer: Renderer, egg: Head, look: Look) -> None:
    red, blue = [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]
    overlays = Overlays(
        segments=np.array([[[-0.02, 0.0, -0.2], [0.02, 0.0, -0.2]]]),
        segment_colours=np.array([red]),
        points=np.array([[0.0, 0.05, 0.0]]),
        point_colours=np.array([blue]),
    )
    camera = Camera(distance=0.6, azimuth=0.0, elevation=0.0, target_y=0.05)
    renderer.render(Stage(egg, overlays=overlays), look, camera, SIZE)
    pixels = renderer.read_pixels().astype(int)
    assert ((pixels[..., 0] > 150) & (pixels[..., 1] < 60)).sum() >= 5
    assert pixels[48, 48, 2] > 150
    assert pixels[48, 48, 0] < 60


def test_target_gets_a_copy(gl: moderngl.Context, renderer: Renderer, stage: Stage, look: Look, camera: Camera) -> None:
    target = gl.simple_framebuffer(SIZE, 4)
    texture = renderer.render(stage, look, camera, SIZE, target)
    assert target.read(components=4) == texture.read()
    assert renderer.colour_texture == texture.glo


def test_supersampling_keeps_the_picture_and_smooths_it(
    renderer: Renderer, stage: Stage, look: Look, camera: Camera
) -> None:
    bald = dataclasses.replace(look, show_hair=False)
    renderer.render(stage, bald, camera, SIZE)
    plain = renderer.read_pixels().astype(float)
    renderer.render(stage, bald, camera, SIZE, supersampling=2)
    fine = renderer.read_pixels().astype(float)
    assert fine.shape == plain.shape
    assert np.abs(fine.mean() - plain.mean()) < 1
    assert np.abs(np.diff(fine, axis=1)).max() < np.abs(np.diff(plain, axis=1)).max()


def test_impossible_size_is_one_clear_line(renderer: Renderer, stage: Stage, look: Look, camera: Camera) -> None:
    with pytest.raises(RenderError, match=r"1 to \d+ pixels a side"):
        renderer.render(stage, look, camera, (0, 20))
    with pytest.raises(ValueError, match="after render"):
        renderer.read_pixels()


def test_stages_are_timed_when_asked(renderer: Renderer, stage: Stage, look: Look, camera: Camera) -> None:
    renderer.render(stage, look, camera, SIZE)
    assert renderer.timer.stages == {}
    renderer.timer.on = True
    renderer.render(stage, look, camera, SIZE)
    assert {"ms_upload", "ms_shadow", "ms_light", "ms_body", "ms_hair", "ms_develop"} <= renderer.timer.stages.keys()
    assert all(milliseconds >= 0 for milliseconds in renderer.timer.stages.values())


def test_nothing_is_kept_that_the_collector_frees(
    gl: moderngl.Context, stage: Stage, look: Look, camera: Camera
) -> None:
    """Objects may only be freed while their context is current: at the end of a picture nothing waits for it."""
    renderer = Renderer(gl)
    for size in (SIZE, (40, 40), SIZE):
        renderer.render(stage, look, camera, size)
        assert len(gl.objects) == 0


# What OpenGL is asked for, by its numbers in the specification.
_STATE = {
    "blend": (0x0BE2, 1),
    "depth test": (0x0B71, 1),
    "cull face": (0x0B44, 1),
    "program point size": (0x8642, 1),
    "depth mask": (0x0B72, 1),
    "colour mask": (0x0C23, 4),
    "viewport": (0x0BA2, 4),
    "framebuffer": (0x8CA6, 1),
    "blend source": (0x80CB, 1),
    "blend destination": (0x80CA, 1),
}


@pytest.fixture
def gl_state(gl: moderngl.Context) -> Callable[[], dict[str, list[int]]]:
    library = ctypes.util.find_library("GL") or ctypes.util.find_library("OpenGL")
    if library is None:
        pytest.skip("no libGL to ask for the state")
    get = ctypes.CDLL(library).glGetIntegerv

    def read() -> dict[str, list[int]]:
        state = {}
        for name, (number, count) in _STATE.items():
            values = (ctypes.c_int * 16)()
            get(ctypes.c_uint(number), values)
            state[name] = list(values[:count])
        return state

    return read


def test_opengl_is_left_as_it_was_found(
    gl: moderngl.Context,
    renderer: Renderer,
    stage: Stage,
    look: Look,
    camera: Camera,
    gl_state: Callable[[], dict[str, list[int]]],
) -> None:
    own = gl.simple_framebuffer((20, 30))
    own.use()
    gl.enable_only(moderngl.DEPTH_TEST)
    gl.blend_func = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA
    before = gl_state()
    assert before["viewport"] == [0, 0, 20, 30]
    renderer.render(stage, look, camera, SIZE)
    assert gl_state() == before
    gl.enable_only(moderngl.NOTHING)
