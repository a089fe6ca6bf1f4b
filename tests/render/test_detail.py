from __future__ import annotations

from dataclasses import replace

import igl
import moderngl
import numpy as np
import pytest
import trimesh

from headstudio.head.mesh import Floats, TriangleMesh
from headstudio.render import detail
from headstudio.render.body import Body
from headstudio.render.detail import Surface, casting_shadows, coarser, faces_of_level, level_of
from headstudio.render.detailed_faces import DetailedFaces
from headstudio.render.renderer import Renderer
from headstudio.scene.settings import Camera, Look
from headstudio.scene.stage import Stage


def surface_of(mesh: TriangleMesh, painted: Floats | None = None) -> Surface:
    return Surface(
        mesh.faces,
        mesh.vertices,
        mesh.vertex_normals,
        np.zeros((len(mesh.vertices), 0)) if painted is None else painted,
    )


def ball(subdivisions: int = 5, radius: float = 0.1) -> TriangleMesh:
    mesh = trimesh.creation.icosphere(subdivisions=subdivisions, radius=radius)
    return TriangleMesh(np.array(mesh.vertices), np.array(mesh.faces))


@pytest.mark.parametrize("pixel", [0.001, 0.002, 0.004])
def test_fewer_triangles_still_close_and_stay_within_a_part_of_a_pixel(pixel: float) -> None:
    mesh = ball(6)
    faces = coarser(surface_of(mesh), pixel)
    assert len(faces) < 0.5 * len(mesh.faces)
    # Every edge is crossed as often one way as the other.
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    keys, back = (edges @ [len(mesh.vertices), 1], edges @ [1, len(mesh.vertices)])
    np.testing.assert_array_equal(np.sort(keys), np.sort(back))
    assert trimesh.Trimesh(mesh.vertices, faces).volume == pytest.approx(4 / 3 * np.pi * 0.1**3, rel=0.02)
    middles = mesh.vertices[faces].mean(axis=1)
    assert (0.1 - np.linalg.norm(middles, axis=1)).max() < pixel


def test_a_border_keeps_its_course() -> None:
    """A cut runs through clusters; were its corners among them the border of a bust would have notches."""
    whole = ball(6)
    kept = whole.faces[whole.vertices[whole.faces].mean(axis=1) @ [0.3, 1.0, 0.1] > -0.01]
    cap = TriangleMesh(whole.vertices, kept)
    faces = coarser(surface_of(cap), 0.004)
    assert len(faces) < 0.3 * len(kept)
    before, after = (np.sort(igl.boundary_facets(f)[0], axis=1) for f in (kept, faces))
    np.testing.assert_array_equal(np.unique(before, axis=0), np.unique(after, axis=0))


def test_nothing_is_left_out_where_triangles_are_larger_than_pixels() -> None:
    mesh = ball()
    surface = surface_of(mesh)
    assert faces_of_level(surface, level_of(1e-5)) is surface.faces
    assert len(coarser(surface, 0.0003)) == len(mesh.faces)


def test_levels_are_never_coarser_than_their_pixels() -> None:
    for pixel in np.geomspace(3e-4, 1e-2, 40):
        level = level_of(pixel)
        assert detail._FINEST * 2 ** (level / 2) <= 1.1 * pixel
        assert level_of(1.5 * pixel) > level


def test_sheets_that_touch_stay_two() -> None:
    """As lips do: what opens later must not be sewn together."""
    across, along = np.meshgrid(np.arange(60), np.arange(30))
    upper = np.column_stack([0.0005 * across.ravel(), 0.0005 * along.ravel(), np.zeros(across.size)])
    cell = np.arange(across.size).reshape(across.shape)[:-1, :-1].ravel()
    faces = np.concatenate([np.stack([cell, cell + 1, cell + 61], 1), np.stack([cell, cell + 61, cell + 60], 1)])
    points = np.concatenate([upper, upper * [1, -1, 1] - [0, 1e-6, 0]])
    mesh = TriangleMesh(points, np.concatenate([faces, faces[:, ::-1] + len(upper)]))
    left = coarser(surface_of(mesh), 0.001)
    assert 0 < len(left) < 0.3 * len(mesh.faces)
    assert ((left < len(upper)).all(axis=1) | (left >= len(upper)).all(axis=1)).all()
    assert len(igl.boundary_loop_all(left)) == 2


def test_closed_lips_do_not_gape_from_afar() -> None:
    """Both lose the same vertices where they meet: none, whatever the rest of either looks like."""
    whole = ball(6)
    upper = whole.vertices[whole.faces].mean(axis=1)[:, 1] > 0.0
    count = len(whole.vertices)
    meet = np.intersect1d(whole.faces[upper], whole.faces[~upper])
    double = np.arange(count)
    double[meet] = count + np.arange(len(meet))
    # Only one of them bends: its clusters are smaller.
    points = np.concatenate([whole.vertices, whole.vertices[meet]])
    normals = np.concatenate([whole.vertex_normals, whole.vertex_normals[meet]])
    normals[: len(whole.vertices)][whole.vertices[:, 1] > 0.0] = [0.0, 0.0, 1.0]
    # A lining behind closes both, so that they have no border.
    lips = np.concatenate([whole.faces[upper], double[whole.faces[~upper]]])
    inner = points * 0.9
    lining = np.concatenate([whole.faces[upper], double[whole.faces[~upper]]])[:, ::-1] + len(points)
    border = igl.boundary_facets(lips)[0]
    sewn = np.concatenate(
        [
            np.stack([border[:, 1], border[:, 0], border[:, 0] + len(points)], axis=1),
            np.stack([border[:, 1], border[:, 0] + len(points), border[:, 1] + len(points)], axis=1),
        ]
    )
    mouth = Surface(
        np.concatenate([lips, lining, sewn]),
        np.concatenate([points, inner]),
        np.concatenate([normals, -normals]),
        np.zeros((2 * len(points), 0)),
    )
    assert len(igl.boundary_facets(mouth.faces)[0]) == 0
    faces = coarser(mouth, 0.004)
    assert len(faces) < 0.4 * len(mouth.faces)
    assert np.isin(np.concatenate([meet, double[meet]]), faces).all()


