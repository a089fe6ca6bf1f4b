"""The steps of section 2.6.2 one after the other, furrow by furrow and segment by segment, as plainly as they are printed."""

from __future__ import annotations

import math

import numpy as np

from headstudio.wrinkle.direction_field import DirectionField
from headstudio.wrinkle.growth import RANDOM_NUMBERS

Point = tuple[float, float]


def carve_one_by_one(field: DirectionField, seed: int) -> list[tuple[Point, Point]]:
    """P and Q of all carved segments [texels] by the printed laws, on a map that does not wrap around."""
    rng = np.random.default_rng(seed)
    random = rng.uniform(-1, 1, RANDOM_NUMBERS)
    size = field.texels.size
    occupied = ~field.texels.mapped
    starts = rng.permutation(np.flatnonzero(field.texels.mapped))
    luck = rng.integers(RANDOM_NUMBERS, size=len(starts))
    jitter = rng.uniform(-0.5, 0.5, (len(starts), 2))
    furrows: list[list[tuple[Point, Point]]] = []
    for texel, place, (dx, dy) in zip(starts, luck, jitter):
        row, column = divmod(int(texel), size)
        if occupied[row, column]:
            continue
        occupied[row, column] = True
        furrow: list[tuple[Point, Point]] = []
        for side in (0, 1):
            p, n, order = (column + 0.5 + dx, row + 0.5 + dy), math.inf, 0
            while True:
                sample = field.at(np.array([p]))
                if sample.triangles[0] < 0:
                    break
                m = float(sample.magnitudes[0])
                n = min(n, math.floor(30 - 20 * m))
                theta = (0.5 - 0.4 * m) * random[(place + 2 * order + side) % RANDOM_NUMBERS]
                angle = math.atan2(*sample.directions[0][::-1]) + theta + math.pi * side
                q = (p[0] + (4 + 2 * m) * math.cos(angle), p[1] + (4 + 2 * m) * math.sin(angle))
                part = min((_meeting(p, q, *other) for old in furrows for other in old), default=math.inf)
                if part < math.inf:
                    q, n = (p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1])), 0
                furrow.append((p, q))
                _occupy(occupied, p, q, 0.5 * (1 + 12 * m))
                if n == 0:
                    break
                p, n, order = q, n - 1, order + 1
        furrows.append(furrow)
    return [segment for furrow in furrows for segment in furrow]


def _meeting(p: Point, q: Point, a: Point, b: Point) -> float:
    """How far along p q it meets a b, 0 to 1; infinite if it does not. The end of a furrow lies just before another."""
    rx, ry, sx, sy = q[0] - p[0], q[1] - p[1], b[0] - a[0], b[1] - a[1]
    turn = rx * sy - ry * sx
    if turn == 0:
        return math.inf
    part = ((a[0] - p[0]) * sy - (a[1] - p[1]) * sx) / turn
    other = ((a[0] - p[0]) * ry - (a[1] - p[1]) * rx) / turn
    met = -1e-9 <= part <= 1 + 1e-9 and -1e-9 <= other <= 1 + 1e-9
    return max(part - 1e-9, 0.0) if met else math.inf


def _occupy(occupied: np.ndarray, p: Point, q: Point, radius: float) -> None:
    rows, columns = np.indices(occupied.shape)
    x, y = columns + 0.5 - p[0], rows + 0.5 - p[1]
    dx, dy = q[0] - p[0], q[1] - p[1]
    part = ((x * dx + y * dy) / max(dx * dx + dy * dy, 1e-30)).clip(0, 1)
    occupied |= (x - part * dx) ** 2 + (y - part * dy) ** 2 <= radius**2
