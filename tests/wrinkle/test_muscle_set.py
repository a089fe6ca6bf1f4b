"""Muscles find their places on any head."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest

from headstudio.head.head import Landmarks
from headstudio.head.mannequin import mannequin
from headstudio.wrinkle.muscle_set import MUSCLES, SIDES, carried_face_points, place_muscles
from headstudio.wrinkle.muscles import LinearMuscle, SheetMuscle, SphincterMuscle

UNIT = 0.016
MIRROR = np.array([-1.0, 1.0, 1.0])


def face_of_1994() -> Landmarks:
    """Landmarks of the face that the muscles are published on; those that no muscle needs are anywhere."""
    places = {
        "hairline": (0.0, 6.5, 7.27),
        "glabella": (0.0, 3.3, 8.2),
        "nose_tip": (0.0, -0.1, 9.28),
        "chin": (0.0, -4.95, 7.1),
        "right_eye": (-2.03, 2.1, 7.32),
        "mouth_right": (-1.57, -2.22, 7.85),
        "right_tragus": (-4.8, 0.5, 1.95),
    }
    for right, left in (("right_eye", "left_eye"), ("mouth_right", "mouth_left"), ("right_tragus", "left_tragus")):
        x, y, z = places[right]
        places[left] = (-x, y, z)
    names = [field.name for field in fields(Landmarks)]
    return Landmarks(**{name: UNIT * np.array(places.get(name, (0.0, 0.0, 0.0))) for name in names})


def test_on_the_face_that_it_was_published_on_the_set_is_as_printed():
    muscles = place_muscles(face_of_1994())
    zygomatic = muscles["right", "zygomatic major"]
    assert isinstance(zygomatic, LinearMuscle)
    np.testing.assert_allclose(zygomatic.insertion / UNIT, [-1.570, -2.221, 7.820], atol=1e-9)
    np.testing.assert_allclose(zygomatic.origin / UNIT, [-3.805, 0.868, 6.600], atol=1e-9)
    assert zygomatic.fade_start / UNIT == pytest.approx(0.1)
    assert zygomatic.fade_end / UNIT == pytest.approx(4.8)
    assert np.degrees(zygomatic.zone) == pytest.approx(45)
    left = muscles["left", "frontalis outer"]
    assert isinstance(left, LinearMuscle)
    np.testing.assert_allclose(left.origin / UNIT, [3.639, 5.648, 5.945], atol=1e-9)


def test_every_muscle_is_there_on_both_sides_and_of_its_kind():
    muscles = place_muscles(mannequin().landmarks)
    assert set(muscles) == {(side, name) for side in SIDES for name in MUSCLES}
    assert isinstance(muscles["left", "frontalis"], SheetMuscle)
    assert isinstance(muscles["left", "orbicularis oris"], SphincterMuscle)
    assert isinstance(muscles["right", "orbicularis oculi"], SphincterMuscle)


def test_a_symmetric_head_has_symmetric_muscles():
    head = mannequin()
    muscles = place_muscles(head.landmarks)
    points = head.skin.vertices[::40]
    for name in MUSCLES:
        left = muscles["left", name].field(points)
        right = muscles["right", name].field(points * MIRROR)
        np.testing.assert_allclose(left, right * MIRROR, atol=1e-9)


def test_an_asymmetric_head_has_asymmetric_muscles():
    marks = mannequin().landmarks
    shift = np.array([0.004, -0.005, 0.0])
    crooked = place_muscles(replace(marks, mouth_left=marks.mouth_left + shift))
    straight = place_muscles(marks)
    left, right = ("left", "zygomatic major"), ("right", "zygomatic major")
    moved = crooked[left].insertion - straight[left].insertion
    assert np.linalg.norm(moved - shift) < 0.2 * np.linalg.norm(shift)
    assert np.linalg.norm(crooked[right].insertion - straight[right].insertion) < 0.3 * np.linalg.norm(shift)


def test_muscles_scale_with_the_head():
    marks = mannequin().landmarks
    double = Landmarks(**{name: 2.0 * point for name, point in vars(marks).items()})
    small, large = place_muscles(marks), place_muscles(double)
    points = mannequin().skin.vertices[::40]
    for key in small:
        np.testing.assert_allclose(large[key].field(2.0 * points), 2.0 * small[key].field(points), atol=1e-9)


def test_points_of_the_face_are_carried_once_in_the_middle_and_twice_beside_it():
    points, index = carried_face_points(mannequin().landmarks, [(0.0, 5.5, 7.9), (-2.2, 5.2, 7.4)])
    assert index.tolist() == [0, 1, 1]
    np.testing.assert_allclose(points[1] * MIRROR, points[2], atol=1e-12)
