"""Living skin in the picture: relief, furrows, figures, splits; on the mannequin, small."""

from __future__ import annotations

import dataclasses
import math

import moderngl
import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from headstudio.head.head import Head
from headstudio.head.mannequin import mannequin
from headstudio.head.mesh import TriangleMesh
from headstudio.params import assign
from headstudio.render.detail import neighbours_together
from headstudio.render.fine_relief import FineRelief
from headstudio.render.head_shade import shade_of_head
from headstudio.render.picture_area import Outline
from headstudio.render.renderer import Renderer
from headstudio.render.skin_shape import curvature_of, faded_in, hidden_in_creases, hidden_in_mouth
from headstudio.render.skin_values import scale_colours, shown_values
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.settings import SKIN_SHOWS, Camera, Look
from headstudio.scene.skin_settings import SkinSettings
from headstudio.scene.stage import Stage
from headstudio.wrinkle.face import WIDEST_JAW, Face
from headstudio.wrinkle.face_settings import FaceSettings
from headstudio.wrinkle.fine_settings import FineSettings
from headstudio.wrinkle.limb_skin import grow_limb_skin
from headstudio.wrinkle.living_skin import LivingSkin, Skin

SIZE = (128, 128)
CLOSE = Camera(azimuth=0.1, elevation=0.1, distance=0.35, target_y=0.07, target_z=0.06)
RAKING = Look(shadow_size=128, light_azimuth=1.1, light_height=0.8)
SMILE = {"face.smile": 0.9, "face.surprise": 0.6}

Pixels = NDArray[np.uint8]


@pytest.fixture(scope="module")
def document() -> Document:
    return assign(
        Document(),
        {"head.source": "mannequin", "look.skin_as": "living", "fine.texture_size": 256, "fine.unit": 5e-4, **SMILE},
    )


@pytest.fixture(scope="module")
def skin(document: Document) -> Skin:
    return Builder().skin(document)


@pytest.fixture(scope="module")
def smiling(skin: Skin, document: Document) -> LivingSkin:
    return skin.at(document.face)


@pytest.fixture(scope="module")
def _camera_man(_gl: moderngl.Context) -> Renderer:
    with _gl:
        return Renderer(_gl)


@pytest.fixture
def camera_man(gl: moderngl.Context, _camera_man: Renderer) -> Renderer:
    return _camera_man


def shot(
    renderer: Renderer,
    living: LivingSkin,
    settings: SkinSettings = SkinSettings(),  # noqa: B008
    *,
    camera: Camera = CLOSE,
    **look: object,
) -> Pixels:
    stage = Stage(living.surface.head, skin=living)
    renderer.render(stage, dataclasses.replace(RAKING, **look), camera, SIZE, skin=settings)  # type: ignore[arg-type]
    return renderer.read_pixels()


def roughness(pixels: Pixels) -> float:
    """How much neighbouring pixels differ in the middle of the picture."""
    gray = pixels[30:70, 40:90].astype(float).mean(axis=2)
    return float(np.abs(np.diff(gray, axis=0)).mean() + np.abs(np.diff(gray, axis=1)).mean())


def test_wrinkles_are_seen_and_the_split_takes_them_away_on_the_left(camera_man: Renderer, smiling: LivingSkin) -> None:
    whole, half, bare = (shot(camera_man, smiling, split=split) for split in (0.0, 0.5, 1.0))
    assert roughness(whole) > 1.3 * roughness(bare)
    np.testing.assert_array_equal(half[:, :64], bare[:, :64])
    np.testing.assert_array_equal(half[:, 66:], whole[:, 66:])


def test_fine_relief_stands_out_nearby_and_leaves_no_noise_far_away(camera_man: Renderer, smiling: LivingSkin) -> None:
    flat = SkinSettings(relief=0.0)
    by = dataclasses.replace(CLOSE, distance=0.12)
    near = np.abs(shot(camera_man, smiling, camera=by).astype(int) - shot(camera_man, smiling, flat, camera=by)).mean()
    away = dataclasses.replace(CLOSE, distance=3.0)
    far = np.abs(
        shot(camera_man, smiling, camera=away).astype(int) - shot(camera_man, smiling, flat, camera=away)
    ).max()
    assert near > 1.0
    assert far <= 12


def test_every_skin_parameter_is_seen(camera_man: Renderer, smiling: LivingSkin) -> None:
    before = shot(camera_man, smiling)
    for change in (
        {"tone": "monk 8"},
        {"melanin": 1.0},
        {"haemoglobin": 0.6},
        {"flush": 0.0},
        {"blood_flow": 1.0},
        {"model": "lafortune"},
        {"gloss": 0.0},
        {"roughness": 0.7},
        {"scattering": 0.0},
        {"scattering_by": "screen"},
        {"relief": 3.0},
        {"creases": 0.0},
    ):
        changed = shot(camera_man, smiling, SkinSettings(**change))  # type: ignore[arg-type]
        assert np.abs(changed.astype(int) - before).max() > 4, change
    browner, yellower = (
        shot(camera_man, smiling, SkinSettings(melanin=1.0, pigments=pigments)).mean(axis=(0, 1))
        for pigments in ("spectra", "pictures")
    )
    assert browner[0] - browner[1] > yellower[0] - yellower[1] + 1
    np.testing.assert_array_equal(shot(camera_man, smiling), before)


