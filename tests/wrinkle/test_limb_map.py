"""Maps of limbs that bring none: one piece, one to one, whatever the limb."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from headstudio.head.limbs import makehuman_foot, makehuman_hand
from headstudio.head.mesh import TriangleMesh
from headstudio.wrinkle.body_part import split_at_seams
from headstudio.wrinkle.hand import Hand
from headstudio.wrinkle.hand_settings import HandSettings
from headstudio.wrinkle.limb_map import long_side, share_of_largest_piece, with_map
from headstudio.wrinkle.mapping import own_coordinates
from headstudio.wrinkle.one_to_one import signed_areas
from headstudio.wrinkle.projection import TextureMapError

from .skins import covering_counts, cut


def of(shape: trimesh.Trimesh, *size: float) -> TriangleMesh:
    return TriangleMesh(shape.vertices * size, shape.faces)


def egg() -> TriangleMesh:
    return of(trimesh.creation.icosphere(subdivisions=3, radius=1.0), 0.03, 0.1, 0.02)


def bumpy(seed: int) -> TriangleMesh:
    """A closed shape with patches of its front that look backward."""
    mesh = egg()
    waves = np.random.default_rng(seed).normal(size=(6, 3)) * 80.0
    bumps = 1.0 + 0.08 * np.sin(mesh.vertices @ waves.T).sum(axis=1)
    return mesh.moved(mesh.vertices * bumps[:, None])


def sleeve() -> TriangleMesh:
    mesh = egg()
    return cut(mesh, np.abs(mesh.vertices[mesh.faces][..., 1].mean(axis=1)) < 0.07)


def hand() -> tuple[TriangleMesh, np.ndarray]:
    part = makehuman_hand(0.5)
    bare = TriangleMesh(part.skin.vertices, part.skin.faces)
    return bare, Hand(part).pose(HandSettings(pose="open"))


@pytest.mark.parametrize(
    "limb", [egg, sleeve, lambda: bumpy(1), lambda: bumpy(2), hand], ids=["egg", "sleeve", "bumpy", "bumpier", "hand"]
)
def test_a_limb_is_mapped_one_to_one_in_one_piece(limb):
    made = limb()
    mesh, open_hand = made if isinstance(made, tuple) else (made, None)
    mapped = with_map(mesh, open_hand)
    np.testing.assert_array_equal(mapped.vertices, mesh.vertices)
    np.testing.assert_array_equal(mapped.faces, mesh.faces)
    opened = split_at_seams(mapped)
    texture_map = own_coordinates(opened.mesh)
    assert (signed_areas(texture_map.corner_uv) > 0).all()
    assert covering_counts(texture_map).max() == 1
    assert texture_map.uv.min() >= 0
    assert texture_map.uv.max() < 1
    faces, vertices = len(mesh.faces), len(opened.mesh.vertices)
    edges = len(np.unique(np.sort(opened.mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0))
    assert vertices - edges + faces == 1, "a disc"


def test_smaller_pieces_are_left_beside_the_map():
    mesh, crumb = egg(), of(trimesh.creation.icosphere(subdivisions=1), 0.002, 0.002, 0.002)
    both = TriangleMesh(
        np.concatenate([mesh.vertices, crumb.vertices + 0.2]),
        np.concatenate([mesh.faces, crumb.faces + len(mesh.vertices)]),
    )
    corners = with_map(both).corner_uv
    assert not corners[len(mesh.faces) :].any()
    assert signed_areas(corners[: len(mesh.faces)]).min() > 0


def test_what_is_no_ball_is_refused_in_one_line():
    ring = trimesh.creation.torus(major_radius=0.05, minor_radius=0.01)
    with pytest.raises(TextureMapError, match="handle"):
        with_map(TriangleMesh(ring.vertices, ring.faces))


def test_the_long_side_of_an_egg():
    np.testing.assert_allclose(np.abs(long_side(egg())), [0, 1, 0], atol=1e-6)


def test_how_much_of_a_limb_its_own_map_holds_in_one_piece():
    foot = makehuman_foot()
    assert 0.6 < share_of_largest_piece(foot.skin) < 0.9  # the leg is on another piece
    bare = TriangleMesh(foot.skin.vertices, foot.skin.faces)
    assert share_of_largest_piece(bare) == 0.0
    assert share_of_largest_piece(with_map(bare)) == pytest.approx(1.0)
