"""Where hair grows: even master roots, Voronoi regions, roots by density, and a parting that nothing reaches across."""

import numpy as np
import pytest
from scipy import stats
from scipy.spatial import cKDTree

from headstudio.head.length_maps import sample
from headstudio.head.scalp_settings import GrayImage
from headstudio.params import ParameterError
from headstudio.wisp.follicles import fulness, scatter_strands, spread_wisps
from headstudio.wisp.maps import density_map, length_map, protrusion_map
from headstudio.wisp.parting import Parting
from headstudio.wisp.rest import rest_outlines
from headstudio.wisp.settings import DENSITY_MAPS, LENGTH_MAPS, PARTINGS, PROTRUSION_MAPS, WispSettings

from .dressed import body

EVEN = GrayImage(np.ones((4, 4)))


@pytest.fixture(scope="module")
def scalp():
    return body()[1]


@pytest.mark.parametrize("wisps", [50, 800, 3000])
def test_master_roots_are_spread_evenly_over_the_skin(scalp, wisps):
    regions = spread_wisps(scalp, EVEN, wisps, None, 1)
    assert regions.count == wisps
    nearest = cKDTree(regions.roots).query(regions.roots, k=2)[0][:, 1]
    # Random points have 0.52 here, and the closest of them nearly touch.
    assert nearest.std() / nearest.mean() < 0.2
    assert nearest.min() > 0.4 * nearest.mean()
    assert regions.share.std() * wisps < 0.3


def test_strands_grow_in_the_voronoi_region_of_their_master(scalp):
    regions = spread_wisps(scalp, EVEN, 800, None, 1)
    roots, wisp = scatter_strands(regions, 20_000, 1)
    assert (cKDTree(regions.roots).query(roots)[1] == wisp).mean() > 0.995
    assert (np.linalg.norm(roots - regions.roots[wisp], axis=1) <= regions.reach[wisp]).all()
    assert regions.reach.max() < 2.5 * np.sqrt(scalp.area / 800 / np.pi)


@pytest.mark.parametrize("name", DENSITY_MAPS)
def test_strands_are_as_dense_as_the_map_says(scalp, name):
    image = density_map(WispSettings(density_map=name))
    regions = spread_wisps(scalp, image, 500, None, 1)
    roots, wisp = scatter_strands(regions, 40_000, 1)
    # Against even roots that were thinned by the map, counted in 40 cells of the skin: some 100,000 are left, or their own
    # chance would show.
    # Against even roots that were thinned by the map, counted in 40 cells of the skin: so many that their own chance is small.
    even = scalp.random_points(1_600_000, np.random.default_rng(2))
    density = sample(image, even) * fulness(scalp, None, scalp.points(even))
    expected = scalp.points(even[2 * np.random.default_rng(3).random(len(even)) < density])
    cells = cKDTree(scalp.points(scalp.random_points(40, np.random.default_rng(4))))
    counts, wanted = (np.bincount(cells.query(points)[1], minlength=40) for points in (roots, expected))
    np.testing.assert_allclose(counts / len(roots), wanted / len(expected), atol=0.004)
    np.testing.assert_allclose(np.bincount(wisp, minlength=regions.count) / len(wisp), regions.share, atol=0.002)


def test_the_first_strands_of_many_are_the_same_and_spread_over_the_whole(scalp):
    regions = spread_wisps(scalp, EVEN, 300, None, 1)
    few, of_few = scatter_strands(regions, 5000, 1)
    many, of_many = scatter_strands(regions, 50_000, 1)
    np.testing.assert_array_equal(few, many[:5000])
    np.testing.assert_array_equal(of_few, of_many[:5000])
    assert stats.chisquare(np.bincount(of_few, minlength=300), 5000 * regions.share).pvalue > 0.01


def test_a_spot_of_hair_has_its_wisps_in_the_spot(scalp):
    pixels = np.zeros((64, 64))
    pixels[20:24, 30:34] = 1
    regions = spread_wisps(scalp, GrayImage(pixels), 500, None, 1)
    assert 1 <= regions.count <= 500
    uv = scalp.locate(scatter_strands(regions, 2000, 1)[0])
    assert np.abs(uv - [0.5, 0.344]).max() < 0.1


def test_where_nothing_grows_there_are_no_wisps(scalp):
    regions = spread_wisps(scalp, GrayImage(np.zeros((2, 2))), 500, None, 1)
    assert regions.count == 0
    assert len(scatter_strands(regions, 100, 1)[0]) == 0


@pytest.mark.parametrize("name", [name for name in PARTINGS if name != "none"])
def test_no_wisp_reaches_across_the_parting(scalp, name):
    settings = WispSettings(parting=name, wisps=800)
    parting = Parting.of(scalp, settings)
    regions = spread_wisps(scalp, EVEN, 800, parting, 1)
    roots, wisp = scatter_strands(regions, 40_000, 1)
    distance, at = cKDTree(parting.points).query(roots)
    # Beside the line, and not beyond its ends.
    near = (distance < 0.008) & (at > 10) & (at < len(parting.points) - 20)
    side = np.einsum("ij,ij->i", roots - parting.points[at], parting.leftward[at])
    home = np.einsum("ij,ij->i", regions.roots[wisp] - parting.points[at], parting.leftward[at])
    clear = near & (np.abs(side) > 0.0015)
    assert clear.sum() > 500
    assert (side[clear] * home[clear] > 0).mean() > 0.995


