from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from headstudio.io.compare import PictureError, compare_images, difference_picture, read_picture

GRAY = np.full((100, 100, 3), 128, np.uint8)


def changed(pixels: int, by: int) -> np.ndarray:
    picture = GRAY.copy()
    picture.reshape(-1, 3)[:pixels, 1] += np.uint8(by)
    return picture


@pytest.mark.parametrize(
    ("pixels", "by", "passed"),
    [
        (0, 0, True),
        (10_000, 3, True),  # rounding may be everywhere
        (4, 24, True),  # under 0.05 % of the pixels may be further off
        (5, 24, False),  # 0.05 % is too many
        (1, 25, False),  # and none may be far off
        (10_000, 4, False),
    ],
)
def test_rule(pixels: int, by: int, passed: bool) -> None:
    comparison = compare_images(GRAY, changed(pixels, by))
    assert comparison.passed is passed
    assert comparison.max_difference == by
    assert comparison.share_over_3 == (pixels / 10_000 if by > 3 else 0)
    assert ("same" if passed else "different") in str(comparison)


def test_comparison_is_symmetric_and_does_not_wrap() -> None:
    black, white = np.zeros((4, 4, 3), np.uint8), np.full((4, 4, 3), 255, np.uint8)
    assert compare_images(black, white) == compare_images(white, black)
    assert compare_images(black, white).max_difference == 255


def test_different_sizes_are_one_clear_line() -> None:
    with pytest.raises(PictureError, match="100 x 100 and 50 x 100"):
        compare_images(GRAY, GRAY[:, :50])


def test_difference_is_shown_magnified() -> None:
    picture = difference_picture(GRAY, changed(1, 2))
    assert picture.shape == (100, 300, 3)
    np.testing.assert_array_equal(picture[:, :100], GRAY)
    assert picture[0, 200].tolist() == [0, 32, 0]
    assert picture[1:, 200:].max() == 0


def test_files_that_are_no_pictures(tmp_path: Path) -> None:
    Image.fromarray(GRAY).save(tmp_path / "gray.png")
    np.testing.assert_array_equal(read_picture(tmp_path / "gray.png"), GRAY)
    (tmp_path / "text.png").write_text("not a picture")
    (tmp_path / "cut.png").write_bytes((tmp_path / "gray.png").read_bytes()[:60])
    for name in ("text.png", "cut.png", "missing.png", "."):
        with pytest.raises(PictureError) as caught:
            read_picture(tmp_path / name)
        assert "\n" not in str(caught.value)