def test_the_floor_of_a_furrow_goes_on_from_end_to_end() -> None:
    """A wavy line over a sheet: what is left of it is joined by edges and leaves it nowhere."""
    x, y = np.meshgrid(np.linspace(0.0, 0.1, 201), np.linspace(-0.02, 0.02, 81), indexing="ij")
    wave = 0.003 * np.sin(60.0 * x)
    points = np.stack([x, y + wave, np.zeros_like(x)], axis=2).reshape(-1, 3)
    corner = (np.arange(200)[:, None] * 81 + np.arange(80)).reshape(-1, 1)
    faces = np.concatenate([corner + np.array(triangle) for triangle in ([0, 81, 1], [81, 82, 1])])
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    line = np.flatnonzero(np.abs(y.ravel()) < 1e-9)
    for lines, joined in ((line, True), (line[:0], False)):
        left = coarser(Surface(faces, points, normals, np.zeros((len(points), 0)), lines), 0.0008)
        assert len(left) < 0.5 * len(faces)
        edges = left[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        edges = edges[np.isin(edges, line).all(axis=1)]
        ahead = np.unique(np.sort(points[edges, 0], axis=1), axis=0)
        reach = 0.0
        for low, high in ahead:
            reach = high if low <= reach + 1e-9 else reach
        assert (reach > 0.099) == joined


def test_what_is_painted_keeps_its_edge() -> None:
    mesh = ball()
    height = mesh.vertices[:, 1]
    painted = np.clip(height / 0.003, 0, 1)[:, None]
    plain, striped = (coarser(surface_of(mesh, paint), 0.0015) for paint in (0 * painted, painted))

    def edges(faces: np.ndarray) -> float:
        corners = mesh.vertices[faces]
        near = np.abs(corners[:, :, 1].mean(axis=1) - 0.0015) < 0.0015
        return float(np.linalg.norm(corners[near, 0] - corners[near, 1], axis=1).mean())

    assert edges(striped) < 0.75 * edges(plain)


def test_a_shadow_needs_few_triangles() -> None:
    mesh = ball(6)
    faces = casting_shadows(mesh)
    assert len(faces) < 0.2 * len(mesh.faces)
    assert trimesh.Trimesh(mesh.vertices, faces).volume == pytest.approx(4 / 3 * np.pi * 0.1**3, rel=0.03)


def test_a_level_is_made_once_and_seen_by_nobody(
    gl: moderngl.Context, stage: Stage, look: Look, camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    renderer, far, bald = Renderer(gl), replace(camera, distance=3.0), replace(stage, hair=None)

    def picture(view: Camera) -> Floats:
        renderer.render(bald, look, view, (96, 96))
        return renderer.read_pixels().astype(float)

    first = picture(far)
    assert isinstance(renderer._body, Body)
    levels = renderer._body._faces._levels
    assert sorted(levels) == [-1, max(levels)]
    assert len(levels[max(levels)]) < 0.9 * len(levels[-1])
    picture(camera)
    np.testing.assert_array_equal(picture(far), first)
    monkeypatch.setattr(DetailedFaces, "level_for", lambda *_: -1)
    assert np.abs(picture(far) - first).mean() < 0.5


def test_no_triangles_are_much_smaller_than_their_clusters() -> None:
    """Cubes that the surface only grazes would be clusters of their own: slivers between those of their neighbours."""
    mesh = ball(7)
    pixel = 0.002
    faces = coarser(surface_of(mesh), pixel)
    a, b, c = (mesh.vertices[faces[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    assert area.min() > 0.2 * np.median(area)
    edges = np.linalg.norm(b - a, axis=1)
    assert edges.min() > 0.4 * np.median(edges)


def test_of_pairs_that_are_too_close_one_stays_and_no_other_has_to_go() -> None:
    rng = np.random.default_rng(4)
    seeds, first, second = np.arange(0, 300, 2), *(2 * rng.integers(0, 150, (2, 400)))
    first, second = first[first != second], second[first != second]
    rank = rng.permutation(300)
    rank[[10, 20]] = -1
    stays = detail._apart(seeds, first, second, rank)
    both = np.isin(first, stays) & np.isin(second, stays)
    assert (rank[first[both]] == rank[second[both]]).all()  # both must stay
    assert {10, 20} <= set(stays.tolist()) <= set(seeds.tolist())
    gone = np.setdiff1d(seeds, stays)
    near_one = np.union1d(first[np.isin(second, stays)], second[np.isin(first, stays)])
    assert np.isin(gone, near_one).all()
