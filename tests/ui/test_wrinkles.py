"""The editor of wrinkles: its tab, expressions over time, and files."""

import json

import numpy as np
import pytest

from headstudio.app.application import EDITORS
from headstudio.app.wrinkles import face_files
from headstudio.params import assign
from headstudio.scene.animation import needs

from .test_projects import answer
from .wrinkle_scenes import FURROWS, SMALL, furrows_of, head_canvas, on_screen


def test_the_tab_brings_the_skin_to_life_and_leaves_hair_and_history_alone(driver):
    work = driver.studio.work
    assert (work.document.look.hair_as, work.document.look.skin_as) == ("particles", "resting")
    work.history.reopen(assign(driver.studio.document, SMALL))
    driver.click("Editors/Wrinkles")
    assert (work.document.look.hair_as, work.document.look.skin_as) == ("particles", "living")
    assert work.history.undo_label is None
    assert not work.modified
    driver.click("Editors/Hair")
    assert work.document.look.skin_as == "living", "hair is combed on a living face"


def test_a_cancelled_build_returns_to_the_tab_before(driver):
    driver.studio.work.history.reopen(assign(driver.studio.document, SMALL | {"wrinkle.breadth": 1.21}))
    driver.click("Editors/Wrinkles")
    assert driver.studio.building
    driver.studio.cancel_build()
    driver.frames(2)
    assert driver.app.editor is EDITORS[0]
    assert driver.studio.document.look.skin_as == "resting"


def test_hair_goes_on_while_the_skin_is_made_anew(face):
    studio = face.studio
    studio.work.hair_as = "particles"
    face.built()
    studio.playback.playing = True
    face.frames(30)
    studio.playback.playing = False
    face.frames()
    time, simulation = studio.time, studio.grown.animation.simulation
    positions = studio.stage.hair.positions
    studio.set("wrinkle.strength", 1.5, "Strength")
    face.built()
    assert studio.time == time > 0
    assert studio.grown.animation.simulation is simulation
    np.testing.assert_array_equal(studio.stage.hair.positions, positions)


def test_a_slider_of_the_face_is_seen_in_every_frame_and_builds_nothing(face):
    studio = face.studio
    grown, rest = studio.grown, studio.stage.skin.skin.positions
    x, y = face.rect("Expression/Smile").at(0.05, 0.5)
    face.move(x, y)
    face.press()
    seen = []
    for k in range(4):
        face.move(x + 20 * (k + 1), y)
        assert not studio.building
        seen.append(np.abs(studio.stage.skin.skin.positions - rest).max())
    face.release()
    face.frames()
    assert seen == sorted(seen)
    assert seen[0] < seen[-1]
    assert seen[-1] > 1e-3
    assert studio.grown is grown
    assert studio.work.history.undo_label == "Expression"
    studio.undo()
    face.frames(2)
    np.testing.assert_array_equal(studio.stage.skin.skin.positions, rest)


def test_a_face_by_one_click_its_mirror_image_and_back(face):
    studio = face.studio
    face.click("Faces/Angry")
    assert (studio.document.face.angry, studio.document.face.smile) == (1.0, 0.0)
    face.click("Faces/Smiling")
    assert (studio.document.face.angry, studio.document.face.smile) == (0.0, 1.0)
    studio.set("face.blink_left", 0.6, "Blink")
    face.click("Faces/Swap sides")
    assert (studio.document.face.blink_left, studio.document.face.blink_right) == (0.0, 0.6)
    face.click("Faces/Neutral")
    assert studio.document.face == type(studio.document.face)()
    for label in ("Neutral", "Swap sides of the face", "Blink", "Smiling", "Angry"):
        assert studio.work.history.undo_label == label
        studio.undo()
    assert not studio.work.modified


def test_depth_follows_the_drag_and_leaves_the_bed_alone(face):
    studio = face.studio
    face.click_at(on_screen(head_canvas(face), FURROWS[0].chain.at(1.3))[0])
    bed, depth = studio.grown.animation.skin.surface.bed, furrows_of(face)[0].depth
    x, y = face.rect("Furrow/Depth").at(0.3, 0.5)
    face.move(x, y)
    face.press()
    face.move(x + 30, y)
    face.until(lambda: studio.grown.document.wrinkle.furrows[0].depth != depth)
    assert studio.work.in_gesture, "it is seen before the mouse is let go"
    assert studio.grown.animation.skin.surface.bed is bed
    face.release()
    face.built()
    studio.undo()
    assert furrows_of(face) == FURROWS


