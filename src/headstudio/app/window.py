"""The life of the window: GLFW, an OpenGL 3.3 context, moderngl and Dear ImGui on top of it.

This is the only module that touches GLFW. A window without a screen works the same way: GLFW's null platform gives it
size and input, EGL gives it OpenGL.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from pathlib import Path

import moderngl
import numpy as np
from imgui_bundle import imgui, implot
from numpy.typing import NDArray

# isort: split
import glfw  # after imgui_bundle, which says which libglfw is loaded: both must drive the same one

from ..render.context import collecting

SMALLEST = (960, 600)


class WindowError(RuntimeError):
    """No window can be opened here. The message is one line for the user."""


class Window:
    """A window that owns the OpenGL context, and the frame of Dear ImGui drawn in it.

    ``on_drop`` is called with the paths of files that are dropped on the window. Raises WindowError when there is no
    display or no OpenGL 3.3.
    """

    def __init__(self, title: str, size: tuple[int, int] = (1440, 900), *, headless: bool = False) -> None:
        self.on_drop: Callable[[list[Path]], None] = lambda paths: None
        self.headless = headless
        self._handle = _open(title, size, headless)
        glfw.make_context_current(self._handle)
        glfw.swap_interval(0 if headless else 1)
        if not headless:
            glfw.set_window_size_limits(self._handle, *SMALLEST, glfw.DONT_CARE, glfw.DONT_CARE)
        # GLFW's Python layer gives a list of paths, whatever its type says.
        glfw.set_drop_callback(self._handle, self._take_dropped)  # type: ignore[arg-type]
        try:
            # Of the window's context, whatever made it and whatever other contexts this process has.
            moderngl.init_context()
            self.gl = collecting(moderngl.get_context())
        except Exception as error:  # moderngl raises plain Exceptions, with the reason in the text
            self._destroy()
            raise WindowError(f"this machine gives no OpenGL 3.3 ({error}); run headstudio demo instead") from None
        self._imgui = imgui.create_context()
        self._implot = implot.create_context()
        # The layout is the studio's own, so there is nothing for ImGui to keep between two runs.
        imgui.get_io().set_ini_filename("")
        imgui.get_io().config_flags |= imgui.ConfigFlags_.nav_enable_keyboard.value
        address = ctypes.cast(self._handle, ctypes.c_void_p).value or 0
        imgui.backends.glfw_init_for_opengl(address, True)
        imgui.backends.opengl3_init("#version 330")
        if headless:
            # The mouse is where the events say, and not where a system has left its cursor.
            imgui.backends.glfw_cursor_enter_callback(address, 1)

    @property
    def scale(self) -> float:
        """How many window units a text unit of a plain screen takes: 2 on many HiDPI screens, 1 where the system scales."""
        content = glfw.get_window_content_scale(self._handle)[0]
        return content / max(self.pixels_per_unit, 1e-6)

    @property
    def pixels_per_unit(self) -> float:
        """Pixels of the framebuffer for one window unit: 2 on a Retina screen, 1 elsewhere."""
        width = glfw.get_window_size(self._handle)[0]
        return glfw.get_framebuffer_size(self._handle)[0] / width if width else 1.0

    @property
    def minimised(self) -> bool:
        """True while there is nothing to draw on."""
        return 0 in glfw.get_framebuffer_size(self._handle)

    @property
    def close_asked(self) -> bool:
        """True once the user asked to close the window; ``keep_open`` answers no."""
        return bool(glfw.window_should_close(self._handle))

    def keep_open(self) -> None:
        """Take back the wish to close."""
        glfw.set_window_should_close(self._handle, False)

    def set_title(self, title: str) -> None:
        """Write the title bar."""
        glfw.set_window_title(self._handle, title)

    def sleep(self, seconds: float) -> None:
        """Wait for an event, at most ``seconds``, without drawing."""
        glfw.wait_events_timeout(seconds)

    def begin_frame(self, seconds: float | None = None, wait: float = 0.0) -> None:
        """Take the events and start a frame of ImGui.

        ``seconds``: length of the frame for ImGui's clock, None for the wall clock. ``wait``: how long [s] to sleep
        for an event when there is nothing to animate.
        """
        if wait > 0:
            glfw.wait_events_timeout(wait)
        else:
            glfw.poll_events()
        # A picture that was drawn without the window, in a context of its own, has left that one current.
        glfw.make_context_current(self._handle)
        imgui.backends.opengl3_new_frame()
        imgui.backends.glfw_new_frame()
        if seconds is not None:
            imgui.get_io().delta_time = seconds
        imgui.new_frame()

    def end_frame(self, background: tuple[float, float, float]) -> None:
        """Draw the frame and show it."""
        imgui.render()
        self.gl.screen.use()
        # The viewport may have changed size, or a render pass set its own.
        self.gl.screen.viewport = (0, 0, *glfw.get_framebuffer_size(self._handle))
        self.gl.screen.clear(*background)
        imgui.backends.opengl3_render_draw_data(imgui.get_draw_data())
        glfw.swap_buffers(self._handle)

    def picture(self) -> NDArray[np.uint8]:
        """What was drawn last, shape (height, width, 3), first row on top. Call between ``end_frame`` and the next."""
        size = glfw.get_framebuffer_size(self._handle)
        # By way of a framebuffer of our own: moderngl reads a window's through an attachment that it does not have.
        # It is not released by hand: the context collects what nobody holds, and stumbles over what is gone already.
        copy = self.gl.simple_framebuffer(size, 4)
        self.gl.copy_framebuffer(copy, self.gl.screen)
        pixels = np.frombuffer(copy.read(components=3, alignment=1), np.uint8)
        self.gl.screen.use()
        return pixels.reshape(size[1], size[0], 3)[::-1].copy()

    def close(self) -> None:
        """Give everything back."""
        imgui.backends.opengl3_shutdown()
        imgui.backends.glfw_shutdown()
        implot.destroy_context(self._implot)
        imgui.destroy_context(self._imgui)
        self.gl.release()
        self._destroy()

    def _take_dropped(self, _: object, paths: Sequence[str]) -> None:
        self.on_drop([Path(path) for path in paths])

    def _destroy(self) -> None:
        glfw.destroy_window(self._handle)
        glfw.terminate()


def _open(title: str, size: tuple[int, int], headless: bool) -> ctypes._Pointer:  # type: ignore[type-arg]
    glfw.ERROR_REPORTING = "ignore"  # failures are answered here, in one line
    glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_NULL if headless else glfw.ANY_PLATFORM)
    if not glfw.init():
        raise WindowError("there is no display to open a window on; run headstudio demo to get pictures and a film")
    if headless:
        glfw.window_hint(glfw.CONTEXT_CREATION_API, glfw.EGL_CONTEXT_API)
    glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
    glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
    glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
    glfw.window_hint(glfw.OPENGL_FORWARD_COMPAT, True)
    glfw.window_hint(glfw.SCALE_TO_MONITOR, True)
    handle = glfw.create_window(*size, title, None, None)
    if not handle:
        _, reason = glfw.get_error()
        glfw.terminate()
        text = reason.decode(errors="replace") if isinstance(reason, bytes) else reason
        raise WindowError(f"no window with OpenGL 3.3 ({text or 'unknown reason'}); run headstudio demo instead")
    return handle
