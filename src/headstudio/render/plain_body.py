"""Meshes as they are, in one colour: the body below hair in pictures that are compared with other programs'."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np

from ..head.mesh import Floats
from ..head.refine import ShadedMesh
from .context import load_program, set_uniforms

_NOTHING = bytes(24)  # a buffer cannot be empty


class PlainBodyPrograms:
    """The shaders of plain meshes."""

    def __init__(self, context: moderngl.Context) -> None:
        self.body = load_program(context, "plain/body.vert", "plain/body.frag")
        self.depth = load_program(context, "plain/depth.vert", "body/depth.frag")


class PlainBody:
    """Meshes as one body; vertices [m], (n, 3), normals, (n, 3), and faces, (m, 3), of all of them."""

    def __init__(self, context: moderngl.Context, programs: PlainBodyPrograms, surfaces: Sequence[ShadedMesh]) -> None:
        self._programs = programs
        starts = np.cumsum([0, *(len(surface.normals) for surface in surfaces)])
        self.vertices = np.concatenate([np.zeros((0, 3)), *(surface.mesh.vertices for surface in surfaces)])
        self.normals = np.concatenate([np.zeros((0, 3)), *(surface.normals for surface in surfaces)])
        self.faces = np.concatenate(
            [np.zeros((0, 3), np.int64), *(surface.mesh.faces + start for surface, start in zip(surfaces, starts))]
        )
        corners = context.buffer(
            np.concatenate([self.vertices, self.normals], axis=1).astype("f4").tobytes() or _NOTHING
        )
        self._soft = context.buffer(reserve=max(12 * len(self.vertices), 4))
        indices = context.buffer(self.faces.astype("u4").tobytes() or _NOTHING)
        self._body = context.vertex_array(
            programs.body, [(corners, "3f 3f", "position", "normal"), (self._soft, "3f", "soft")], indices
        )
        self._depth = context.vertex_array(programs.depth, [(corners, "3f 12x", "position")], indices)

    def set_soft_light(self, irradiance: Floats) -> None:
        """The irradiance of the soft light at every vertex, linear RGB, (n, 3)."""
        self._soft.write(irradiance.astype("f4").tobytes())

    def draw_depth(self) -> None:
        """Into the shadow map."""
        self._depth.render(vertices=3 * len(self.faces))

    def draw(self, diffuse: Floats, **uniforms: object) -> None:
        """Into the framebuffer in use; uniforms of common/shadow.glsl and common/deep_opacity.glsl."""
        set_uniforms(self._programs.body, diffuse=tuple(diffuse), **uniforms)
        self._body.render(vertices=3 * len(self.faces))
