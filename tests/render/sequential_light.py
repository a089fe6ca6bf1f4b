"""The light pass as the thesis prints it (section 3.4, lines 6 to 12): one particle at a time, read, then draw."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from headstudio.head.mesh import Floats
from headstudio.render.strand_texture import ENDS


def reduced(image: Floats, level: int) -> Floats:
    """Level ``level`` of a mip-map pyramid: every step takes the mean of 2 x 2 texels."""
    for _ in range(level):
        image = (image[::2, ::2] + image[1::2, ::2] + image[::2, 1::2] + image[1::2, 1::2]) / 4
    return image


def nearest(image: Floats, u: Floats, v: Floats) -> Floats:
    """An image read at the nearest texel, as OpenGL reads it: repeating along u, clamped along v."""
    rows, columns = image.shape
    row = np.clip(np.floor(v * rows).astype(int), 0, rows - 1)
    return image[row, np.floor(u * columns).astype(int) % columns]


def sequential_light(billboards: NDArray[np.void], lit: Floats, strands: Floats, size: int) -> tuple[Floats, Floats]:
    """Light on every particle, (n,), by its index, and the light map, (size, size), row 0 at the bottom.

    billboards: BILLBOARD_DTYPE, nearest to the light first. lit: what comes past the objects, by index, (n,). strands: the
    opacity of the strand texture at the mip level of the light pass.
    """
    light_map = np.ones((size, size))
    light = np.empty(len(billboards))
    for board in billboards:
        column, row = np.floor(board["centre"]).astype(int)
        particle = int(board["particle"])
        light[particle] = lit[particle] * light_map[row, column]
        _draw(light_map, board, lit[particle], strands)
    return light, light_map


def _draw(light_map: Floats, board: Any, lit: float, strands: Floats) -> None:
    size = len(light_map)
    reach = abs(board["half_width"]) + abs(board["half_length"])
    low = np.clip(np.floor(board["centre"] - reach).astype(int), 0, size)
    high = np.clip(np.ceil(board["centre"] + reach).astype(int), 0, size)
    x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
    dx, dy = x - board["centre"][0], y - board["centre"][1]
    ax, ay = board["axis"]
    across = (dx * ay - dy * ax) / board["half_width"]
    along = (dx * ax + dy * ay) / board["half_length"]
    t = 1 - across**2
    # Before the rows where strands end; billboards go over one into the other.
    opacity = nearest(strands, board["window"] + 0.5 * board["window_width"] * across, 0.5 * ENDS * (1 + along))
    opacity = opacity * t * (2 - t) * (1 - along**2) * board["opacity"] * lit
    inside = (np.abs(across) < 1) & (np.abs(along) < 1)
    light_map[low[1] : high[1], low[0] : high[0]] *= np.where(inside, 1 - opacity, 1.0)
