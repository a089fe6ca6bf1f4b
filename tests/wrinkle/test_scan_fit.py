"""Scans: laid on a skin, measured, and furrows fitted to them. Grooves come from a profile that is not the studio's."""

from __future__ import annotations

from dataclasses import replace

import igl
import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from headstudio.head.mannequin import mannequin
from headstudio.head.mesh import TriangleMesh
from headstudio.head.repair import repair
from headstudio.wrinkle.alignment import ScanError, align, moved, plausible_units
from headstudio.wrinkle.comparison import Distances, compare
from headstudio.wrinkle.creases import Creases
from headstudio.wrinkle.cross_profile import section_height
from headstudio.wrinkle.cross_section import CrossSection, control_heights, half_width
from headstudio.wrinkle.face_creases import face_bed
from headstudio.wrinkle.fitting import FurrowFit, fit_grooves
from headstudio.wrinkle.furrow_bed import prepare_bed
from headstudio.wrinkle.groove import SAMPLES, Groove, GrooveBed, MetricField
from headstudio.wrinkle.groove_stiffness import bends_of
from headstudio.wrinkle.scan_fit import fit_face
from headstudio.wrinkle.scan_heights import ScanHeights, SkinTexels
from headstudio.wrinkle.skin_layout import SkinLayout
from headstudio.wrinkle.valley_lines import valley_lines
from headstudio.wrinkle.valleys import valley_field

from .skins import cap, cut, flat_map, sheet
from .strange_scans import Strange, profile, strange_scan

NOISE = 1e-4


def layout() -> SkinLayout:
    return SkinLayout.of_map(flat_map(sheet(cells=40)))


def lifted(mesh: TriangleMesh, by: float) -> TriangleMesh:
    return moved(mesh, turned(0.0, [0, 0, by]))


def turned(angle: float, shift) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    matrix[:3, 3] = shift
    return matrix


def mexican(x, sigma):
    """A Gaussian valley with raised rims, as much above the skin as below it."""
    return -2 * np.exp(-(x**2) / 2 / sigma**2) + np.exp(-(x**2) / 8 / sigma**2)


def wrinkled_sheet(seed: int, lines, depth: float, sigma: float) -> TriangleMesh:
    """A fine sheet with wandering grooves, and noise. lines: (start, end) [m]."""
    rng = np.random.default_rng(seed)
    fine = sheet(cells=110, seed=seed)
    height = rng.normal(0, NOISE, len(fine.vertices))
    for start, end in lines:
        part = np.linspace(0, 1, 400)[:, None]
        way = np.subtract(end, start)
        aside = 0.002 * np.sin(2 * np.pi * (1.3 * part + rng.random())) * np.array([-way[1], way[0]]) / np.hypot(*way)
        away, nearest = cKDTree(np.asarray(start) + part * way + aside).query(fine.vertices[:, :2])
        ends = np.clip(np.minimum(nearest, 399 - nearest) / 50, 0, 1)
        height += depth * ends**2 * (3 - 2 * ends) * mexican(away, sigma)
    return fine.moved(fine.vertices + height[:, None] * [0, 0, 1])


LINES = [((0.015, 0.03), (0.085, 0.04)), ((0.02, 0.075), (0.08, 0.065))]


@pytest.fixture(scope="module")
def scan() -> TriangleMesh:
    return wrinkled_sheet(3, LINES, 3e-3, 2.2e-3)


@pytest.fixture(scope="module")
def fit(scan) -> FurrowFit:
    return fit_grooves(layout(), scan)


def test_a_fit_comes_near_a_scan_whose_grooves_have_another_profile(scan, fit):
    before = np.nanmean(np.abs(ScanHeights.measured(layout(), scan).height))
    after = np.nanmean(np.abs(fit.left))
    assert after < 0.3e-3
    assert after < 0.3 * before


