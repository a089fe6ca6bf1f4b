"""Furrow sets: as JSON, on the chart that all heads share, and the default set on a head."""

from dataclasses import replace

import numpy as np
import pytest

from headstudio.head.head import Head, Landmarks
from headstudio.head.mannequin.build import mannequin
from headstudio.params import assign
from headstudio.scene.attachments import ATTACHMENTS
from headstudio.scene.document import Document
from headstudio.wrinkle.default_furrows import REGIONS, default_furrows
from headstudio.wrinkle.face_chart import FaceChart
from headstudio.wrinkle.face_creases import face_bed, face_creases, face_layout
from headstudio.wrinkle.furrow import Furrow, decode_furrows, encode_furrows
from headstudio.wrinkle.settings import WrinkleSettings


@pytest.fixture(scope="module")
def head():
    return mannequin()


@pytest.fixture(scope="module")
def chart(head):
    return FaceChart(head, face_layout(head))


def test_a_set_comes_back_from_json_as_it_was():
    furrows = (*default_furrows(0.7), Furrow())
    assert decode_furrows(encode_furrows(furrows)) == furrows
    assert decode_furrows(encode_furrows(())) == ()


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        (b"\xff", "no furrow set"),
        (b"{}", "no list"),
        (b"[1]", "furrow 1"),
        (b'[{"depth": 0.001}]', "furrow 1"),
        (b'[{"controls": [[0, 0], [1, 1], [2, 2]]}]', "control points"),
        (b'[{"controls": [[0, 0], [1, 1], [2, 2], [3, Infinity]]}]', "finite"),
        (b'[{"controls": [[0, 0], [1, 1], [2, 2], [3, 3]], "depth": 7}]', "depth goes from"),
        (b'[{"controls": [[0, 0], [1, 1], [2, 2], [3, 3]], "colour": 7}]', "furrow 1"),
        (b'[{"controls": [[0, 0], [1, 1], [2, 2], "xy"]}]', "furrow 1"),
    ],
)
def test_a_bad_set_is_refused_with_a_phrase(content, complaint):
    with pytest.raises(ValueError, match=complaint):
        decode_furrows(content)


def test_furrows_are_saved_with_the_project():
    attachment = next(a for a in ATTACHMENTS if a.path == "wrinkle.furrows")
    furrows = default_furrows(0.2)[:3]
    assert attachment.decode(attachment.encode(furrows)) == furrows
    document = replace(Document(), wrinkle=replace(WrinkleSettings(), furrows=furrows))
    assert document == replace(Document(), wrinkle=replace(WrinkleSettings(), furrows=default_furrows(0.2)[:3]))
    assert assign(document, {"wrinkle.strength": 0.5}).wrinkle.furrow_set() == furrows


def test_age_deepens_the_default_set_and_makes_it_stay():
    young, old = default_furrows(0.0), default_furrows(1.0)
    assert {furrow.region for furrow in young} == set(REGIONS)
    assert [furrow.name for furrow in young] == [furrow.name for furrow in old]
    assert all(a.depth < b.depth and a.width < b.width for a, b in zip(young, old))
    assert max(furrow.initial for furrow in young) == 0
    assert all(0.1 < furrow.initial < 0.6 for furrow in old)
    assert len({furrow.name for furrow in young}) == len(young)


def test_left_and_right_are_mirror_images():
    furrows = {furrow.name: furrow for furrow in default_furrows(0.5)}
    for name, furrow in furrows.items():
        if name.endswith("left"):
            other = furrows[name.replace("left", "right")]
            assert np.allclose(np.array(other.controls), np.array(furrow.controls) * [-1, 1], atol=1e-5)


def test_the_chart_and_back(chart):
    points = np.array([furrow.chain.at(np.array(0.5)) for furrow in default_furrows(0.5)])
    skin = chart.on_skin(points)
    assert np.isfinite(skin).all()
    assert np.abs(chart.from_skin(skin) - points).max() < 1e-5


def test_landmarks_lie_where_the_chart_has_them(head, chart):
    marks = head.landmarks
    for name, place in (("glabella", (0, 0.013)), ("nose_tip", (0, -0.038)), ("mouth_right", (-0.0235, -0.068))):
        assert np.linalg.norm(chart.on_skin(np.array([place]))[0] - getattr(marks, name)) < 3e-3, name


