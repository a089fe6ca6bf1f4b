"""The skin of a face in a process of its own: the same skin, foreseen for the next frame, and what happens in between."""

import dataclasses

import numpy as np
import pytest

from headstudio.params import assign
from headstudio.scene.animation import Animation
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.face_ahead import FaceAhead
from headstudio.scene.motion import head_motion
from headstudio.wrinkle.face_settings import FaceSettings
from headstudio.wrinkle.performance import keyframe

FRAME = 1 / 30
SMILING = FaceSettings(performance=(keyframe(0.0, {"smile": 0.0}), keyframe(4.0, {"smile": 1.0})))
SMALL = assign(
    Document(),
    {
        "head.source": "mannequin",
        "look.skin_as": "living",
        "look.hair_as": "none",
        "fine.texture_size": 128,
        "wrinkle.fineness": 1.0,
    },
)


@pytest.fixture(scope="module")
def builder():
    return Builder()


@pytest.fixture(scope="module")
def skin(builder):
    return builder.skin(SMALL)


@pytest.fixture(scope="module")
def running(skin):
    face = FaceAhead(skin)
    assert face.wait_for_process()
    return face


@pytest.fixture
def face(running):
    running.advance(FaceSettings(), 0.0, FRAME)
    running.at(FaceSettings(), 0.0)
    return running


def play(face, settings, times):
    """What is shown at each time, a frame apart."""
    shown = []
    for time in times:
        face.advance(settings, time, FRAME)
        shown.append(face.at(settings, time))
    return shown


def same(one, other):
    for name in ("positions", "normals", "height", "amplitude"):
        np.testing.assert_allclose(getattr(one.skin, name), getattr(other.skin, name), atol=1e-7)
    np.testing.assert_allclose(one.amplitudes, other.amplitudes)
    np.testing.assert_allclose(one.expansion, other.expansion)
    for part, as_well in zip(one.parts, other.parts, strict=True):
        np.testing.assert_allclose(part.mesh.vertices, as_well.mesh.vertices)


def test_the_foreseen_skin_is_that_of_the_frame_it_is_shown_in(face, skin):
    for time, shown in zip((1.0, 1.0 + FRAME), play(face, SMILING, (1.0, 1.0 + FRAME)), strict=True):
        same(shown, skin.at(SMILING.at(time)))
        assert shown.surface is skin.surface
    assert face.shows(SMILING, 1.0 + FRAME)


def test_a_frame_that_comes_late_shows_what_was_foreseen_until_time_stands_still(face, skin):
    play(face, SMILING, (1.0, 1.0 + FRAME))
    late = 1.0 + 2.3 * FRAME
    face.advance(SMILING, late, FRAME)
    same(face.at(SMILING, late), skin.at(SMILING.at(1.0 + 2 * FRAME)))
    assert not face.shows(SMILING, late)
    same(face.at(SMILING, late), skin.at(SMILING.at(late)))
    assert face.shows(SMILING, late)


def test_a_jump_and_another_slider_are_shown_at_once(face, skin):
    play(face, SMILING, (1.0, 1.0 + FRAME))
    face.advance(SMILING, 3.0, FRAME)
    same(face.at(SMILING, 3.0), skin.at(SMILING.at(3.0)))
    angry = dataclasses.replace(SMILING, angry=0.8)
    face.advance(angry, 3.0 + FRAME, FRAME)
    same(face.at(angry, 3.0 + FRAME), skin.at(angry.at(3.0 + FRAME)))


def test_other_tissue_reaches_the_process(face, skin):
    full = dataclasses.replace(SMILING, tissue="full")
    play(face, SMILING, (1.0, 1.0 + FRAME))
    same(play(face, full, (2.0, 2.0 + FRAME))[-1], skin.at(full.at(2.0 + FRAME)))


def test_a_face_that_holds_still_asks_nobody_and_stays_the_same_object(face):
    shown = play(face, FaceSettings(smile=0.3), (1.0, 1.0 + FRAME, 1.0 + 2 * FRAME))
    assert shown[0] is shown[1] is shown[2]


def test_a_process_is_started_for_skin_that_lasts_and_its_end_stops_nothing(skin):
    face = FaceAhead(skin)
    play(face, SMILING, np.arange(10) * FRAME)
    assert face._worker is None
    play(face, SMILING, np.arange(10, 20) * FRAME)
    assert face._worker is not None
    assert face.wait_for_process()
    play(face, SMILING, (1.0, 1.0 + FRAME))
    face._worker._pipe.close()
    same(play(face, SMILING, (2.0, 2.0 + FRAME))[-1], skin.at(SMILING.at(2.0 + FRAME)))


def test_an_animation_that_somebody_looks_at_is_exact_again_when_it_stops(builder, skin):
    animation = Animation(builder, dataclasses.replace(SMALL, face=SMILING), live=True)
    assert animation.skin is skin
    still = head_motion(SMALL.motion)
    for seconds in (0.6, FRAME, FRAME):
        animation.advance(still, seconds)
        animation.stage()
    assert animation._face.wait_for_process()
    for seconds in (FRAME, FRAME, 1.5 * FRAME):
        animation.advance(still, seconds)
        animation.stage()
    assert not animation.exact
    same(animation.stage().skin, skin.at(SMILING.at(animation.face_time)))
    assert animation.exact
