"""``headstudio compare``: whether two pictures are the same, by the rule of the screenshot tests."""

from __future__ import annotations

from pathlib import Path

from ..io.compare import compare_images, difference_picture, read_picture
from .pictures import check_is_picture, save_picture
from .reporting import say


def compare(one: Path, other: Path, difference: Path | None) -> bool:
    """Print how far two pictures lie apart; True when they are the same. Raises PictureError.

    ``difference``: where to write both and their magnified difference, side by side, or None.
    """
    if difference is not None:
        check_is_picture(difference)
    a, b = read_picture(one), read_picture(other)
    comparison = compare_images(a, b)
    if difference is not None:
        save_picture(difference_picture(a, b), difference)
    say(str(comparison))
    return comparison.passed
