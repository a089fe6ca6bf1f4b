"""The wheel: built, installed into a clean environment, used from another folder."""

import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).parents[2]


def run(*words, cwd):
    done = subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The folder with the commands of an environment that has the wheel, and the dependencies of this one."""
    folder = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder, cwd=ROOT)
    (wheel,) = folder.glob("headstudio-*.whl")
    environment = folder / "environment"
    venv.create(environment, symlinks=True)
    python = environment / "bin" / "python"
    run(sys.executable, "-m", "pip", "--python", python, "install", "--no-deps", "--no-index", wheel, cwd=folder)
    # A path in a .pth file is searched, but the .pth files it holds are not read: the editable install stays outside.
    (site_packages,) = environment.glob("lib/python*/site-packages")
    (site_packages / "dependencies.pth").write_text(sysconfig.get_path("purelib"))
    return environment / "bin"


def test_it_is_the_wheel_that_is_used(installed, tmp_path):
    where = run(installed / "python", "-c", "import headstudio; print(headstudio.__file__)", cwd=tmp_path)
    assert Path(where.strip()).is_relative_to(installed.parent)


def test_every_shader_and_asset_is_in_it(installed, tmp_path):
    here = {
        f"{folder}/{path.relative_to(ROOT / folder)}"
        for folder in ("shaders", "assets")
        for path in (ROOT / folder).rglob("*")
        if path.is_file()
    }
    code = "import headstudio, pathlib as p; d = p.Path(headstudio.__file__).parent / '_data';" + (
        "print(*sorted(str(f.relative_to(d)) for f in d.rglob('*') if f.is_file()), sep='\\n')"
    )
    assert set(run(installed / "python", "-c", code, cwd=tmp_path).splitlines()) == here


def test_it_draws_a_picture(installed, tmp_path):
    words = ("render", "--head", "mannequin", "--particles", 300, "--size", 96, "--out", "picture.png")
    run(installed / "headstudio", *words, cwd=tmp_path)
    with Image.open(tmp_path / "picture.png") as picture:
        pixels = np.asarray(picture.convert("RGB"), dtype=float)
    assert pixels.shape == (96, 96, 3)
    assert pixels.std() > 10, "a head with hair is no even surface"
