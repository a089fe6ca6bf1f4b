"""What an overhang hides gets a place of its own in the plane, and the rest stays where it was."""

import numpy as np
import pytest

from headstudio.head.mesh import TriangleMesh
from headstudio.scene.builder import Builder
from headstudio.scene.settings import HeadSettings
from headstudio.wrinkle.face_chart import FaceChart
from headstudio.wrinkle.face_creases import face_layout
from headstudio.wrinkle.one_to_one import Layout, signed_areas, why_not_one_to_one
from headstudio.wrinkle.unfolding import unfolded


def overhanging(shape: int = 41) -> TriangleMesh:
    """A sheet, 8 cm long, that runs back under itself in its middle, seen from the front."""
    x, s = np.meshgrid(np.linspace(-0.04, 0.04, shape), np.linspace(-0.04, 0.04, shape))
    deep = np.exp(-((x / 0.02) ** 2))
    y = s - 0.0105 * deep * np.exp(-((s / 0.008) ** 2)) * s / 0.008 * 1.6
    z = 0.01 * deep * np.tanh(s / 0.004)
    k = np.arange(shape * shape).reshape(shape, shape)
    a, b, c, d = (part.ravel() for part in (k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]))
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return TriangleMesh(np.stack([x, y, z], axis=-1).reshape(-1, 3), faces)


def test_a_fold_is_drawn_out_of_the_plane_and_the_rest_stays():
    mesh = overhanging()
    places = mesh.vertices[:, :2]
    turned = signed_areas(places[mesh.faces]) <= 0
    assert turned.sum() > 20
    flat = unfolded(mesh, places, turned)
    assert why_not_one_to_one(mesh, Layout(flat, np.zeros_like(mesh.faces))) is None
    far = np.abs(mesh.vertices[:, 1]) > 0.025
    assert np.array_equal(flat[far], places[far])


def test_what_lies_flat_is_left_alone():
    mesh = overhanging()
    plain = mesh.vertices[:, :2] * 1.0
    assert unfolded(mesh, plain, np.zeros(len(mesh.faces), dtype=bool)) is plain


@pytest.mark.parametrize("source", ["mannequin", "makehuman"])
def test_the_face_and_its_chart_are_one_to_one(source):
    """Under the jaw and the nose, too: furrows fitted there come back to where they were."""
    head = Builder().head(HeadSettings(source=source))
    layout = face_layout(head)
    chart = FaceChart(head, layout)
    skin = layout.part.mesh.vertices
    back = chart.on_skin(chart.from_skin(skin))
    away = np.linalg.norm(back - skin, axis=1)
    assert np.isfinite(away).all()
    # All but some vertices at the rims of nostrils.
    assert (away > 1e-5).mean() < 0.003
