"""Hair that was groomed in another program, in the place of the styled hair."""

import dataclasses

import numpy as np
import pytest

from headstudio.params import assign
from headstudio.scene.attachments import decode_groom, encode_groom
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.project import load_project, save_project
from headstudio.scene.styles import load_style
from headstudio.wisp.groom import Groom, mixed
from headstudio.wisp.strands import Strands

from .dressed import body


@pytest.fixture(scope="module")
def ragged() -> Strands:
    """300 strands of 2 to 9 points that stand out of the scalp by 5 cm and start 2 mm below it."""
    _, scalp, _ = body()
    rng = np.random.default_rng(4)
    uv = scalp.random_points(300, rng)
    roots, normals, counts = scalp.points(uv), scalp.normals(uv), rng.integers(2, 10, 300)
    strands = [
        root + np.linspace(-0.002, 0.05, count)[:, None] * normal for root, normal, count in zip(roots, normals, counts)
    ]
    return Strands(np.concatenate(strands), np.concatenate([[0], np.cumsum(counts)]))


@pytest.fixture(scope="module")
def document(ragged) -> Document:
    plain = assign(Document(), {"head.source": "mannequin", "wisp.strands": 200})
    return dataclasses.replace(plain, groom=dataclasses.replace(plain.groom, hair=Groom("ragged.hair", ragged)))


def known(strands: Strands) -> Strands:
    rng = np.random.default_rng(5)
    points = len(strands.points)
    return dataclasses.replace(
        strands, radius=rng.uniform(1e-5, 5e-5, points).astype("f4"), colour=rng.random((points, 3), dtype="f4")
    )


def test_picked_strands_take_all_that_is_theirs_along(ragged):
    strands = dataclasses.replace(known(ragged), wisp=np.arange(300, dtype=np.int32))
    order = np.random.default_rng(6).permutation(300)[:50]
    picked = strands.picked(order)
    assert picked.count == 50
    for k, strand in enumerate(order):
        here, there = slice(*picked.first[k : k + 2]), slice(*strands.first[strand : strand + 2])
        for name in ("points", "radius", "colour"):
            np.testing.assert_array_equal(getattr(picked, name)[here], getattr(strands, name)[there])
    np.testing.assert_array_equal(picked.wisp, order)


def test_a_project_keeps_it(document, ragged, tmp_path):
    for strands in (ragged, known(ragged)):
        kept = dataclasses.replace(document, groom=dataclasses.replace(document.groom, hair=Groom("ä.hair", strands)))
        save_project(kept, tmp_path / "groomed.headstudio")
        assert load_project(tmp_path / "groomed.headstudio").document == kept
    assert Groom("a", ragged) != Groom("a", known(ragged)) != Groom("b", known(ragged))


def test_what_is_no_groom_is_refused(ragged):
    content = encode_groom(Groom("a", ragged))
    assert decode_groom(content) == Groom("a", ragged)
    for damaged in (b"", content[:-8], content.replace(b"<f4", b"<i4"), content[:128] + content):
        with pytest.raises(ValueError, match="strands"):
            decode_groom(damaged)


def test_it_takes_the_place_of_styled_hair_and_is_laid_as_asked(document, ragged):
    builder = Builder()
    _, _, surroundings = body()
    laid = builder.hairdo(document).strands
    assert laid.count == ragged.count
    assert surroundings.distance(laid.points).min() > 0.0003
    assert laid.radius is not None
    assert laid.colour.shape == laid.points.shape
    assert builder.hairdo(assign(document, {"look.shadows": False})).strands is laid
    few = builder.hairdo(document, 40).strands
    assert few.stands_for == pytest.approx(300 / 40)
    np.testing.assert_array_equal(few.points, laid.points[: len(few.points)])
    as_it_is = builder.hairdo(assign(document, {"groom.reroot": False, "groom.lift": False})).strands
    np.testing.assert_allclose(as_it_is.points, mixed(ragged).points, atol=1e-6)


def test_what_the_file_says_of_shafts_and_colours_is_kept(document, ragged):
    kept = dataclasses.replace(document.groom, hair=Groom("known.hair", known(ragged)))
    strands = Builder().hairdo(dataclasses.replace(document, groom=kept)).strands
    order = mixed(known(ragged))
    np.testing.assert_allclose(strands.radius, order.radius)
    np.testing.assert_array_equal(strands.colour, order.colour)


def test_a_beard_grows_beside_it_and_a_style_takes_its_place(document):
    bearded = assign(document, {"beard.style": "full beard", "beard.strands": 500})
    assert Builder().hairdo(bearded).strands.count == 800
    assert load_style("bob").on(document).groom.hair is None