def test_light_spread_in_the_picture_softens_red_and_keeps_its_sum(camera_man: Renderer, smiling: LivingSkin) -> None:
    """Neighbouring pixels of a close look differ less, in red the least; as a whole the skin is as bright as before."""
    close = dataclasses.replace(CLOSE, distance=0.08)
    matt = SkinSettings(gloss=0.0, scattering_by="screen", flush=0.0)
    sharp, soft = (
        shot(camera_man, smiling, dataclasses.replace(matt, scattering=amount), camera=close)[20:100, 20:100].astype(
            float
        )
        for amount in (0.0, 1.0)
    )
    left = np.abs(np.diff(soft, axis=0)).mean(axis=(0, 1)) / np.abs(np.diff(sharp, axis=0)).mean(axis=(0, 1))
    assert left[0] < 0.8
    assert left[0] < left[1] < 1.02
    np.testing.assert_allclose(soft.mean(axis=(0, 1)), sharp.mean(axis=(0, 1)), atol=3.0)


def test_a_tone_map_is_a_choice(camera_man: Renderer, smiling: LivingSkin) -> None:
    soft, filmic, none = (shot(camera_man, smiling, tone_map=word).astype(int) for word in ("soft", "filmic", "none"))
    assert np.abs(soft - filmic).max() > 10
    assert none.max() > soft.max()


@pytest.mark.parametrize("shows", [word for word in SKIN_SHOWS if word != "skin"])
def test_figures_are_drawn_in_their_colours(camera_man: Renderer, smiling: LivingSkin, shows: str) -> None:
    values = shown_values(shows, smiling)
    assert values.shape == (len(smiling.surface.rest),)
    assert np.isfinite(values).all()
    assert np.ptp(values) > 0.1
    assert np.abs(shot(camera_man, smiling, skin_shows=shows).astype(int) - shot(camera_man, smiling)).max() > 60


def test_skin_at_rest_is_in_the_middle_of_its_scales(skin: Skin) -> None:
    resting = skin.at(Document().face)
    np.testing.assert_allclose(shown_values("expansion", resting), 0.5, atol=1e-6)
    np.testing.assert_allclose(shown_values("shrinkage", resting), 0.5, atol=1e-6)
    white = scale_colours("height", 255)[127]
    assert white.min() > 0.8


def test_a_pose_is_sent_once(camera_man: Renderer, skin: Skin, smiling: LivingSkin) -> None:
    first = shot(camera_man, smiling)
    resting = shot(camera_man, skin.at(Document().face))
    assert (resting != first).any()
    np.testing.assert_array_equal(shot(camera_man, smiling), first)


def test_the_shadow_follows_the_face(camera_man: Renderer, skin: Skin) -> None:
    """Without its own shadow an open mouth is lit inside."""
    wide = skin.at(assign(Document(), {"face.jaw_open": 1.0}).face)
    mouth = dataclasses.replace(CLOSE, target_y=-0.03, distance=0.25)
    lit, dark = (shot(camera_man, wide, camera=mouth, shadows=shadows).astype(int) for shadows in (False, True))
    assert (lit - dark).max() > 25


def test_furrows_hide_the_sky_and_bulges_do_not() -> None:
    hidden = hidden_in_creases(np.array([-0.01, -0.003, 0.0, 0.002]))
    assert hidden[1] == pytest.approx(1 - 1 / math.sqrt(2))
    assert hidden[0] > hidden[1]
    assert (hidden[2:] == 0).all()


def test_curvature_of_a_ball_is_one_over_its_radius() -> None:
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.05)
    np.testing.assert_allclose(
        curvature_of(TriangleMesh(np.array(ball.vertices), np.array(ball.faces))), 20.0, rtol=0.02
    )


def test_triangles_in_another_order_are_the_same_triangles() -> None:
    ball = trimesh.creation.icosphere(subdivisions=4)
    faces, points = np.array(ball.faces), np.array(ball.vertices)
    ordered = neighbours_together(faces, points)
    assert sorted(map(tuple, ordered.tolist())) == sorted(map(tuple, faces.tolist()))

    def steps(each: NDArray[np.int64]) -> float:
        return float(np.linalg.norm(np.diff(points[each].mean(axis=1), axis=0), axis=1).mean())

    assert steps(ordered) < 0.5 * steps(np.random.default_rng(0).permutation(faces))


