"""Valleys of a height image: how much each place looks like one, at every angle and width.

Every place is compared with what lies on both sides of it, by elongated second derivatives of Gaussians turned to many
angles (Freeman and Adelson 1991). Where two valleys cross, both angles answer, so that each can be followed through.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import fft, ndimage

from ..head.mesh import Floats, Ints
from .scan_heights import ScanHeights

ANGLES = 16
"""Directions that a valley is looked for along, evenly over half a turn."""

# Standard deviations of the filters across [m], and how much longer they are along.
GROOVES = (1.2e-3, 2.0e-3, 3.2e-3)
_ALONG = 3.0
# A valley answers to angles near its own, too. Only those are kept that answer most within so many angles of them.
_PEAK = 3
# Filters reach this many standard deviations, and are trusted this many texels inside what the scan covers.
_EXTENT, _RIM = 3.5, 2


@dataclass(frozen=True, eq=False)
class ValleyField:
    """Answers of the filters on a part of the texels.

    depth: how far a place lies below both of its sides [m], (ANGLES, rows, columns), 0 where the scan is not, and at
    angles where no valley runs. width: scale of the filter that found most [m], alike. origin: (x, y) of the first texel.
    metres: edge of a texel [m].
    """

    depth: Floats
    width: Floats
    origin: Ints
    metres: float


def valley_field(heights: ScanHeights, scales: tuple[float, ...] = GROOVES) -> ValleyField:
    """Look for valleys in a scan whose smooth change of shape is taken off."""
    texels = heights.texels
    covered = np.isfinite(texels.image(heights.height))
    rows, columns = (np.flatnonzero(covered.any(axis=axis)) for axis in (1, 0))
    box = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    image, inside = heights.filled[box], ndimage.binary_erosion(covered, iterations=_RIM)[box]
    margin = int(np.ceil(_EXTENT * _ALONG * scales[-1] / texels.metres))
    padded = np.pad(image, margin, mode="edge")
    shape = [fft.next_fast_len(edge, real=True) for edge in padded.shape]
    spectrum = fft.rfft2(padded, shape)
    deepest = np.zeros((ANGLES, *image.shape))
    width = np.full(deepest.shape, scales[0])
    for across in scales:
        for k in range(ANGLES):
            kernel = _kernel(across / texels.metres, np.pi * k / ANGLES, margin)
            # The filter is symmetric, so that correlation and convolution are one.
            answer = fft.irfft2(spectrum * fft.rfft2(kernel, shape), shape)
            answer = answer[2 * margin : 2 * margin + image.shape[0], 2 * margin : 2 * margin + image.shape[1]]
            better = inside & (answer > deepest[k])
            deepest[k][better], width[k][better] = answer[better], across
    highest = ndimage.maximum_filter1d(deepest, 2 * _PEAK + 1, axis=0, mode="wrap")
    # The angles on both sides of the best are kept with it, to follow a valley that turns.
    peak = ndimage.maximum_filter1d((deepest == highest).view(np.uint8), 3, axis=0, mode="wrap").view(bool)
    deepest = np.where(peak, deepest, 0.0)
    return ValleyField(deepest, width, np.array([columns[0], rows[0]]), texels.metres)


def _kernel(sigma: float, angle: float, margin: int) -> Floats:
    """A filter for valleys along ``angle``, (2 margin + 1, 2 margin + 1): the mean of both sides less the middle."""
    y, x = np.mgrid[-margin : margin + 1, -margin : margin + 1]
    along = x * np.cos(angle) + y * np.sin(angle)
    across = -x * np.sin(angle) + y * np.cos(angle)
    bend = ((across / sigma) ** 2 - 1.0) * np.exp(-0.5 * (across / sigma) ** 2 - 0.5 * (along / (_ALONG * sigma)) ** 2)
    kernel = bend - bend.mean()
    return kernel / (0.5 * np.abs(kernel).sum())
