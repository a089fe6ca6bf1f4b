"""The editor of hairstyles: its tab, its seven steps, and its tools in the view."""

import dataclasses
from itertools import pairwise

import numpy as np
import pytest
from imgui_bundle import imgui
from scipy.spatial import cKDTree

from headstudio.app.application import EDITORS
from headstudio.head.scalp_settings import GrayImage
from headstudio.io.hair import read_strands, write_strands
from headstudio.params import assign
from headstudio.scene.styles import PARTS, load_style
from headstudio.wisp.maps import length_map
from headstudio.wisp.operations import Constrain, Tie, ToPoint
from headstudio.wisp.proportions import Proportions
from headstudio.wisp.sample_strand import sample_strand
from headstudio.wisp.selection import Selection

CTRL, SHIFT = imgui.Key.mod_ctrl, imgui.Key.mod_shift
SMALL = {
    "wisp.strands": 500,
    "wisp.wisps": 40,
    "wisp.points": 8,
    "wisp.segments": 10,
    "look.strands_shown": 500,
    "look.shadows": False,
}
SECTIONS = ("Styles", "1 Maps", "2 Global", "3 Prototype")


@pytest.fixture
def wisps(driver):
    """A small hairstyle at rest in its tab; the particles' tab is opened again afterwards."""
    studio = driver.studio
    studio.work.history.reopen(assign(studio.document, SMALL))
    studio.chosen = None
    driver.click("Editors/Wisps")
    driver.key(imgui.Key["_1"])
    driver.built()
    yield driver
    studio.work.history.end_gesture()
    driver.app.open_editor(EDITORS[0])


@pytest.fixture
def opened(wisps):
    """A section of the right side, all others folded, as long as the test runs."""
    turned = []

    def turn(*sections):
        for section in sections:
            wisps.click(section)
            wisps.frames()

    def open_only(section):
        turned.extend(name for name in SECTIONS if name != section)
        if section not in SECTIONS:
            turned.append(section)
        turn(*turned)

    yield open_only
    turn(*reversed(turned))


def entries(driver):
    """How many changes could be undone."""
    return len(driver.studio.work.history._past)


def on_screen(driver, point):
    """Where a point of the head [m], (3,), is in the window."""
    viewport = driver.app.viewport
    x, y = viewport.view.project(viewport.frame.to_world(np.asarray(point)[None]))[0]
    return viewport.rect.x + x, viewport.rect.y + y


def on_scalp(driver, u, v):
    """Where a point of the scalp square is in the window."""
    return on_screen(driver, driver.studio.grown.animation.scalp.points(np.array([[u, v]]))[0])


def proportions(driver):
    return Proportions.of(driver.studio.grown.animation.head.landmarks)


def test_opening_a_tab_shows_its_hair_and_is_no_change(wisps):
    assert wisps.studio.grown.animation.hairdo is not None
    assert entries(wisps) == 0
    assert not wisps.studio.work.modified
    wisps.studio.set("wisp.fuzziness", 0.5, "Fuzziness")
    wisps.click("Editors/Hair")
    wisps.studio.undo()
    wisps.built()
    assert wisps.studio.grown.animation.simulation is not None, "undo does not turn the page"
    assert wisps.studio.document.wisp.fuzziness != 0.5


def test_a_project_opens_the_tab_that_it_was_saved_in(wisps, tmp_path):
    wisps.studio.save(tmp_path / "style.headstudio")
    wisps.click("Editors/Hair")
    wisps.studio.open(tmp_path / "style.headstudio")
    wisps.built()
    assert wisps.app.editor.label == "Wisps"
    assert wisps.studio.grown.animation.hairdo is not None


def test_a_drag_shows_its_result_before_it_ends(wisps, opened):
    opened("2 Global")
    rect = wisps.rect("2 Global/Wisps")
    before = wisps.studio.grown
    wisps.drag(rect.at(0.5, 0.5), rect.at(0.3, 0.5), release=False)
    wisps.until(lambda: wisps.studio.grown is not before)
    assert wisps.studio.work.in_gesture
    wisps.release()
    wisps.built()
    assert len(wisps.studio.grown.animation.hairdo.outlines.roots) == wisps.studio.document.wisp.wisps < 40
    assert entries(wisps) == 1


