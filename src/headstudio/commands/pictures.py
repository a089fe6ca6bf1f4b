"""``headstudio render``: one picture of a document. Also the camera that the other commands film with."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..params import ParameterError
from ..render.context import headless_context
from ..render.renderer import Renderer
from ..scene.document import Document
from ..scene.motion import Motion
from ..scene.stage import Stage
from .documents import animate
from .reporting import counting

Size = tuple[int, int]
Pixels = NDArray[np.uint8]

# A picture of a moment in a motion is reached in steps of a film, like the frames of one.
APPROACH_RATE = 30.0

LARGEST_SIDE = 16384  # no OpenGL here draws more; what draws less says so by itself


class Photographer:
    """Takes pictures of stages as a document wants them to look, without a window. Raises RenderError without OpenGL."""

    def __init__(self, size: Size) -> None:
        self.size = size
        self.renderer = Renderer(headless_context())
        self.renderer.timer.on = True

    @property
    def device(self) -> str:
        """What draws: the graphics card, or llvmpipe."""
        return str(self.renderer.context.info["GL_RENDERER"])

    @property
    def cost(self) -> dict[str, float]:
        """What the stages of the last picture took, by name [ms]: "ms_light" and so on."""
        return self.renderer.timer.stages

    def picture(self, stage: Stage, document: Document) -> Pixels:
        """The stage as pixels, top row first, (height, width, 3)."""
        self.renderer.render(stage, document.look, document.camera, self.size, skin=document.skin)
        return self.renderer.read_pixels()

    def still(self, stage: Stage, document: Document, size: Size) -> Pixels:
        """The stage in a size of its own, drawn twice as fine as its pixels: (height, width, 3)."""
        self.renderer.render(stage, document.look, document.camera, size, supersampling=2, skin=document.skin)
        return self.renderer.read_pixels()

    def final(self, stage: Stage, document: Document, size: Size) -> Pixels:
        """The stage in final quality, all strands and a bar that fills up: (height, width, 3)."""
        with counting("drawing", 1) as bar:

            def progress(done: int, of: int) -> bool:
                bar.update(bar.task_ids[0], completed=done, total=of)
                return True

            self.renderer.render_final(stage, document.look, document.camera, size, progress, skin=document.skin)
        return self.renderer.read_pixels()


def parse_size(words: str) -> Size:
    """``512`` or ``640x480`` as width and height. Raises ParameterError."""
    match = re.fullmatch(r"(\d+)(?:x(\d+))?", words)
    if not match:
        raise ParameterError(f"a size is one number of pixels or two, 512 or 640x480; got {words!r}")
    size = int(match[1]), int(match[2] or match[1])
    if not 1 <= min(size) <= max(size) <= LARGEST_SIDE:
        raise ParameterError(f"a picture has 1 to {LARGEST_SIDE} pixels a side; got {words!r}")
    return size


def render(document: Document, motion: Motion, seconds: float, size: Size, out: Path) -> None:
    """Write the document as a picture, ``seconds`` after the start of the motion. Raises what building raises."""
    check_is_picture(out)
    photographer = Photographer(size)
    animation = animate(document)
    steps = round(seconds * APPROACH_RATE)
    with counting("simulating", steps) as progress:
        for _ in range(steps):
            animation.advance(motion, seconds / steps)
            progress.advance(progress.task_ids[0])
    save_picture(photographer.picture(animation.stage(), document), out)


def check_is_picture(path: Path) -> None:
    """Raise ParameterError for a name that no picture is written under, before the work begins."""
    if path.suffix.lower() != ".png":
        raise ParameterError(f"a picture is written as PNG: give a name that ends in .png, not {str(path)!r}")


def save_picture(pixels: Pixels, path: Path) -> None:
    """Write pixels, (height, width, 3), as PNG. Makes the folder; raises OSError."""
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(pixels).save(path, "PNG")
