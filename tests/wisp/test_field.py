import numpy as np
import pytest

from headstudio.wisp.field import PRESETS, force_field
from headstudio.wisp.strokes import Stroke
from headstudio.wisp.styling_settings import StylingSettings

from .dressed import body, plain_styling

PLACES = np.random.default_rng(2).uniform(-2, 2, (400, 3))


def field_at(places, **settings) -> np.ndarray:
    _, _, surroundings = body()
    return force_field(plain_styling(**settings), surroundings).at(surroundings.proportions.place(np.asarray(places)))


def test_every_preset_is_a_parameter_and_no_longer_than_its_weight():
    for name, preset in PRESETS.items():
        vectors = preset(PLACES, StylingSettings(**{name: 1.0}))
        assert np.linalg.norm(vectors, axis=1).max() <= (1.7 if name == "blown" else 1.0 + 1e-9)
        assert np.linalg.norm(vectors, axis=1).max() > 0.5


def test_the_field_is_the_weighted_sum_of_its_presets():
    both = field_at(PLACES, gravity=0.7, back=1.3)
    alone = 0.7 * field_at(PLACES, gravity=1.0) + 1.3 * field_at(PLACES, gravity=0.0, back=1.0)
    assert both == pytest.approx(alone, abs=1e-5)


@pytest.mark.parametrize(
    ("settings", "place", "direction"),
    [
        ({"gravity": 1.0}, (0.3, 0.2, 0.1), (0, -1, 0)),
        ({"back": 1.0}, (0.0, 1.1, 0.0), (0, 0, -1)),
        ({"back": 1.0}, (0.0, 0.2, 1.1), (0, 1, 0)),
        ({"forward": 1.0}, (0.0, 1.0, 0.2), (0, 0, 1)),
        ({"forward": 1.0}, (0.0, 0.3, 1.0), (0, -1, 0)),
        ({"left": 1.0}, (0.0, 1.0, 0.2), (1, 0, 0)),
        ({"right": 1.0}, (0.0, 1.0, 0.2), (-1, 0, 0)),
        ({"up": 1.0}, (0.0, 1.0, 0.2), (0, 1, 0)),
        ({"spiky": 1.0}, (0.0, 0.0, 1.2), (0, 0, 1)),
        ({"blown": 1.0, "blown_heading": np.pi / 2}, (0.0, 0.0, 0.0), (1, 0, 0)),
        ({"parted": 1.0, "parting": 0.3}, (0.1, 1.0, 0.2), (-1, 0, 0)),
        ({"off_face": 1.0}, (0.4, -0.3, 1.0), (1, 0, 0)),
        ({"off_face": 1.0, "parting": 0.5}, (0.3, -0.1, 1.0), (-1, 0, 0)),
        ({"inward": 1.0}, (1.2, -1.0, 0.0), (-1, 0, 0)),
    ],
)
def test_presets_pull_where_their_names_say(settings, place, direction):
    force = field_at([place], **{"gravity": 0.0, **settings})[0]
    assert force @ np.array(direction) > 0.8 * np.linalg.norm(force) > 0.2


def test_hair_that_is_beside_the_head_is_pushed_down_and_no_farther_off():
    beside = np.array([[1.1, y, z] for y in (-0.2, 0.1, 0.4) for z in (0.0, 0.4, 0.8)])
    both = np.concatenate([beside, beside * [-1, 1, 1]])
    away = np.sign(both[:, 0]) * field_at(both, gravity=0.0, off_face=1.0)[:, 0]
    assert np.all(away < 0.05)
    parted = field_at(both + np.array([0.0, 0.6, 0.0]), gravity=0.0, parted=1.0, parting=0.0)
    assert np.all(parted[:, 1] <= 0.0)
    assert parted[:, 1].min() < -0.2


def test_hair_follows_a_stroke_inside_its_radius_and_not_far_away():
    stroke = Stroke(((1.3, 0.8, 0.0), (1.3, -0.6, -0.8)), 0.04, 1.5)
    along = np.array(stroke.path)
    middle = along.mean(axis=0)
    drawn, plain = field_at([middle], strokes=(stroke,))[0], field_at([middle])[0]
    _, _, surroundings = body()
    tangent = (along[1] - along[0]) * surroundings.proportions.extent
    assert drawn == pytest.approx(1.5 * tangent / np.linalg.norm(tangent), abs=0.02)
    assert not np.allclose(drawn, plain, atol=0.2)
    far = [[-1.5, 0.0, 0.0], [0.0, -3.0, 0.0]]
    assert field_at(far, strokes=(stroke,)) == pytest.approx(field_at(far), abs=0.02)


