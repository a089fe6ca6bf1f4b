"""Hairstyles and hair files on the command line."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from headstudio.io.hair import read_strands
from headstudio.scene.project import load_project
from headstudio.scene.styles import style_names

FEW = ["--head", "mannequin", "--strands", "300", "--set", "wisp.wisps=40"]


def test_every_style_is_listed_by_name(headstudio):
    lines = headstudio("styles").output.splitlines()
    assert [line.partition(":")[0] for line in lines] == list(style_names())
    assert all(line.partition(": ")[2] for line in lines)


def test_a_style_as_strands_a_project_and_a_picture(headstudio, tmp_path):
    headstudio("style", "--preset", "bob", "--wisps", "40", *FEW[:4], "--out", str(tmp_path / "bob.npy"))
    strands = read_strands(tmp_path / "bob.npy")
    assert strands.count == 300
    headstudio("style", "--preset", "bob", *FEW, "--out", str(tmp_path / "bob.headstudio"))
    document = load_project(tmp_path / "bob.headstudio").document
    assert document.look.hair_as == "strands"
    assert document.wisp.strands == 300
    out = tmp_path / "bob.png"
    headstudio("style", str(tmp_path / "bob.headstudio"), "--size", "96", "--out", str(out))
    pixels = np.asarray(Image.open(out))
    assert pixels.shape == (96, 96, 3)
    assert pixels.std() > 10


def test_export_of_a_style_and_of_a_file(headstudio, tmp_path):
    headstudio("export", "ponytail", str(tmp_path / "tail.hair"), *FEW)
    first = read_strands(tmp_path / "tail.hair")
    headstudio("export", str(tmp_path / "tail.hair"), str(tmp_path / "tail.tfx"), "--points", "16")
    assert read_strands(tmp_path / "tail.tfx").counts.tolist() == [16] * first.count


def test_import_says_what_it_found(headstudio, tmp_path):
    headstudio("export", "bob", str(tmp_path / "bob.usda"), *FEW)
    said = headstudio("import", str(tmp_path / "bob.usda"), "--head", "mannequin", "--out", str(tmp_path / "back.ply"))
    assert "strands: 300" in said.output
    assert "the head's coordinates" in said.output
    moved = read_strands(tmp_path / "back.ply").points - read_strands(tmp_path / "bob.usda").points
    assert np.quantile(np.linalg.norm(moved, axis=1), 0.95) < 2e-3, "hair of this head stays where it was"


def test_imported_strands_are_the_hair_of_a_project(headstudio, tmp_path):
    headstudio("export", "bob", str(tmp_path / "bob.usda"), *FEW)
    project, back = str(tmp_path / "bob.headstudio"), str(tmp_path / "back.npy")
    headstudio("import", str(tmp_path / "bob.usda"), "--head", "mannequin", "--out", project)
    assert load_project(tmp_path / "bob.headstudio").document.groom.hair.name == "bob.usda"
    headstudio("export", project, back)
    assert read_strands(tmp_path / "back.npy").count == 300


def test_hairdressing_by_word_and_by_file(headstudio, tmp_path):
    headstudio("style", *FEW, "--out", "plain.npy")
    headstudio("style", *FEW, "--operation", "tie back", "--out", "tied.npy")
    (tmp_path / "list.json").write_text('[{"kind": "cut", "place": [0, -0.5, 0], "normal": [0, -1, 0]}]')
    headstudio("style", *FEW, "--operations", "list.json", "--out", "cut.npy")
    plain, tied, cut = (read_strands(tmp_path / f"{name}.npy").points for name in ("plain", "tied", "cut"))
    assert np.abs(tied - plain).max() > 0.02
    assert cut[:, 1].min() > plain[:, 1].min() + 0.02


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["style", "--preset", "nonsense", "--out", "x.png"], "no style 'nonsense'"),
        (["style", "--out", "x.xyz"], "a style is written to"),
        (["style", "--operation", "knot all"], "begins with tie, braid, bun, updo, cut"),
        (["style", "--operation", "tie behind"], "tie behind"),
        (["style", "--operations", "missing.json"], "missing.json"),
        (["export", "nonsense", "x.hair"], "neither a project"),
        (["export", "bob", "x.xyz"], "hair is written to"),
        (["export", "missing.hair", "x.ply"], "missing.hair"),
        (["import", "missing.tfx"], "missing.tfx"),
    ],
)
def test_what_cannot_be_is_one_line_and_status_2(headstudio, words, complaint):
    said = headstudio(*words)
    assert said.status == 2
    assert complaint in said.complaint
    assert len(said.complaint.strip().splitlines()) == 1


def test_a_strand_of_a_file_is_the_prototype(headstudio, tmp_path):
    headstudio("export", "tight-curls", str(tmp_path / "curls.hair"), *FEW)
    out = tmp_path / "like.headstudio"
    headstudio("style", "--prototype", str(tmp_path / "curls.hair"), *FEW, "--out", str(out))
    curve = np.array(load_project(out).document.wisp.prototype_curve)
    own = read_strands(tmp_path / "curls.hair").lengths
    assert np.linalg.norm(np.diff(curve, axis=0), axis=1).sum() == pytest.approx(np.median(own), rel=0.1)
    assert headstudio("style", "--prototype", str(out), *FEW).status == 2
