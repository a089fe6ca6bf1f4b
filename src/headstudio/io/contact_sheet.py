"""Many pictures on one sheet, each with a line below it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

_GAP = 6
_PAPER = (24, 25, 27)
_INK = (214, 214, 210)


def contact_sheet(
    frames: Sequence[NDArray[np.uint8]], captions: Sequence[str] | None = None, columns: int = 4
) -> NDArray[np.uint8]:
    """Tile ``frames``, (height, width, 3) each, row by row; ``captions`` go below them, one each.

    Frames of different sizes are set in the middle of the largest. Raises ValueError for no frames, or when there are
    not as many captions as frames.
    """
    if not frames:
        raise ValueError("a contact sheet needs at least one picture")
    if captions is not None and len(captions) != len(frames):
        raise ValueError(f"{len(captions)} captions for {len(frames)} pictures")
    height = max(frame.shape[0] for frame in frames)
    width = max(frame.shape[1] for frame in frames)
    text_size = max(11, height // 22)
    strip = 2 * text_size if captions else 0
    columns = min(columns, len(frames))
    rows = -(-len(frames) // columns)
    cell = (width + _GAP, height + strip + _GAP)
    sheet = Image.new("RGB", (columns * cell[0] + _GAP, rows * cell[1] + _GAP), _PAPER)
    draw = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(text_size)
    for k, frame in enumerate(frames):
        left, top = _GAP + (k % columns) * cell[0], _GAP + (k // columns) * cell[1]
        inset = ((width - frame.shape[1]) // 2, (height - frame.shape[0]) // 2)
        sheet.paste(Image.fromarray(frame), (left + inset[0], top + inset[1]))
        if captions:
            draw.text((left + width / 2, top + height + strip / 2), captions[k], _INK, font, anchor="mm")
    return np.asarray(sheet)
