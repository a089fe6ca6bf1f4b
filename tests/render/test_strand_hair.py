from __future__ import annotations

import dataclasses
from itertools import pairwise

import flip_evaluator
import moderngl
import numpy as np
import pytest

from headstudio.head.frame import HeadFrame
from headstudio.head.head import Head
from headstudio.head.mesh import Floats, TriangleMesh
from headstudio.render.deep_opacity import LAYER_DEPTHS, taken
from headstudio.render.fibre import Fibre, Sent, followed, melanin_absorption, scattering
from headstudio.render.light_volume import Grid, lit_from_beside
from headstudio.render.renderer import Renderer
from headstudio.render.scene_block import SCENE_DTYPE
from headstudio.render.sky_light import Sky, SkyLight, SkyPrograms
from headstudio.render.soft_light import irradiance
from headstudio.render.strand_detail import FINE, StrandSurvey, thinned
from headstudio.render.strand_hair import StrandHair, StrandMaterial, StrandPrograms
from headstudio.render.strand_picture import StrandScene, shown, strand_picture
from headstudio.render.strand_points import pack, piece_indices, piece_spheres, strip_indices
from headstudio.render.targets import light_targets
from headstudio.render.view import View, bounding_sphere, parallel_view, perspective_view
from headstudio.scene.settings import Camera, Look
from headstudio.scene.stage import Stage
from headstudio.wisp.strands import Strands

from .strand_scenes import BALL_RADIUS, ball, fur, strands_crossed

TO_LIGHT = np.array([0.36, 0.80, 0.48])
MELANIN = 0.6

BLACK = Sent(np.zeros(3), np.zeros(3))
"""What strands send forward and back that keep all light."""


def material(melanin: float = MELANIN, **fibre: float) -> StrandMaterial:
    red, green, blue = melanin_absorption(melanin, 0.4)
    return StrandMaterial(Fibre(**fibre), (float(red), float(green), float(blue)))


def eye_view(eye: tuple[float, float, float] = (0.1, 0.15, 0.7)) -> View:
    return perspective_view(np.array(eye), np.zeros(3), np.radians(30), 1.0)


def fur_scene(**changes: object) -> StrandScene:
    scene = StrandScene(
        strands=fur(2_000),
        meshes=[ball()],
        material=material(),
        diffuse=np.array([0.6, 0.4, 0.3]),
        sun_direction=TO_LIGHT,
        sun=np.full(3, 2.5),
        sky=np.full(3, 0.25),
    )
    return dataclasses.replace(scene, **changes)


def picture(gl: moderngl.Context, scene: StrandScene, size: int = 128) -> Floats:
    light = strand_picture(gl, scene, eye_view(), size)
    assert light is not None
    return light.astype(np.float64)


