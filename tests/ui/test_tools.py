"""The tools of the viewport."""

import numpy as np
import pytest
from imgui_bundle import imgui


def on_screen(driver, point):
    """Where a point of the head [m], (3,), is in the window."""
    viewport = driver.app.viewport
    x, y = viewport.view.project(viewport.frame.to_world(np.asarray(point)[None]))[0]
    return viewport.rect.x + x, viewport.rect.y + y


@pytest.fixture
def tool(driver):
    """Take a tool in the hand, and put the first one back afterwards."""
    yield lambda name: driver.click(f"Tools/{name}")
    driver.app.viewport.tool = driver.app._tools["Hair"][0]


def test_dragging_the_head_shakes_it_and_it_comes_home(driver):
    driver.key(imgui.Key["_1"])
    x, y = on_screen(driver, driver.studio.stage.head.landmarks.nose_tip)
    driver.drag((x, y), (x + 90, y), steps=20, release=False)
    driver.frames(15)
    turned = driver.studio.stage.frame.rotation.as_rotvec()
    assert turned[1] > 0.2, "the nose follows the mouse"
    assert not driver.studio.work.modified, "shaking is no change of the work"
    driver.release()
    driver.frames(90)
    assert driver.studio.stage.frame.rotation.magnitude() < 0.02


def test_ctrl_moves_the_bust(driver):
    driver.key(imgui.Key["_1"])
    start = on_screen(driver, driver.studio.stage.head.landmarks.nose_tip)
    driver.drag(start, (start[0] + 80, start[1]), keys=(imgui.Key.mod_ctrl,), steps=20, release=False)
    driver.frames(20)
    moved = driver.studio.stage.frame.translation
    driver.release()
    assert moved[0] > 0.02
    assert abs(moved[1]) < 0.01


def test_hair_is_held_apart_and_let_go(driver, tool):
    tool("Part")
    driver.click("Tools/Hold apart")
    assert driver.studio.grown.animation.simulation.parting is not None
    assert driver.studio.playback.playing
    driver.click("Tools/Let go")
    assert driver.studio.grown.animation.simulation.parting is None
    driver.drag(
        on_screen(driver, driver.studio.stage.head.landmarks.crown), driver.rect("Viewport").centre, release=False
    )
    assert driver.studio.grown.animation.simulation.parting is not None
    driver.release()
    driver.frames()
    assert driver.studio.grown.animation.simulation.parting is None


def test_the_whorl_is_placed_by_a_click_as_one_change(driver, tool):
    tool("Whorl")
    driver.key(imgui.Key["_7"])
    before = driver.studio.document.scalp
    scalp = driver.studio.grown.animation.scalp
    wanted = np.array([[0.42, 0.3]])
    driver.click_at(on_screen(driver, scalp.points(wanted)[0]))
    driver.built()
    after = driver.studio.document.scalp
    assert (after.whorl_u, after.whorl_v) == pytest.approx(tuple(wanted[0]), abs=0.03)
    driver.studio.undo()
    assert driver.studio.document.scalp == before


def test_a_handle_of_the_scalp_is_dragged_along_the_skin(driver, tool):
    tool("Scalp")
    driver.key(imgui.Key["_1"])
    head = driver.studio.grown.animation.head
    x, y = on_screen(driver, head.landmarks.hairline)
    driver.drag((x, y), (x, y - 12))
    driver.built()
    curves = driver.studio.document.scalp.curves
    points = np.concatenate([np.array(curve) for curve in curves])
    nearest = np.linalg.norm(points - head.landmarks.hairline, axis=1).min()
    assert 0.003 < nearest < 0.03
    for one, other in zip(curves, curves[1:] + curves[:1]):
        assert one[-1] == other[0], "neighbours share their ends"
    assert driver.studio.work.history.undo_label == "Scalp curve"
    driver.click("Tools/Default curves")
    assert driver.studio.document.scalp.curves == ()
    driver.studio.undo()
    driver.studio.undo()
    assert driver.studio.document.scalp.curves == ()
    assert not driver.studio.work.modified


def test_a_press_beside_the_head_is_for_the_camera(driver, tool):
    for name in ("Part", "Scalp", "Whorl"):
        tool(name)
        before = driver.studio.document.camera
        x, y = driver.rect("Viewport").at(0.06, 0.9)
        driver.drag((x, y), (x + 50, y))
        assert driver.studio.document.camera != before, name