def test_grooves_that_add_up_where_they_cross_are_met_there():
    scan = wrinkled_sheet(6, [((0.02, 0.045), (0.08, 0.055)), ((0.05, 0.02), (0.052, 0.08))], 2.5e-3, 2.2e-3)
    fit = fit_grooves(layout(), scan)
    crossing = np.linalg.norm(fit.texels.positions[:, :2] - 0.05, axis=1) < 5e-3
    height = ScanHeights.measured(layout(), scan).height
    assert -height[crossing].min() > 4e-3
    assert np.abs(fit.left[crossing]).mean() < 0.25e-3
    # As furrows they make the same of the skin.
    creases = Creases(prepare_bed(layout(), [groove.furrow("groove") for groove in fit.grooves]))
    skin = creases.mesh(creases.displaced(layout().skin.vertices))
    assert compare(skin, moved(scan, fit.motion)).distances().mean < 0.15e-3


def test_fitted_furrows_lie_along_the_grooves_and_are_there_at_rest(fit):
    deep = [groove for groove in fit.grooves if groove.floor > 1.5e-3]
    assert len(LINES) <= len(deep) <= 2 * len(LINES)
    for groove in deep:
        _, uv = groove.chain.sampled(30)
        places = (uv - 0.1) / 8
        off = min(np.abs(np.interp(places[:, 0], [a[0], b[0]], [a[1], b[1]]) - places[:, 1]).max() for a, b in LINES)
        # They wander by 2 mm.
        assert off < 0.005
        assert groove.furrow("groove").initial == 1.0


def test_a_smooth_skin_gets_no_furrows():
    rng = np.random.default_rng(1)
    fine = sheet(cells=110)
    noisy = fine.moved(fine.vertices + rng.normal(0, NOISE, len(fine.vertices))[:, None] * [0, 0, 1])
    assert fit_grooves(layout(), noisy).grooves == ()


def test_a_scan_of_another_place_gets_no_furrows(scan):
    assert fit_grooves(layout(), lifted(scan, 0.5)).grooves == ()


def test_valleys_are_followed_through_a_crossing():
    crossing = wrinkled_sheet(5, [((0.02, 0.05), (0.08, 0.05)), ((0.05, 0.02), (0.05, 0.08))], 3e-3, 2e-3)
    heights = ScanHeights.measured(layout(), crossing)
    lines = [line for line in valley_lines(valley_field(heights), 5e-4) if line.length > 0.04]
    assert len(lines) == 2
    assert all(line.length < 0.085 for line in lines)


HEIGHTS = (0.0, 0.1, 0.3, 0.1, -0.4, -0.9, -1.1, -0.8, -0.2, 0.2, 0.1)


@pytest.mark.parametrize("section", [(), HEIGHTS])
def test_derivatives_of_a_groove_are_those_of_differences(section):
    texels = SkinTexels.of(layout())
    controls = np.array([[0.2, 0.4], [0.3, 0.42], [0.4, 0.44], [0.5, 0.45], [0.6, 0.46], [0.7, 0.455], [0.8, 0.45]])
    groove = Groove(controls, 3e-3, 2e-3, section, swell=(0.8, 1.2, 1.0, 0.9) if section else ())
    metrics, near = MetricField(texels), np.arange(len(texels.uv))
    bed = GrooveBed(groove, texels, metrics, near)
    height, analytic = bed.heights()
    image = np.zeros(len(near))
    image[bed.rows] = height
    count = len(bed.free)
    steps = {1: 2e-5, count + 1: 2e-5}
    steps |= {count + 5: 1e-5, count + 9: 1e-5, count + 16: 1e-3} if section else {count + 3: 1e-3, count + 4: 1e-5}
    for unknown, step in steps.items():
        change = np.zeros(bed.unknowns)
        change[unknown] = step
        other = GrooveBed(bed.moved(change), texels, metrics, near)
        moved_image = np.zeros(len(near))
        moved_image[other.rows] = other.heights()[0]
        difference = ((moved_image - image) / step)[bed.rows]
        assert np.corrcoef(difference, analytic[:, unknown])[0, 1] > 0.97
        assert np.linalg.norm(difference) == pytest.approx(np.linalg.norm(analytic[:, unknown]), rel=0.1)


