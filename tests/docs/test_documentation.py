"""The documentation is true: its commands and its Python run, its names and links exist, its tables are current."""

import functools
import importlib
import re
import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner

from headstudio.cli import app
from headstudio.commands.parameters import markdown
from headstudio.head.load import load_head
from headstudio.scene import builder

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]

# What makes a command of the guide small enough for a test; a later option wins over the guide's own.
SMALL = {
    "demo": ["--quick"],
    "simulate": ["--seconds", "0.1", "--size", "32", "--particles", "150"],
    "render": ["--seconds", "0", "--size", "32", "--particles", "150"],
    "bench": ["--counts", "100", "--frames", "1"],
}


read_once = functools.cache(load_head)


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def commands(page):
    """The headstudio commands in the sh blocks of a page, continued lines joined."""
    lines = "\n".join(blocks(page, "sh")).replace("\\\n", " ").splitlines()
    return [shlex.split(re.sub(r"\s#.*", "", line)) for line in lines if line.startswith("headstudio ")]


def test_the_parameter_page_is_current():
    assert (ROOT / "docs/parameters.md").read_text() == markdown(), "headstudio params --markdown > docs/parameters.md"


@pytest.mark.parametrize("page", [page for page in PAGES if commands(page)], ids=lambda page: page.name)
def test_the_commands_of_a_page_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(builder, "load_head", read_once)
    if "demo" in {words[1] for words in commands(page)}:
        from headstudio.commands import demo

        monkeypatch.setattr(demo, "QUICK", demo.Scale(particles=150, size=32, length=0.03))
    for _, command, *words in commands(page):
        result = CliRunner().invoke(app, [command, *words, *SMALL.get(command, [])])
        assert result.exit_code == 0, f"headstudio {command} {' '.join(words)}: {result.stderr}"


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page, "python")], ids=lambda page: page.name)
def test_the_python_of_a_page_runs(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for block in blocks(page, "python"):
        exec(compile(block, page.name, "exec"), {"__name__": page.stem})
    assert blocks(page, "python")


def test_every_function_named_beside_an_equation_exists():
    names = re.findall(r"`((?:lcp|head|render|scene)\.[\w.]+)`", (ROOT / "docs/papers.md").read_text())
    assert len(names) > 20
    for name in names:
        resolve(f"headstudio.{name}")


def resolve(path):
    """The object at a dotted path: the longest module, then attributes."""
    words = path.split(".")
    for count in range(len(words), 0, -1):
        try:
            found = importlib.import_module(".".join(words[:count]))
        except ModuleNotFoundError:
            continue
        for attribute in words[count:]:
            found = getattr(found, attribute)
        return found
    raise AssertionError(f"{path} is nowhere")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_and_pictures_of_a_page_are_there(page):
    targets = re.findall(r"\]\((?!https?:)([^)#]+)", page.read_text())
    missing = [target for target in targets if not (page.parent / target).exists()]
    assert missing == []
