"""Repairing meshes: welding, bad faces, winding, pieces."""

import numpy as np
import pytest

from headstudio.head.mesh import TriangleMesh
from headstudio.head.parts import joined, pieces_of
from headstudio.head.read import TriangleSoup
from headstudio.head.repair import border_loops, face_components, non_manifold_edge_count, repair, weld

from .zoo import is_coherent, moebius, open_cap, plane, signed_volume, soup, sphere, torn


def test_torn_surface_is_closed_again():
    ball = sphere()
    mesh, repairs = repair(torn(ball))
    assert len(mesh.vertices) == len(ball.vertices)
    assert border_loops(mesh.faces) == []
    assert repairs.welded_vertices == 3 * len(ball.faces) - len(ball.vertices)
    assert repairs.lines() == [f"{repairs.welded_vertices:,} vertices welded (they share their position with another)"]


def test_welding_keeps_texture_coordinates_at_their_corners():
    mesh, _ = repair(torn(sphere()))
    np.testing.assert_array_equal(mesh.corner_uv, mesh.vertices[mesh.faces][..., :2])


def test_weld_joins_across_rounding_and_nothing_else():
    points = np.array([[0.0, 0, 0], [1e-9, 0, 0], [1, 0, 0], [1, 1e-3, 0], [-1e-9, 0, 0]])
    np.testing.assert_array_equal(weld(points, 1e-8), [0, 0, 2, 3, 0])


def test_degenerate_and_duplicate_faces_go():
    ball = sphere()
    extra = np.array([[0, 0, 1], [2, 3, 3], ball.faces[0], ball.faces[1][[1, 2, 0]], ball.faces[2][::-1]])
    mesh, repairs = repair(TriangleSoup(ball.vertices, np.concatenate([ball.faces, extra]), None))
    assert (repairs.degenerate_faces, repairs.duplicate_faces) == (2, 3)
    assert len(mesh.faces) == len(ball.faces)


def test_flat_face_of_three_places_goes():
    mesh, repairs = repair(TriangleSoup(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), np.array([[0, 1, 2]]), None))
    assert repairs.degenerate_faces == 1
    assert mesh.faces.shape == (0, 3)


@pytest.mark.parametrize("surface", [sphere, open_cap])
def test_winding_becomes_coherent_and_outward(surface):
    mesh = surface()
    flip = np.random.default_rng(1).random(len(mesh.faces)) < 0.7
    faces = np.where(flip[:, None], mesh.faces[:, ::-1], mesh.faces)
    uv = mesh.vertices[faces][..., :2]
    repaired, repairs = repair(TriangleSoup(mesh.vertices, faces, uv))
    assert repairs.turned_faces == flip.sum()
    assert is_coherent(repaired.faces)
    assert signed_volume(repaired) > 0
    np.testing.assert_array_equal(repaired.corner_uv, repaired.vertices[repaired.faces][..., :2])


def test_every_piece_is_turned_outward_by_itself():
    inside_out = TriangleMesh(sphere(0.5, (3, 0, 0)).vertices, sphere(0.5).faces[:, ::-1])
    mesh, _ = repair(soup(joined([sphere(), inside_out])))
    assert [signed_volume(piece) > 0 for piece in pieces_of(mesh)] == [True, True]


def test_open_cap_stays_open():
    mesh, _ = repair(soup(open_cap()))
    loops = border_loops(mesh.faces)
    assert len(loops) == 1
    np.testing.assert_allclose(mesh.vertices[loops[0], 1], -0.3, atol=1e-12)


def test_pieces_that_touch_along_an_edge_stay_apart():
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [1, -1, 0.5]])
    first = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    second = np.array([[0, 1, 4], [0, 5, 1], [0, 4, 5], [1, 5, 4]])
    mesh, _ = repair(TriangleSoup(vertices, np.concatenate([first, second]), None))
    assert non_manifold_edge_count(mesh.faces) == 1
    assert np.bincount(face_components(mesh.faces)).tolist() == [4, 4]


def test_plane_is_one_piece_with_one_border():
    mesh, _ = repair(soup(plane()))
    assert len(pieces_of(mesh)) == 1
    assert [len(loop) for loop in border_loops(mesh.faces)] == [4 * 19]


def test_surface_without_two_sides_survives():
    mesh, _ = repair(soup(moebius()))
    assert len(mesh.faces) == len(moebius().faces)
    assert non_manifold_edge_count(mesh.faces) == 0
    assert len(border_loops(mesh.faces)) == 1
