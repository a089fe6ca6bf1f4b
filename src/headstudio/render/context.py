"""The OpenGL context and the programs that run in it."""

from __future__ import annotations

import weakref
from collections.abc import Mapping

import moderngl

from ..resources import shader

GL_VERSION = 330
"""OpenGL 3.3 core is all that drawing needs; macOS stops at 4.1."""


class RenderError(RuntimeError):
    """No picture can be drawn on this machine, or of this size. The message is one line for the user."""


def headless_context() -> moderngl.Context:
    """An OpenGL 3.3 context without a window, through EGL (Mesa's llvmpipe where there is no graphics card).

    It is given back, with all that was made in it, when nothing refers to it any more. Raises RenderError, in one line,
    if there is none.
    """
    try:
        context = moderngl.create_context(standalone=True, require=GL_VERSION, backend="egl")  # type: ignore[arg-type]
    except Exception as error:  # glcontext raises bare Exception, moderngl its own and ValueError
        reason = " ".join(str(error).split()) or type(error).__name__
        raise RenderError(
            f"no OpenGL 3.3 without a window ({reason}); on Debian: apt install libegl1 libgl1 libgl1-mesa-dri"
        ) from None
    # moderngl keeps a context of its own making for as long as the program runs.
    weakref.finalize(context, context.mglo.release).atexit = False
    return collecting(context)


def collecting(context: moderngl.Context) -> moderngl.Context:
    """The context, which from now on gathers what nobody refers to any more; its ``gc()`` frees it.

    Python drops an object wherever it happens to be, and OpenGL may only free it while the context is current.
    """
    context.gc_mode = "context_gc"
    return context


def is_software(context: moderngl.Context) -> bool:
    """True on Mesa's llvmpipe, whose pictures do not change from machine to machine by more than a rounding."""
    return "llvmpipe" in context.info["GL_RENDERER"]


def load_program(
    context: moderngl.Context, vertex: str, fragment: str, choices: Mapping[str, int] | None = None
) -> moderngl.Program:
    """The program made of two shaders below ``shaders/``; ``#include "common/x.glsl"`` brings in a shared piece.

    choices: what the fragment shader finds defined. A processor works out both sides of what is asked at every pixel, but
    of what is asked when the shader is compiled only the one. The uniform block ``Scene``, if the program has it, is bound
    to slot 0. Raises RenderError with the compiler's words if a shader does not compile.
    """
    for include in sorted(shader("common").glob("*.glsl")):
        context.includes[f"common/{include.name}"] = include.read_text()
    try:
        program = context.program(
            vertex_shader=shader(vertex).read_text(),
            fragment_shader=_with_choices(shader(fragment).read_text(), choices or {}),
        )
    except moderngl.Error as error:
        raise RenderError(f"{vertex} with {fragment}: {error}") from None
    if "Scene" in program:
        program["Scene"].binding = 0  # type: ignore[union-attr]
    return program


def _with_choices(source: str, choices: Mapping[str, int]) -> str:
    version, _, rest = source.partition("\n")
    return "\n".join([version, *(f"#define {name} {value}" for name, value in choices.items()), rest])


def set_uniforms(program: moderngl.Program, **values: object) -> None:
    """Set uniforms by name; one that the compiler found no use for is passed over."""
    for name, value in values.items():
        uniform = program.get(name, None)
        if uniform is not None:
            uniform.value = value  # type: ignore[union-attr]
