import dataclasses
import json
import re
from pathlib import Path

import numpy as np
import pytest

from headstudio.params import ParameterError, assign
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.project import load_project, save_project
from headstudio.scene.styles import PARTS, load_style, read_style, style_names


def test_every_style_is_read_and_says_what_it_is():
    assert len(style_names()) >= 40
    for name in style_names():
        style = load_style(name)
        assert style.name == name
        assert 3 <= len(style.title) <= 60
        assert style.description.endswith(".")
        assert "\n" not in style.description
        assert style.on(Document()) != Document()


@pytest.mark.parametrize("name", ["spiky", "bob", "crown-braid", "figure-15a"])
def test_a_style_survives_in_a_project(name, tmp_path):
    document = load_style(name).on(assign(Document(), {"head.source": "mannequin"}))
    save_project(document, tmp_path / "p.headstudio")
    assert load_project(tmp_path / "p.headstudio").document == document


def test_a_style_changes_the_hair_and_nothing_else():
    document = assign(Document(), {"camera.azimuth": 1.0, "wisp.length": 0.77, "head.source": "mannequin"})
    styled = load_style("ponytail").on(document)
    others = [field.name for field in dataclasses.fields(Document) if field.name not in PARTS]
    assert all(getattr(styled, part) == getattr(document, part) for part in others)
    assert styled.wisp.length == load_style("ponytail").hair.wisp.length


def test_ties_of_the_shipped_styles_are_met():
    builder = Builder()
    for name in ("ponytail", "pigtails", "bun"):
        document = load_style(name).on(assign(Document(), {"head.source": "mannequin"}))
        document = assign(document, {"wisp.wisps": 150, "wisp.strands": 1500, "wisp.points": 8})
        hairdo = builder.hairdo(document)
        assert sum(queue.too_short for queue in hairdo.report.queues) <= 2
        assert np.isfinite(hairdo.strands.points).all()


def test_a_name_that_is_none_is_one_line():
    with pytest.raises(ParameterError, match="no style 'mullet-2000'"):
        load_style("mullet-2000")


@pytest.mark.parametrize(
    "content",
    [
        "",
        "[]",
        '{"title": "A"}',
        '{"title": "A", "description": "B.", "wisp": {}}',
        '{"title": "A", "description": "B.", "parameters": {"wisp.length": 7}}',
        '{"title": "A", "description": "B.", "parameters": {"camera.azimuth": 0}}',
        '{"title": "A", "description": "B.", "parameters": {"wisp.nothing": 0}}',
        '{"title": "A", "description": "B.", "parameters": 5}',
        '{"title": "A", "description": "B.", "attachments": {"styling.operations": [{"kind": "perm"}]}}',
        '{"title": "A", "description": "B.", "attachments": {"styling.nothing": []}}',
        '{"title": "A", "description": "B.", "attachments": {"scalp.curves": []}}',
    ],
)
def test_a_damaged_style_is_one_line(content, tmp_path):
    path = tmp_path / "style.json"
    path.write_text(content)
    with pytest.raises(ParameterError, match="is no hairstyle") as error:
        read_style(path)
    assert "\n" not in str(error.value)


def test_a_style_of_one_s_own(tmp_path):
    path = tmp_path / "mine.json"
    tie = {"kind": "tie", "selection": "top", "place": [0, 1.2, 0]}
    content = {"title": "Mine", "description": "B.", "parameters": {"wisp.length": 0.3}}
    path.write_text(json.dumps({**content, "attachments": {"styling.operations": [tie]}}))
    hair = read_style(path).on(Document())
    assert hair.wisp.length == 0.3
    assert hair.styling.operations[0].place == (0.0, 1.2, 0.0)


def test_every_style_has_its_line_and_its_picture_in_the_documentation():
    docs = Path(__file__).parents[2] / "docs"
    page = (docs / "styles.md").read_text()
    rows = re.findall(r"^\| (.*) \| (.*) \| `headstudio style --preset (\S+) --out \S+` \|$", page, re.MULTILINE)
    shown = {name: (title, description) for title, description, name in rows}
    assert shown == {name: (load_style(name).title, load_style(name).description) for name in style_names()}
    pictures = re.findall(r"\]\((pictures/\S+)\)", page)
    assert len(pictures) >= 5
    assert all((docs / picture).stat().st_size > 10_000 for picture in pictures)
