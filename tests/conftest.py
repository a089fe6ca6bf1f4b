"""What all tests share: an OpenGL context without a window, and pictures to compare with."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from headstudio.io.compare import compare_images, difference_picture, read_picture
from headstudio.render.context import headless_context, is_software

SCREENSHOTS = Path(__file__).parent / "screenshots"
CheckPicture = Callable[[str, NDArray[np.uint8]], None]


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--regenerate-screenshots",
        action="store_true",
        help="write the reference pictures anew; whoever does opens every one of them and looks",
    )


@pytest.fixture(scope="session")
def _gl() -> moderngl.Context:
    return headless_context()


@pytest.fixture
def gl(_gl: moderngl.Context) -> Iterator[moderngl.Context]:
    """The context, current, and free of errors before and after every test."""
    with _gl:
        _gl.clear_errors()
        yield _gl
        assert _gl.error == "GL_NO_ERROR"
        _gl.gc()


@pytest.fixture
def check_picture(gl: moderngl.Context, request: pytest.FixtureRequest) -> CheckPicture:
    """Compares a picture with ``screenshots/reference/NAME.png`` on llvmpipe, where a picture is the same everywhere.

    With HEADSTUDIO_REQUIRE_LLVMPIPE=1 it is an error that something else draws.
    """
    if not is_software(gl):
        if os.environ.get("HEADSTUDIO_REQUIRE_LLVMPIPE") == "1":
            pytest.fail(f"screenshots need llvmpipe, but {gl.info['GL_RENDERER']} draws")
        pytest.skip("screenshots are compared on llvmpipe only")
    return _Checker(request.config.getoption("--regenerate-screenshots"))


class _Checker:
    def __init__(self, regenerate: bool) -> None:
        self.regenerate = regenerate

    def __call__(self, name: str, picture: NDArray[np.uint8]) -> None:
        reference = SCREENSHOTS / "reference" / f"{name}.png"
        if self.regenerate:
            reference.parent.mkdir(parents=True, exist_ok=True)
            Image.fromarray(picture).save(reference, optimize=True)
            return
        wanted = read_picture(reference)
        comparison = compare_images(picture, wanted)
        if not comparison.passed:
            failed = SCREENSHOTS / "failed" / f"{name}.png"
            failed.parent.mkdir(exist_ok=True)
            Image.fromarray(difference_picture(picture, wanted)).save(failed)
            pytest.fail(f"{name}: {comparison}; new, reference and difference in {failed}")