def test_hair_that_cannot_be_made_is_said_and_taken_back(wisps):
    document = wisps.studio.document
    broken = dataclasses.replace(document, wisp=dataclasses.replace(document.wisp, radius_curve=((0.5, 1.0),)))
    wisps.studio.work.change(broken, "Radius")
    wisps.until(lambda: any("2 to 64" in text for text in wisps.messages()))
    wisps.built()
    assert wisps.studio.document == document


def test_a_style_is_one_change(wisps, opened):
    opened("Styles")
    before = wisps.studio.document
    wisps.click("Styles/Find a style")
    wisps.type("ponytail")
    wisps.click("Styles/ponytail")
    after = wisps.studio.document
    for part in PARTS:
        assert getattr(after, part) == getattr(load_style("ponytail").hair, part)
    assert after.head == before.head
    assert wisps.studio.work.history.undo_label == "Style Ponytail"
    wisps.click("Styles/Find a style")
    wisps.key(CTRL, imgui.Key.a)
    wisps.key(imgui.Key.backspace)
    wisps.key(imgui.Key.escape)
    wisps.studio.undo()
    assert wisps.studio.document == before
    wisps.built()


def test_a_stroke_of_paint_changes_the_map_on_both_sides_as_one_change(wisps):
    wisps.click("Tools/Length")
    before = length_map(wisps.studio.document.wisp).pixels
    start, end = on_scalp(wisps, 0.7, 0.1), on_scalp(wisps, 0.62, 0.15)
    wisps.drag(start, end, keys=(CTRL,))
    wisps.built()
    lost = before - wisps.studio.document.wisp.painted_lengths.pixels
    assert lost.max() == pytest.approx(wisps.studio.brush.strength, abs=0.05)
    left, right = lost[:, 128:].sum(), lost[:, :128].sum()
    assert left == pytest.approx(right, rel=0.1)
    assert (lost[180:] == 0).all(), "the back of the head keeps its hair"
    assert entries(wisps) == 1
    wisps.studio.undo()
    assert wisps.studio.document.wisp.painted_lengths is None


def test_shift_smooths_on_the_scalp_and_pans_beside_it(wisps):
    wisps.click("Tools/Density")
    noise = np.random.default_rng(0).random((256, 256)).astype(np.float32)
    document = wisps.studio.document
    wisp = dataclasses.replace(document.wisp, painted_density=GrayImage(noise))
    wisps.studio.work.change(dataclasses.replace(document, wisp=wisp), "Noise")
    wisps.built()
    camera = wisps.studio.document.camera
    wisps.drag(on_scalp(wisps, 0.6, 0.1), on_scalp(wisps, 0.4, 0.1), keys=(SHIFT,))
    smooth = wisps.studio.document.wisp.painted_density.pixels
    painted = np.abs(smooth - noise) > 0.15
    assert painted.sum() > 500
    assert smooth[painted].std() < 0.7 * noise[painted].std()
    assert smooth[painted].mean() == pytest.approx(noise[painted].mean(), abs=0.05)
    assert wisps.studio.document.camera == camera
    x, y = wisps.rect("Viewport").at(0.06, 0.9)
    wisps.drag((x, y), (x + 50, y), keys=(SHIFT,))
    moved = wisps.studio.document.camera
    assert (moved.azimuth, moved.elevation) == (camera.azimuth, camera.elevation)
    assert moved.target_x != camera.target_x


def test_a_map_in_the_hand_is_seen_on_the_scalp(wisps):
    stage = wisps.studio.stage
    assert len(wisps.app.viewport.tool.dress(stage).overlays.triangles) == 0
    wisps.studio.set("look.show_hair", False, "Hair")
    wisps.frames(2)
    x, y = (round(at) for at in on_scalp(wisps, 0.5, 0.1))
    plain = wisps.app.window.picture()[y, x].astype(int)
    wisps.click("1 Maps/Paint density")
    tool = wisps.app.viewport.tool
    dressed = tool.dress(wisps.studio.stage)
    assert tool.label == "Density"
    assert len(dressed.overlays.triangles) > 500
    assert tool.dress(wisps.studio.stage) is dressed, "nothing is sent twice"
    wisps.frames(2)
    yellow = wisps.app.window.picture()[y, x].astype(int)
    assert yellow[:2].min() - yellow[2] > plain[:2].min() - plain[2] + 60