def test_the_map_fades_out_at_its_border() -> None:
    line = np.stack([np.linspace(0, 0.1, 101), np.zeros(101), np.zeros(101)], axis=1)
    fade = faded_in(line, (line[:, 0] > 0.02).astype(float))
    assert (fade[:21] == 0).all()
    assert (np.diff(fade) >= -1e-12).all()
    assert (fade[40:] == 1).all()


def test_slopes_are_those_of_the_height_fields(gl: moderngl.Context, skin: Skin) -> None:
    fine = skin.surface.fine
    assert fine is not None
    relief = FineRelief(gl, fine)
    read = np.frombuffer(relief.slopes.read(), np.float16).reshape(256, 256, 4).astype(float)
    row, column = np.unravel_index(np.abs(fine.heights[0][1:-1, 1:-1]).argmax(), (254, 254))
    row, column = row + 1, column + 1
    by_u = 128 * (fine.heights[0][row, column + 1] - fine.heights[0][row, column - 1])
    assert read[row, column, 0] == pytest.approx(by_u, rel=2e-3, abs=1e-4)
    assert FineRelief(gl, None).size == 1


def test_a_limb_is_drawn_with_its_fine_wrinkles(camera_man: Renderer) -> None:
    """A bent sheet that brings its own texture coordinates, as the hand of MakeHuman does."""
    u, v = np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, 1, 41))
    flat = np.stack([0.06 * (u - 0.5), 0.06 * (v - 0.5), 0.01 * np.cos(3 * (u - 0.5))], axis=-1).reshape(-1, 3)
    corner = (np.arange(40)[:, None] * 41 + np.arange(40)).ravel()
    faces = np.concatenate([
        np.stack([corner, corner + 1, corner + 42], axis=1), np.stack([corner, corner + 42, corner + 41], axis=1)
    ])  # fmt: skip
    coordinates = np.stack([u, v], axis=-1).reshape(-1, 2)
    sheet = TriangleMesh(flat, faces, 0.3 * coordinates[faces])
    grown = grow_limb_skin(sheet, FineSettings(texture_size=256), np.array([0.0, 1.0, 0.0]))
    posed = grown.at(flat * [1.0, 0.85, 1.0])
    np.testing.assert_allclose(posed.expansion[posed.expansion != 1], 0.85, atol=0.02)
    camera = Camera(azimuth=0.0, elevation=0.0, distance=0.12, target_y=0.0, target_z=0.0)
    pictures = []
    for settings in (SkinSettings(), SkinSettings(relief=0.0)):
        camera_man.render_limb(posed, RAKING, camera, SIZE, skin=settings)
        pictures.append(camera_man.read_pixels().astype(int))
    assert roughness(pictures[0].astype(np.uint8)) > 2 * roughness(pictures[1].astype(np.uint8))


def test_lips_come_to_light_as_the_jaw_opens(gl: moderngl.Context) -> None:
    """What a mouth hides it hides less and less, and next to nothing of lips that are wide apart."""
    shut = np.array([0.0, 0.5, 1.0])
    hidden = np.stack([hidden_in_mouth(shut, jaw) for jaw in np.linspace(0.0, WIDEST_JAW, 20)])
    np.testing.assert_allclose(hidden[0], shut)
    np.testing.assert_allclose(hidden[-1], 0.0)
    assert (np.diff(hidden, axis=0) <= 0).all()

    head = mannequin()
    face = Face(head)
    wide = face.posed_head(face.pose(FaceSettings(jaw_open=1.0)))
    rest, shade = shade_of_head(gl, head), shade_of_head(gl, head, wide)
    np.testing.assert_allclose(1 - (1 - shade.skin) * (1 - shade.mouth), rest.skin, atol=1e-6)
    edge = find_seam_vertices(head)
    assert rest.skin[edge].mean() > 0.7
    assert shade.skin[edge].mean() < 0.55


def find_seam_vertices(head: Head) -> NDArray[np.int64]:
    """Where both lips have a vertex in one place, in the middle half of the mouth."""
    pairs = cKDTree(head.skin.vertices).query_pairs(1e-9, output_type="ndarray").ravel()
    return pairs[np.abs(head.skin.vertices[pairs, 0]) < 0.5 * head.landmarks.mouth_left[0]]


def test_skin_beyond_the_map_of_fine_wrinkles_needs_no_bumps(
    gl: moderngl.Context, smiling: LivingSkin, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is lit without them, which takes a third less; the picture is the same."""
    views = [CLOSE, Camera(azimuth=0.6, distance=0.9), Camera(azimuth=3.0, distance=0.7)]
    stage = Stage(smiling.surface.head, skin=smiling)

    def pictures() -> list[Pixels]:
        renderer = Renderer(gl)
        shown = []
        for view in views:
            renderer.render(stage, RAKING, view, SIZE)
            shown.append(renderer.read_pixels().astype(int))
        return shown

    apart = pictures()
    monkeypatch.setattr(Outline, "area", lambda *_: (0, 0, *SIZE))
    for mine, whole in zip(apart, pictures(), strict=True):
        assert np.abs(mine - whole).max() <= 1
