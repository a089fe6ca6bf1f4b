import igl
import numpy as np
import pytest

from headstudio.wisp.accessories import Band, HairTie, Pin, Ribbon, accessory_mesh
from headstudio.wisp.adornment import adorn
from headstudio.wisp.elastics import elastics_of
from headstudio.wisp.operations import Braid, Bun, Tie
from headstudio.wisp.selection import Selection
from headstudio.wisp.sweep import closed_tube, tube

from .dressed import body, hair, weight

WORN = [Band(), Pin(), Pin((0.0, 1.2, 0.3), (1.0, 0.0, 0.0)), Ribbon(), HairTie(), HairTie(direction=(0, -1.0, 0))]


def volume(mesh) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


@pytest.mark.parametrize("accessory", WORN)
def test_accessories_are_closed_face_outward_and_lie_on_the_head(accessory):
    _, _, surroundings = body()
    mesh = accessory_mesh(accessory, surroundings)
    assert len(igl.boundary_facets(mesh.faces)[0]) == 0
    assert volume(mesh) > 0
    distance = surroundings.distance(mesh.vertices)
    assert distance.min() > -0.003
    assert distance.min() < 0.03


def test_a_band_goes_over_the_head_from_ear_to_ear():
    _, _, surroundings = body()
    places = surroundings.proportions.measure(accessory_mesh(Band(), surroundings).vertices)
    assert places[:, 0].min() < -0.9
    assert places[:, 0].max() > 0.9
    assert places[:, 1].max() > 1.0


def test_tubes_have_their_volume():
    line = np.stack([np.zeros(9), np.linspace(0, 0.1, 9), np.zeros(9)], axis=1)
    ten_corners = 5 * np.sin(2 * np.pi / 10)
    assert volume(tube(line, np.full(9, 0.01))) == pytest.approx(ten_corners * 0.01**2 * 0.1, rel=1e-6)
    turn = np.linspace(0, 2 * np.pi, 65)[:-1]
    ring = 0.03 * np.stack([np.cos(turn), 0 * turn, np.sin(turn)], axis=1)
    assert volume(closed_tube(ring, 0.004)) == pytest.approx(ten_corners * 0.004**2 * 2 * np.pi * 0.03, rel=0.01)


def test_ties_and_braids_bring_their_elastics():
    _, scalp, surroundings = body()
    operations = (Tie(colour=(1.0, 0.0, 0.0)), Bun(), Braid(Selection("left")), Tie(Selection("right"), elastic=False))
    outlines = hair(scalp)
    elastics = elastics_of(operations, outlines, surroundings, weight(), scalp.locate(outlines.roots))
    worn = adorn((Pin(),), elastics, surroundings)
    assert len(worn) == 3
    assert worn[1].colour == (1.0, 0.0, 0.0)
    knot = surroundings.proportions.place(np.array(Tie().place))
    assert np.linalg.norm(worn[1].mesh.vertices.mean(axis=0) - knot) < 0.02
