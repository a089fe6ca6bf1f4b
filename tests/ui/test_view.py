"""Looking around: orbit, pan, zoom, the framing keys, and what of it is kept."""

import math

import numpy as np
import pytest
from imgui_bundle import imgui
from scipy.spatial.transform import Rotation

from headstudio.app import navigation
from headstudio.app.picking import View, pick_head
from headstudio.head.frame import HeadFrame
from headstudio.scene.settings import Camera


def corner(driver):
    """A point of the viewport beside the head."""
    return driver.rect("Viewport").at(0.08, 0.8)


def test_dragging_beside_the_head_orbits(driver):
    before = driver.studio.document.camera
    x, y = corner(driver)
    driver.drag((x, y), (x + 100, y + 30))
    after = driver.studio.document.camera
    assert after.azimuth < before.azimuth
    assert after.elevation > before.elevation
    assert after.distance == before.distance


def test_alt_orbits_on_the_head_as_well(driver):
    before = driver.studio.document.camera
    x, y = driver.rect("Viewport").centre
    driver.drag((x, y), (x + 60, y), keys=(imgui.Key.mod_alt,))
    assert driver.studio.document.camera.azimuth != before.azimuth


@pytest.mark.parametrize(("button", "keys"), [(2, ()), (0, (imgui.Key.mod_shift,))])
def test_the_middle_button_and_shift_pan(driver, button, keys):
    x, y = corner(driver)
    driver.drag((x, y), (x + 80, y), button=button, keys=keys)
    camera = driver.studio.document.camera
    assert navigation.target(camera) @ navigation.axes(camera)[0] < -0.01


def test_the_wheel_zooms(driver):
    driver.wheel(corner(driver), 3)
    assert driver.studio.document.camera.distance == pytest.approx(1 / navigation.ZOOM_RATE**3)


def test_looking_around_is_no_change_of_the_work_and_has_its_own_way_back(driver):
    driver.studio.set("lcp.gravity", 5.0, "Gravity")
    driver.studio.undo()
    start = driver.studio.document.camera
    x, y = corner(driver)
    driver.drag((x, y), (x + 100, y))
    assert not driver.studio.work.modified
    driver.key(imgui.Key.mod_ctrl, imgui.Key.y)
    assert driver.studio.document.lcp.gravity == 5.0, "a glance costs no redo"
    driver.key(imgui.Key.left_bracket)
    assert driver.studio.document.camera == start
    driver.key(imgui.Key.right_bracket)
    assert driver.studio.document.camera != start


@pytest.mark.parametrize(
    ("key", "azimuth", "elevation"),
    [("_1", 0, 0), ("_3", 90, 0), ("_9", 180, 0), ("_7", 0, 89)],
)
def test_keys_look_from_the_sides(driver, key, azimuth, elevation):
    driver.key(imgui.Key[key])
    camera = driver.studio.document.camera
    assert (math.degrees(camera.azimuth), math.degrees(camera.elevation)) == pytest.approx((azimuth, elevation))


def test_f_shows_head_and_hair_in_full(driver):
    driver.wheel(corner(driver), 12)
    driver.key(imgui.Key.f)
    stage, view = driver.studio.stage, driver.app.viewport.view
    for points in (stage.head.skin.vertices, stage.hair.positions):
        shown = view.project(points)
        assert (shown >= -1).all()
        assert (shown <= [view.width + 1, view.height + 1]).all()
    driver.key(imgui.Key.h)
    assert driver.app.viewport.view.camera.distance < view.camera.distance


def test_the_picture_is_drawn_again_only_when_something_changes(driver, monkeypatch):
    drawn = []
    render = driver.app.viewport.renderer.render
    monkeypatch.setattr(
        driver.app.viewport.renderer, "render", lambda *args, **more: drawn.append(args) or render(*args, **more)
    )
    driver.frames(5)
    assert drawn == []
    driver.studio.set("look.ambient", 1.0, "Ambient")
    driver.frames(5)
    assert len(drawn) == 1


def test_rays_and_points_of_the_picture_are_inverse():
    view = View(Camera(azimuth=0.7, elevation=-0.4, distance=0.8), 640, 480)
    points = np.random.default_rng(0).normal(0, 0.1, (20, 3))
    for point, (x, y) in zip(points, view.project(points)):
        ray = view.ray(x, y)
        along = (point - ray.origin) @ ray.direction
        assert ray.at(along) == pytest.approx(point, abs=1e-9)


def test_a_ray_finds_the_near_side_of_a_turned_and_moved_head(driver):
    head = driver.studio.stage.head
    frame = HeadFrame(Rotation.from_euler("y", 0.5), np.array([0.1, 0.0, 0.0]))
    nose = frame.to_world(head.landmarks.nose_tip[None])[0]
    view = View(Camera(azimuth=0.5), 400, 400)
    x, y = view.project(nose[None])[0]
    hit = pick_head(head, view.ray(x, y), frame)
    assert hit.point == pytest.approx(head.landmarks.nose_tip, abs=2e-3)
    assert pick_head(head, view.ray(2, 2), frame) is None


def test_pan_follows_the_mouse_and_zoom_stays_in_range():
    camera = Camera(azimuth=1.0, elevation=0.3)
    view = View(camera, 500, 500)
    centre = navigation.target(camera)[None]
    moved = View(navigation.pan(camera, 0.2, -0.1), 500, 500)
    assert moved.project(centre)[0] == pytest.approx(view.project(centre)[0] + [100, -50], abs=1e-6)
    assert navigation.zoom(camera, 500).distance == pytest.approx(0.05)
    assert navigation.orbit(camera, 0, 50).elevation == pytest.approx(math.radians(89))


def test_what_stands_still_is_drawn_in_full_and_not_again_while_time_runs(driver):
    studio, viewport = driver.studio, driver.app.viewport
    studio.work.hair_as = "none"
    driver.built()
    viewport._resolution = 2
    studio.playback.playing = True
    driver.frames(2)
    studio.set("motion.kind", "nod", "Nod")
    driver.frames(3)
    moving = viewport._drawn
    assert moving.size[0] <= 0.5 * viewport.rect.width * driver.app.window.pixels_per_unit
    studio.set("motion.kind", "rest", "Rest")
    driver.frames(150)
    still = viewport._drawn
    assert still.size[0] >= 2 * moving.size[0]
    driver.frames(10)
    assert viewport._drawn is still
    assert studio.playback.playing
