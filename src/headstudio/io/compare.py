"""Are two pictures the same? The rule of the screenshot tests, for everybody."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

Picture = NDArray[np.uint8]

# Between processors a few hundred values of a picture move by 2 or 3 of 255; what is drawn differently moves farther.
_ROUNDING = 3
_FAR = 24
_SHARE_BEYOND_ROUNDING = 0.0005
_MAGNIFICATION = 16


class PictureError(ValueError):
    """A file that is no picture, or two that cannot be compared. The message is one line for the user."""


@dataclass(frozen=True)
class Comparison:
    """How far two pictures lie apart, in steps of 255.

    max_difference: the largest of any value. share_over_3: the part of the pixels where some value differs by more than
    3. mean_difference: over all values.
    """

    max_difference: int
    share_over_3: float
    mean_difference: float

    @property
    def passed(self) -> bool:
        """The same but for rounding: nowhere more than 3 apart, or in under 0.05 % of the pixels and never over 24."""
        if self.max_difference <= _ROUNDING:
            return True
        return self.share_over_3 < _SHARE_BEYOND_ROUNDING and self.max_difference <= _FAR

    def __str__(self) -> str:
        verdict = "same" if self.passed else "different"
        return (
            f"{verdict}: largest difference {self.max_difference} of 255, "
            f"{100 * self.share_over_3:.3f} % of the pixels beyond {_ROUNDING}, mean {self.mean_difference:.3f}"
        )


def read_picture(path: Path) -> Picture:
    """A picture file as (height, width, 3), top row first. Raises PictureError, in one line, if it is none."""
    try:
        with Image.open(path) as image:
            return np.asarray(image.convert("RGB"))
    except FileNotFoundError:
        raise PictureError(f"{path}: there is no such file") from None
    except (UnidentifiedImageError, OSError, Image.DecompressionBombError) as error:
        raise PictureError(f"{path} is not a picture that can be read ({type(error).__name__})") from None


def compare_images(a: Picture, b: Picture) -> Comparison:
    """Compare two pictures, (height, width, 3) of 0 to 255. Raises PictureError if their sizes differ."""
    if a.shape != b.shape:
        raise PictureError(
            f"the pictures have different sizes: {a.shape[1]} x {a.shape[0]} and {b.shape[1]} x {b.shape[0]}"
        )
    difference = np.abs(a.astype(np.int16) - b.astype(np.int16))
    return Comparison(
        max_difference=int(difference.max(initial=0)),
        share_over_3=float((difference.max(axis=2) > _ROUNDING).mean()),
        mean_difference=float(difference.mean()),
    )


def difference_picture(a: Picture, b: Picture) -> Picture:
    """``a``, ``b`` and their difference, magnified 16 times, side by side: (height, 3 * width, 3)."""
    difference = np.abs(a.astype(np.int16) - b.astype(np.int16))
    magnified = np.minimum(difference * _MAGNIFICATION, 255).astype(np.uint8)
    return np.concatenate([a, b, magnified], axis=1)
