"""Views by name."""

import math

import pytest

from headstudio.params import ParameterError, walk
from headstudio.scene.settings import Camera
from headstudio.scene.views import VIEWS, seen_from


@pytest.mark.parametrize("view", VIEWS)
def test_a_view_turns_the_camera_and_keeps_what_it_looks_at(view):
    before = Camera(distance=0.7, target_y=0.1, field_of_view=0.5)
    camera = seen_from(before, view)
    assert (camera.distance, camera.target_y, camera.field_of_view) == (0.7, 0.1, 0.5)
    for name, parameter, value in walk(camera):
        assert parameter.check(value, name) == value


def test_left_is_the_persons_own():
    assert seen_from(Camera(), "left").azimuth == pytest.approx(math.pi / 2)
    assert seen_from(Camera(), "right").azimuth == pytest.approx(-math.pi / 2)


def test_another_word_is_no_view():
    with pytest.raises(ParameterError, match="a view is one of front"):
        seen_from(Camera(), "inside")
