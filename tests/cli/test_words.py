"""Commands that answer in words, and how all commands fail."""

import os
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from headstudio import __version__
from headstudio.params import assign, walk
from headstudio.scene.document import Document
from headstudio.scene.project import save_project

SMALL = ("--head", "mannequin", "--particles", 200, "--size", 48)


def test_version_names_what_computes(headstudio):
    lines = dict(line.split(" ", 1) for line in headstudio("version").output.splitlines())
    assert lines["headstudio"] == __version__
    assert lines["numpy"] == np.__version__


def test_params_lists_every_parameter_on_a_line_of_its_own(headstudio):
    lines = headstudio("params").output.splitlines()
    assert [line.split("\t")[0] for line in lines] == [name for name, _, _ in walk(Document())]


def test_params_tells_default_range_unit_and_help(headstudio):
    (line,) = headstudio("params", "lcp.gravity").output.splitlines()
    assert line.split("\t")[:4] == ["lcp.gravity", "9.81", "0 to 30", "m/s^2"]
    assert "free fall" in line


def test_params_says_when_nothing_has_that_name(headstudio):
    ran = headstudio("params", "zzz")
    assert ran.status == 2
    assert "'zzz'" in ran.complaint


@pytest.mark.parametrize("command", ["", "demo", "simulate", "render", "inspect", "compare", "bench", "params", "open"])
def test_every_command_has_help(headstudio, command):
    ran = headstudio(*command.split(), "--help")
    assert ran.status == 0
    assert "Usage" in ran.output


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("render", "--set", "lcp.gravty=1"), "did you mean lcp.gravity"),
        (("render", "--set", "lcp.gravity=1e9"), "lcp.gravity goes from 0 to 30"),
        (("render", "--set", "gravity"), "--set takes NAME=VALUE"),
        (("render", "--size", "wide"), "512 or 640x480"),
        (("render", "--size", "0"), "1 to 16384 pixels"),
        (("render", "--size", "512x100000"), "1 to 16384 pixels"),
        (("render", "--view", "inside"), "a view is one of"),
        (("render", "--out", "picture.jpg", *SMALL), "ends in .png"),
        (("render", "--head", "nobody.obj"), "nobody.obj"),
        (("render", "missing.headstudio"), "missing.headstudio: No such file"),
        (("simulate", "--motion", "jump"), "motion.kind is one of"),
        (("simulate", "--motion", "missing.csv"), "missing.csv: No such file"),
        (("simulate", "--particles", "7"), "hair.particles goes from 100"),
        (("simulate", "--seed", "-1"), "hair.seed goes from 0"),
        (("simulate", "--out", "film.avi"), "a film ends in .mp4"),
        (("simulate", "--stats", "."), "Is a directory"),
        (("render", "--out", "/dev/null/picture.png"), "/dev/null"),
        (("style", "--out", "/dev/null/picture.png"), "/dev/null"),
        (("bake", "--out", "/dev/null/maps"), "/dev/null"),
        (("inspect", "nobody.stl"), "nobody.stl"),
        (("compare", "a.png", "b.png"), "a.png: there is no such file"),
    ],
)
def test_a_mistake_gives_one_line_and_status_2(headstudio, words, complaint):
    ran = headstudio(*words)
    assert ran.status == 2
    assert complaint in ran.complaint
    assert len(ran.complaint.splitlines()) == 1
    assert ran.output == ""


@pytest.mark.parametrize("words", [("simulate", "--seconds", "0"), ("nonsense",), ("render", "--nonsense")])
def test_words_that_are_no_command_have_status_2(headstudio, words):
    assert headstudio(*words).status == 2


def test_a_foreign_file_is_no_project(headstudio):
    Path("notes.headstudio").write_text("dear diary")
    ran = headstudio("render", "notes.headstudio")
    assert ran.status == 2
    assert ran.complaint == "headstudio: notes.headstudio: this is no headstudio project\n"


def test_what_a_project_holds_that_nobody_knows_is_a_warning(headstudio):
    save_project(assign(Document(), {"head.source": "mannequin", "hair.particles": 200}), Path("hair.headstudio"))
    with zipfile.ZipFile("hair.headstudio", "a") as archive:
        archive.writestr("glitter.json", "{}")
    ran = headstudio("render", "hair.headstudio", "--size", 32)
    assert (ran.status, ran.output) == (0, "picture.png\n")
    assert ran.complaint == "warning: glitter.json is not known to this version and was left out\n"


def test_alone_it_opens_the_window(headstudio, monkeypatch):
    opened = []
    monkeypatch.setattr("headstudio.app.main", lambda *words: opened.append(words))
    assert headstudio().status == 0
    assert headstudio("open", "hair.headstudio").status == 0
    assert headstudio("open", "--head", "mannequin", "--set", "hair.length=0.2").status == 0
    assert opened == [
        (None, {}),
        ("hair.headstudio", {}),
        (None, {"head.source": "mannequin", "hair.length": "0.2"}),
    ]


def test_a_parameter_that_the_window_cannot_take_is_one_line(headstudio):
    ran = headstudio("open", "--set", "hair.length=long")
    assert ran.status == 2
    assert "hair.length takes a number" in ran.complaint


def test_compare_tells_same_from_different(headstudio):
    picture = np.random.default_rng(1).integers(0, 255, (20, 30, 3), dtype=np.uint8)
    other = picture.copy()
    other[:5] = 255 - other[:5]
    Image.fromarray(picture).save("a.png")
    Image.fromarray(other).save("b.png")
    assert headstudio("compare", "a.png", "a.png").status == 0
    ran = headstudio("compare", "a.png", "b.png", "--difference", "difference.png")
    assert ran.status == 1
    assert ran.output.startswith("different")
    with Image.open("difference.png") as difference:
        assert difference.size == (90, 20)


def test_inspect_tells_what_a_head_holds(headstudio):
    ran = headstudio("inspect", "mannequin")
    assert ran.status == 0
    assert "triangles" in ran.output
    assert "scalp" in ran.output


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_says_cancelled_with_status_130(tmp_path):
    words = [sys.executable, "-c", "from headstudio.cli import main; main()", "simulate", "--seconds", "600", "--head"]
    running = subprocess.Popen(
        [*words, "mannequin"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
        # Tests that run in the background of a shell are deaf to Ctrl-C, and so would be what they start.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    try:
        time.sleep(1.5)
        running.send_signal(signal.SIGINT)
        try:
            _, complaint = running.communicate(timeout=30)
        except subprocess.TimeoutExpired:
            # On a busy machine the first came so early that Python was still loading: a person would press again.
            running.send_signal(signal.SIGINT)
            _, complaint = running.communicate(timeout=60)
    finally:
        running.kill()
    assert running.returncode == 130
    assert complaint.strip().splitlines()[-1:] in ([], ["headstudio: cancelled"])


def test_a_reader_who_has_seen_enough_is_no_error(tmp_path):
    line = "\"$0\" -c 'from headstudio.cli import main; main()' params | head -n 1"
    done = subprocess.run(["bash", "-c", line, sys.executable], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout.startswith("head.source")
    assert "Traceback" not in done.stderr