def test_between_two_strokes_the_field_goes_over_smoothly():
    left, right = Stroke(((0.6, 1.5, -0.3), (0.6, 1.5, 0.3))), Stroke(((-0.6, 1.5, 0.3), (-0.6, 1.5, -0.3)))
    across = np.stack([np.linspace(0.6, -0.6, 13), np.full(13, 1.5), np.zeros(13)], axis=1)
    forward = field_at(across, gravity=0.0, strokes=(left, right), stroke_reach=0.2)[:, 2]
    assert forward[0] == pytest.approx(1.0, abs=0.05)
    assert forward[-1] == pytest.approx(-1.0, abs=0.05)
    assert np.all(np.diff(forward) < 0.01)
    assert np.abs(np.diff(forward)).max() < 0.5


def test_a_stroke_finer_than_the_grid_still_counts():
    place = np.array([1.2, 0.5, 0.0])
    thin = Stroke((tuple(place), tuple(place + np.array([0.0, 0.0, 0.05]))), 0.005, 2.0)
    assert np.abs(field_at([place], strokes=(thin,)) - field_at([place])).max() > 0.1


def test_hair_on_the_shoulders_is_led_off_them_before_and_behind():
    _, _, surroundings = body()
    across = surroundings.proportions.place(np.array([[side, -1.2, z] for side in (-1.8, 1.8) for z in (-0.2, -0.8)]))
    down = np.linspace(0.0, 0.2, 400)[:, None] * np.array([0.0, -1.0, 0.0])
    onto = []
    for place in across:
        line = place + down
        onto.append(line[np.flatnonzero(surroundings.distance(line) > 0.006)[-1]])
    places = surroundings.proportions.measure(np.array(onto))
    pushed, plain = field_at(places, off_shoulders=1.0), field_at(places)
    assert np.all(np.sign((pushed - plain)[:, 2]) == [1, -1, 1, -1])
    # Far from the body nothing is changed.
    assert field_at([[0.0, -1.9, 3.0]], off_shoulders=1.0) == pytest.approx(field_at([[0.0, -1.9, 3.0]]))


def test_shoulders_carry_hair_and_it_does_not_slide_outward_beside_the_head():
    _, _, surroundings = body()
    above = surroundings.proportions.place(np.array([[side, -1.2, -0.8] for side in (-1.6, -0.8, 0.8, 1.6)]))
    down = np.linspace(0.0, 0.2, 400)[:, None] * np.array([0.0, -1.0, 0.0])
    onto = np.array([(place + down)[surroundings.distance(place + down) > 0.006][-1] for place in above])
    places, outward = surroundings.proportions.measure(onto), surroundings.gradient(onto)
    carried, free = (np.einsum("ij,ij->i", field_at(places, off_shoulders=w), outward) for w in (1.0, 0.0))
    # What would press hair into the shoulder is mostly gone, and beside the head it is held against the slope.
    assert np.all(free < -0.5)
    assert np.all(carried > 0.5 * free)
    aside = field_at(places, off_shoulders=1.0)[:, 0] * np.sign(places[:, 0])
    assert np.all(aside[[0, 3]] < -0.1)
    assert np.all(aside[[1, 2]] < 0.5 * np.abs(outward[[1, 2], 0]))


def test_hair_that_hangs_beside_the_back_lies_down_on_it():
    _, _, surroundings = body()
    behind = surroundings.proportions.place(np.array([[side, -2.6, -2.5] for side in (-0.5, 0.5)]))
    forward = np.linspace(0.0, 0.2, 400)[:, None] * np.array([0.0, 0.0, 1.0])
    onto = [(place + forward)[surroundings.distance(place + forward) < 0.03][0] for place in behind]
    places = surroundings.proportions.measure(np.array(onto))
    change = field_at(places, off_shoulders=1.0) - field_at(places)
    assert np.all(np.einsum("ij,ij->i", change, surroundings.gradient(np.array(onto))) < -0.1)


def test_hair_beside_the_head_is_drawn_to_it_and_what_lies_over_an_ear_is_not():
    _, _, surroundings = body()
    beside = np.array([[side, -0.7, 0.8] for side in (-1.3, 1.3)])
    over = np.array([[side, -0.3, -0.1] for side in (-1.5, 1.5)])
    change = [field_at(places, close=1.0) - field_at(places) for places in (beside, over)]
    outward = surroundings.gradient(surroundings.proportions.place(beside))
    assert np.all(np.einsum("ij,ij->i", change[0], outward) < -0.3)
    assert np.abs(change[0][:, 1]).max() < 1e-6
    assert np.abs(change[1]).max() < 1e-6
    # Nor is it on top of the head, at the nape, or far off.
    for place in ([0.0, 1.1, 0.0], [0.0, -0.9, -1.2], [3.5, -0.5, 0.0]):
        assert field_at([place], close=1.0) == pytest.approx(field_at([place]))


def test_what_is_combed_forward_begins_at_the_whorl_and_is_pressed_to_the_brow():
    behind, above, before = (
        field_at([place], gravity=0.0, forward=1.0)[0] for place in ((0, 0.6, -0.9), (0, 1, 0), (0, 0.1, 1.1))
    )
    assert np.abs(behind).max() < 1e-6
    assert above[2] > 0.9
    assert before[1] < -0.8
    assert before[2] < 0.0
