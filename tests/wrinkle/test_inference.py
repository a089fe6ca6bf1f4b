"""Furrows proposed from how skin shrinks."""

from __future__ import annotations

import numpy as np
import pytest

from headstudio.head.mannequin import mannequin
from headstudio.wrinkle.face import Face
from headstudio.wrinkle.face_creases import face_layout
from headstudio.wrinkle.inference import propose_furrows, shrinkage_across
from headstudio.wrinkle.skin_layout import SkinLayout
from headstudio.wrinkle.valleys import ANGLES

from .skins import flat_map, sheet


def middle_line(furrow):
    return furrow.chain.sampled(20)[1]


def test_shrinkage_is_found_across_furrows_and_not_along_them():
    layout = SkinLayout.of_map(flat_map(sheet(), stretch=(8.0, 5.0)))
    narrower = layout.skin.vertices * [0.8, 1.0, 1.0]
    found = shrinkage_across(layout, narrower)
    # What shrinks from left to right folds into furrows that run up.
    assert found[ANGLES // 2] == pytest.approx(np.full(found.shape[1], 0.2), abs=1e-9)
    assert found[0].max() < 1e-9


def test_stretched_skin_asks_for_nothing():
    layout = SkinLayout.of_map(flat_map(sheet()))
    assert shrinkage_across(layout, layout.skin.vertices * [1.3, 1.3, 1.0]).max() == 0.0


@pytest.fixture(scope="module")
def face():
    return Face(mannequin())


def test_a_frown_is_folded_upright_and_raised_brows_level(face):
    layout = face_layout(face.head)
    frown = propose_furrows(face, layout, {"angry": {"angry": 1.0}})
    raised = propose_furrows(face, layout, {"surprise": {"surprise": 1.0}})

    def steepness(furrows, inside):
        """Of those that have their middle inside.

        Others only pass. Above the inner end of a brow three ridges meet, and a line goes on along the one that texels
        favour: the mannequin's mouth, cut open, is a hole of the map and moved it by a quarter of a texel there, though the
        skin moves as before. So the line from beside the eye went up between the brows and no longer across.
        """
        lines = [line for line in map(middle_line, furrows) if inside(line[len(line) // 2])]
        x, y = np.abs(np.concatenate([np.diff(line, axis=0) for line in lines])).sum(axis=0)
        return y / x

    assert steepness(frown, lambda middle: abs(middle[0]) < 0.02 and 0.02 < middle[1] < 0.045) > 2.0
    assert steepness(raised, lambda middle: abs(middle[0]) < 0.04 and middle[1] > 0.025) < 0.6


def test_proposals_are_furrows_that_an_artist_can_take_over(face):
    furrows = propose_furrows(face, face_layout(face.head))
    assert 5 < len(furrows) <= 40
    assert len({furrow.name for furrow in furrows}) == len(furrows)
    for furrow in furrows:
        assert 0 < furrow.initial <= 0.25
        assert 5e-4 < furrow.depth <= 8e-3
        assert np.abs(furrow.controls).max() < 0.25


def test_a_face_that_rests_gets_none(face):
    assert propose_furrows(face, face_layout(face.head), {"neutral": {}}) == ()
