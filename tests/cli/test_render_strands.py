"""``headstudio render STRANDS``: what a JSON file states is what is drawn, and what it gets wrong is one line."""

from __future__ import annotations

import json

import numpy as np
import pytest
import trimesh
from PIL import Image

VIEW = {
    "eye": [0.0, 0.1, 0.8],
    "target": [0, 0.05, 0],
    "fov_degrees": 30,
    "size": 48,
    "samples": 64,
    "hair_melanin": 0.75,
    "hair_redness": 0.5,
    "hair_roughness": 0.3,
    "hair_radius_root": 0.0003,
    "hair_radius_tip": 0.0002,
    "sun_direction": [0.5, 0.8, 0.6],
    "sun_strength": 2.5,
    "ambient": 0.25,
    "skin_rgb": [0.6, 0.38, 0.3],
}


@pytest.fixture
def files(tmp_path):
    """Strands that hang before a ball, strewn as hair is and not in one plane, and the ball."""
    rng = np.random.default_rng(1)
    x, z = rng.uniform(-0.05, 0.05, (400, 1)), rng.uniform(0.085, 0.1, (400, 1))
    points = np.stack(np.broadcast_arrays(x, np.linspace(0.12, -0.02, 8), z), axis=-1)
    np.save(tmp_path / "curtain.npy", points.astype(np.float32))
    trimesh.creation.icosphere(subdivisions=3, radius=0.07).export(tmp_path / "ball.obj")
    return tmp_path


def drawn(headstudio, files, heads=("ball.obj",), **changes):
    (files / "view.json").write_text(json.dumps(VIEW | changes))
    words = [word for head in heads for word in ("--head", files / head)]
    ran = headstudio("render", files / "curtain.npy", *words, "--view", files / "view.json", "--out", files / "out.png")
    assert ran.status == 0, ran.complaint
    return np.asarray(Image.open(files / "out.png").convert("RGB")).astype(float)


def test_hair_hangs_before_the_ball(headstudio, files):
    picture = drawn(headstudio, files)
    assert picture.shape == (48, 48, 3)
    np.testing.assert_array_equal(picture[0, 0], 137)  # 0.25 in sRGB
    hair, skin = picture[18:24, 20:28].mean(), picture[33:36, 20:28].mean()
    # Cycles has it at 0.646.
    assert 0.58 * skin < hair < 0.71 * skin
    assert np.abs(drawn(headstudio, files, hair_melanin=0.1)[18:24, 20:28].mean() - hair) > 20


def test_camera_light_and_size_are_obeyed(headstudio, files):
    usual = drawn(headstudio, files)
    assert drawn(headstudio, files, size=24).shape == (24, 24, 3)
    # In Cycles the sun adds 4.9 there.
    assert drawn(headstudio, files, sun_strength=0)[30:36, 20:28].mean() < usual[30:36, 20:28].mean() - 4
    np.testing.assert_array_equal(drawn(headstudio, files, ambient=0.5)[0, 0], 188)
    assert np.abs(drawn(headstudio, files, eye=[0.8, 0.1, 0.0]) - usual).mean() > 3


def test_hair_without_a_head_and_with_two(headstudio, files):
    trimesh.creation.icosphere(subdivisions=2, radius=0.03).apply_translation([0.15, 0, 0]).export(files / "small.obj")
    none, one, two = (drawn(headstudio, files, heads) for heads in ((), ("ball.obj",), ("ball.obj", "small.obj")))
    beside = np.s_[28:31, 40:43]
    assert np.abs(one[beside] - none[beside]).max() < 6
    assert np.abs(two[beside] - one[beside]).mean() > 10
    assert np.abs(one[33:36, 22:26] - none[33:36, 22:26]).mean() > 10


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"eye": [0, 0]}, "eye is three numbers"),
        ({"fov_degrees": 0}, "fov_degrees lies between"),
        ({"size": 10.5}, "size is a whole number"),
        ({"max_bounces": 0}, "max_bounces lies between"),
        ({"ambient": "bright"}, "ambient is no number"),
        ({"hair_melanin": 1.5}, "hair_melanin lies between"),
        ({"target": VIEW["eye"]}, "the same place"),
        ({"sun_direction": [0, 0, 0]}, "no length"),
        ({"skin_rgb": None}, "skin_rgb"),
    ],
)
def test_wrong_fields_are_named(headstudio, files, changes, said):
    (files / "view.json").write_text(json.dumps(VIEW | changes))
    ran = headstudio("render", files / "curtain.npy", "--head", files / "ball.obj", "--view", files / "view.json")
    assert ran.status == 2
    assert said in " ".join(ran.complaint.split())


def test_what_is_missing_is_said(headstudio, files):
    ran = headstudio("render", files / "curtain.npy", "--head", files / "ball.obj")
    assert ran.status == 2
    assert "--view" in ran.complaint
    (files / "view.json").write_text(json.dumps({key: value for key, value in VIEW.items() if key != "ambient"}))
    ran = headstudio("render", files / "curtain.npy", "--view", files / "view.json")
    assert ran.status == 2
    assert "does not say ambient" in " ".join(ran.complaint.split())
    (files / "view.json").write_text("{")
    assert headstudio("render", files / "curtain.npy", "--view", files / "view.json").status == 2
    assert headstudio("render", files / "bald.npy", "--view", files / "view.json").status == 2
