"""The soft light inside hair: what comes from all over the sky past the body and through the hair, and from the skin.

The sky is a few dozen lights, each with its own deep opacity map and its own view of the body. At any place the light
that arrives is kept as nine numbers for each colour (render/soft_light.py), which hair and skin turn into what they send on.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import moderngl
import numpy as np

from ..head.mesh import Floats, Ints
from .context import load_program, set_uniforms
from .deep_opacity import DeepOpacityMap, LightStrips, OpacityPrograms
from .fibre import Sent, filling
from .receivers import receive
from .screen import ScreenPasses
from .sky import sphere_directions
from .soft_light import NUMBERS, weights
from .strand_detail import StrandDetail
from .view import Sphere, bounding_sphere, parallel_view

MAP_SIZE = 192
BODY_SIZE = 256
# Places this near under the surface still see past it [m].
_BIAS = 0.003
# Depth, in boxes, where a view shows no body.
_FAR = 1e9
_NOTHING = bytes(12)  # a buffer cannot be empty


class SkyPrograms:
    """The shaders of the soft light."""

    def __init__(self, context: moderngl.Context) -> None:
        self.body = load_program(context, "strands/body_light.vert", "strands/body_light.frag")
        self.gather = ScreenPasses(context, "gather", room="strands")


@dataclass(frozen=True)
class Sky:
    """Radiance of the sky from above and from below, linear RGB, and where above is, in the head frame."""

    above: Floats
    below: Floats
    upward: Floats


class SkyLight:
    """The sky as seen through one hairstyle on one body; in the head frame."""

    def __init__(
        self,
        context: moderngl.Context,
        programs: SkyPrograms,
        opacity: OpacityPrograms,
        vertices: Floats,
        faces: Ints,
        detail: StrandDetail,
    ) -> None:
        self._context = context
        self._programs = programs
        self._tiles = math.isqrt(2 * detail.pairs - 1) + 1
        self._hair = DeepOpacityMap(context, opacity, MAP_SIZE, self._tiles)
        side = BODY_SIZE * self._tiles
        self._body = context.texture((side, side), 4, dtype="f4")
        self._body.filter = (moderngl.NEAREST, moderngl.NEAREST)
        # What lies under an overhang: of all that faces a direction the last.
        self._far_body = context.texture((side, side), 4, dtype="f4")
        self._far_body.filter = (moderngl.NEAREST, moderngl.NEAREST)
        depth = context.depth_texture((side, side))
        self._body_target, self._far_target = (
            context.framebuffer([seen], depth) for seen in (self._body, self._far_body)
        )
        self._corners = 3 * len(faces)
        self._radiance = context.buffer(reserve=max(12 * len(vertices), 4))
        self._surface = context.vertex_array(
            programs.body,
            [
                (context.buffer(vertices.astype("f4").tobytes() or _NOTHING), "3f", "position"),
                (self._radiance, "3f", "radiance"),
            ],
            context.buffer(faces.astype("u4").tobytes() or _NOTHING),
        )
        half = sphere_directions(2 * detail.pairs)[: detail.pairs]
        self._directions = np.stack([half, -half], axis=1).reshape(-1, 3)
        self._frames = context.texture((6, 2 * detail.pairs), 3, dtype="f4")
        self._frames.filter = (moderngl.NEAREST, moderngl.NEAREST)
        self._body_sphere = self._hair_sphere = bounding_sphere(vertices)
        self._views = [
            parallel_view(direction, self._body_sphere.centre, self._body_sphere.radius)
            for direction in self._directions
        ]
        frames = np.array([[view.right, view.up, -view.forward] for view in self._views])
        counts = weights(self._directions).reshape(-1, 3, 3)
        self._frames.write(np.concatenate([frames, counts], axis=1).astype(np.float32))

    def see_hair(self, strips: LightStrips, sphere: Sphere) -> None:
        """Look at the hair, which lies within a sphere, from everywhere."""
        self._hair_sphere = sphere
        lights = [parallel_view(direction, sphere.centre, sphere.radius) for direction in self._directions]
        self._hair.fill(strips, np.eye(4), lights)

    def see_body(self, radiance: Floats) -> None:
        """Look at the body from everywhere; ``radiance`` of every vertex, linear RGB, (n, 3)."""
        self._radiance.write(radiance.astype("f4").tobytes())
        self._look_at_body(self._body_target, "<", moderngl.DEPTH_TEST)
        self._look_at_body(self._far_target, ">", moderngl.DEPTH_TEST | moderngl.CULL_FACE)

    def _look_at_body(self, target: moderngl.Framebuffer, nearer: str, flags: int) -> None:
        """From everywhere, where of what lies behind one another that is seen whose depth is ``nearer``."""
        with self._context.scope(target, flags):
            self._context.depth_func = nearer
            target.clear(0.0, 0.0, 0.0, _FAR, depth=1.0 if nearer == "<" else 0.0)
            for tile, light in enumerate(self._views):
                target.viewport = (
                    tile % self._tiles * BODY_SIZE,
                    tile // self._tiles * BODY_SIZE,
                    BODY_SIZE,
                    BODY_SIZE,
                )
                set_uniforms(self._programs.body, map_from_head=tuple(light.clip_from_world.T.ravel()))
                self._surface.render(vertices=self._corners)
            target.viewport = (0, 0, *target.size)
            self._context.depth_func = "<"

    def gather(self, places: Floats, sky: Sky, sent: Sent, clear: float = 0.0) -> Floats:
        """The light that arrives at ``places`` [m], (n, 3): (n, 8, 4), as render/soft_light.py says; none inside the body.

        sent: what strands do with it. clear: no strand is so near to a place [m].
        """
        self._frames.use(1)
        self._body.use(2)
        self._far_body.use(3)
        return receive(
            self._context, self._programs.gather, "gather", places, NUMBERS, directions=1, body=2, far_body=3,
            tiles=self._tiles, body_sphere=self._body_sphere.uniform, hair_sphere=self._hair_sphere.uniform,
            filling=filling(sent), sky_above=tuple(sky.above), sky_below=tuple(sky.below), upward=tuple(sky.upward), bias=_BIAS,
            clear=clear, **self._hair.bind(4), **self._hair.let_through(sent),
        )  # fmt: skip
