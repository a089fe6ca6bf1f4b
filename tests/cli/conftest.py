import functools
from dataclasses import dataclass

import pytest
from typer.testing import CliRunner

from headstudio.cli import app
from headstudio.head.load import load_head
from headstudio.scene import builder


@dataclass
class Ran:
    """How a command ended."""

    status: int
    output: str
    complaint: str


@pytest.fixture(scope="session")
def heads():
    """Heads are read once for all commands of a test run."""
    return functools.cache(load_head)


@pytest.fixture
def headstudio(monkeypatch, tmp_path, heads):
    """Run a command in an empty folder, as a shell would."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setattr(builder, "load_head", heads)

    def run(*words):
        result = CliRunner().invoke(app, [str(word) for word in words])
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        return Ran(result.exit_code, result.stdout, result.stderr)

    return run
