"""The view of the scene: shows the renderer's picture and gives the mouse to the camera or to a tool."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import moderngl
import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..render.renderer import Renderer
from ..scene.settings import Camera, Look
from ..scene.skin_settings import SkinSettings
from ..scene.stage import Stage
from ..scene.views import seen_from
from . import navigation
from .picking import View
from .studio import Studio
from .tools.tool import Canvas, Pointer, Tool
from .ui import Rect, Ui

LEFT, RIGHT, MIDDLE = 0, 1, 2
# Parts of the full resolution; the picture is drawn coarser while it moves if a frame would take longer than this [s].
RESOLUTIONS = (1.0, 0.75, 0.5)
SLOW_FRAME, FAST_FRAME = 0.045, 0.018
STILL_AFTER = 4  # frames in a row with nothing new to see


@dataclass(frozen=True)
class _Drawn:
    """What the picture shows."""

    stage: Stage
    look: Look
    camera: Camera
    skin: SkinSettings
    size: tuple[int, int]
    supersampling: int

    def same_scene(self, other: _Drawn | None) -> bool:
        """Whether both show the same things from the same place, in whatever resolution."""
        return other is not None and self == replace(other, size=self.size, supersampling=self.supersampling)


class Viewport:
    """The middle of the window. ``tool`` is what the left button does."""

    def __init__(self, studio: Studio, gl: moderngl.Context, tool: Tool) -> None:
        self.studio = studio
        self.renderer = Renderer(gl)
        # Without it the time of a picture would not be known: OpenGL draws behind the caller's back.
        self.renderer.timer.on = True
        self.tool = tool
        self.adaptive = True
        self.rect = Rect(0, 0, 1, 1)
        self._pixels_per_unit = 1.0
        self._resolution = 0
        self._still_for = 0
        self._drawn: _Drawn | None = None
        self._held: str | None = None

    def draw(self, ui: Ui, size: tuple[float, float], pixels_per_unit: float) -> None:
        """Draw the view in the current ImGui window, ``size`` in window units."""
        corner = imgui.get_cursor_screen_pos()
        self.rect = Rect(corner.x, corner.y, *size)
        flags = imgui.ButtonFlags_
        buttons = flags.mouse_button_left.value | flags.mouse_button_right.value | flags.mouse_button_middle.value
        # Buttons and messages lie on top of it and come first.
        imgui.set_next_item_allow_overlap()
        imgui.invisible_button("##view", size, buttons)
        ui.note("Viewport")
        self._take_mouse(imgui.is_item_hovered(), imgui.is_item_active())
        self._pixels_per_unit = pixels_per_unit
        self._render(pixels_per_unit)
        drawing = imgui.get_window_draw_list()
        far = (corner.x + size[0], corner.y + size[1])
        if self._drawn is not None:
            texture = imgui.ImTextureRef(self.renderer.colour_texture)
            # OpenGL counts rows from below.
            drawing.add_image(texture, (corner.x, corner.y), far, (0, 1), (1, 0))
        drawing.push_clip_rect((corner.x, corner.y), far, True)
        self.tool.draw(Canvas(drawing, self.view, self.frame, corner.x, corner.y, ui.scale))
        drawing.pop_clip_rect()

    @property
    def view(self) -> View:
        """The camera over the picture as it lies in the window."""
        return View(self.studio.document.camera, self.rect.width, self.rect.height)

    @property
    def frame(self) -> HeadFrame:
        """Where the head is in the picture."""
        return self.studio.stage.frame if self.studio.stage else HeadFrame()

    def frame_all(self) -> None:
        """See head and hair in full."""
        self._frame_points(everything=True)

    def frame_head(self) -> None:
        """See the head alone, up close."""
        self._frame_points(everything=False)

    def look_from(self, name: str) -> None:
        """Look from one of the named sides."""
        self.studio.work.look(seen_from(self.studio.document.camera, name), name.capitalize())

    def picture(self, supersampling: int = 1) -> NDArray[np.uint8]:
        """What is on show, at the full resolution of the view, shape (height, width, 3), first row on top.

        ``supersampling``: how many times finer it is drawn before every pixel takes the mean.
        """
        self._render(self._pixels_per_unit, supersampling)
        return self.renderer.read_pixels()

    def _frame_points(self, *, everything: bool) -> None:
        stage = self.studio.stage
        if stage is None:
            return
        head = stage.frame.skinned(stage.head.skin.vertices, stage.head.head_weight)
        points: list[Floats] = [head if everything else head[stage.head.head_weight > 0.9]]
        if everything and stage.hair is not None:
            points.append(stage.frame.to_world(stage.hair.positions))
        if everything and stage.strands is not None:
            points.append(stage.frame.to_world(stage.strands.points.astype(np.float64)))
        camera = navigation.frame(
            self.studio.document.camera, np.concatenate(points), self.rect.width / self.rect.height
        )
        self.studio.work.look(camera, "Frame all" if everything else "Frame head")

    def _render(self, pixels_per_unit: float, supersampling: int | None = None) -> None:
        """Draw the scene, unless nothing in it has changed; without ``supersampling`` maybe coarser while it moves."""
        stage, document = self.studio.stage, self.studio.document
        if stage is None:
            return
        if supersampling is None:
            stage = self.tool.dress(stage)
        hasty = supersampling is None and self.adaptive
        full = _Drawn(
            stage, document.look, document.camera, document.skin, self._size(pixels_per_unit), supersampling or 1
        )
        self._still_for = self._still_for + 1 if full.same_scene(self._drawn) else 0
        playing = self.studio.playback.playing and self._still_for < STILL_AFTER
        moving = hasty and (playing or self._held is not None)
        part = RESOLUTIONS[self._resolution] if moving else 1.0
        wanted = replace(full, size=self._size(pixels_per_unit * part))
        if wanted == self._drawn:
            return
        started = time.perf_counter()
        with self.studio.reporting() as outcome:
            self.renderer.render(
                stage,
                document.look,
                document.camera,
                wanted.size,
                supersampling=wanted.supersampling,
                skin=document.skin,
            )
        # A picture that failed is not tried again until something changes.
        self._drawn = wanted
        if outcome.good and moving:
            self._adapt(time.perf_counter() - started)

    def _size(self, density: float) -> tuple[int, int]:
        """Pixels of a picture with so many of them to a unit of the window."""
        return max(int(self.rect.width * density), 16), max(int(self.rect.height * density), 16)

    def _adapt(self, seconds: float) -> None:
        if seconds > SLOW_FRAME and self._resolution < len(RESOLUTIONS) - 1:
            self._resolution += 1
        elif seconds < FAST_FRAME and self._resolution > 0:
            self._resolution -= 1

    def _take_mouse(self, hovered: bool, active: bool) -> None:
        io = imgui.get_io()
        camera = self.studio.document.camera
        if hovered and io.mouse_wheel:
            self.studio.work.look(navigation.zoom(camera, io.mouse_wheel))
        if self._held is None and hovered:
            self._begin(io)
        elif self._held is not None and not active:
            self._end()
        if self._held == "tool":
            self.tool.drag(self._pointer(io))
        elif self._held is not None and (io.mouse_delta.x or io.mouse_delta.y):
            across, down = io.mouse_delta.x / self.rect.height, io.mouse_delta.y / self.rect.height
            moved = {
                "orbit": lambda: navigation.orbit(camera, across, down),
                "pan": lambda: navigation.pan(camera, across, down),
                "zoom": lambda: navigation.zoom(camera, 12 * (across - down)),
            }[self._held]()
            self.studio.work.look(moved)

    def _begin(self, io: imgui.IO) -> None:
        if imgui.is_mouse_clicked(MIDDLE):
            self._held = "pan"
        elif imgui.is_mouse_clicked(RIGHT):
            self._held = "zoom"
        elif imgui.is_mouse_clicked(LEFT):
            for_tool = not io.key_alt and (self.tool.takes_shift or not io.key_shift)
            if for_tool and self.tool.press(self._pointer(io)):
                self._held = "tool"
            else:
                self._held = "pan" if io.key_shift else "orbit"
        if self._held not in (None, "tool"):
            self.studio.work.begin_gesture(str(self._held).capitalize(), "camera.")

    def _end(self) -> None:
        if self._held == "tool":
            self.tool.release()
        self.studio.work.end_gesture()
        self._held = None

    def _pointer(self, io: imgui.IO) -> Pointer:
        stage = self.studio.stage
        x, y = io.mouse_pos.x - self.rect.x, io.mouse_pos.y - self.rect.y
        return Pointer(x, y, self.view, stage.head if stage else None, self.frame, io.key_ctrl, io.key_shift)