def test_a_named_map_takes_the_place_of_the_painted_one(wisps, opened):
    wisps.click("Tools/Protrusion")
    wisps.drag(on_scalp(wisps, 0.5, 0.1), on_scalp(wisps, 0.45, 0.1))
    assert wisps.studio.document.wisp.painted_protrusion is not None
    opened("1 Maps")
    wisps.click("1 Maps/Protrusion map")
    wisps.click("1 Maps/Protrusion map/standing")
    wisp = wisps.studio.document.wisp
    assert (wisp.protrusion_map, wisp.painted_protrusion) == ("standing", None)
    assert entries(wisps) == 2


def test_a_point_of_a_distribution_is_dragged_added_and_taken_away(wisps, opened):
    opened("4 Wisp")
    plot = wisps.rect("4 Wisp/Length curve")
    start = wisps.rect("4 Wisp/Length curve/Point 1").centre
    wisps.drag(start, (start[0] - 0.3 * plot.width, start[1] - 0.3 * plot.height))
    curve = wisps.studio.document.wisp.length_curve
    assert curve[0] == pytest.approx((0.8 - 0.3 / 0.92, 0.3 * 1.2 / 0.88), abs=0.03)
    assert entries(wisps) == 1
    wisps.move(*plot.at(0.3, 0.5))
    for _ in range(2):
        wisps.press()
        wisps.release()
    wisps.frames()
    assert len(wisps.studio.document.wisp.length_curve) == 4
    wisps.click("4 Wisp/Length curve/Point 2", button=1)
    assert len(wisps.studio.document.wisp.length_curve) == 3
    wisps.click("4 Wisp/Length distribution")
    wisps.click("4 Wisp/Length distribution/frayed")
    assert wisps.studio.document.wisp.length_curve == ()
    wisps.built()


def test_the_prototype_is_bent_in_space_and_its_siblings_follow(wisps, opened):
    opened("3 Prototype")
    steps = wisps.app._steps["Wisps"]
    prototype = next(draw.__self__ for title, _, draw in steps._sections if title == "3 Prototype")
    straight = prototype._made[1]
    point = wisps.rect("3 Prototype/Front/Point 3").centre
    wisps.drag(point, (point[0] + 15, point[1]))
    side = wisps.rect("3 Prototype/Side/Point 5").centre
    wisps.drag(side, (side[0] - 15, side[1]))
    curve = np.array(wisps.studio.document.wisp.prototype_curve)
    assert curve[2, 0] > 0.001
    assert curve[2, 2] == 0
    assert curve[4, 2] < -0.001
    assert entries(wisps) == 2
    assert np.abs(straight[0][:, 0]).max() == 0
    assert np.abs(prototype._made[1][0][:, 0]).max() > 1e-4
    wisps.studio.undo()
    wisps.studio.undo()
    assert wisps.studio.document.wisp.prototype_curve == ()
    wisps.built()


def test_a_parting_is_drawn_on_the_scalp(wisps):
    wisps.click("Tools/Parting")
    wisps.key(imgui.Key["_7"])
    wisps.drag(on_scalp(wisps, 0.6, 0.05), on_scalp(wisps, 0.6, 0.3), steps=12)
    wisps.built()
    line = np.array(wisps.studio.document.wisp.parting_line)
    assert line[0] == pytest.approx([0.6, 0.05], abs=0.03)
    assert line[-1] == pytest.approx([0.6, 0.3], abs=0.03)
    assert wisps.studio.work.history.undo_label == "Draw a parting"
    wisps.click("Tools/Remove parting")
    assert wisps.studio.document.wisp.parting_line == ()
    wisps.built()


def test_a_stroke_of_the_comb_bends_the_hair(wisps):
    wisps.click("Tools/Comb")
    wisps.key(imgui.Key["_9"])
    start = on_scalp(wisps, 0.5, 0.7)
    wisps.drag(start, (start[0] + 120, start[1]), steps=12)
    wisps.built()
    (stroke,) = wisps.studio.document.styling.strokes
    path = proportions(wisps).place(np.array(stroke.path))
    assert path[-1, 0] < path[0, 0] - 0.03, "to the right, seen from behind: to the person's left"
    assert entries(wisps) == 1
    wisps.studio.undo()
    assert wisps.studio.document.styling.strokes == ()


