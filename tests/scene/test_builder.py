"""Building only what a change concerns."""

import os

import pytest

from headstudio.params import assign
from headstudio.scene import builder as builder_module
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document

SMALL = assign(Document(), {"head.source": "mannequin", "hair.particles": 300})


@pytest.fixture
def made(monkeypatch):
    """Stands in for the makers of the parts: each part is a fresh object, and what was made is written down."""
    log = []

    def maker(kind):
        def make(*_, **__):
            log.append(kind)
            return object()

        return make

    monkeypatch.setattr(builder_module, "load_head", maker("head"))
    monkeypatch.setattr(builder_module, "grow_scalp", maker("scalp"))
    monkeypatch.setattr(builder_module.Body, "around", maker("body"))
    monkeypatch.setattr(builder_module, "grow_hair", maker("hair"))
    return log


def test_it_builds_everything_once(made):
    builder = Builder()
    first = builder.build(SMALL)
    assert made == ["head", "scalp", "body", "hair"]
    again = builder.build(assign(SMALL, {"hair.particles": 300}))
    assert made == ["head", "scalp", "body", "hair"]
    assert (again.head, again.scalp, again.body, again.hair) == (first.head, first.scalp, first.body, first.hair)


@pytest.mark.parametrize(
    ("path", "value", "concerned"),
    [
        ("hair.length", 0.2, ["hair"]),
        ("scalp.whorl_u", 0.4, ["scalp", "hair"]),
        ("head.source", "makehuman", ["head", "scalp", "body", "hair"]),
        ("lcp.friction", 1.0, []),
        ("look.shadows", False, []),
        ("camera.azimuth", 1.0, []),
        ("motion.kind", "nod", []),
    ],
)
def test_a_change_makes_again_only_what_it_concerns(made, path, value, concerned):
    builder = Builder()
    builder.build(SMALL)
    made.clear()
    builder.build(assign(SMALL, {path: value}))
    assert made == concerned


def test_a_head_file_that_was_written_again_is_read_again(made, tmp_path):
    file = tmp_path / "head.obj"
    file.touch()
    document = assign(SMALL, {"head.source": str(file)})
    builder = Builder()
    builder.build(document)
    made.clear()
    os.utime(file, (1, 1))
    builder.build(document)
    assert made[0] == "head"


def test_it_announces_what_it_makes(made):
    announced = []
    Builder(announced.append).build(SMALL)
    assert announced == made


def test_a_head_of_hair_grows():
    built = Builder().build(SMALL)
    assert built.hair.count == pytest.approx(300, rel=0.02)
    assert len(built.hair.links) > built.hair.count
