"""How much of its sky every point of a body sees: soft light is dimmer in nostrils, between lips and under the chin."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats, TriangleMesh
from .context import load_program, set_uniforms
from .particle_texture import ROW
from .view import parallel_view

_DIRECTIONS = 64
_MAP_SIZE = 512
# Points are lifted off their surface by this much [m], about a texel of the map, so as not to be in their own way.
_OFFSET = 0.0012


def hidden_from_sky(context: moderngl.Context, body: TriangleMesh, points: Floats, normals: Floats) -> Floats:
    """The part of its half of the sky, weighted by the cosine, that ``body`` hides from each point, 0 to 1, (n,).

    points [m] and unit normals, (n, 3). The body's depth is drawn from directions spread evenly over the whole sky, and
    every point asks each map whether it is seen. Ray casting would give the same, later and less repeatably.
    """
    depth_program = load_program(context, "sky/depth.vert", "body/depth.frag")
    seen_program = load_program(context, "sky/seen.vert", "light/particle.frag")
    depth = context.depth_texture((_MAP_SIZE, _MAP_SIZE))
    depth.compare_func = "<="
    map_target = context.framebuffer([], depth)
    rows = max(1, -(-len(points) // ROW))
    sums = context.texture((ROW, rows), 4, dtype="f4")
    sum_target = context.framebuffer([sums])
    sum_target.clear()

    surface = context.vertex_array(
        depth_program,
        [(context.buffer(body.vertices.astype(np.float32).tobytes()), "3f", "position")],
        context.buffer(body.faces.astype(np.uint32).tobytes()),
    )
    asking = context.buffer(np.concatenate([points, normals], axis=1).astype(np.float32).tobytes())
    askers = context.vertex_array(seen_program, [(asking, "3f 3f", "position", "normal")])
    set_uniforms(seen_program, depth_map=0, rows=rows, offset=_OFFSET)
    depth.use(0)
    centre = body.bounds.mean(axis=0)
    radius = float(np.linalg.norm(body.vertices - centre, axis=1).max()) + 4 * _OFFSET
    for direction in sphere_directions(_DIRECTIONS):
        matrix = parallel_view(direction, centre, radius).clip_from_world.T.astype(np.float32)
        set_uniforms(depth_program, map_from_world=tuple(matrix.ravel()))
        set_uniforms(seen_program, map_from_world=tuple(matrix.ravel()), direction=tuple(direction))
        with context.scope(map_target, moderngl.DEPTH_TEST):
            map_target.clear(depth=1.0)
            surface.render()
        with context.scope(sum_target, moderngl.BLEND | moderngl.PROGRAM_POINT_SIZE):
            context.blend_func = moderngl.ONE, moderngl.ONE
            askers.render(moderngl.POINTS)
    seen, all_ = np.frombuffer(sums.read(), np.float32).reshape(-1, 4)[: len(points), :2].astype(np.float64).T
    return 1.0 - np.divide(seen, all_, out=np.ones_like(seen), where=all_ > 0)


def sphere_directions(count: int) -> Floats:
    """Directions spread evenly, (count, 3): a Fibonacci spiral."""
    k = np.arange(count) + 0.5
    height = 1 - 2 * k / count
    around = k * np.pi * (3 - np.sqrt(5))
    level = np.sqrt(1 - height**2)
    return np.stack([level * np.cos(around), height, level * np.sin(around)], axis=1)
