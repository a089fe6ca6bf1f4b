"""Every style that ships, on a head: it builds, lies outside of the skin, and what is worn is closed."""

from __future__ import annotations

import os

import igl
import numpy as np
import pytest

from headstudio.head.depth import SkinDepth
from headstudio.head.frame import HeadFrame
from headstudio.params import assign
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.styles import load_style, style_names

# One of each kind; HEADSTUDIO_SLOW=1 takes all.
SAMPLE = ("beard", "bob", "crown-braid", "figure-14d", "figure-15a", "hairband", "side-part", "tight-curls")
NAMES = style_names() if os.environ.get("HEADSTUDIO_SLOW") else SAMPLE
STRANDS = 400


@pytest.fixture(scope="module")
def builder() -> Builder:
    return Builder()


@pytest.mark.parametrize("name", NAMES)
def test_a_style_lies_on_the_head_and_not_in_it(name, builder):
    document = load_style(name).on(assign(Document(), {"head.source": "mannequin"}))
    hairdo = builder.hairdo(assign(document, {"wisp.wisps": 250}), STRANDS)
    points = hairdo.strands.points.astype(np.float64)
    assert hairdo.strands.count >= STRANDS
    assert np.isfinite(points).all()
    assert SkinDepth(builder.head(document.head)).deepest(points, HeadFrame()) < 0.001
    elastics = [operation for operation in document.styling.operations if getattr(operation, "elastic", False)]
    assert len(hairdo.adornments) == len(document.styling.accessories) + len(elastics)
    for worn in hairdo.adornments:
        assert len(igl.boundary_facets(worn.mesh.faces)[0]) == 0


def test_hair_that_nobody_styled_leaves_the_face_free(builder):
    document = assign(Document(), {"head.source": "mannequin", "wisp.wisps": 400})
    hairdo, marks = builder.hairdo(document, 2000), builder.head(document.head).landmarks
    points = hairdo.strands.points
    across = max(abs(marks.left_eye[0]), abs(marks.right_eye[0]))
    before = (np.abs(points[:, 0]) < across) & (points[:, 2] > marks.left_eye[2])
    before &= (points[:, 1] < marks.glabella[1]) & (points[:, 1] > marks.chin[1])
    owner = np.repeat(np.arange(hairdo.strands.count), hairdo.strands.counts)
    assert len(np.unique(owner[before])) < 0.005 * hairdo.strands.count
