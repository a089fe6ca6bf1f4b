"""The documentation is true: its commands and its Python run, its names and links exist, its tables are current."""

import dataclasses
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
from headstudio.params import walk
from headstudio.scene import builder
from headstudio.scene.document import Document

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]

# The pages that say where each equation of a paper is.
EQUATIONS = [ROOT / "docs" / name for name in ("papers.md", "wisps.md", "wrinkles.md")]

# What makes a command of the guide small enough for a test; a later option wins over the guide's own.
FEW_STRANDS = ["--strands", "200", "--set", "wisp.wisps=20"]
SMALL = {
    "demo": ["--quick"],
    "simulate": ["--seconds", "0.1", "--size", "32", "--particles", "150"],
    "render": ["--seconds", "0", "--size", "32", "--particles", "150"],
    "bench": ["--head", "mannequin", "--counts", "100", "--texels", "128", "--frames", "1", *FEW_STRANDS],
    "style": ["--size", "32", *FEW_STRANDS],
    "export": FEW_STRANDS,
    "wrinkle": ["--head", "mannequin", "--size", "32", "--set", "fine.texture_size=128"],
    "limb": ["--size", "32", "--set", "fine.texture_size=128"],
    "bake": ["--head", "mannequin", "--size", "128"],
}


read_once = functools.cache(load_head)


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def files(page):
    """The files that a page shows: its json blocks whose first line names one, as (name, content)."""
    return re.findall(r"^```json (\S+)\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


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
    for name, content in files(page):
        Path(name).write_text(content)
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


@pytest.mark.parametrize("page", EQUATIONS, ids=lambda page: page.name)
def test_every_function_named_beside_an_equation_exists(page):
    names = re.findall(r"`((?:lcp|head|render|scene|wisp|wrinkle|io)\.[\w.]+)`", page.read_text())
    assert len(names) > 20
    for name in names:
        resolve(f"headstudio.{name}")


@pytest.mark.parametrize("page", [ROOT / "docs/guide.md", ROOT / "CHANGELOG.md"], ids=lambda page: page.name)
def test_every_parameter_that_a_page_names_exists(page):
    parts = "|".join(field.name for field in dataclasses.fields(Document))
    names = set(re.findall(rf"`((?:{parts})\.\w+)`", page.read_text()))
    assert names
    assert names - {name for name, _, _ in walk(Document())} == set()


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