def test_keyframes_are_added_moved_played_and_deleted(face):
    studio, keys = face.studio, face.rect("Timeline/Keys")
    face.click("Timeline/Add key")
    face.click_at(keys.at(0.5, 0.3))
    face.click("Faces/Surprised")
    first, second = studio.document.face.performance
    assert (first.time, dict(first.weights)["surprise"], dict(second.weights)["surprise"]) == (0.0, 0.0, 1.0)
    assert second.time == pytest.approx(studio.face_time)
    start = face.rect("Timeline/Key 2").centre
    face.drag(start, (keys.at(0.25, 0.3)[0], start[1]))
    earlier = studio.document.face.performance[1].time
    assert earlier == pytest.approx(second.time / 2, rel=0.1)
    assert studio.work.history.undo_label == "Move keyframe"
    face.click("Transport/Reset")
    rest = studio.stage.skin.posed
    studio.playback.playing = True
    face.until(lambda: studio.face_time > earlier)
    studio.playback.playing = False
    face.frames()
    assert np.abs(studio.stage.skin.posed - rest).max() > 1e-3
    face.click_at(face.rect("Timeline/Key 2").centre)
    face.click("Timeline/Delete key")
    assert len(studio.document.face.performance) == 1
    for _ in range(4):
        studio.undo()
    assert studio.document.face.performance == ()


def test_furrows_go_out_and_in_again(face, tmp_path):
    face.menu("File", "Export furrows...")
    answer(face, "Export furrows", tmp_path / "set", "Save")
    assert len(json.loads((tmp_path / "set.json").read_text())) == 3
    face.click("Furrows/Old")
    face.menu("File", "Import furrows...")
    answer(face, "Import furrows", tmp_path / "set.json", "Open")
    assert furrows_of(face) == FURROWS
    assert face.studio.work.history.undo_label == "Import furrows"
    (tmp_path / "torn.json").write_text("[{")
    face.app.actions.face_files.load_furrows(tmp_path / "torn.json")
    assert face.messages()[-1] == "torn.json is no furrow set"
    assert furrows_of(face) == FURROWS


def test_mesh_and_maps_are_written_while_the_window_goes_on(face, tmp_path, monkeypatch):
    monkeypatch.setattr(face_files, "MAP_SIZE", 96)
    files = face.app.actions.face_files
    face.click("Faces/Angry")
    files.save_mesh(tmp_path / "angry.ply")
    face.until(lambda: not face.studio.chores.busy)
    assert (tmp_path / "angry.ply").stat().st_size > 100_000
    face.frames()
    assert face.messages()[-1].startswith("Wrote")
    files.save_maps(tmp_path / "maps")
    face.until(lambda: not face.studio.chores.busy)
    assert {"height.png", "weight-angry.png"} <= {path.name for path in (tmp_path / "maps").iterdir()}
    files.save_maps(tmp_path / "angry.ply")
    face.until(lambda: not face.studio.chores.busy)
    face.frames()
    assert "angry.ply" in face.messages()[-1]
    assert face.studio.messages.log[-1].kind == "error"


def test_needs_tell_creases_from_the_face(face):
    document = face.studio.document
    assert needs(assign(document, {"face.smile": 0.5, "skin.melanin": 0.2})) == needs(document)
    assert needs(assign(document, {"wrinkle.strength": 0.5})) != needs(document)


@pytest.mark.parametrize("shows", ["expansion", "shrinkage", "amplitude", "height"])
def test_colours_on_the_skin_are_explained(face, shows):
    assert not face.shown("Scale")
    face.studio.set("look.skin_shows", shows, "Skin shows")
    face.frames(2)
    view, scale = face.rect("Viewport"), face.rect("Scale")
    assert view.x < scale.x
    assert scale.y + scale.height < view.y + view.height


def test_the_border_of_the_smooth_side_is_dragged_as_one_change(face):
    assert not face.shown("Split line")
    face.studio.set("look.split", 0.4, "Split")
    face.frames(2)
    view, (x, y) = face.rect("Viewport"), face.rect("Split line").centre
    assert x == pytest.approx(view.x + 0.4 * view.width, abs=1)
    camera = face.studio.document.camera
    face.drag((x, y), (view.x + 0.7 * view.width, y))
    assert face.studio.document.look.split == pytest.approx(0.7, abs=0.01)
    assert face.studio.document.camera == camera
    face.studio.undo()
    assert face.studio.document.look.split == 0.4
