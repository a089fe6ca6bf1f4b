"""Hairstyles on demand: what a change concerns, and hair of the face among that of the head."""

import numpy as np
import pytest

from headstudio.params import assign
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.wisp.strands import Strands

SMALL = assign(Document(), {"head.source": "mannequin", "wisp.wisps": 60, "wisp.strands": 3000, "wisp.points": 6})


@pytest.fixture(scope="module")
def builder():
    return Builder()


def test_hair_is_styled_again_when_its_settings_change_and_only_then(builder):
    first = builder.hairdo(SMALL)
    assert builder.hairdo(assign(SMALL, {"look.shadows": False, "lcp.friction": 1.0, "hair.particles": 500})) is first
    for path, value in {"wisp.fuzziness": "0.4", "styling.gravity": 0.5, "colour.pigment": "red"}.items():
        assert builder.hairdo(assign(SMALL, {path: value})) is not first


def test_a_preview_is_a_part_of_the_whole(builder):
    whole, few = builder.hairdo(SMALL).strands, builder.hairdo(SMALL, 500).strands
    assert few.count == 500
    np.testing.assert_allclose(few.points, whole.points[: len(few.points)], atol=2e-6)


def test_hair_of_the_face_is_among_the_strands_in_their_proportion(builder):
    document = assign(SMALL, {"beard.style": "full beard", "beard.strands": 1000})
    without, bearded = builder.hairdo(SMALL).strands, builder.hairdo(document).strands
    assert bearded.count == without.count + 1000
    assert builder.hairdo(document).strands is bearded
    few = builder.hairdo(document, 1500).strands
    assert few.count == pytest.approx(2000, abs=2)
    chin = builder.head(document.head).landmarks.chin
    assert near(bearded, chin) > 5 * near(without, chin)


def near(strands: Strands, place: np.ndarray) -> int:
    """How many strands are rooted within 3 cm of a place."""
    return int((np.linalg.norm(strands.points[strands.first[:-1]] - place, axis=1) < 0.03).sum())
