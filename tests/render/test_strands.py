from __future__ import annotations

import dataclasses

import numpy as np
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.head.head import Head
from headstudio.lcp.model import HairModel
from headstudio.render.covered import shown_through_hair
from headstudio.render.particle_texture import neighbour_records
from headstudio.render.ribbons import farthest_first, lay_out_ribbons
from headstudio.render.strands import SECTIONS, CurveBuilder, HairCurves, ending, openness
from headstudio.render.strays import KINK
from headstudio.render.undergrowth import Undergrowth
from headstudio.render.view import camera_view
from headstudio.scene.settings import Camera
from headstudio.scene.stage import HairOnStage

from .stages import CENTRE, RADII, model_of


def curves_of(model: HairModel, frame: HeadFrame | None = None, half_length: float = 0.03) -> HairCurves:
    hair = HairOnStage(model, model.rest_positions, model.rest_directions)
    return CurveBuilder(model).curves(hair, frame or HeadFrame(), half_length)


def straight_hair(count: int) -> HairModel:
    """Hair straight down from the origin, a particle every centimetre."""
    arc = 0.01 * np.arange(count)
    down = np.array([0.0, -1.0, 0.0])
    return model_of(arc[:, None] * down, np.tile(down, (count, 1)), arc, np.zeros((count, 3)))


def test_curve_of_straight_hair_is_straight_and_as_long_as_asked() -> None:
    curves = curves_of(straight_hair(12), half_length=0.02)
    middle = curves.path[6]
    np.testing.assert_allclose(middle[:, [0, 2]], 0, atol=1e-12)
    np.testing.assert_allclose(np.diff(middle[:, 1]), -0.04 / (SECTIONS - 1), atol=1e-12)
    np.testing.assert_allclose(curves.along[6], np.linspace(-1, 1, SECTIONS), atol=1e-12)


