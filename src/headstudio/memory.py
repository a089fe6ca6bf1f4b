"""Memory that is freed is needed again in the next frame."""

from __future__ import annotations

import ctypes
import sys

# glibc's names for what mallopt sets, and how much memory stays with the program [bytes].
_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3
_KEPT, _LARGEST = 256 << 20, 32 << 20


def keep_freed_memory() -> None:
    """Let the C library keep the memory of arrays that are freed, instead of giving it back to the system every time.

    Every frame makes and frees the same arrays, in numpy as in a software renderer. Taken from the system anew, each page
    of them has to be cleared first: thousands of page faults a frame. Elsewhere than with glibc nothing is done.
    """
    if not sys.platform.startswith("linux"):
        return
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt is not None:
        mallopt(_MMAP_THRESHOLD, _LARGEST)
        mallopt(_TRIM_THRESHOLD, _KEPT)
