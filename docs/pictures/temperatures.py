"""Figure 7 of Choe and Ko (2005): a prototype strand, and master strands made after it at four temperatures.

python docs/pictures/temperatures.py [FILE]
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from headstudio.io.contact_sheet import contact_sheet
from headstudio.wisp.catmull_rom import catmull_rom_matrix
from headstudio.wisp.markov import synthesise, window_size, without_loose_end
from headstudio.wisp.masters import CONTROLS_PER_PITCH
from headstudio.wisp.prototypes import Prototype, prototype_of
from headstudio.wisp.settings import WispSettings

TEMPERATURES = (0.01, 0.03, 0.07, 0.12)
SIZE, FINER = (190, 330), 3
LENGTH = 0.27  # of the strands [m]
BACKGROUND, HAIR = (58, 61, 67), (214, 178, 130)


def main(file: Path) -> None:
    """Write the picture: one column for the prototype, and one of four strands for every temperature."""
    prototype = prototype_of(WispSettings(prototype="loose curl"))
    assert prototype is not None
    columns = [_drawn(_strands(prototype, 0.0, 1))]
    columns += [_drawn(_strands(prototype, temperature, 4)) for temperature in TEMPERATURES]
    labels = ["prototype", *(f"T = {temperature}" for temperature in TEMPERATURES)]
    picture = Image.fromarray(contact_sheet(columns, labels, columns=len(columns)))
    picture.quantize(32).save(file, optimize=True)


def _strands(prototype: Prototype, temperature: float, count: int) -> np.ndarray:
    """Points of strands that hang side by side [m], (count, n, 3)."""
    spacing = prototype.pitch / CONTROLS_PER_PITCH
    samples = prototype.sampled(spacing)
    window = window_size(samples, 0.5 * CONTROLS_PER_PITCH)
    samples = without_loose_end(samples, window)
    controls = round(LENGTH / spacing)
    details = synthesise(
        samples, window, temperature, np.full(count, window), controls, np.random.default_rng(1)
    ).astype(np.float64)
    details[:, :, 2] += spacing * np.arange(controls)
    return np.matmul(catmull_rom_matrix(controls, np.linspace(0, controls - 1, 12 * controls)), details)


def _drawn(strands: np.ndarray) -> np.ndarray:
    picture = Image.new("RGB", (FINER * SIZE[0], FINER * SIZE[1]), BACKGROUND)
    draw = ImageDraw.Draw(picture)
    scale = FINER * (SIZE[1] - 20) / LENGTH
    for k, strand in enumerate(strands):
        middle = FINER * SIZE[0] * (k + 0.5) / len(strands)
        draw.line([(middle + scale * x, FINER * 10 + scale * z) for x, _, z in strand], HAIR, 2 * FINER, joint="curve")
    return np.asarray(picture.resize(SIZE, Image.Resampling.LANCZOS))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_suffix(".png"))
