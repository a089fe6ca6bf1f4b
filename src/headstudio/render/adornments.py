"""What is worn in the hair - bands, pins, ribbons, elastics - on the graphics card."""

from __future__ import annotations

from collections.abc import Sequence

import igl
import moderngl
import numpy as np

from ..head.mesh import Floats
from ..wisp.adornment import Adornment
from .buffers import floats_of
from .context import load_program, set_uniforms
from .scene_block import linear

# Where faces meet at more than this angle [degrees] there is an edge to be seen: that of a ribbon, but none of a tube.
_SHARP = 50.0


class AdornmentPrograms:
    """The shaders of what is worn."""

    def __init__(self, context: moderngl.Context) -> None:
        self.surface = load_program(context, "worn/adornment.vert", "worn/adornment.frag")
        self.depth = load_program(context, "body/depth.vert", "body/depth.frag")


class Adornments:
    """Everything worn in one hairstyle; made once for it, and turned with the head."""

    def __init__(self, context: moderngl.Context, programs: AdornmentPrograms, worn: Sequence[Adornment]) -> None:
        """worn: one or more, in the head frame."""
        self.worn = worn
        corners = np.concatenate([_corners(adornment) for adornment in worn])
        surface = context.buffer(floats_of(corners))
        turning = context.buffer(floats_of(np.ones(len(corners))))
        self._surface = context.vertex_array(programs.surface, [(surface, "3f 3f 3f", "position", "normal", "tint")])
        self._depth = context.vertex_array(
            programs.depth, [(surface, "3f 24x", "position"), (turning, "1f", "head_weight")]
        )

    def draw_depth(self) -> None:
        """Into the shadow map."""
        self._depth.render()

    def draw(self) -> None:
        """Into the framebuffer in use; texture 0 is the shadow map, 1 the light map."""
        set_uniforms(self._surface.program, shadow_map=0, light_map=1)
        self._surface.render()


def _corners(adornment: Adornment) -> Floats:
    """Place [m], normal and linear colour of the corners of all faces, (3 m, 9)."""
    mesh = adornment.mesh
    places = mesh.vertices[mesh.faces].reshape(-1, 3)
    normals = igl.per_corner_normals(mesh.vertices, mesh.faces, _SHARP)
    tint = np.broadcast_to(linear(adornment.colour), places.shape)
    return np.concatenate([places, normals, tint], axis=1)
