"""Arrays as the bytes that vertex and index buffers hold."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats


def floats_of(values: Floats) -> bytes:
    """Single precision."""
    return np.ascontiguousarray(values, dtype=np.float32).tobytes()


def bytes_of(values: Floats) -> bytes:
    """0 to 1 in steps of 1/255; what is outside is cut off."""
    return np.rint(np.clip(values, 0, 1) * 255).astype(np.uint8).tobytes()


def indices_of(faces: object) -> bytes:
    """Whole numbers of 32 bits."""
    return np.ascontiguousarray(faces, dtype=np.uint32).tobytes()