def test_texels_are_as_small_where_a_map_is_drawn_out():
    """A map whose upper half stands for twice as much skin, as it does on a chin."""
    flat = sheet(cells=40)
    upper = flat.vertices[:, 1] > 0.05
    tall = flat.vertices.copy()
    tall[:, 0] *= 1.5
    tall[upper, 1] = 0.05 + 3.0 * (tall[upper, 1] - 0.05)
    drawn_out = replace(flat_map(flat), mesh=flat.moved(tall))
    part = lifted(cut(flat.moved(tall), tall[flat.faces][..., 1].mean(axis=1) > 0.08), 0.001)
    heights = ScanHeights.measured(SkinLayout.of_map(drawn_out), part)
    edges = np.sqrt(heights.texels.area[heights.covered])
    assert np.median(edges) == pytest.approx(8e-4, rel=0.15)
    assert heights.texels.metres == pytest.approx(np.median(edges), rel=0.15)
    assert np.allclose(heights.height[heights.covered], 0.001, atol=1e-5)


def test_derivatives_of_what_bends_cost_are_those_of_differences():
    texels = SkinTexels.of(layout())
    controls = np.array([[0.2, 0.4], [0.3, 0.42], [0.4, 0.44], [0.5, 0.45], [0.6, 0.46], [0.7, 0.455], [0.8, 0.45]])
    groove = Groove(controls, 3e-3, 2e-3, HEIGHTS, swell=(0.8, 1.2, 1.0, 0.9))
    metrics, near = MetricField(texels), np.arange(len(texels.uv))
    bed = GrooveBed(groove, texels, metrics, near)
    # Its swell has a mean of 1 then, as after every step.
    bed = GrooveBed(bed.moved(np.zeros(bed.unknowns)), texels, metrics, near)
    bends, analytic = bends_of(bed, NOISE)
    for unknown, step in {1: 1e-6, 3: 1e-6, len(bed.free) + 5: 1e-7}.items():
        change = np.zeros(bed.unknowns)
        change[unknown] = step
        other = bends_of(GrooveBed(bed.moved(change), texels, metrics, near), NOISE)[0]
        difference, expected = (other - bends) / step, analytic[:, unknown]
        assert np.linalg.norm(difference - expected) < 0.05 * np.linalg.norm(expected)


def test_a_straight_and_even_groove_costs_nothing_for_bends():
    texels = SkinTexels.of(layout())
    metrics, near = MetricField(texels), np.arange(len(texels.uv))
    straight = np.column_stack([np.linspace(0.2, 0.8, 4), np.full(4, 0.4)])
    plain = Groove(straight, 3e-3, 2e-3, swell=(1.0,) * 6)
    winding = replace(plain, controls=straight + np.outer([0.0, 0.1, -0.1, 0.0], [0, 1]))
    cost = [
        np.square(bends_of(GrooveBed(groove, texels, metrics, near), NOISE)[0]).sum() for groove in (plain, winding)
    ]
    assert cost[0] < 1e-6 * cost[1]


def test_a_line_is_two_furrows_at_most_and_none_winds_about(fit):
    """Those that others can make good for are left out, and bends cost: none turns by more than half a turn in all."""
    assert len(fit.grooves) <= 2 * len(LINES)
    for groove in fit.grooves:
        along = np.diff(groove.chain.sampled(SAMPLES)[1], axis=0)
        turns = np.diff(np.unwrap(np.arctan2(along[:, 1], along[:, 0])))
        assert np.abs(turns).sum() < np.pi


def test_a_groove_as_a_furrow_is_as_deep_as_its_floor_and_makes_the_same_of_the_skin():
    controls = np.array([[0.2, 0.4], [0.4, 0.4], [0.6, 0.4], [0.8, 0.4]])
    across = np.linspace(-0.01, 0.01, 101)
    for section in ((), HEIGHTS):
        furrow = Groove(controls, 2e-3, 3e-3, section, swell=(0.5, 1.0, 2.0)).furrow("groove")
        assert max(furrow.swell) == 1.0
        made = section_height(across, furrow.depth, furrow.width, furrow.section)
        assert np.allclose(furrow.swell[1] * made, section_height(across, 3e-3, 2e-3, section), atol=1e-6)
        assert made.min() == pytest.approx(-furrow.depth, rel=0.01)


