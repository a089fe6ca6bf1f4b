"""Commands that simulate and draw, small."""

import json
import math
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

SMALL = ("--head", "mannequin", "--particles", 200)
TINY = (*SMALL, "--size", 48)


def read(path):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB"))


@pytest.fixture
def stats(headstudio):
    ran = headstudio("simulate", *SMALL, "--motion", "shake", "--seconds", 0.2, "--seed", 7, "--stats", "s/stats.json")
    assert ran.status == 0
    return json.loads(Path("s/stats.json").read_text())


def test_the_stats_file_says_what_ran(stats):
    assert set(stats) == {"versions", "renderer", "seed", "particles", "links", "solver", "frames"}
    assert stats["seed"] == 7
    assert stats["particles"] == pytest.approx(200, rel=0.02)
    assert stats["links"] > stats["particles"]
    assert stats["renderer"] is None, "nothing was drawn"
    assert stats["versions"]["numpy"] == np.__version__


def test_every_frame_is_flat_and_has_its_figures(stats):
    wanted = {
        "time",
        "kinetic_energy",
        "stretch_rms",
        "stretch_max",
        "reach_max",
        "penetration_max",
        "min_pair_distance",
        "density_variance",
        "ms_simulation",
    }
    assert len(stats["frames"]) == 6
    for frame in stats["frames"]:
        assert wanted <= set(frame)
        assert all(value is None or math.isfinite(value) for value in frame.values())
    np.testing.assert_allclose([frame["time"] for frame in stats["frames"]], np.arange(1, 7) / 30)


def test_the_same_seed_gives_the_same_numbers(headstudio):
    runs = []
    for name in ("a.json", "b.json"):
        headstudio("simulate", *SMALL, "--motion", "nod", "--seconds", 0.1, "--stats", name)
        frames = json.loads(Path(name).read_text())["frames"]
        runs.append([{key: v for key, v in frame.items() if not key.startswith("ms_")} for frame in frames])
    assert runs[0] == runs[1]


def test_a_film_has_its_frames(headstudio):
    ran = headstudio("simulate", *TINY, "--motion", "turn", "--seconds", 0.2, "--out", "turn.mp4")
    assert ran.status == 0
    assert "turn.mp4" in ran.output
    frames, seconds = imageio_ffmpeg.count_frames_and_secs("turn.mp4")
    assert frames == 6
    assert seconds == pytest.approx(0.2, abs=0.05)


def test_a_folder_has_a_picture_for_every_frame(headstudio):
    headstudio("simulate", *TINY, "--seconds", 0.1, "--fps", 20, "--out", "frames")
    pictures = sorted(Path("frames").iterdir())
    assert len(pictures) == 2
    assert read(pictures[0]).shape == (48, 48, 3)


def test_a_recorded_motion_moves_the_head(headstudio):
    Path("take.csv").write_text("time,ry\n0,0\n0.2,40\n")
    headstudio("simulate", *SMALL, "--motion", "take.csv", "--seconds", 0.2, "--stats", "moved.json")
    turned = [frame["head_ry"] for frame in json.loads(Path("moved.json").read_text())["frames"]]
    assert turned[-1] == pytest.approx(math.radians(40))
    assert turned == sorted(turned)


def test_a_picture_shows_what_was_asked_for(headstudio):
    assert headstudio("render", *SMALL, "--size", "64x48", "--view", "front", "--out", "front.png").status == 0
    headstudio("render", *SMALL, "--size", "64x48", "--view", "back", "--out", "back.png")
    headstudio(
        "render", *SMALL, "--size", "64x48", "--view", "front", "--set", "look.hair_colour=#d0c060", "--out", "b.png"
    )
    front, back, blond = read("front.png"), read("back.png"), read("b.png")
    assert front.shape == (48, 64, 3)
    assert headstudio("compare", "front.png", "back.png").status == 1
    assert blond.mean() > front.mean() > back.mean(), "blond is lighter than brown, a face than hair"


def test_a_picture_of_a_moment(headstudio):
    for seconds in (0, 0.25):
        headstudio("render", *TINY, "--motion", "shake", "--seconds", seconds, "--out", f"{seconds}.png")
    assert headstudio("compare", "0.png", "0.25.png").status == 1


def test_the_demo_fills_its_folder(headstudio, monkeypatch):
    from headstudio.commands import demo

    monkeypatch.setattr(demo, "QUICK", demo.Scale(particles=150, size=40, length=0.03))
    ran = headstudio("demo", "--quick", "--out", "made", "--head", "mannequin")
    assert ran.status == 0
    assert str(Path("made").resolve()) in ran.output
    scenes = {scene.name for scene in demo.SCENES}
    wanted = {f"{name}.{kind}" for name in scenes for kind in ("mp4", "png", "json")} | {"views.png", "shadows.png"}
    assert {path.name for path in Path("made").iterdir()} == wanted
