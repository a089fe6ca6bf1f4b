from __future__ import annotations

from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

from headstudio.io.contact_sheet import contact_sheet
from headstudio.io.film import FilmError, open_film


def frames(count: int, width: int, height: int) -> list[np.ndarray]:
    """A bright bar that moves to the right."""
    pictures = np.full((count, height, width, 3), 40, np.uint8)
    for k in range(count):
        pictures[k, :, k * width // count : (k + 1) * width // count] = 220
    return list(pictures)


@pytest.mark.parametrize("size", [(64, 48), (65, 47)])
def test_film_holds_its_frames(tmp_path: Path, size: tuple[int, int]) -> None:
    path = tmp_path / "new" / "shake.mp4"
    with open_film(path, 25, size) as film:
        for frame in frames(10, *size):
            film.add(frame)
    reader = imageio_ffmpeg.read_frames(str(path))
    meta = next(reader)
    assert meta["fps"] == 25
    width, height = meta["size"]
    assert (width, height) == (size[0] + size[0] % 2, size[1] + size[1] % 2)
    shown = [np.frombuffer(data, np.uint8).reshape(height, width, 3) for data in reader]
    assert len(shown) == 10
    for wanted, got in zip(frames(10, *size), shown):
        assert np.abs(got[: size[1], : size[0]].astype(int) - wanted).mean() < 12


def test_folder_gets_numbered_pictures(tmp_path: Path) -> None:
    with open_film(tmp_path / "frames", 30, (20, 10)) as film:
        for frame in frames(3, 20, 10):
            film.add(frame)
    files = sorted(path.name for path in (tmp_path / "frames").iterdir())
    assert files == ["frame_0000.png", "frame_0001.png", "frame_0002.png"]
    with Image.open(tmp_path / "frames" / "frame_0002.png") as image:
        np.testing.assert_array_equal(np.asarray(image), frames(3, 20, 10)[2])


@pytest.mark.parametrize("name", ["film.mp4", "folder"])
def test_frame_of_another_size_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(FilmError, match="20 x 10"), open_film(tmp_path / name, 30, (20, 10)) as film:
        film.add(np.zeros((20, 10, 3), np.uint8))


@pytest.mark.parametrize("name", ["film.mp4", "folder"])
def test_where_nothing_can_be_written(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(FilmError, match="cannot be written") as caught, open_film(tmp_path / "file" / name, 30, (2, 2)):
        pass
    assert "\n" not in str(caught.value)


def test_sheet_puts_pictures_in_rows_with_captions() -> None:
    pictures = [np.full((40, 50, 3), shade, np.uint8) for shade in (60, 120, 180, 240, 90)]
    sheet = contact_sheet(pictures, list("abcde"), columns=3)
    plain = contact_sheet(pictures, columns=3)
    assert plain.shape == (2 * 46 + 6, 3 * 56 + 6, 3)
    assert sheet.shape[0] > plain.shape[0]
    for k, picture in enumerate(pictures):
        top, left = 6 + (k // 3) * 46, 6 + (k % 3) * 56
        np.testing.assert_array_equal(plain[top : top + 40, left : left + 50], picture)


def test_small_pictures_stand_in_the_middle_of_their_cell() -> None:
    sheet = contact_sheet([np.full((40, 40, 3), 200, np.uint8), np.full((20, 20, 3), 100, np.uint8)])
    np.testing.assert_array_equal(sheet[16:36, 62:82], 100)


@pytest.mark.parametrize(("count", "captions"), [(0, None), (2, ["one"])])
def test_sheet_that_cannot_be_made(count: int, captions: list[str] | None) -> None:
    with pytest.raises(ValueError, match="picture"):
        contact_sheet([np.zeros((4, 4, 3), np.uint8)] * count, captions)