def test_a_groove_ends_where_it_is_no_more_to_be_seen():
    texels = SkinTexels.of(layout())
    controls = np.array([[0.2, 0.4], [0.4, 0.4], [0.6, 0.4], [0.8, 0.4]])
    groove = Groove(controls, 2e-3, 3e-3, HEIGHTS, taper=0.05, swell=(1.0, 1.0, 1.0, 0.0, 0.0))
    metrics, near = MetricField(texels), np.arange(len(texels.uv))
    bed = GrooveBed(groove, texels, metrics, near)
    seen = np.ones(len(groove.chain.sampled(SAMPLES)[0]), dtype=bool)
    short = groove.trimmed(bed.arc_at, seen, 0.06)
    assert np.array_equal(short.controls[0], controls[0])
    assert 0.6 < short.controls[-1, 0] < 0.68
    image, other = np.zeros((2, len(near)))
    image[bed.rows] = bed.heights()[0]
    again = GrooveBed(short, texels, metrics, near)
    other[again.rows] = again.heights()[0]
    assert np.abs(image - other).mean() < 0.1 * np.abs(image).mean()
    # Nothing is known of its first half.
    seen[: len(seen) // 2] = False
    assert groove.trimmed(bed.arc_at, seen, 0.06).controls[0, 0] == pytest.approx(0.5, abs=0.03)
    assert groove.trimmed(bed.arc_at, np.zeros_like(seen), 0.06) is groove


def section_of(height) -> CrossSection:
    across = np.arange(-0.014, 0.0141, 4e-4)
    return CrossSection(across, height(across), np.ones_like(across))


def misfit_of(seen: CrossSection) -> float:
    width = half_width(seen, 3e-3)
    made = section_height(seen.across, 1.0, width, tuple(control_heights(seen, width)))
    return float(np.abs(made - seen.height).mean() / np.abs(seen.height).mean())


@pytest.mark.parametrize("rims", [0.0, 0.3, 0.5, 1.0, 1.3])
def test_a_section_has_round_floors_and_rims_of_any_height(rims):
    seen = section_of(lambda across: 3e-3 * profile(across / 2e-3, Strange(0, rims=rims)))
    assert seen.told
    assert 2e-3 < half_width(seen, 3e-3) < 5e-3
    assert misfit_of(seen) < 0.06


def test_a_section_that_leans_to_one_side_is_met():
    seen = section_of(lambda x: 2e-3 * (np.exp(-(((x - 4e-3) / 2e-3) ** 2)) - np.exp(-((x / 2e-3) ** 2))))
    assert misfit_of(seen) < 0.06


def test_where_no_groove_is_there_is_no_width_of_one():
    assert half_width(section_of(np.abs), 2e-3) == 2e-3


def test_of_a_section_that_is_hardly_seen_nothing_is_told():
    few = np.arange(5) * 4e-4
    assert not CrossSection(few, -few, np.ones(5)).told


def test_a_scan_of_a_face_with_wandering_grooves_is_met():
    head = mannequin()
    scan = strange_scan(head, Strange(11, radius=0.028, lines=1, length=(0.03, 0.04), spacing=1.6e-3))
    fit = fit_face(head, scan, [])
    bed = face_bed(head, fit.furrows, 0.4)
    figures = []
    for strength in (0.0, 1.0):
        creases = Creases(bed, fit.furrows, strength=strength)
        skin = creases.mesh(creases.displaced(head.skin.vertices))
        figures.append(compare(skin, moved(scan, fit.fit.motion) if strength else scan).distances().mean)
    assert figures[1] < 0.3e-3
    assert figures[1] < 0.3 * figures[0]


def test_a_scan_that_was_moved_is_laid_back():
    base = cap(bumps=0.08)
    half = TriangleMesh(base.vertices, base.faces[base.vertices[base.faces][..., 0].mean(axis=1) > -0.01])
    away = turned(0.08, [0.004, -0.003, 0.002])
    found = align(moved(half, away), base, plausible_units(half))
    assert np.abs(found.matrix @ away - np.eye(4)).max() < 1e-3
    assert found.distance < 1e-4


def test_a_scan_that_lies_already_is_left_where_it_is():
    base = cap(bumps=0.08)
    assert np.array_equal(align(base, base, [np.eye(4)]).matrix, np.eye(4))


def test_a_scan_in_millimetres_is_understood():
    base = cap(bumps=0.08)
    found = align(base.moved(1000 * base.vertices), base, plausible_units(base.moved(1000 * base.vertices)))
    assert np.allclose(found.matrix[:3, :3], 1e-3 * np.eye(3), atol=1e-6)


def test_a_scan_of_something_else_is_refused():
    base = cap(bumps=0.08)
    with pytest.raises(ScanError, match="does not lie on this head"):
        align(lifted(base, 0.5), base, [np.eye(4)])


def test_scans_that_cannot_be_of_this_head_are_refused_and_those_that_can_are_laid_on_it():
    head = mannequin()
    scan = strange_scan(head, Strange(5, place="face", radius=0.05, crossing=True, spacing=2.5e-3))
    for good in (scan, scan.moved(scan.vertices / 0.0254), TriangleMesh(scan.vertices, scan.faces[:, ::-1])):
        mesh, _ = repair(good)
        assert align(mesh, head.skin, plausible_units(mesh)).distance < 1e-3
    turned_away = scan.vertices @ Rotation.from_euler("y", 60, degrees=True).as_matrix()
    plane = sheet(size=0.1)
    upright = plane.moved(plane.vertices - [0.05, 0.0, 0.0])
    for bad in (scan.moved(turned_away), scan.moved(1.15 * scan.vertices), scan.moved(3.7 * scan.vertices), upright):
        with pytest.raises(ScanError, match="does not lie on this head"):
            align(bad, head.skin, plausible_units(bad))


def test_distances_between_parallel_sheets_are_their_distance():
    flat, other = sheet(), sheet(cells=37, seed=4)
    comparison = compare(flat, lifted(other, 0.002))
    found = comparison.distances()
    assert (found.mean, found.rms, found.largest) == pytest.approx((2e-3, 2e-3, 2e-3), rel=1e-9)
    assert (comparison.to_scan > 0).all()
    assert found.count == len(comparison.vertices) + len(comparison.scan_vertices)


def test_what_a_patch_does_not_cover_does_not_count():
    flat = sheet()
    patch = TriangleMesh(flat.vertices, flat.faces[flat.vertices[flat.faces][..., 0].mean(axis=1) < 0.05])
    comparison = compare(flat, lifted(patch, 0.001))
    assert flat.vertices[comparison.vertices][:, 0].max() < 0.06
    with pytest.raises(ScanError, match="covers no part"):
        compare(flat, lifted(patch, 0.1))


def test_skin_behind_what_a_scan_shows_does_not_count():
    flat, behind = sheet(), lifted(sheet(), -0.008)
    folded = TriangleMesh(
        np.concatenate([flat.vertices, behind.vertices]),
        np.concatenate([flat.faces, behind.faces + len(flat.vertices)]),
    )
    scan = lifted(sheet(cells=37, seed=4), 0.001)
    assert compare(folded, scan).distances().largest == pytest.approx(1e-3)
    # A deep groove that the skin lacks does: nothing else is near it.
    deep = lifted(scan, -0.006)
    assert compare(flat, deep).distances().mean == pytest.approx(5e-3)


def test_figures_of_distances():
    found = Distances.of(np.array([3.0, -4.0]), np.array([3.0, 1.0]))
    assert (found.mean, found.rms, found.largest, found.count) == (3.25, pytest.approx(np.sqrt(10.75)), 4.0, 2)


def test_triangles_that_are_finer_in_places_count_no_more():
    flat, step = sheet(jitter=0.0), 2e-3
    # Half of the sheet lies 2 mm higher, with four times as many triangles.
    high = flat.vertices[flat.faces][..., 0].mean(axis=1) > 0.05
    parts = [cut(flat, ~high), cut(flat, high)]
    fine = lifted(TriangleMesh(*igl.upsample(parts[1].vertices, parts[1].faces)[:2]), step)
    both = TriangleMesh(
        np.concatenate([parts[0].vertices, fine.vertices]),
        np.concatenate([parts[0].faces, fine.faces + len(parts[0].vertices)]),
    )
    assert compare(flat, both).distances().mean == pytest.approx(0.5 * step, rel=0.06)
