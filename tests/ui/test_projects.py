"""New, open, save: by menu, by key and by dropping a file; nothing is lost by accident."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui
from PIL import Image

from headstudio.scene.document import Document
from headstudio.scene.project import load_project, save_project
from headstudio.scene.recent import recent_projects

from .conftest import SMALL, assign

CTRL = imgui.Key.mod_ctrl


@pytest.fixture
def project(tmp_path: Path) -> Path:
    path = tmp_path / "stored.headstudio"
    save_project(assign(Document(), SMALL | {"lcp.gravity": 4.0, "camera.distance": 2.0}), path)
    return path


def answer(driver, title: str, path: Path, verb: str) -> None:
    """Type a path into the file dialog and agree."""
    driver.frames(2)
    driver.click(f"{title}/Name")
    driver.key(CTRL, imgui.Key.a)
    driver.type(str(path))
    driver.click(f"{title}/{verb}")
    driver.frames(2)


def test_save_as_and_open_by_menu(driver, tmp_path):
    driver.studio.set("lcp.gravity", 2.0, "Gravity")
    driver.menu("File", "Save as...")
    answer(driver, "Save the project", tmp_path / "mine", "Save")
    path = tmp_path / "mine.headstudio"
    assert load_project(path).document == driver.studio.document
    assert not driver.studio.work.modified
    driver.menu("File", "New")
    driver.frames(2)
    assert driver.studio.document.lcp.gravity == Document().lcp.gravity
    driver.menu("File", "Open...")
    answer(driver, "Open a project", path, "Open")
    assert driver.studio.document.lcp.gravity == 2.0
    assert driver.studio.work.path == path
    assert recent_projects()[0] == path


def test_ctrl_s_writes_where_it_came_from_with_the_view(driver, project):
    assert driver.studio.open(project)
    driver.studio.set("lcp.gravity", 7.0, "Gravity")
    driver.wheel(driver.rect("Viewport").at(0.9, 0.5), 2)
    driver.key(CTRL, imgui.Key.s)
    stored = load_project(project).document
    assert stored.lcp.gravity == 7.0
    assert stored.camera.distance < 2.0
    assert any("Saved" in text for text in driver.messages())


@pytest.mark.parametrize(("choice", "goes_on", "kept"), [("Discard", True, 9.81), ("Cancel", False, 3.0)])
def test_unsaved_changes_are_asked_for(driver, choice, goes_on, kept):
    driver.studio.set("lcp.gravity", 3.0, "Gravity")
    driver.key(CTRL, imgui.Key.n)
    driver.frames(2)
    assert driver.studio.document.lcp.gravity == 3.0, "nothing happens before the answer"
    driver.click(f"Unsaved changes/{choice}")
    driver.frames(2)
    assert driver.studio.document.lcp.gravity == kept
    assert driver.studio.work.modified is not goes_on


def test_saving_first_goes_on_afterwards(driver, project):
    driver.studio.open(project)
    driver.studio.set("lcp.gravity", 3.0, "Gravity")
    driver.key(CTRL, imgui.Key.n)
    driver.frames(2)
    driver.click("Unsaved changes/Save")
    driver.frames(2)
    assert load_project(project).document.lcp.gravity == 3.0
    assert driver.studio.work.path is None


def test_closing_the_window_asks_as_well(driver):
    driver.studio.set("lcp.gravity", 3.0, "Gravity")
    driver.key(CTRL, imgui.Key.q)
    driver.frames(2)
    assert not driver.app.closed
    driver.click("Unsaved changes/Cancel")
    assert not driver.app.closed
    driver.key(CTRL, imgui.Key.z)
    driver.key(CTRL, imgui.Key.q)
    assert driver.app.closed
    driver.app.closed = False


@pytest.mark.parametrize("content", [b"", b"not a zip", b"PK\x03\x04 half a zip"])
def test_a_bad_file_is_one_line_and_changes_nothing(driver, tmp_path, content):
    path = tmp_path / "bad.headstudio"
    path.write_bytes(content)
    before = driver.studio.document
    assert not driver.studio.open(path)
    (text,) = driver.messages()
    assert "bad.headstudio" in text
    assert "\n" not in text
    assert driver.studio.document == before
    assert driver.studio.work.path is None


def test_a_folder_that_cannot_be_written_is_a_message(driver):
    driver.studio.set("lcp.gravity", 3.0, "Gravity")
    assert not driver.studio.save(Path("/proc/nowhere/x.headstudio"))
    assert driver.studio.work.modified
    assert driver.studio.messages.log[-1].kind == "error"


def test_files_can_be_dropped_on_the_window(driver, project, tmp_path):
    driver.app.window.on_drop([project])
    assert driver.studio.document.lcp.gravity == 4.0
    driver.app.window.on_drop([tmp_path / "picture.gif"])
    assert any("neither a project nor a head" in text for text in driver.messages())


def test_the_picture_is_exported(driver, tmp_path):
    driver.key(CTRL, imgui.Key.e)
    answer(driver, "Export the picture", tmp_path / "out.png", "Save")
    picture = np.asarray(Image.open(tmp_path / "out.png"))
    rect = driver.rect("Viewport")
    assert picture.shape == (int(rect.height), int(rect.width), 3)
    assert picture.std() > 10


def test_replacing_a_file_takes_a_second_word(driver, project):
    before = project.read_bytes()
    driver.key(CTRL, imgui.Key.mod_shift, imgui.Key.s)
    answer(driver, "Save the project", project, "Save")
    assert project.read_bytes() == before
    driver.click("Save the project/Save")
    driver.frames(2)
    assert project.read_bytes() != before


def test_the_file_dialog_says_what_is_not_there(driver, tmp_path):
    driver.key(CTRL, imgui.Key.o)
    answer(driver, "Open a project", tmp_path / "nothing.headstudio", "Open")
    assert driver.app.dialogs.asking
    driver.click("Open a project/Cancel")
    driver.frames(2)
    assert not driver.app.dialogs.asking


def test_keys_are_listed_and_none_is_taken_twice(driver):
    keys = [key for command in driver.app.commands for key in command.keys.split()]
    assert len(keys) == len(set(keys))
    driver.key(imgui.Key.f1)
    driver.frames(2)
    assert driver.app.dialogs.asking
    driver.click("Keys and mouse/Close")
    assert not driver.app.dialogs.asking


@pytest.mark.parametrize(
    "broken",
    [{"head.source": "/nowhere/anna.obj"}, {"head.source": "mannequin", "hair.length": 0.2}],
    ids=["a head that is gone", "curves that cannot be used"],
)
def test_a_project_that_cannot_be_built_opens_with_a_stand_in(driver, tmp_path, broken):
    document = assign(Document(), SMALL | broken)
    if "hair.length" in broken:
        curves = tuple(((0.0, 0.0, z), (0.0, 0.1, z)) for z in (0.5, 0.6, 0.7, 0.8))
        document = replace(document, scalp=replace(document.scalp, curves=curves))
    path = tmp_path / "broken.headstudio"
    save_project(document, path)
    assert driver.studio.open(path)
    driver.built()
    assert driver.studio.document.head.source == "mannequin"
    assert driver.studio.document.hair == document.hair
    errors = [message for message in driver.studio.messages.log if message.kind == "error"]
    assert [message.times for message in errors] == [1]
    driver.frames(5)
    assert not driver.studio.building
