"""Marks for whoever tunes the simulation."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.lcp.wind import AirState
from headstudio.params import assign
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.overlays import overlays_of
from headstudio.scene.settings import Look
from headstudio.scene.stage import NO_OVERLAYS, HairOnStage

FRAME = HeadFrame(Rotation.from_euler("y", 0.4), np.array([0.1, 0.0, 0.0]))
NO_AIR = AirState(np.zeros((0, 3)), np.zeros((0, 3)))


@pytest.fixture(scope="module")
def built():
    return Builder().build(assign(Document(), {"head.source": "mannequin", "hair.particles": 300}))


@pytest.fixture
def hair(built):
    return HairOnStage(built.hair, built.hair.rest_positions, built.hair.rest_directions)


def test_nothing_asked_for_is_always_the_same_nothing(built, hair):
    assert overlays_of(Look(), hair, built.body, FRAME, NO_AIR) is NO_OVERLAYS


def test_a_spring_is_red_when_stretched_and_blue_when_compressed(built, hair):
    look = Look(show_links=True)
    longer = overlays_of(look, replace(hair, positions=1.2 * hair.positions), built.body, FRAME, NO_AIR)
    shorter = overlays_of(look, replace(hair, positions=0.8 * hair.positions), built.body, FRAME, NO_AIR)
    assert longer.segments.shape == (len(built.hair.links), 2, 3)
    assert np.median(longer.segment_colours[:, 0]) > 0.9
    assert np.median(shorter.segment_colours[:, 2]) > 0.9
    first = FRAME.to_world(1.2 * hair.positions[built.hair.links[0]])
    assert longer.segments[0] == pytest.approx(first)


def test_a_particle_is_a_point_with_its_direction(built, hair):
    marks = overlays_of(Look(show_particles=True), hair, built.body, FRAME, NO_AIR)
    assert marks.points == pytest.approx(FRAME.to_world(hair.positions))
    ways = marks.segments[:, 1] - marks.segments[:, 0]
    assert ways / np.linalg.norm(ways, axis=1)[:, None] == pytest.approx(FRAME.rotation.apply(hair.directions))


def test_contact_planes_are_squares_at_right_angles_to_the_normal(built, hair):
    marks = overlays_of(Look(show_contact=True), hair, built.body, HeadFrame(), NO_AIR)
    squares = marks.segments.reshape(-1, 4, 2, 3)
    assert len(squares) > 20
    sides = squares[:, :, 1] - squares[:, :, 0]
    assert sides.sum(axis=1) == pytest.approx(np.zeros((len(squares), 3)), abs=1e-12)
    assert np.einsum("ij,ij->i", sides[:, 0], sides[:, 1]) == pytest.approx(np.zeros(len(squares)), abs=1e-12)


def test_air_trails_behind_itself(built, hair):
    air = AirState(np.array([[0.5, 0.0, 0.0]]), np.array([[4.0, 0.0, 0.0]]))
    marks = overlays_of(Look(show_wind=True), hair, built.body, FRAME, air)
    assert marks.points == pytest.approx(air.positions)
    assert marks.segments[0, 1, 0] < 0.5
