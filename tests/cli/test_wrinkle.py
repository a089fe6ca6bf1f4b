"""Faces on the command line."""

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

SMALL = ("--head", "mannequin", "--set", "fine.texture_size=128")


def pixels(path):
    return np.asarray(Image.open(path)).astype(int)


def test_a_face_with_and_without_its_wrinkles(headstudio):
    for name, more in (("with", ()), ("without", ("--no-wrinkles",)), ("neutral", ("--preset", "neutral"))):
        face = more if name == "neutral" else ("--preset", "angry", *more)
        ran = headstudio("wrinkle", *SMALL, "--view", "front", *face, "--size", 128, "--out", f"{name}.png")
        assert ran.status == 0, ran.complaint
    one, other, neutral = (pixels(f"{name}.png") for name in ("with", "without", "neutral"))
    assert 0.05 < np.abs(one - other).mean() < np.abs(one - neutral).mean()


def test_an_expression_by_its_slider_as_a_mesh(headstudio):
    assert headstudio("wrinkle", *SMALL, "--expression", "smile_left=1", "--out", "smile.glb").status == 0
    assert headstudio("wrinkle", *SMALL, "--out", "rest.glb").status == 0
    smile, rest = (trimesh.load(name).geometry["skin"].vertices for name in ("smile.glb", "rest.glb"))
    moved = np.linalg.norm(smile - rest, axis=1)
    assert moved[rest[:, 0] > 0.015].max() > 0.003
    assert moved[rest[:, 0] < -0.015].max() < 0.001


def test_maps_and_what_they_mean(headstudio):
    ran = headstudio("bake", *SMALL, "--size", 128, "--maps", "height,normal,ao,weights", "--out", "maps")
    assert ran.status == 0, ran.complaint
    meaning = json.loads(Path("maps/maps.json").read_text())
    assert meaning["height_black_m"] < 0 < meaning["height_white_m"]
    height = Image.open("maps/height.png")
    assert height.size == (128, 128)
    assert np.asarray(height).dtype.itemsize >= 2
    assert {path.name for path in Path("maps").glob("weight-*.png")} >= {"weight-angry.png", "weight-neutral.png"}
    assert pixels("maps/weight-angry.png").max() > pixels("maps/weight-neutral.png").max()


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("wrinkle", "--preset", "bored"), "no face 'bored'"),
        (("wrinkle", "--expression", "smile"), "NAME=0.8"),
        (("wrinkle", "--expression", "frown=1"), "NAME=0.8"),
        (("wrinkle", "--expression", "smile=2"), "smile"),
        (("wrinkle", "--out", "face.xyz"), "a face is written to"),
        (("bake", "--maps", "colour"), "maps are height"),
    ],
)
def test_what_cannot_be_is_one_line(headstudio, words, complaint):
    ran = headstudio(*words)
    assert ran.status == 2
    assert complaint in ran.complaint
    assert len(ran.complaint.strip().splitlines()) == 1


def test_limbs_with_and_without_wrinkles(headstudio):
    small = ("--size", 96, "--set", "fine.texture_size=128")
    for name, more in (("with", ()), ("without", ("--no-wrinkles",))):
        ran = headstudio("limb", "foot", *small, *more, "--out", f"{name}.png")
        assert ran.status == 0, ran.complaint
    assert pixels("with.png").shape == (96, 96, 3)
    assert 0.01 < np.abs(pixels("with.png") - pixels("without.png")).mean() < 10


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("limb", "ear"), "a limb is hand, arm, foot"),
        (("limb", "--pose", "wave"), "pose"),
        (("limb", "no.glb"), "no.glb"),
        (("limb", "foot", "--near", "wrist"), "no skeleton"),
    ],
)
def test_limbs_that_are_none(headstudio, words, complaint):
    ran = headstudio(*words)
    assert ran.status == 2
    assert complaint in ran.complaint
