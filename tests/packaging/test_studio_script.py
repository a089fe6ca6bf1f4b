"""The set-up script, with stand-ins for Python, pip and apt that write down how they were called."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

# Answers everything the script asks a Python, and notes it; without the file gl-works OpenGL cannot be had.
PYTHON = """#!/bin/sh
echo "python $*" >>"{log}"
if [ "$1" = - ]; then [ -e "{folder}/gl-works" ]; fi
"""
HEADSTUDIO = """#!/bin/sh
echo "headstudio [$*]" >>"{log}"
"""


class Checkout:
    """A checkout with spaces in its path and a virtual environment of stand-ins."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.log = folder / "calls.log"
        self.commands = folder / "commands"
        self.commands.mkdir(parents=True)
        for name in ("studio", "pyproject.toml"):
            shutil.copy(ROOT / name, folder)
        (folder / ".venv" / "bin").mkdir(parents=True)
        (folder / "gl-works").touch()
        self.stand_in(folder / ".venv/bin/python", PYTHON)
        self.stand_in(folder / ".venv/bin/headstudio", HEADSTUDIO)

    def stand_in(self, path: Path, script: str) -> None:
        path.write_text(script.format(log=self.log, folder=self.folder))
        path.chmod(0o755)

    def command(self, name: str, script: str) -> None:
        self.stand_in(self.commands / name, script)

    def run(self, *words: str, **environment: str) -> subprocess.CompletedProcess[str]:
        plain = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        plain["PATH"] = f"{self.commands}:{plain['PATH']}"
        return subprocess.run(
            [self.folder / "studio", *words], cwd="/", env=plain | environment, capture_output=True, text=True
        )

    def calls(self) -> list[str]:
        lines = self.log.read_text().splitlines() if self.log.exists() else []
        self.log.unlink(missing_ok=True)
        return lines


@pytest.fixture
def checkout(tmp_path):
    return Checkout(tmp_path / "my head studio")


def test_the_first_run_installs_and_the_second_does_not(checkout):
    assert checkout.run("version").returncode == 0
    first = checkout.calls()
    assert any("--editable . --group dev" in call for call in first)
    assert any("--no-deps anny" in call for call in first)
    assert first[-1] == "headstudio [version]"
    assert checkout.run("version").returncode == 0
    assert checkout.calls() == ["headstudio [version]"]


def test_a_changed_project_file_installs_again(checkout):
    checkout.run("version")
    checkout.calls()
    with (checkout.folder / "pyproject.toml").open("a") as file:
        file.write("# another dependency\n")
    checkout.run("version")
    assert any("install" in call for call in checkout.calls())


def test_words_are_passed_on_as_they_are(checkout):
    checkout.run("render", "--out", "my picture.png", "--set", "hair.length=0.2")
    assert checkout.calls()[-1] == "headstudio [render --out my picture.png --set hair.length=0.2]"


def test_without_a_display_the_demo_runs(checkout):
    ran = checkout.run()
    assert checkout.calls()[-1] == "headstudio [demo]"
    assert "no display" in ran.stderr


@pytest.mark.parametrize("display", ["DISPLAY", "WAYLAND_DISPLAY"])
def test_with_a_display_the_window_opens(checkout, display):
    checkout.run(**{display: ":0"})
    assert checkout.calls()[-1] == "headstudio []"


def test_a_failing_command_keeps_its_status(checkout):
    checkout.stand_in(checkout.folder / ".venv/bin/headstudio", "#!/bin/sh\nexit 2\n")
    assert checkout.run("render").returncode == 2


def test_missing_libraries_are_installed_through_apt_by_root(checkout):
    (checkout.folder / "gl-works").unlink()
    checkout.command("id", "#!/bin/sh\necho 0\n")
    checkout.command("apt-get", '#!/bin/sh\necho "apt-get $*" >>"{log}"\ntouch "{folder}/gl-works"\n')
    assert checkout.run("version").returncode == 0
    calls = checkout.calls()
    assert any("apt-get install" in call and "libegl1" in call for call in calls)
    assert calls[-1] == "headstudio [version]"


def test_whoever_is_not_root_gets_the_packages_by_name(checkout):
    (checkout.folder / "gl-works").unlink()
    checkout.command("id", "#!/bin/sh\necho 1000\n")
    checkout.command("sudo", "#!/bin/sh\nexit 1\n")
    ran = checkout.run("version")
    assert ran.returncode == 1
    for word in ("apt install libegl1", "dnf install mesa", "pacman -S mesa"):
        assert word in ran.stderr
    assert "headstudio [version]" not in checkout.calls()


def test_pip_without_a_network_is_one_line(checkout):
    script = PYTHON + 'case "$*" in *"--group dev"*) exit 1 ;; esac\n'
    checkout.stand_in(checkout.folder / ".venv/bin/python", script)
    ran = checkout.run("version")
    assert ran.returncode == 1
    assert "pip could not install headstudio" in ran.stderr


def test_an_old_python_is_named(checkout):
    shutil.rmtree(checkout.folder / ".venv")
    for name in ("python3", "python3.13", "python3.12", "python3.11", "python"):
        checkout.command(name, '#!/bin/sh\n[ "$1" = --version ] && echo Python 3.9.2 && exit 0\nexit 1\n')
    ran = checkout.run("version")
    assert ran.returncode == 1
    assert ran.stderr.strip().splitlines() == [
        "studio: headstudio needs Python 3.11 or newer; found Python 3.9.2. "
        "Install one, or name it: PYTHON=/path/to/python ./studio"
    ]


def test_the_tests_run_after_the_lints_and_decide_with_them(checkout):
    for name in ("ruff", "mypy", "lint-imports"):
        checkout.stand_in(checkout.folder / ".venv/bin" / name, f'#!/bin/sh\necho "{name} $*" >>"{{log}}"\n')
    assert checkout.run("test", "-k", "nothing").returncode == 0
    calls = [call for call in checkout.calls() if "pip" not in call]
    assert [call.split()[0] for call in calls[-5:]] == ["ruff", "ruff", "mypy", "lint-imports", "python"]
    assert calls[-1].endswith("-k nothing")
    checkout.stand_in(checkout.folder / ".venv/bin/mypy", "#!/bin/sh\nexit 1\n")
    ran = checkout.run("test")
    assert ran.returncode == 1
    assert "failed: mypy" in ran.stderr
    assert "pytest" in checkout.calls()[-1]
