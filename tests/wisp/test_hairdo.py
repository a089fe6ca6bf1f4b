"""A whole hairstyle: the same for the same settings, thinner for fewer strands, and there for silly settings too."""

import dataclasses

import numpy as np
import pytest

from headstudio.head.depth import SkinDepth
from headstudio.head.frame import HeadFrame
from headstudio.head.scalp_settings import GrayImage
from headstudio.wisp import growth
from headstudio.wisp.facial_hair import facial_patches
from headstudio.wisp.hairdo import Stylist
from headstudio.wisp.joining import join_strands
from headstudio.wisp.settings import FACIAL_HAIR, PROTOTYPES, FacialHairSettings, HairColourSettings, WispSettings
from headstudio.wisp.styling_settings import StylingSettings

from .dressed import body

SMALL = WispSettings(wisps=200, strands=20_000, points=12, length=0.2, segments=12)


def style(settings: WispSettings = SMALL, strands: int | None = None, **colour):
    _, scalp, surroundings = body()
    return Stylist().style(scalp, surroundings, settings, HairColourSettings(**colour), StylingSettings(), strands)


def points_of(strands) -> np.ndarray:
    return strands.points.reshape(strands.count, -1, 3)


@pytest.fixture(scope="module")
def whole():
    return style()


def test_it_has_what_was_asked_for(whole):
    strands = whole.strands
    assert strands.count == 20_000
    assert set(strands.counts) == {12}
    assert strands.wisp.max() < len(whole.outlines.roots) == 200
    assert np.isfinite(strands.points).all()
    assert strands.points.dtype == strands.radius.dtype == strands.colour.dtype == np.float32
    shafts = strands.radius.reshape(-1, 12)
    np.testing.assert_allclose(shafts[:, 0] / shafts[:, -1], 35 / 15, rtol=1e-5)
    # All but those of the hairline, which are finer.
    assert shafts[:, 0].max() == pytest.approx(35e-6)
    assert np.mean(np.isclose(shafts[:, 0], 35e-6)) > 0.7


def test_the_same_settings_give_the_same_hair_and_another_seed_another(whole):
    np.testing.assert_array_equal(style().strands.points, whole.strands.points)
    other = style(dataclasses.replace(SMALL, seed=2))
    assert not np.array_equal(other.strands.points, whole.strands.points)


def test_the_number_of_threads_changes_nothing(whole, monkeypatch):
    monkeypatch.setattr(growth.os, "cpu_count", lambda: 1)
    np.testing.assert_array_equal(style().strands.points, whole.strands.points)


def test_fewer_strands_are_the_first_of_the_same_hair(whole):
    few = style(strands=3000)
    np.testing.assert_allclose(points_of(few.strands), points_of(whole.strands)[:3000], atol=2e-6)
    np.testing.assert_array_equal(few.strands.colour, whole.strands.colour[: 12 * 3000])
    np.testing.assert_array_equal(few.strands.wisp, whole.strands.wisp[:3000])
    assert few.strands.stands_for == pytest.approx(20 / 3)


def test_roots_are_on_the_skin_and_nothing_is_in_the_head(whole):
    head, scalp, _ = body()
    points = points_of(whole.strands)[::20]
    away = np.linalg.norm(points[:, 0] - scalp.points(scalp.locate(points[:, 0].astype(float))), axis=1)
    assert away.max() < 0.001
    assert SkinDepth(head).deepest(points.reshape(-1, 3).astype(float), HeadFrame()) < 0.001


@pytest.mark.parametrize("prototype", PROTOTYPES)
def test_every_prototype_makes_hair_of_its_size(prototype):
    settings = dataclasses.replace(
        SMALL, prototype=prototype, deviation_radius="constant", fuzziness=0.0, temperature=0.0, strands=200, points=80
    )
    points = points_of(style(settings).strands)
    straight = points_of(style(dataclasses.replace(settings, prototype="straight")).strands)
    reach = np.median(np.linalg.norm(points - straight, axis=2).max(axis=1))
    size = {"straight": 0, "wavy": 7, "loose curl": 9, "tight curl": 4.5, "coil": 3, "kinky": 2.8, "zigzag": 3.5}
    assert reach == pytest.approx(1e-3 * size[prototype], rel=0.6, abs=1e-6)


def test_curls_have_one_pitch_on_short_and_on_long_hair():
    turns = []
    for length in (0.08, 0.24):
        settings = WispSettings(
            wisps=60,
            strands=60,
            points=200,
            length=length,
            length_map="even",
            prototype="tight curl",
            straight_roots=0.0,
        )
        made = style(settings)
        controls = made.controls.astype(float)
        centre = controls - np.apply_along_axis(lambda x: np.convolve(x, np.ones(7) / 7, "same"), 1, controls)
        signs = np.sign(centre[:, 7:-7, 0])
        turns.append((np.abs(np.diff(signs, axis=1)) > 0).sum(axis=1).mean() / length)
    assert turns[0] == pytest.approx(turns[1], rel=0.25)


