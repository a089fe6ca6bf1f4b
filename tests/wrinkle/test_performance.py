"""Keyframes of expressions."""

from __future__ import annotations

import numpy as np
import pytest

from headstudio.scene.attachments import decode_performance, encode_performance
from headstudio.wrinkle.face_settings import SLIDERS, FaceSettings
from headstudio.wrinkle.performance import check_performance, keyframe, weights_at

TAKE = (
    keyframe(0.0, {}),
    keyframe(0.5, {"smile": 1.0}),
    keyframe(1.5, {"smile": 1.0, "squint_left": 0.4}),
    keyframe(2.0, {"squint_left": 0.1}),
)


def test_keyframes_are_met_and_held_before_and_after():
    assert weights_at(TAKE, 0.5) == pytest.approx({"smile": 1.0, "squint_left": 0.0})
    assert weights_at(TAKE, 1.5) == pytest.approx({"smile": 1.0, "squint_left": 0.4})
    assert weights_at(TAKE, -3.0) == pytest.approx({"smile": 0.0, "squint_left": 0.0})
    assert weights_at(TAKE, 9.0) == pytest.approx({"smile": 0.0, "squint_left": 0.1})
    assert weights_at((), 1.0) == {}
    assert weights_at(TAKE[1:2], 7.0) == {"smile": 1.0}


def test_motion_between_keyframes_is_smooth_and_never_goes_beyond_them():
    times = np.linspace(-0.2, 2.2, 2401)
    smile = np.array([weights_at(TAKE, time)["smile"] for time in times])
    assert smile.min() >= 0
    assert smile.max() <= 1
    assert (smile[(times > 0.5) & (times < 1.5)] == 1.0).all()
    speed = np.diff(smile) / np.diff(times)
    assert np.abs(np.diff(speed)).max() < 0.05 * np.abs(speed).max()


def test_a_face_takes_its_sliders_from_its_performance():
    face = FaceSettings(angry=0.5, smile=0.2, performance=TAKE)
    shown = face.at(0.5)
    assert shown.smile == pytest.approx(1.0)
    assert shown.angry == 0.5
    assert FaceSettings(angry=0.5).at(3.0) == FaceSettings(angry=0.5)


def test_left_and_both_add_up_to_full_strength():
    face = FaceSettings(smile=0.7, smile_left=0.6)
    assert face.strength("smile", "left") == 1.0
    assert face.strength("smile", "right") == pytest.approx(0.7)


def test_a_performance_survives_the_project_file():
    assert decode_performance(encode_performance(TAKE)) == TAKE
    assert decode_performance(encode_performance(())) == ()


@pytest.mark.parametrize(
    ("content", "phrase"),
    [
        (b"{", "no list of keyframes"),
        (b"[3]", "no list of keyframes"),
        (b'[{"time": 0}]', "no list of keyframes"),
        (b'[{"time": 0, "weights": [1]}]', "no list of keyframes"),
        (b'[{"time": 1, "weights": {}}, {"time": 1, "weights": {}}]', "do not rise"),
        (b'[{"time": NaN, "weights": {}}]', "do not rise"),
        (b'[{"time": 0, "weights": {"grin": 1}}]', "'grin' that does not exist"),
        (b'[{"time": 0, "weights": {"smile": 1.5}}]', "out of the range"),
        (b'[{"time": 0, "weights": {"smile": NaN}}]', "out of the range"),
    ],
)
def test_a_damaged_performance_is_one_line(content, phrase):
    with pytest.raises(ValueError, match=phrase):
        decode_performance(content)


def test_sliders_are_the_expressions_by_side():
    assert {"smile", "smile_left", "smile_right", "blink_left", "jaw_open"} <= set(SLIDERS)
    assert not {"driver", "tissue", "tissue_lift"} & set(SLIDERS)
    with pytest.raises(ValueError, match="does not exist"):
        check_performance((keyframe(0.0, {"tissue_lift": 1.0}),), SLIDERS)