def test_curve_follows_its_neighbours_around_a_circle() -> None:
    radius, step, count = 0.05, 0.2, 15
    angle = step * np.arange(count)
    circle = radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    tangent = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
    model = model_of(circle, tangent, radius * angle, np.zeros((count, 3)))
    curves = curves_of(model, half_length=radius * step)
    np.testing.assert_allclose(np.linalg.norm(curves.path[count // 2], axis=1), radius, rtol=5e-3)


def test_curves_do_not_start_deeper_than_the_roots(hair_model: HairModel) -> None:
    curves = curves_of(hair_model, half_length=0.05)
    start = hair_model.arc_length + 0.05 * curves.along[:, 0]
    assert start.min() >= hair_model.arc_length.min() - 1e-12
    assert (curves.grown[hair_model.fixed, 0] == 0).all()
    np.testing.assert_allclose(np.linalg.norm(curves.tangent, axis=2), 1, atol=1e-9)


def test_curves_turn_with_the_head(hair_model: HairModel) -> None:
    frame = HeadFrame(Rotation.from_rotvec([0.2, 0.9, -0.3]), np.array([0.1, 0.0, 0.2]))
    still, turned = curves_of(hair_model), curves_of(hair_model, frame)
    np.testing.assert_allclose(frame.to_world(still.path.reshape(-1, 3)), turned.path.reshape(-1, 3), atol=1e-12)
    np.testing.assert_allclose(frame.rotation.apply(still.sideways), turned.sideways, atol=1e-12)


def test_one_particle_that_points_aside_is_combed() -> None:
    model = straight_hair(12)
    directions = model.rest_directions.copy()
    directions[6] = [1.0, 0.0, 0.0]
    curves = CurveBuilder(model).curves(HairOnStage(model, model.rest_positions, directions), HeadFrame(), 0.02)
    assert curves.direction[6] @ [0, -1, 0] > 0.9
    np.testing.assert_allclose(np.einsum("ni,ni->n", curves.sideways, curves.direction), 0, atol=1e-9)


def hanging_hair(aside: float) -> HairModel:
    """Six strands side by side, straight down; the last two particles of the first are ``aside`` [m] of their place."""
    across, along = np.meshgrid(0.01 * np.arange(6), 0.01 * np.arange(15), indexing="ij")
    positions = np.stack([across, -along, 0 * along], axis=-1)
    positions[0, -2:, 0] -= aside
    flat = positions.reshape(-1, 3)
    return model_of(flat, np.tile([0.0, -1.0, 0.0], (len(flat), 1)), along.ravel(), np.zeros((len(flat), 3)))


def hung(model: HairModel, tip: int, root: int) -> HairModel:
    """The model with no rootward link from ``tip`` but its lifeline, to ``root``."""
    kept = model.links[:, 1] != tip
    parts = {
        name: np.append(getattr(model, name)[kept], getattr(model, name).mean())
        for name in ("alignment", "rest_length", "strength")
    }
    lifeline = model.lifeline.copy()
    lifeline[tip] = np.count_nonzero(kept)
    return dataclasses.replace(
        model,
        links=np.concatenate([model.links[kept], [[root, tip]]]),
        rest_cosine=np.ones((lifeline[tip] + 1, 2)),
        lifeline=lifeline,
        **parts,
    )


def test_hair_that_strays_begins_at_its_neighbour() -> None:
    model = hung(hanging_hair(0.03), 13, 10)
    curves = curves_of(model, half_length=0.02)
    start = np.linalg.norm(curves.path[13, 0] - model.rest_positions[10])
    assert start < 0.016
    assert (curves.grown[13, 1:] > 0.9).all()
    assert np.linalg.norm(curves.sideways[13]) < 0.75
    assert curves.direction[13] @ [-1, 0, 0] > 0.5
    # Hair amid other hair is drawn as ever.
    np.testing.assert_allclose(np.linalg.norm(curves.sideways[20:], axis=1), 1, atol=1e-9)


def test_hair_that_would_have_to_come_from_afar_is_not_drawn_nor_what_hangs_on_it() -> None:
    model = hung(hanging_hair(0.12), 13, 12)
    grown = curves_of(model, half_length=0.02).grown
    assert (grown[[13, 14]] == 0).all()
    assert (grown[20:, -1] == 1).all()


def test_hair_that_would_turn_on_the_spot_ends_before_it_does() -> None:
    """A tip that comes to lie behind what it hangs on would be a hook."""
    model = straight_hair(20)
    shown = []
    for angle in np.radians(np.linspace(0, 150, 151)):
        directions = model.rest_directions.copy()
        directions[14:] = [np.sin(angle), -np.cos(angle), 0]
        positions = model.rest_positions.copy()
        positions[14:] = positions[13] + 0.01 * np.arange(1, 7)[:, None] * directions[14:]
        curves = CurveBuilder(model).curves(HairOnStage(model, positions, directions), HeadFrame(), 0.03)
        turn = np.einsum("nsi,nsi->ns", curves.tangent[:, 1:], curves.tangent[:, :-1])
        assert (curves.grown[:, 1:][turn < np.cos(KINK[1])] == 0).all()
        shown.append(curves.grown[5:, 1:])
    shown = np.array(shown)
    assert (shown[0] == 1).all()
    # All of it up to a turn that hair makes, and of hair that ends before the kink in any case.
    assert (shown[15] == 1).all()
    assert (shown[:, :5] == 1).all()
    assert (shown[-1, 8:] < 1).any()
    assert (np.abs(np.diff(shown, axis=0)) < 0.35).all()


def test_a_lock_that_winds_goes_as_a_whole() -> None:
    """The lock to a particle that strays runs aside and back: what is left of it would lie across the hair."""
    wound = []
    for gap in (8, 9, 10, 11, 12):
        curves = curves_of(hung(hanging_hair(0.03), 13, gap), half_length=0.02)
        turns = np.einsum("si,si->s", curves.tangent[13, 1:], curves.tangent[13, :-1])
        total = np.degrees(np.arccos(np.clip(turns, -1, 1)).sum())
        if total > 85:
            wound.append(gap)
            assert (curves.grown[13] < 0.5).all()
        if total < 60:
            assert (curves.grown[13, 1:] > 0.8).all()
    assert 0 < len(wound) < 5


def test_a_curve_reaches_the_hair_that_it_comes_from() -> None:
    arc = np.array([-0.01, 0.0, 0.01, 0.02, 0.08, 0.09])
    down = np.array([0.0, -1.0, 0.0])
    model = model_of(arc[:, None] * down, np.tile(down, (6, 1)), arc, np.zeros((6, 3)))
    model = dataclasses.replace(
        model,
        links=np.array([[0, 1], [1, 2], [2, 3], [3, 4], [4, 5]]),
        rest_length=np.array([0.01, 0.01, 0.01, 0.06, 0.01]),
        alignment=np.ones(5),
        strength=np.ones(5),
        rest_cosine=np.ones((5, 2)),
    )
    curves = curves_of(model, half_length=0.02)
    np.testing.assert_allclose(curves.path[4, 0], model.rest_positions[3], atol=1e-9)
    np.testing.assert_allclose(curves.path[5, 0], 0.07 * down, atol=1e-9)
    assert (np.abs(curves.along) <= 1).all()


def test_hair_goes_astray_little_by_little() -> None:
    """No curve jumps while a lock is drawn out of the hair."""
    model = hung(hanging_hair(0.0), 13, 10)
    starts, shown = [], []
    for aside in np.linspace(0, 0.06, 121):
        positions = model.rest_positions.copy()
        positions[[13, 14], 0] -= aside
        curves = CurveBuilder(model).curves(HairOnStage(model, positions, model.rest_directions), HeadFrame(), 0.02)
        starts.append(curves.path[13, 0])
        shown.append(curves.grown[13, -1])
    assert np.linalg.norm(np.diff(starts, axis=0), axis=1).max() < 0.004
    assert np.abs(np.diff(shown)).max() < 0.2
    assert shown[0] == 1
    assert shown[-1] < 0.5


def test_sideways_stays_across_hair_that_moved(hair_model: HairModel) -> None:
    turned = Rotation.from_rotvec([0, 0, 1.2]).apply(hair_model.rest_directions)
    curves = CurveBuilder(hair_model).curves(
        HairOnStage(hair_model, hair_model.rest_positions, turned), HeadFrame(), 0.03
    )
    np.testing.assert_allclose(np.einsum("ni,ni->n", curves.sideways, curves.direction), 0, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(curves.sideways, axis=1), 1, atol=1e-9)


def test_ribbons_go_from_far_to_near(hair_model: HairModel) -> None:
    view, half_width = camera_view(Camera(azimuth=0.4), 1.0), 0.007
    ribbons, curves = lay_out_ribbons(ending(hair_model), 3, np.zeros(0, int)), curves_of(hair_model)
    curve = ribbons["curve"].astype(int)
    other = np.cross(curves.direction, curves.sideways)
    middles = curves.position[curve] + half_width * (
        ribbons["spread"][:, :1] * curves.sideways[curve] + ribbons["spread"][:, 1:] * other[curve]
    )
    order = farthest_first(ribbons, curves, half_width, view)
    np.testing.assert_array_equal(np.sort(order), np.arange(3 * hair_model.count))
    assert (np.diff(view.depth(middles[order])) <= 1e-9).all()


def test_strands_end_where_hair_does_and_nowhere_else() -> None:
    long, short = straight_hair(30), straight_hair(12)
    # Side by side, farther apart than hair that tells of its neighbour's end.
    apart = np.array([1.0, 0.0, 0.0])
    model = model_of(
        np.concatenate([long.rest_positions, short.rest_positions + apart]),
        np.concatenate([long.rest_directions, short.rest_directions]),
        np.concatenate([long.arc_length, short.arc_length]),
        np.concatenate([long.root_points, short.root_points + apart]),
    )
    ends = ending(model)
    for part, arc in ((ends[:30], long.arc_length), (ends[30:], short.arc_length)):
        assert part[-1] == 1.0
        assert (part[arc < arc[-1] - 0.031] == 0.0).all()
        assert (np.diff(part) >= 0.0).all()
    ribbons = lay_out_ribbons(ends, 400, np.zeros(0, int))
    np.testing.assert_allclose(ribbons["ending"].reshape(42, 400).mean(axis=1), ends, atol=0.1)


def test_undergrowth_lies_on_the_scalp_and_moves_with_the_head(egg: Head, hair_model: HairModel) -> None:
    undergrowth = Undergrowth(egg, hair_model)
    still = undergrowth.curves(HeadFrame())
    assert len(undergrowth) > 50
    height = np.sqrt((((still.path - CENTRE) / RADII) ** 2).sum(axis=2))
    assert np.abs(height - 1).max() < 0.08
    np.testing.assert_allclose(np.linalg.norm(still.tangent, axis=2), 1, atol=1e-9)
    # On the sides and the back hair lies downwards.
    lying = still.position[:, 1] < CENTRE[1] + 0.05
    assert lying.any()
    assert (still.direction[lying, 1] < 0).mean() > 0.9
    frame = HeadFrame(Rotation.from_rotvec([0.2, 0.9, -0.3]), np.array([0.1, 0.0, 0.2]))
    turned = undergrowth.curves(frame)
    np.testing.assert_allclose(frame.to_world(still.path.reshape(-1, 3)), turned.path.reshape(-1, 3), atol=1e-12)


def test_neighbour_records_name_every_link_once() -> None:
    links = np.array([[0, 1], [0, 2], [1, 2], [2, 3], [0, 3], [1, 3]])
    dtype, records = neighbour_records(links, 5)
    assert dtype.itemsize % 16 == 0
    assert sorted(records["rootward"][3]) == [-1, 0, 1, 2]
    assert sorted(records["tipward"][0]) == [-1, 1, 2, 3]
    assert (records["tipward"][4] == -1).all()


def test_hair_before_hair_hides_it_little_by_little() -> None:
    depth = 0.01 * np.arange(30)
    down = np.tile([0.0, -1.0, 0.0], (30, 1))
    positions = np.column_stack([np.zeros((30, 2)), -depth])
    model = model_of(positions, down, np.full(30, 0.1), positions)
    view = camera_view(Camera(azimuth=0.0, elevation=0.0, target_y=0.0), 1.0)
    shown = shown_through_hair(curves_of(model, half_length=0.01), view, 0.05)
    assert (np.diff(shown) <= 0).all()
    assert shown[0] == 1
    assert shown[-1] == 0
    assert ((shown > 0) & (shown < 1)).any()


def test_hair_side_by_side_hides_nothing() -> None:
    positions = np.column_stack([np.linspace(-0.2, 0.2, 30), np.zeros((30, 2))])
    model = model_of(positions, np.tile([0.0, -1.0, 0.0], (30, 1)), np.full(30, 0.1), positions)
    view = camera_view(Camera(azimuth=0.0, elevation=0.0, target_y=0.0), 1.0)
    assert (shown_through_hair(curves_of(model, half_length=0.01), view, 0.01) == 1).all()


def test_surface_is_more_open_than_the_inside() -> None:
    grid = np.stack(np.meshgrid(*[np.linspace(-0.05, 0.05, 11)] * 3), axis=-1).reshape(-1, 3)
    model = model_of(grid, np.tile([0.0, -1.0, 0.0], (len(grid), 1)), np.full(len(grid), 0.1), grid)
    open_ = openness(model)
    inside = np.abs(grid).max(axis=1) < 0.02
    corner = np.abs(grid).min(axis=1) > 0.045
    assert open_[inside].max() < 0.2
    assert open_[corner].min() > 0.8