def test_scissors_cut_what_lies_beyond_their_stroke(wisps):
    lowest = wisps.studio.grown.animation.hairdo.strands.points[:, 1].min()
    wisps.click("Tools/Scissors")
    x, y = on_screen(wisps, [0.0, -0.02, 0.0])
    wisps.drag((x - 150, y), (x + 150, y), steps=12)
    wisps.built()
    (cut,) = wisps.studio.document.styling.cuts
    assert cut.normal[1] < -0.9
    assert wisps.studio.grown.animation.hairdo.strands.points[:, 1].min() > lowest + 0.02
    assert wisps.studio.work.history.undo_label == "Cut"


def test_a_constraint_is_added_and_its_handle_dragged(wisps, opened):
    opened("Operations")
    wisps.click("Operations/Add")
    wisps.click("Operations/Add/Point constraint")
    wisps.built()
    assert wisps.studio.document.styling.operations == (Constrain(steps=(ToPoint(),)),)
    assert wisps.app.viewport.tool.label == "Adjust"
    wisps.key(imgui.Key["_9"])
    place = proportions(wisps).place(np.array(ToPoint().place))
    x, y = on_screen(wisps, place)
    wisps.drag((x, y), (x, y + 60))
    wisps.built()
    (operation,) = wisps.studio.document.styling.operations
    moved = proportions(wisps).place(np.array(operation.steps[0].place))
    assert on_screen(wisps, moved) == pytest.approx((x, y + 60), abs=1.5)
    assert moved[2] == pytest.approx(place[2], abs=1e-6), "as deep as it was"
    assert entries(wisps) == 2
    controls = wisps.studio.grown.animation.hairdo.outlines.joints
    gathered = np.linalg.norm(controls - moved, axis=2).min(axis=1) < 0.03
    assert gathered.mean() > 0.5
    wisps.studio.undo()
    assert wisps.studio.document.styling.operations == (Constrain(steps=(ToPoint(),)),)


def test_operations_are_put_in_order_and_taken_away(wisps, opened):
    opened("Operations")
    for kind in ("Tie", "Bun"):
        wisps.click("Operations/Add")
        wisps.click(f"Operations/Add/{kind}")
        wisps.frames(2)
    tie, bun = wisps.studio.document.styling.operations
    wisps.click("Operations/2/Up")
    assert wisps.studio.document.styling.operations == (bun, tie)
    assert wisps.studio.chosen.index == 0
    wisps.click("Operations/1/Delete")
    assert wisps.studio.document.styling.operations == (tie,)
    assert wisps.studio.chosen is None
    wisps.click("Operations/1/Choose")
    wisps.frames()
    wisps.click("Operations/1/Region")
    wisps.click("Operations/1/Region/top")
    assert wisps.studio.document.styling.operations == (Tie(Selection("top")),)
    wisps.built()


def test_a_bad_expression_is_said_and_not_taken(wisps, opened):
    opened("Operations")
    wisps.click("Operations/Add")
    wisps.click("Operations/Add/Tie")
    wisps.frames(2)
    wisps.click("Operations/1/Where")
    wisps.key(CTRL, imgui.Key.a)
    wisps.type("v <")
    wisps.key(imgui.Key.enter)
    wisps.frames(2)
    assert any("is no expression" in text for text in wisps.messages())
    assert wisps.studio.document.styling.operations == (Tie(),)


def test_a_lasso_and_a_brush_choose_wisps(wisps, opened):
    wisps.click("Tools/Lasso")
    wisps.drag(on_scalp(wisps, 0.3, 0.1), on_scalp(wisps, 0.7, 0.1))
    assert any("Choose an operation" in text for text in wisps.messages())
    opened("Operations")
    wisps.click("Operations/Add")
    wisps.click("Operations/Add/Tie")
    wisps.built()
    wisps.key(imgui.Key["_7"])
    wisps.click("Tools/Lasso")
    corners = [on_scalp(wisps, u, v) for u, v in ((0.55, 0.1), (0.8, 0.1), (0.8, 0.5), (0.55, 0.5))]
    wisps.move(*corners[0])
    wisps.press()
    for a, b in pairwise(corners):
        for point in np.linspace(a, b, 8)[1:]:
            wisps.move(float(point[0]), float(point[1]))
    wisps.release()
    wisps.frames()
    selection = wisps.studio.document.styling.operations[0].selection
    assert selection.of(np.array([[0.68, 0.3], [0.3, 0.3]])).tolist() == [True, False]
    marked = len(wisps.app.viewport.tool.dress(wisps.studio.stage).overlays.triangles)
    assert 2 <= marked < 2 * 40
    wisps.click("Tools/Select")
    wisps.studio.brush = dataclasses.replace(wisps.studio.brush, strength=1.0, mirror=False)
    wisps.drag(on_scalp(wisps, 0.3, 0.2), on_scalp(wisps, 0.3, 0.3))
    mask = wisps.studio.document.styling.operations[0].selection
    assert mask.lasso == ()
    assert mask.of(np.array([[0.68, 0.3], [0.3, 0.25]])).tolist() == [False, True]
    wisps.studio.brush = type(wisps.studio.brush)()
    wisps.built()


