"""Pieces of hair that a body hides are left out, and nobody sees it."""

from __future__ import annotations

from unittest.mock import patch

import moderngl
import numpy as np

from headstudio.render import strand_picture as pictures
from headstudio.render.occlusion import Occluder
from headstudio.render.view import View, perspective_view

from .strand_scenes import fur
from .test_strand_hair import fur_scene, picture

SIZE = 96
IDENTITY = np.eye(4)


def view() -> View:
    return perspective_view(np.array([0.05, 0.1, 0.7]), np.zeros(3), np.radians(30), 1.0)


def window_depth(at: np.ndarray, view: View) -> np.ndarray:
    """What a depth buffer holds for places, (n, 3)."""
    clip = np.c_[at, np.ones(len(at))] @ view.clip_from_world.T
    return 0.5 + 0.5 * clip[:, 2] / clip[:, 3]


def wall(gl: moderngl.Context, view: View, distance: float, right_half_only: bool = False) -> moderngl.Texture:
    """The depth of a wall square to the direction of looking."""
    there = window_depth((view.eye + distance * view.forward)[None], view)[0]
    depth = np.full((SIZE, SIZE), there, np.float32)
    if right_half_only:
        depth[:, : SIZE // 2] = 1.0
    texture = gl.depth_texture((SIZE, SIZE))
    texture.write(depth)
    return texture


def beyond(view: View, distance: float, right: float = 0.0) -> np.ndarray:
    return (view.eye + distance * view.forward + right * view.right)[None].astype(np.float32)


def test_what_is_behind_a_wall_is_hidden_and_what_reaches_before_it_is_not(gl: moderngl.Context) -> None:
    seen = view()
    occluder = Occluder(wall(gl, seen, 0.6), seen)
    assert occluder.hides(beyond(seen, 0.65), IDENTITY, 0.04).all()
    assert not occluder.hides(beyond(seen, 0.65), IDENTITY, 0.06).any()
    assert not occluder.hides(beyond(seen, 0.55), IDENTITY, 0.01).any()
    assert not occluder.hides(beyond(seen, -0.65), IDENTITY, 0.01).any()


def test_what_looks_out_beside_a_wall_is_seen(gl: moderngl.Context) -> None:
    seen = view()
    occluder = Occluder(wall(gl, seen, 0.6, right_half_only=True), seen)
    assert occluder.hides(beyond(seen, 0.65, right=0.1), IDENTITY, 0.01).all()
    assert not occluder.hides(beyond(seen, 0.65, right=0.005), IDENTITY, 0.01).any()
    assert not occluder.hides(beyond(seen, 0.65, right=-0.1), IDENTITY, 0.01).any()


def test_places_may_move_with_a_head(gl: moderngl.Context) -> None:
    seen = view()
    occluder = Occluder(wall(gl, seen, 0.6), seen)
    moved = np.eye(4)
    moved[:3, 3] = 0.1 * seen.forward
    assert not occluder.hides(beyond(seen, 0.55), IDENTITY, 0.01).any()
    assert occluder.hides(beyond(seen, 0.55), moved, 0.01).all()


def test_a_picture_is_the_same_with_what_is_hidden_and_without(gl: moderngl.Context) -> None:
    scene = fur_scene(strands=fur(2_000, points=29, length=0.02))
    spared: list[float] = []

    class Counting(Occluder):
        def hides(self, *args):
            hidden = super().hides(*args)
            spared.append(hidden.mean())
            return hidden

    class Blind(Occluder):
        def hides(self, places, *args):
            return np.zeros(len(places), dtype=bool)

    drawn = []
    for occluder in (Counting, Blind):
        with patch.object(pictures, "Occluder", occluder):
            drawn.append(picture(gl, scene, 256))
    np.testing.assert_array_equal(*drawn)
    assert 0.1 < spared[0] < 0.5
