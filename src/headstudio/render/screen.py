"""Passes over the whole picture: one triangle that covers it, and a shader that works out every pixel."""

from __future__ import annotations

import moderngl

from .context import load_program, set_uniforms


class ScreenPasses:
    """The fragment shaders ``shaders/ROOM/NAME.frag``, ready to be drawn over a framebuffer."""

    def __init__(self, context: moderngl.Context, *names: str, room: str = "picture", **choices: int) -> None:
        """choices: what the shaders find defined."""
        programs = {
            name: load_program(context, "picture/screen.vert", f"{room}/{name}.frag", choices) for name in names
        }
        self._arrays = {name: context.vertex_array(program, []) for name, program in programs.items()}

    def draw(self, name: str, **uniforms: object) -> None:
        """Draw one of them into the framebuffer in use."""
        array = self._arrays[name]
        set_uniforms(array.program, **uniforms)
        array.render(moderngl.TRIANGLES, vertices=3)