class TestStrips:
    strands = Strands(np.zeros((12, 3), np.float32), np.array([0, 2, 9, 12]))

    def test_every_segment_is_drawn_once(self) -> None:
        first = pack(self.strands).first
        whole = strip_indices(first, 3)
        assert (np.flatnonzero(whole == 0xFFFFFFFF) + 1 == 2 * first[1:4] + [1, 2, 3]).all()
        assert (whole[whole != 0xFFFFFFFF] == np.arange(24)).all()

    @pytest.mark.parametrize("piece", [1, 2, 4])
    def test_every_segment_is_in_one_piece(self, piece: int) -> None:
        first = pack(self.strands).first
        pieces, of_strands = piece_indices(first, 3, piece)
        drawn = {
            (int(a) // 2, int(b) // 2) for row in pieces for a, b in zip(row[:-3:2], row[2:-1:2]) if a // 2 != b // 2
        }
        assert drawn == {(k, k + 1) for start, end in pairwise(first) for k in range(start, end - 1)}
        assert pieces.shape == (sum(-(-segments // piece) for segments in (1, 6, 2)), 2 * piece + 3)
        assert (pieces[:, -1] == 0xFFFFFFFF).all()
        assert of_strands[-1] == len(pieces)

    @pytest.mark.parametrize("piece", [1, 2])
    def test_a_piece_is_known_by_its_middle(self, piece: int) -> None:
        points = np.float32([[0, 0, 0], [2, 0, 0], [4, 0, 0], [6, 0, 0], [7, 0, 0]])
        packed = pack(Strands(points, np.array([0, 5])))
        middles, reaches = piece_spheres(packed, piece_indices(packed.first, 1, piece)[0])
        np.testing.assert_allclose(middles[:, 0], [1, 3, 5, 6.5] if piece == 1 else [2, 6])
        np.testing.assert_allclose(reaches, [1, 1, 1, 0.5] if piece == 1 else [2, 2])

    def test_coarser_strips_keep_roots_and_tips(self) -> None:
        strands = Strands(np.zeros((12, 3), np.float32), np.array([0, 2, 9, 12]))
        first = np.asarray(strands.first)
        coarse = strip_indices(first, 3, stride=4)
        ends = np.flatnonzero(coarse == 0xFFFFFFFF) + 1
        points = [(part[:-1:2] // 2).tolist() for part in np.split(coarse, ends[:-1])]
        assert points == [[0, 1], [2, 6, 8], [9, 11]]

    def test_fewer_strands_are_a_sample_of_all(self) -> None:
        strands = fur(500)
        packed = pack(strands)
        chosen = packed.points[: packed.first[100], :3].reshape(100, -1, 3)[:, 0]
        every = strands.points.reshape(500, -1, 3)[:, 0]
        assert np.linalg.norm(chosen.mean(axis=0) - every.mean(axis=0)) < 0.2 * every.std()
        assert {tuple(point) for point in chosen.tolist()} <= {tuple(point) for point in every.tolist()}


def test_a_strand_that_runs_away_from_the_eye_is_before_another_and_then_behind_it(gl: moderngl.Context) -> None:
    """Red comes from before blue, and crosses behind it: in order of middles of both its segments blue would be behind."""
    crossing, before = np.array([0.05, 0.0, 0.02]), np.array([0.0, 0.0, 0.06])
    behind = crossing + 0.05 * (crossing - eye_view().eye)
    red = [2 * before - behind, before, 2 * behind - before]
    blue = crossing + np.array([[0.0, -0.05, 0.0], [0.0, 0.0, 0.0], [0.0, 0.05, 0.0]])
    colours = np.repeat(np.float32([[0.9, 0.02, 0.02], [0.02, 0.02, 0.9]]), 3, axis=0)
    strands = Strands.of_equal_count(
        np.float32([red, blue]), radius=np.full((2, 3), 0.004, np.float32), colour=colours.reshape(2, 3, 3)
    )
    far_off = TriangleMesh(0.1 * ball().vertices - [0.0, 0.0, 0.3], ball().faces)
    light = picture(gl, fur_scene(strands=strands, meshes=[far_off], sun=np.zeros(3), sky=np.ones(3)))
    x, y, _, w = eye_view().clip_from_world @ [*crossing, 1.0]
    at = light[int(64 - 64 * y / w), int(64 + 64 * x / w)]
    assert at[2] > 2 * at[0]


@pytest.fixture
def programs(gl: moderngl.Context) -> StrandPrograms:
    return StrandPrograms(gl)


def lit_hair(
    gl: moderngl.Context, programs: StrandPrograms, strands: Strands, shadows: bool
) -> tuple[StrandHair, object]:
    """Strands under a light and no sky, with nothing in the way but themselves."""
    hair = StrandHair(gl, programs, StrandSurvey(strands), strands.count, FINE)
    maps = light_targets(gl, 512)
    sphere = bounding_sphere(strands.points)
    light = parallel_view(TO_LIGHT, sphere.centre, sphere.radius)
    block = np.zeros(1, SCENE_DTYPE)
    view = eye_view()
    block["clip_from_world"], block["light_from_world"] = view.clip_from_world.T, light.clip_from_world.T
    block["eye"][0, :3], block["to_light"][0, :3] = view.eye, TO_LIGHT
    block["radiance"][0, :3] = 1 / np.pi
    block["shadow"][0] = float(shadows), light.far, view.near, view.far
    buffer = gl.buffer(block.tobytes())
    buffer.bind_to_uniform_block(0)
    maps.shadow.clear(depth=1.0)
    hair.shed_light(light, HeadFrame(), maps, 512)
    dark = Sky(np.zeros(3), np.zeros(3), np.array([0.0, 1.0, 0.0]))
    empty = SkyLight(gl, SkyPrograms(gl), programs.opacity, ball().vertices, ball().faces, FINE)
    hair.see_from_sky(empty)
    empty.see_body(np.zeros((len(ball().vertices), 3)))
    hair.take_soft_light(empty, dark, BLACK)
    maps.depth.use(0)
    maps.map.use(1)
    return hair, (maps, buffer)


@pytest.mark.parametrize("roughness", [0.2, 0.5])
def test_shader_scatters_as_the_reference_does(
    gl: moderngl.Context, programs: StrandPrograms, roughness: float
) -> None:
    rng = np.random.default_rng(5)
    direction = rng.normal(size=(40, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    start = rng.uniform(-0.1, 0.1, (40, 3))
    strands = Strands.of_equal_count(
        np.stack([start, start + 0.01 * direction], axis=1).astype(np.float32),
        radius=np.full((40, 2), 1e-6, np.float32),
    )
    hair, kept = lit_hair(gl, programs, strands, shadows=False)
    made_of = material(roughness=roughness)
    hair.shade(made_of)
    packed = pack(strands)
    shades = np.frombuffer(hair._shades.read(), np.float16).reshape(-1, 4)[: len(packed.points), :3].astype(float)
    wanted = np.zeros_like(shades)
    for k, (place, along) in enumerate(zip(packed.points[:, :3].astype(float), packed.tangents.astype(float))):
        along = along / np.linalg.norm(along)
        to_eye = eye_view().eye - place
        to_eye /= np.linalg.norm(to_eye)
        across = [vector - along * (vector @ along) for vector in (TO_LIGHT, to_eye)]
        phi = np.arccos(across[0] @ across[1] / np.linalg.norm(across[0]) / np.linalg.norm(across[1]))
        for colour, absorption in enumerate(made_of.absorption):
            lobes = scattering(np.array([TO_LIGHT @ along]), to_eye @ along, np.array([phi]), absorption, made_of.fibre)
            wanted[k, colour] = lobes[0, 0]
    assert wanted.max() > 0.01
    assert np.abs(shades - wanted).mean() < 0.03 * wanted.mean()
    del kept


def test_light_comes_through_strands_and_past_them(gl: moderngl.Context, programs: StrandPrograms) -> None:
    """tests/render/test_pile.py has how much comes through."""
    strands = fur(3_000, points=8)
    hair, (maps, _) = lit_hair(gl, programs, strands, shadows=True)
    low, high = strands.points.min(axis=0), strands.points.max(axis=0)
    places = np.random.default_rng(9).uniform(low, high, (300, 3))
    past = hair.sunlit(places, maps, BLACK)[:, 0]
    through = hair.sunlit(places, maps, Sent(np.array([0.8, 0.5, 0.1]), np.array([0.2, 0.1, 0.05])))
    assert (np.diff(through, axis=1) <= 1e-3).all()
    assert (through[:, 2] > past - 1e-3).all()
    assert (through[:, 0] < 1 + 1e-3).all()
    shaded = past < 0.3
    assert (through[shaded, 0] > past[shaded] + 0.1).all()
    ended = hair.sunlit(places, maps, Sent(np.array([0.8, 0.5, 0.1]), np.array([0.2, 0.1, 0.05]), followed(2)))
    assert (ended <= through + 1e-3).all()
    assert ended[shaded, 0].mean() < 0.9 * through[shaded, 0].mean()


def test_a_place_behind_one_thick_strand_is_dark(gl: moderngl.Context, programs: StrandPrograms) -> None:
    """Strands wider than a texel of the map hide all of what is behind them, and not exp(-1) of it."""
    right = np.cross(TO_LIGHT, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    ends = np.linspace(-0.15, 0.15, 7)[:, None] * right
    strands = Strands.of_equal_count(ends[None].astype(np.float32), radius=np.full((1, 7), 0.002, np.float32))
    hair, (maps, _) = lit_hair(gl, programs, strands, shadows=True)
    behind, beside = -0.02 * TO_LIGHT, -0.02 * TO_LIGHT + 0.01 * np.cross(right, TO_LIGHT)
    lit = hair.sunlit(np.stack([behind, beside]), maps, BLACK)[:, 0]
    assert lit[0] < 0.05
    assert lit[1] == pytest.approx(1.0, abs=0.01)


def test_deep_opacity_is_what_rays_meet(gl: moderngl.Context, programs: StrandPrograms) -> None:
    strands = fur(3_000, points=8)
    hair, (maps, _) = lit_hair(gl, programs, strands, shadows=True)
    rng = np.random.default_rng(8)
    low, high = strands.points.min(axis=0), strands.points.max(axis=0)
    places = rng.uniform(low, high, (900, 3))
    through = hair.sunlit(places, maps, BLACK)[:, 0]
    met = strands_crossed(strands, places, np.full(len(places), -1), TO_LIGHT)
    seen = (met == 0).astype(float)
    assert 0.2 < seen.mean() < 0.8
    assert abs(through.mean() - seen.mean()) < 0.03
    # Not only in the mean: where the map says that little light comes, little does.
    for low_, high_ in ((0.0, 0.2), (0.2, 0.5), (0.5, 0.8), (0.8, 1.01)):
        inside = (through >= low_) & (through < high_)
        assert abs(through[inside].mean() - seen[inside].mean()) < 0.1
    assert (np.diff(LAYER_DEPTHS) > 0).all()


def sun_that_arrives(gl: moderngl.Context, programs: StrandPrograms, strands: Strands) -> Floats:
    """The part of the sun that falls on every point, (p,): black strands with their shadows over those without."""
    black = StrandMaterial(Fibre(roughness=0.8, radial_roughness=0.8), (50.0, 50.0, 50.0))
    source = pack(strands).source
    shades = np.empty((2, len(source)))
    for k, shadows in enumerate((True, False)):
        hair, kept = lit_hair(gl, programs, strands, shadows=shadows)
        hair.shade(black)
        shades[k, source] = np.frombuffer(hair._shades.read(), np.float16).reshape(-1, 4)[: len(source), 0]
        del kept
    assert shades[1].min() > 0.0
    return shades[0] / shades[1]


def test_sun_falls_on_the_strands_that_rays_reach(gl: moderngl.Context, programs: StrandPrograms) -> None:
    strands = fur(3_000, points=8)
    asked = np.random.default_rng(8).choice(len(strands.points), 900, replace=False)
    lit = sun_that_arrives(gl, programs, strands)[asked]
    seen = strands_crossed(strands, strands.points[asked].astype(float), asked // 8, TO_LIGHT) == 0
    assert 0.2 < seen.mean() < 0.8
    assert abs(lit.mean() - seen.mean()) < 0.03
    assert np.corrcoef(lit, seen)[0, 1] > 0.8
    assert lit[seen].mean() > 0.85
    assert lit[~seen].mean() < 0.32


def test_a_strand_that_stands_alone_is_in_no_shadow(gl: moderngl.Context, programs: StrandPrograms) -> None:
    """Not in its own, either, whatever it has added to the light's map: thick strands in every direction, far apart."""
    strands = fur(60, points=8, radius=6e-4)
    met = strands_crossed(strands, strands.points.astype(float), np.arange(60).repeat(8), TO_LIGHT)
    lit = sun_that_arrives(gl, programs, strands)[met == 0]
    assert len(lit) > 200
    assert np.quantile(lit, 0.1) > 0.95
    assert lit.mean() > 0.95


def test_a_ball_hides_its_part_of_the_sky(gl: moderngl.Context, programs: StrandPrograms) -> None:
    strands = fur(50)
    hair = StrandHair(gl, programs, StrandSurvey(strands), 50, FINE)
    body = ball()
    sky_light = SkyLight(gl, SkyPrograms(gl), programs.opacity, body.vertices, body.faces, FINE)
    hair.see_from_sky(sky_light)
    sky_light.see_body(np.zeros((len(body.vertices), 3)))
    even = Sky(np.ones(3), np.ones(3), np.array([0.0, 1.0, 0.0]))
    below = np.array([[0.0, -0.083, 0.0]])
    light = sky_light.gather(np.concatenate([below, [[0.0, -5.0, 0.0]]]), even, BLACK)
    hidden = 0.5 * (1 - np.sqrt(1 - (BALL_RADIUS / 0.083) ** 2))  # what the ball takes of all directions
    assert light[0, 1, 0] == pytest.approx(1 - hidden, abs=0.06)
    assert light[1, 1, 0] == pytest.approx(1.0, abs=0.1)
    down = irradiance(light, np.array([[0.0, -1.0, 0.0], [0.0, -1.0, 0.0]]))
    assert down[0] == pytest.approx(np.pi, rel=0.15)


def test_strands_that_cover_texels_let_through_as_much_as_rays_that_miss_them() -> None:
    """Strands strewn at random: in the mean exp(-lost count) comes through, however much of a texel each one covers."""
    lost, mean = np.array([0.2, 0.6, 0.95]), 1.5
    for cover in (0.02, 0.5, 0.99):
        counts = cover * np.random.default_rng(4).poisson(mean / cover, 200_000)
        through = np.exp(-taken(lost, cover) * counts[:, None]).mean(axis=0)
        np.testing.assert_allclose(through, np.exp(-lost * mean), rtol=0.02)
    np.testing.assert_allclose(taken(lost, 1e-3), lost, rtol=1e-3)


def test_light_from_below_reaches_a_place_under_an_overhang(gl: moderngl.Context, programs: StrandPrograms) -> None:
    """A ball hides the place from above; a floor below it shines, and the ball does not."""
    body, half, depth = ball(), 0.3, 0.2
    corners = np.array([[-half, -depth, -half], [-half, -depth, half], [half, -depth, half], [half, -depth, -half]])
    vertices = np.concatenate([body.vertices, corners])
    faces = np.concatenate([body.faces, len(body.vertices) + np.array([[0, 1, 2], [0, 2, 3]])])
    hair = StrandHair(gl, programs, StrandSurvey(fur(2, radius=1e-7)), 2, FINE)
    sky_light = SkyLight(gl, SkyPrograms(gl), programs.opacity, vertices, faces, FINE)
    hair.see_from_sky(sky_light)
    shining = np.arange(len(vertices)) >= len(body.vertices)
    sky_light.see_body(np.repeat(shining[:, None], 3, axis=1).astype(float))
    dark = Sky(np.zeros(3), np.zeros(3), np.array([0.0, 1.0, 0.0]))
    under, within = np.array([0.0, -0.09, 0.0]), np.array([0.0, -0.05, 0.0])
    light = sky_light.gather(np.stack([under, within]), dark, BLACK)
    # The part of all directions that a square fills, seen from above its middle.
    tall = depth + under[1]
    wanted = np.arcsin(half**2 / (half**2 + tall**2)) / np.pi
    assert light[0, 1, 0] == pytest.approx(wanted, abs=0.05)
    assert light[0, 1, 2] < -wanted  # it comes from below
    assert not light[1].any()


def test_hair_on_the_skin_reads_no_darkness_from_within_the_body() -> None:
    grid = Grid(np.zeros(3), 0.004, (3, 3, 3), np.arange(27))
    light = np.random.default_rng(2).uniform(0.1, 1.0, (27, 8, 4))
    light[:9] = 0.0  # z = 0 is under the skin
    filled = lit_from_beside(grid, light)
    np.testing.assert_array_equal(filled[9:], light[9:])
    np.testing.assert_allclose(filled[4], light[9:18].mean(axis=0))  # has all nine of the next layer beside it
    np.testing.assert_allclose(filled[0], light[[9, 10, 12, 13]].mean(axis=0))


class TestPicture:
    def test_empty_sky_is_the_background_in_srgb(self, gl: moderngl.Context) -> None:
        light = picture(gl, fur_scene(), 64)
        assert (shown(light.astype(np.float32))[0, 0] == 137).all()

    def test_strands_thinner_than_a_pixel_cover_what_they_cover_of_it(self, gl: moderngl.Context) -> None:
        """Where a picture has pixels four times finer, a strand is four times as many of them wide, and no darker."""
        scene = fur_scene(strands=fur(300, radius=8e-5))
        coarse, fine = picture(gl, scene, 64), picture(gl, scene, 256)
        bare = picture(gl, fur_scene(strands=fur(2, radius=1e-7)), 64)
        few, many, none = (
            light.reshape(16, n, 16, n, 3).mean(axis=(1, 3)) for light, n in ((coarse, 4), (fine, 16), (bare, 4))
        )
        seen = np.abs(many - none).mean()
        assert seen > 0.002
        assert np.abs(few - many).mean() < 0.1 * seen

    def test_the_light_of_hair_grows_with_what_it_does_not_absorb(self, gl: moderngl.Context) -> None:
        crown = np.s_[10:17, 26:38]
        scenes = (fur_scene(strands=fur(4_000, points=6), material=material(melanin)) for melanin in (0.95, 0.6, 0.1))
        dark, brown, light = (picture(gl, scene, 64)[crown].mean() for scene in scenes)
        assert 1.3 * dark < brown < 0.8 * light

    def test_hair_shades_the_body_and_the_body_hair(self, gl: moderngl.Context) -> None:
        lit = picture(gl, fur_scene(sky=np.zeros(3)), 96)
        behind = picture(gl, fur_scene(sky=np.zeros(3), sun_direction=np.array([0.0, -0.6, -0.8])), 96)
        bare = picture(gl, fur_scene(sky=np.zeros(3), strands=fur(2, radius=1e-7)), 96)
        assert behind[15:25, 40:56].mean() < 0.5 * lit[15:25, 40:56].mean()
        rim = np.s_[50:58, 40:56]
        assert lit[rim].mean() < bare[rim].mean()

    def test_it_can_be_watched_and_stopped(self, gl: moderngl.Context) -> None:
        seen: list[tuple[int, int]] = []

        def stop_at_three(done: int, of: int) -> bool:
            seen.append((done, of))
            return done < 3

        assert strand_picture(gl, fur_scene(), eye_view(), 32, progress=stop_at_three) is None
        assert [done for done, _ in seen] == [1, 2, 3]


def flip(one: Floats, other: Floats) -> float:
    """Mean FLIP of two pictures of 8 bits."""
    return float(flip_evaluator.evaluate(one.astype(np.float32) / 255, other.astype(np.float32) / 255, "LDR")[1])


class TestOnStage:
    camera = Camera(distance=0.6, target_y=0.02)

    def stage(self, egg: Head, **changes: object) -> Stage:
        strands = fur(4_000, radius=8e-5)
        lifted = dataclasses.replace(
            strands, points=strands.points * np.float32(1.15) + np.float32([0, 0.05, 0]), **changes
        )
        return Stage(egg, strands=lifted)

    def test_fewer_wider_strands_look_the_same(self, renderer: Renderer, egg: Head) -> None:
        stage, look = self.stage(egg), Look(shadow_size=512)
        renderer.render_final(stage, look, self.camera, (160, 160))
        final = renderer.read_pixels()
        renderer.render(stage, dataclasses.replace(look, strands_shown=1_000), self.camera, (160, 160))
        assert flip(final, renderer.read_pixels()) < 0.08
        renderer.render(Stage(egg), look, self.camera, (160, 160))
        assert flip(final, renderer.read_pixels()) > 0.1  # two different pictures

    def test_recoloured_strands_are_as_strands_of_these_colours(self, renderer: Renderer, egg: Head) -> None:
        def drawn(strands: Strands) -> Floats:
            renderer.render(Stage(egg, strands=strands), Look(), self.camera, (96, 96))
            return renderer.read_pixels().astype(float)

        strands = self.stage(egg).strands
        assert strands is not None
        brown, red = (
            dataclasses.replace(strands, colour=np.tile(np.float32(colour), (40_000, 1)))
            for colour in ([0.1, 0.06, 0.04], [0.6, 0.1, 0.05])
        )
        before = drawn(brown)
        hair = renderer._strands.hair
        recoloured = drawn(red)
        assert renderer._strands.hair is hair
        renderer._strands.hair = None
        np.testing.assert_array_equal(drawn(red), recoloured)
        assert np.abs(recoloured - before).max() > 20

    def test_points_are_left_out_where_nobody_sees_it(self, renderer: Renderer, egg: Head) -> None:
        strands = fur(200, points=17)
        renderer.render(Stage(egg, strands=strands), Look(), self.camera, (64, 64))
        assert renderer._strands.hair is not None
        assert renderer._strands.hair.sparse
        assert thinned(strands, 2).counts.tolist() == [9] * 200
        np.testing.assert_array_equal(thinned(strands, 2).points[8::9], strands.points[16::17])

    def test_what_is_left_out_is_counted_in(self) -> None:
        along = np.linspace(0.0, 1.0, 17)
        helix = np.stack([np.cos(2 * np.pi * along), np.sin(2 * np.pi * along), 0 * along], axis=1)
        curl = StrandSurvey(Strands(helix.astype(np.float32), np.array([0, 17])))
        # Chords of a circle: 16 of them against 4.
        assert curl.shortening(4) == pytest.approx(16 * np.sin(np.pi / 16) / (4 * np.sin(np.pi / 4)), rel=1e-5)
        assert curl.straight_for == 1
        straight = StrandSurvey(Strands(np.outer(along, [0.0, 0.0, 0.1]).astype(np.float32), np.array([0, 17])))
        assert straight.shortening(8) == pytest.approx(1.0)
        assert straight.straight_for == 8

    def test_final_picture_stops(self, renderer: Renderer, egg: Head) -> None:
        done: list[int] = []
        stopped = renderer.render_final(
            self.stage(egg), Look(), self.camera, (64, 64), lambda step, of: bool(done.append(step)) or step < 2
        )
        assert stopped is None
        assert done == [1, 2]
        assert renderer.render(self.stage(egg), Look(), self.camera, (64, 64)) is not None

    @pytest.mark.parametrize("model", ["fibre", "kajiya-kay"])
    def test_strands_have_their_own_colours(self, renderer: Renderer, egg: Head, model: str) -> None:
        red = np.tile(np.float32([0.5, 0.04, 0.02]), (40_000, 1))
        look = Look(shadow_size=256, strand_model=model)
        renderer.render(self.stage(egg, colour=red), look, self.camera, (96, 96))
        reddish = renderer.read_pixels()[20:40, 10:25].mean(axis=(0, 1))
        renderer.render(self.stage(egg, colour=red[:, ::-1].copy()), look, self.camera, (96, 96))
        blueish = renderer.read_pixels()[20:40, 10:25].mean(axis=(0, 1))
        assert reddish[0] > 1.3 * reddish[2]
        assert blueish[2] > 1.3 * blueish[0]

    def test_nothing_is_left_of_shaved_hair(self, renderer: Renderer, egg: Head) -> None:
        renderer.render(Stage(egg), Look(), self.camera, (64, 64))
        bald = renderer.read_pixels()
        renderer.render(self.stage(egg), Look(), self.camera, (64, 64))
        assert (renderer.read_pixels() != bald).any()
        empty = Strands(np.zeros((0, 3), np.float32), np.zeros(1, np.int64))
        renderer.render(Stage(egg, strands=empty), Look(), self.camera, (64, 64))
        np.testing.assert_array_equal(renderer.read_pixels(), bald)
