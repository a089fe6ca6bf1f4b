"""Maps of a skin as PNG: heights and weights in 16 bits, normals in 8 as other programs expect them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

LEVELS = 65535


def write_gray16(values: NDArray[np.float32], low: float, high: float, path: Path) -> None:
    """Values from ``low``, black, to ``high``, white, first row at v = 0 and so at the foot of the picture. Raises OSError."""
    share = np.clip((values - low) / (high - low), 0.0, 1.0)
    _save(np.rint(share * LEVELS).astype(np.uint16), path)


def write_normals(normals: NDArray[np.float32], path: Path) -> None:
    """Unit normals, (rows, columns, 3), as colours: x red, y green (up), z blue. Raises OSError."""
    _save(np.rint((0.5 + 0.5 * normals) * 255).astype(np.uint8), path)


def _save(pixels: NDArray[np.uint8] | NDArray[np.uint16], path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(pixels[::-1].copy()).save(path, "PNG")
