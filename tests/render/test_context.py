from __future__ import annotations

import os
from pathlib import Path

import moderngl
import numpy as np
import pytest

from headstudio.render import context as context_module
from headstudio.render.context import RenderError, headless_context, load_program, set_uniforms


def test_no_opengl_is_one_clear_line(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(**_: object) -> moderngl.Context:
        raise Exception("libEGL not\nloaded")

    monkeypatch.setattr(moderngl, "create_context", fail)
    with pytest.raises(RenderError, match="libEGL not loaded") as caught:
        headless_context()
    assert "\n" not in str(caught.value)
    assert "libegl1" in str(caught.value)


def test_context_is_at_least_what_macos_has(gl: moderngl.Context) -> None:
    assert gl.version_code >= context_module.GL_VERSION


def test_broken_shader_names_its_file(gl: moderngl.Context, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "broken.vert").write_text("#version 330\nvoid main() { gl_Position = nothing; }\n")
    (tmp_path / "broken.frag").write_text("#version 330\nvoid main() {}\n")
    monkeypatch.setattr(context_module, "shader", lambda name: tmp_path / name)
    with pytest.raises(RenderError, match=r"broken\.vert(.|\n)*nothing"):
        load_program(gl, "broken.vert", "broken.frag")


def test_uniforms_that_are_not_used_are_passed_over(gl: moderngl.Context) -> None:
    program = gl.program(
        vertex_shader="#version 330\nuniform float size; void main() { gl_Position = vec4(size); }",
        fragment_shader="#version 330\nvoid main() {}",
    )
    set_uniforms(program, size=2.0, colour=(1.0, 0.0, 0.0))
    assert program["size"].value == 2.0  # type: ignore[union-attr]


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="only Linux says how much memory is taken")
def test_contexts_that_nobody_holds_give_their_memory_back() -> None:
    """Each command that draws makes one, and all that it drew with would stay: a test run would take 16 GB."""

    def draw() -> None:
        with headless_context() as context:
            sheet = context.framebuffer([context.texture((2048, 1024), 4, dtype="f4")])
            sheet.clear(0.5, 0.5, 0.5, 0.5)
            assert sheet.read(viewport=(0, 0, 1, 1), components=1, dtype="f4") == np.float32(0.5).tobytes()

    def taken() -> float:
        return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20

    draw()
    before = taken()
    for _ in range(8):
        draw()
    assert taken() - before < 2 * 32  # megabytes: one sheet has 32
