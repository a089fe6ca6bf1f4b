"""Panels made from the declarations: every change is one entry of the history, and nothing bad gets in."""

import math

import pytest
from imgui_bundle import imgui

from headstudio.params import parameters_of, walk
from headstudio.scene.document import Document

CTRL = imgui.Key.mod_ctrl


def test_dragging_a_slider_is_one_change_and_undo_takes_it_back(driver):
    before = driver.studio.document
    rect = driver.rect("Dynamics/Gravity")
    driver.drag(rect.at(0.33, 0.5), rect.at(0.7, 0.5))
    after = driver.studio.document
    assert after.lcp.gravity == pytest.approx(0.7 * parameters_of(before.lcp)["gravity"].high, abs=1.0)
    driver.key(CTRL, imgui.Key.z)
    assert driver.studio.document == before
    driver.key(CTRL, imgui.Key.y)
    assert driver.studio.document == after


def test_every_parameter_of_the_open_panels_has_a_widget(driver):
    for panel in driver.app.editor.panels:
        if not panel.opened:
            continue
        for path, declared, _ in walk(getattr(Document(), panel.part)):
            if path not in panel.elsewhere:
                assert driver.shown(f"{panel.title}/{declared.label}"), path


def test_lengths_are_shown_in_centimetres_and_typed_in_them(driver):
    driver.click("Hair/Length", keys=(CTRL,))
    driver.type("25")
    driver.key(imgui.Key.enter)
    assert driver.studio.document.hair.length == pytest.approx(0.25)


def test_a_typed_value_out_of_range_is_taken_as_the_nearest_and_said(driver):
    driver.click("Hair/Length", keys=(CTRL,))
    driver.type("900")
    driver.key(imgui.Key.enter)
    driver.frames(2)
    declared = parameters_of(Document().hair)["length"]
    assert driver.studio.document.hair.length == declared.high
    bounds = f"from {100 * declared.low:.1f} cm to {100 * declared.high:.1f} cm"
    assert any(f"Length goes {bounds}" in text for text in driver.messages())
    driver.key(CTRL, imgui.Key.z)
    assert driver.studio.document.hair.length == Document().hair.length


def test_typing_is_one_change_and_letters_are_no_keys_of_the_scene(driver):
    driver.click("Head/Head")
    driver.key(CTRL, imgui.Key.a)
    camera = driver.studio.document.camera
    driver.type("no such head.obj")
    driver.key(imgui.Key.f)
    driver.key(imgui.Key.enter)
    driver.until(lambda: any("no such head.obj" in text for text in driver.messages()))
    assert driver.studio.document.camera == camera
    assert driver.studio.document.head.source == "mannequin", "the last good head stays"
    assert driver.studio.stage is not None


def test_right_click_goes_back_to_the_default(driver):
    driver.studio.set("lcp.gravity", 3.0, "Gravity")
    driver.frames(2)
    driver.click("Dynamics/Gravity", button=1)
    assert driver.studio.document.lcp.gravity == Document().lcp.gravity


def test_a_logarithmic_slider_has_its_ends_where_they_are_declared(driver):
    rect = driver.rect("Dynamics/Elastic modulus")
    driver.drag(rect.at(0.5, 0.5), rect.at(1.2, 0.5))
    declared = parameters_of(Document().lcp)["elastic_modulus"]
    assert driver.studio.document.lcp.elastic_modulus == declared.high
    driver.drag(rect.at(0.95, 0.5), rect.at(-0.2, 0.5))
    assert driver.studio.document.lcp.elastic_modulus == declared.low


def test_a_choice_is_one_change(driver):
    driver.click("Scalp/Length map")
    driver.key(imgui.Key.down_arrow)
    driver.key(imgui.Key.enter)
    changed = driver.studio.document.scalp.length_map
    assert changed != "fringe"
    assert driver.studio.work.history.undo_label == "Length map"


def test_ticks_and_buttons_change_the_document(driver):
    driver.click("Show/Springs")
    driver.click("Wind/Blow")
    driver.click("Motion/Nod")
    document = driver.studio.document
    assert (document.look.show_links, document.wind.on, document.motion.kind) == (True, True, "nod")
    for _ in range(3):
        driver.key(CTRL, imgui.Key.z)
    document = driver.studio.document
    assert (document.look.show_links, document.wind.on, document.motion.kind) == (False, False, "rest")


def test_the_compass_turns_the_wind(driver):
    rect = driver.rect("Wind/Compass")
    driver.drag(rect.at(0.9, 0.5), rect.at(0.5, 0.95))
    assert driver.studio.document.wind.heading == pytest.approx(0.0, abs=0.05)
    driver.key(CTRL, imgui.Key.z)
    assert driver.studio.document.wind.heading == pytest.approx(math.pi / 2)


def test_the_search_narrows_the_panels(driver):
    driver.click("Search")
    driver.type("friction")
    assert driver.shown("Dynamics/Air friction")
    assert not driver.shown("Hair/Length")
    driver.key(CTRL, imgui.Key.a)
    driver.key(imgui.Key.backspace)
    driver.key(imgui.Key.escape)
    driver.app.rows.wanted = ""


def test_camera_sliders_belong_to_the_view(driver):
    driver.click("Camera")
    driver.studio.work.set("camera.distance", 2.0, "Distance")
    driver.frames(2)
    assert not driver.studio.work.modified
    driver.key(imgui.Key.left_bracket)
    assert driver.studio.document.camera.distance == 1.0
    driver.click("Camera")
