"""Keyframes of a face: set, moved, taken away, and what sliders mean while there are any."""

import pytest

from headstudio.wrinkle.face_settings import FaceSettings
from headstudio.wrinkle.performance import SAME_TIME, check_performance, keyframe, moved_key, with_key, without_key

THREE = tuple(keyframe(time, {"smile": time}) for time in (0.0, 0.5, 1.0))


def test_a_key_takes_its_place_in_time_or_that_of_the_one_there():
    between = keyframe(0.25, {"smile": 0.9})
    assert with_key(THREE, between) == (THREE[0], between, *THREE[1:])
    instead = keyframe(0.5 + 0.5 * SAME_TIME, {"angry": 1.0})
    assert with_key(THREE, instead) == (THREE[0], instead, THREE[2])
    assert without_key(THREE, 1) == (THREE[0], THREE[2])


@pytest.mark.parametrize(
    ("index", "time", "low", "high"), [(0, -1, 0, 0), (1, 7, 0.5, 1), (1, -7, 0, 0.5), (2, 9, 9, 9)]
)
def test_a_key_moves_between_its_neighbours(index, time, low, high):
    moved = moved_key(THREE, index, time)
    check_performance(moved, ("smile",))
    assert low <= moved[index].time <= high
    assert moved[index].weights == THREE[index].weights


def test_a_slider_of_a_still_face_is_just_set():
    assert FaceSettings(smile=0.2).with_sliders({"smile": 0.7}, 3.0) == FaceSettings(smile=0.7)


def test_a_slider_of_a_performance_sets_a_key_at_the_playhead():
    face = FaceSettings(performance=THREE).with_sliders({"smile": 0.9}, 0.25)
    assert [key.time for key in face.performance] == [0.0, 0.25, 0.5, 1.0]
    assert face.at(0.25).smile == pytest.approx(0.9)
    assert face.at(1.0).smile == 1.0


def test_a_slider_that_begins_to_move_keeps_what_it_had_elsewhere():
    face = FaceSettings(squint=0.4, performance=THREE).with_sliders({"squint": 1.0}, 0.5)
    assert (face.at(0.0).squint, face.at(0.5).squint, face.at(1.0).squint) == pytest.approx((0.4, 1.0, 0.4))
    assert face.at(0.5).smile == 0.5


def test_a_key_of_the_face_as_it_is_changes_nothing_there():
    face = FaceSettings(blink=0.3, performance=THREE)
    keyed = face.with_key(0.7)
    for time in (0.0, 0.7, 1.0):
        assert keyed.at(time).smile == pytest.approx(face.at(time).smile)
        assert keyed.at(time).blink == pytest.approx(0.3)
    assert FaceSettings().with_key(0.0).performance == (keyframe(0.0, {}),)