def test_the_line_of_a_parting_is_fine_and_bare_and_hair_stands_close_beside_it(scalp):
    parting = Parting.of(scalp, WispSettings(parting="centre"))
    roots, _ = scatter_strands(spread_wisps(scalp, EVEN, 800, parting, 1), 100_000, 1)
    distance, at = cKDTree(parting.points).query(roots)
    distance = distance[(at > 10) & (at < len(parting.points) - 40)]
    # All hair that grows beside the line within 2.3 mm is drawn to within 1.7 mm, and none onto it.
    assert distance.min() > 0.0006
    per_millimetre = np.histogram(distance, [0.0007, 0.0017, 0.010, 0.011, 0.030, 0.031])[0]
    assert per_millimetre[0] > 2.0 * per_millimetre[4]
    assert 1.1 * per_millimetre[4] < per_millimetre[2] < 1.6 * per_millimetre[4]


def test_around_the_whorl_hair_is_fuller(scalp):
    at_whorl = scalp.points(scalp.whorl[None])
    assert fulness(scalp, None, at_whorl)[0] > 1.8
    far = scalp.points(np.array([[0.5, 0.02], [0.5, 0.98]]))
    np.testing.assert_allclose(fulness(scalp, None, far), 1.0, atol=1e-3)


def test_hair_leans_away_from_the_parting_and_by_the_protrusion_map(scalp):
    settings = WispSettings(parting="left", wisps=800, protrusion_map="flat")
    parting = Parting.of(scalp, settings)
    regions = spread_wisps(scalp, EVEN, 800, parting, 1)
    outlines, _ = rest_outlines(scalp, regions, parting, settings)
    normals = scalp.normals(regions.uv)
    raised = np.einsum("ij,ij->i", outlines.directions[:, 0], normals)
    np.testing.assert_allclose(raised, np.sin(0.08 * np.pi / 2), atol=0.01)
    distance, at = cKDTree(parting.points).query(regions.roots)
    side = np.einsum("ij,ij->i", regions.roots - parting.points[at], parting.leftward[at])
    lean = np.einsum("ij,ij->i", outlines.directions[:, 0], parting.leftward[at])
    near = (distance < 0.02) & (at > 10) & (at < len(parting.points) - 20)
    assert (np.sign(side[near]) == np.sign(lean[near])).mean() > 0.97


def test_hair_at_the_end_of_a_parting_falls_to_its_sides_and_not_over_the_face(scalp):
    settings = WispSettings(parting="centre", protrusion_map="flat")
    regions = spread_wisps(scalp, EVEN, 3000, None, 1)
    frames = rest_outlines(scalp, regions, Parting.of(scalp, settings), settings)[0].frames[:, 0]
    end = scalp.points(np.array([[0.5, 0.0]]))
    near = np.linalg.norm(regions.roots - end, axis=1) < 0.014
    assert near.sum() > 10
    assert np.median(np.abs(frames[near, 0, 2])) > 0.9


def test_hair_near_a_parting_feels_the_field_of_its_own_bank(scalp):
    settings = WispSettings(parting="left", wisps=1500)
    parting = Parting.of(scalp, settings)
    roots = spread_wisps(scalp, EVEN, 1500, parting, 1).roots
    distance, at = cKDTree(parting.points).query(roots)
    side = np.einsum("ij,ij->i", roots - parting.points[at], parting.leftward[at])
    aside = parting.aside(roots)
    felt = side + np.einsum("ij,ij->i", aside, parting.leftward[at])
    near = (distance < 0.02) & (at > 10) & (at < len(parting.points) - 20)
    np.testing.assert_allclose(np.abs(felt[near]), 0.02, atol=0.002)
    assert np.all(felt[near] * side[near] > 0)
    assert np.all(aside[distance > 0.02] == 0)


def test_standing_hair_stands_up(scalp):
    settings = WispSettings(protrusion_map="standing", wisps=100)
    regions = spread_wisps(scalp, EVEN, 100, None, 1)
    frames = rest_outlines(scalp, regions, None, settings)[0].frames[:, 0]
    np.testing.assert_allclose(frames[..., 2], scalp.normals(regions.uv), atol=1e-6)
    np.testing.assert_allclose(frames.transpose(0, 2, 1) @ frames, np.broadcast_to(np.eye(3), frames.shape), atol=1e-9)


def test_outlines_are_as_long_as_the_map_says(scalp):
    settings = WispSettings(wisps=300, length=0.2, segments=10, length_map="bob")
    regions = spread_wisps(scalp, EVEN, 300, None, 1)
    outlines, length = rest_outlines(scalp, regions, None, settings)
    np.testing.assert_allclose(length, 0.2 * sample(length_map(settings), regions.uv))
    assert outlines.segment == pytest.approx(0.02)
    assert ((outlines.counts * 0.02 >= length - 1e-9) & ((outlines.counts - 1) * 0.02 < length)).all()
    np.testing.assert_allclose(outlines.radii[:, 0], regions.reach)


@pytest.mark.parametrize(
    ("names", "image", "part"),
    [
        (DENSITY_MAPS, density_map, "density_map"),
        (LENGTH_MAPS, length_map, "length_map"),
        (PROTRUSION_MAPS, protrusion_map, "protrusion_map"),
    ],
)
def test_every_named_map_is_there_and_they_differ(names, image, part):
    maps = [image(WispSettings(**{part: name})) for name in names]
    assert len(set(maps)) == len(names)
    assert all(m.pixels.max() > 0 for m in maps)


@pytest.mark.parametrize("line", [((0.5, 0.5),), ((0.5, float("nan")), (0.5, 0.2))])
def test_what_is_no_line_is_no_parting(scalp, line):
    with pytest.raises(ParameterError, match="parting"):
        Parting.of(scalp, WispSettings(parting_line=line))