def test_lengths_of_loose_hair_are_painted_too(driver):
    driver.click("Tools/Lengths")
    driver.key(imgui.Key["_1"])
    driver.drag(on_scalp(driver, 0.6, 0.05), on_scalp(driver, 0.5, 0.05), keys=(CTRL,))
    driver.built()
    assert driver.studio.document.scalp.painted_lengths is not None
    assert entries(driver) == 1
    driver.click("Tools/Shake")


def test_strands_of_another_program_are_looked_at_and_put_on_the_head(wisps, tmp_path):
    files, studio = wisps.app.actions.hair_files, wisps.studio
    styled, before = studio.stage.strands, entries(wisps)
    path = tmp_path / "bob.usda"
    # In centimetres, z up: the axes of another program.
    turned = 100 * styled.points @ np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], dtype=np.float32)
    write_strands(dataclasses.replace(styled, points=turned), path)
    files.look_into(path)
    wisps.until(lambda: wisps.shown("Import strands/Import"))
    wisps.frames(3)
    assert studio.document.groom.hair is None, "nothing happens before the answer"
    wisps.click("Import strands/Cancel")
    assert not wisps.app.dialogs.asking
    files.look_into(path)
    wisps.until(lambda: wisps.shown("Import strands/Import"))
    wisps.frames(3)
    wisps.click("Import strands/Out of the head")
    wisps.click("Import strands/Import")
    wisps.built()
    groom = studio.document.groom
    assert (groom.hair.name, groom.reroot, groom.lift) == ("bob.usda", True, False)
    assert entries(wisps) == before + 1
    shown = studio.stage.strands
    assert shown.count == styled.count
    # In another order, but in the same places.
    assert np.median(cKDTree(styled.points).query(shown.points)[0]) < 0.005
    wisps.click("Imported hair/Style hair instead")
    wisps.built()
    assert studio.document.groom.hair is None
    studio.undo()
    assert studio.document.groom == groom
    studio.undo()
    assert studio.document.groom.hair is None


def test_a_file_without_strands_is_refused_in_a_line(wisps, tmp_path):
    (tmp_path / "torn.hair").write_bytes(b"HAIR")
    wisps.app.actions.take_dropped([tmp_path / "torn.hair"])
    wisps.until(lambda: not wisps.app.dialogs.asking)
    assert wisps.studio.messages.log[-1].kind == "error"
    assert "torn.hair" in wisps.messages()[-1]


def test_hair_goes_out_to_a_file_and_a_strand_of_it_comes_in_as_the_prototype(wisps, tmp_path):
    files, studio = wisps.app.actions.hair_files, wisps.studio
    files.save_hair(tmp_path / "hair")
    wisps.until(lambda: not studio.chores.busy)
    wisps.frames()
    assert wisps.messages()[-1].startswith("Wrote 500 strands")
    written, shown = read_strands(tmp_path / "hair.hair"), studio.stage.strands
    np.testing.assert_array_equal(written.points, shown.points)
    before = studio.document.wisp
    files.load_prototype(tmp_path / "hair.hair")
    assert studio.document.wisp.prototype_curve == sample_strand(written)
    assert studio.work.history.undo_label == "Import prototype"
    studio.undo()
    assert studio.document.wisp == before
    (tmp_path / "torn.hair").write_bytes(b"HAIR")
    files.load_prototype(tmp_path / "torn.hair")
    assert studio.messages.log[-1].kind == "error"
    assert "torn.hair" in wisps.messages()[-1]
    assert "Error" not in wisps.messages()[-1]