SILLY = {
    "one wisp": {"wisps": 1},
    "one strand": {"wisps": 1, "strands": 1},
    "more wisps than strands": {"wisps": 200, "strands": 7},
    "more wisps than places": {"wisps": 10_000, "strands": 100, "painted_density": GrayImage(np.eye(300))},
    "no length": {"length": 0.001, "painted_lengths": GrayImage(np.zeros((2, 2)))},
    "no radius": {"radius": 0.0},
    "pinched to points": {"radius_curve": ((0.0, 1.0), (0.3, 0.0), (0.6, 0.0), (1.0, 1.0))},
    "a curve over a piece": {"radius_curve": ((0.4, 1.0), (0.6, 2.0))},
    "two points": {"points": 2, "segments": 2},
    "one segment's worth of a prototype": {"prototype_curve": ((0, 0, 0), (0.01, 0.01, 0), (0, 0.02, 0))},
    "a prototype that doubles back": {"prototype_curve": ((0, 0, 0), (0, 0.1, 0), (0, 0.01, 0), (0, 0.2, 0.1))},
    "all at once": {"temperature": 0.3, "fuzziness": 1.0, "curl_size": 4.0, "prototype": "kinky", "protrusion": 3.0},
    "very short curls": {"prototype": "coil", "curl_length": 0.25, "window": 3.0, "strands": 50},
    "a parting beyond the scalp": {"parting_line": ((-1.0, 0.5), (2.0, 0.5))},
    "a parting on one spot": {"parting_line": ((0.5, 0.5), (0.5, 0.5))},
}


@pytest.mark.parametrize("name", SILLY)
def test_silly_settings_still_make_hair(name):
    settings = dataclasses.replace(SMALL, **{"strands": 500, "wisps": 20, **SILLY[name]})
    made = style(settings)
    assert made.strands.count == settings.strands
    assert np.isfinite(made.strands.points).all()
    assert np.isfinite(made.strands.colour).all()
    assert np.abs(made.strands.points).max() < 1.5


def test_where_no_hair_grows_there_is_a_hairdo_without_strands():
    made = style(dataclasses.replace(SMALL, painted_density=GrayImage(np.zeros((2, 2)))))
    assert made.strands.count == 0
    assert made.controls.shape[0] == 0


def test_sets_of_strands_are_joined_so_that_every_part_of_them_is_a_picture_of_all(whole):
    few = style(dataclasses.replace(SMALL, points=5), strands=2000, pigment="white").strands
    joined = join_strands([whole.strands, few])
    assert joined.count == 22_000
    assert len(joined.points) == 12 * 20_000 + 5 * 2000
    of_few = joined.counts == 5
    assert of_few[:2200].mean() == pytest.approx(1 / 11, rel=0.05)
    np.testing.assert_array_equal(joined.points[np.repeat(of_few, joined.counts)], few.points)
    assert joined.wisp[of_few].min() == whole.strands.wisp.max() + 1 + few.wisp.min()


@pytest.mark.parametrize("name", FACIAL_HAIR)
def test_facial_hair_shares_its_strands_among_its_patches(name):
    patches = facial_patches(FacialHairSettings(style=name, strands=1000))
    assert sum(patch.wisp.strands for patch in patches) == (0 if name == "none" else 1000)


# Another value for every setting of the wisps, and what must be made again for it.
CHANGES = {
    "wisps": 40, "strands": 15_000, "points": 9, "segments": 5, "length": 0.17, "density_map": "thinning",
    "length_map": "bob", "protrusion_map": "standing", "protrusion": 0.7, "parting": "right", "parting_reach": 0.03,
    "prototype": "wavy", "curl_size": 0.5, "curl_length": 0.7, "curl_variety": 0.3, "straight_roots": 0.01, "temperature": 0.1,
    "window": 0.3, "alignment": 0.5, "length_distribution": "frayed", "deviation_radius": "flaring", "radius": 0.6,
    "fuzziness": 0.7, "shaft_root": 5e-5, "shaft_tip": 5e-6, "hairline": 0.02, "seed": 4,
    "length_curve": ((0.2, 1.0), (0.7, 1.0)),
    "radius_curve": ((0.0, 1.0), (1.0, 0.2)), "prototype_curve": ((0, 0, 0), (0.01, 0.05, 0), (0, 0.1, 0.01), (0, 0.2, 0)),
    "parting_line": ((0.3, 0.0), (0.4, 0.4)), "painted_density": GrayImage(np.linspace(0, 1, 64).reshape(8, 8)),
    "painted_lengths": GrayImage(np.linspace(0.3, 1, 64).reshape(8, 8)),
    "painted_protrusion": GrayImage(np.linspace(0, 1, 64).reshape(8, 8)),
}  # fmt: skip


class TestStylist:
    def test_a_change_makes_the_hair_that_is_made_anew(self) -> None:
        _, scalp, surroundings = body()
        curly = dataclasses.replace(SMALL, wisps=50, segments=6, strands=2000, prototype="loose curl")
        assert CHANGES.keys() == {field.name for field in dataclasses.fields(WispSettings)}
        stylist = Stylist()
        for name, value in CHANGES.items():
            rest = (HairColourSettings(), StylingSettings(), 300)
            changed = dataclasses.replace(curly, **{name: value})
            made = stylist.style(scalp, surroundings, changed, *rest)
            anew = Stylist().style(scalp, surroundings, changed, *rest)
            assert np.array_equal(made.strands.points, anew.strands.points), name
            assert np.array_equal(made.strands.radius, anew.strands.radius), name

    def test_another_colour_leaves_the_strands_alone_and_curls_the_outlines(self) -> None:
        _, scalp, surroundings = body()
        stylist, steps = Stylist(), []
        settings = dataclasses.replace(SMALL, strands=1000)
        first = stylist.style(scalp, surroundings, settings, HairColourSettings(), StylingSettings())
        red = stylist.style(
            scalp, surroundings, settings, HairColourSettings(pigment="red"), StylingSettings(), None, steps.append
        )
        assert red.strands.points is first.strands.points
        assert steps == ["colour"]
        curly = dataclasses.replace(settings, prototype="coil")
        assert (
            stylist.style(scalp, surroundings, curly, HairColourSettings(), StylingSettings()).outlines
            is first.outlines
        )