def test_every_default_furrow_lies_in_its_place(head, chart):
    """On the skin, from one side of its landmarks to the other."""
    marks = head.landmarks
    laid = {furrow.name: chart.to_texture(furrow) for furrow in default_furrows(0.5)}
    assert None not in laid.values()
    places = {}
    for name, furrow in laid.items():
        found, outside = chart.layout.locate(furrow.chain.sampled(20)[1])
        assert outside.max() < 1e-9
        mesh = chart.layout.part.mesh
        places[name] = found.blend(mesh.vertices, mesh.faces)
    for k in (1, 2, 3):
        assert (places[f"forehead {k}"][:, 1] < places[f"forehead {k + 1}"][:, 1].max()).all()
    assert places["forehead 1"][:, 1].min() > marks.glabella[1]
    assert places["eye corner 2 left"][:, 0].min() > marks.left_eye[0] + 0.01
    assert places["eye corner 2 right"][:, 0].max() < marks.right_eye[0] - 0.01
    nasolabial = places["nasolabial left"]
    assert marks.nasion[1] > nasolabial[0, 1] > marks.mouth_left[1] > nasolabial[-1, 1] > marks.chin[1]
    assert nasolabial[-1, 0] > marks.mouth_left[0]
    assert places["neck 1"][:, 1].max() < marks.chin[1]
    assert np.ptp(places["neck 2"][:, 0]) > 0.04


def another(head: Head) -> Head:
    """A broader, shorter head with a receding chin."""

    def shape(points: np.ndarray) -> np.ndarray:
        lower = np.clip(-points[..., 1:2], 0, None)
        return points * [1.15, 0.9, 1.05] - lower * [0, 0, 0.12]

    marks = Landmarks(**{name: shape(point) for name, point in vars(head.landmarks).items()})
    return replace(head, skin=head.skin.moved(shape(head.skin.vertices)), landmarks=marks, parts=())


def test_a_furrow_moves_to_another_head_through_the_landmarks(head, chart):
    """Authored in one head's texture space, carried by the chart, laid on a head of another shape."""
    other_head = another(head)
    other = FaceChart(other_head, face_layout(other_head))
    there = chart.to_texture(default_furrows(0.5)[1])
    back = chart.to_chart(there)
    moved = other.to_texture(back)
    assert moved is not None
    points = np.array(default_furrows(0.5)[1].chain.sampled(20)[1])
    again = np.array(back.chain.sampled(20)[1])
    assert np.linalg.norm(points[[0, -1]] - again[[0, -1]], axis=1).max() < 3e-4
    found, _ = other.layout.locate(moved.chain.sampled(20)[1])
    mesh = other.layout.part.mesh
    on_other = found.blend(mesh.vertices, mesh.faces)
    assert on_other[:, 1].min() > other_head.landmarks.glabella[1]
    assert on_other[:, 1].max() < other_head.landmarks.hairline[1]
    assert abs(on_other[0, 0] + on_other[-1, 0]) < 5e-3


def test_a_head_with_its_default_furrows(head):
    settings = WrinkleSettings(age=0.8, fineness=0.6)
    bed = face_bed(head, settings.furrow_set(), settings.fineness)
    rest = face_creases(head, settings, bed).displaced(head.skin.vertices)
    assert np.isfinite(rest.positions).all()
    assert np.isfinite(rest.normals).all()
    assert -2.5e-3 < rest.height.min() < -1e-3
    young = face_creases(head, replace(settings, age=0.0, breadth=1.1456), bed)
    assert np.abs(young.displaced(head.skin.vertices).height).max() < 1e-20
    hidden = face_creases(head, replace(settings, shown=False), bed).displaced(head.skin.vertices)
    assert np.abs(hidden.height).max() == 0


def test_what_the_skin_has_to_be_prepared_for_again():
    settings = WrinkleSettings()
    deeper = replace(settings, furrows=tuple(replace(f, depth=1e-3, initial=0.9) for f in settings.furrow_set()))
    assert deeper.lines() == settings.lines()
    assert replace(settings, breadth=1.3).lines() != settings.lines()
