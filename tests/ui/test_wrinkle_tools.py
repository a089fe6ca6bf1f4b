"""Tools of the editor of wrinkles: furrows, directions and paint, on the head and in texture space."""

import threading
from dataclasses import replace

import numpy as np
import pytest
from imgui_bundle import imgui

from headstudio.app.wrinkles import proposals
from headstudio.app.wrinkles.face_places import places_of
from headstudio.wrinkle.face_settings import FaceSettings
from headstudio.wrinkle.furrow import Furrow

from .wrinkle_scenes import FURROWS, draw_stroke, furrows_of, head_canvas, on_screen, texture_canvas, tool

CTRL, SHIFT = imgui.Key.mod_ctrl, imgui.Key.mod_shift
STROKE = [(-0.03, -0.022), (-0.036, -0.03), (-0.039, -0.04), (-0.039, -0.05)]  # down the right cheek, on the chart [m]


@pytest.fixture
def hand(face):
    """Take a tool of the tab."""
    return lambda label: face.click(f"Tools/{label}")


def away_from(furrow, points):
    """How far points of the chart [m], (k, 2), are from a furrow at most."""
    line = furrow.chain.sampled(100)[1]
    return np.linalg.norm(np.array(points)[:, None] - line, axis=2).min(axis=1).max()


@pytest.mark.parametrize("where", ["head", "texture"])
def test_a_stroke_is_a_furrow_on_both_sides_as_one_change(face, where):
    if where == "texture":
        face.click("Views/Texture space")
        face.frames(2)
    canvas = head_canvas(face) if where == "head" else texture_canvas(face)
    way = on_screen(canvas, *STROKE)
    draw_stroke(face, way)
    right, left = furrows_of(face)[3:]
    # The whole head is in texture space: a pixel of it is more than a millimetre of the face.
    pixel = np.max(np.linalg.norm(np.diff(STROKE, axis=0), axis=1) / np.linalg.norm(np.diff(way, axis=0), axis=1))
    exact = max(1.2e-3, 1.5 * pixel)
    assert exact < 2e-3
    assert away_from(right, STROKE) < exact
    assert away_from(left, [(-x, y) for x, y in STROKE]) < exact
    assert right.name.endswith("right")
    assert left.name.endswith("left")
    assert face.studio.work.history.undo_label == "Draw furrow"
    face.built()
    assert len(face.studio.grown.animation.skin.surface.bed.furrows) == 5
    face.studio.undo()
    assert furrows_of(face) == FURROWS


def test_a_short_press_draws_nothing_and_lets_go(face):
    furrows = tool(face, "Furrows").set
    furrows.chosen = 1
    face.click_at(on_screen(head_canvas(face), (0.0, -0.02))[0])
    assert furrows.chosen is None
    assert not face.studio.work.modified


@pytest.mark.parametrize("where", ["head", "texture"])
def test_a_handle_is_dragged_and_the_other_side_follows(face, where):
    if where == "texture":
        face.click("Views/Texture space")
        face.frames(2)
    canvas = head_canvas(face) if where == "head" else texture_canvas(face)
    left = FURROWS[1]
    face.click_at(on_screen(canvas, left.chain.at(0.6))[0])
    assert tool(face, "Furrows").set.chosen == 1
    wanted = np.add(left.controls[-1], [0.004, -0.004])
    face.drag(*on_screen(canvas, left.controls[-1], wanted))
    moved, across = furrows_of(face)[1:3]
    np.testing.assert_allclose(moved.controls[-1], wanted, atol=1.5e-3)
    np.testing.assert_allclose(across.controls, np.array(moved.controls) * [-1, 1])
    assert across.name == FURROWS[2].name
    assert face.studio.work.history.undo_label == "Move furrow"
    face.studio.undo()
    assert furrows_of(face) == FURROWS


def test_handles_come_and_go(face):
    furrows, canvas = tool(face, "Furrows").set, head_canvas(face)
    forehead = FURROWS[0]
    furrows.chosen = 0
    face.click_at(on_screen(canvas, forehead.chain.at(2.5))[0], keys=(CTRL,))
    finer = furrows_of(face)[0]
    assert finer.chain.count == forehead.chain.count + 1
    assert away_from(finer, forehead.chain.sampled(20)[1]) < 2e-4, "its course stays"
    face.click_at(on_screen(canvas, finer.controls[9])[0], keys=(CTRL,))
    assert furrows_of(face)[0].chain.count == forehead.chain.count
    face.move(*face.rect("Viewport").at(0.1, 0.1))
    face.key(imgui.Key.delete)
    assert [furrow.name for furrow in furrows_of(face)] == ["nasolabial left", "nasolabial right"]
    face.studio.undo()
    assert len(furrows_of(face)) == 3


def test_the_list_chooses_and_the_last_furrow_stays(face):
    furrows = tool(face, "Furrows").set
    if not face.shown("Nasolabial/nasolabial left"):
        face.click("Furrows/Nasolabial")
    face.click("Nasolabial/nasolabial left")
    assert furrows.chosen == 1
    face.click("Furrow/Remove")
    assert [furrow.name for furrow in furrows_of(face)] == ["forehead 2"]
    furrows.chosen = 0
    face.frames()
    face.click("Furrow/Remove")
    assert len(furrows_of(face)) == 1
    assert "last furrow stays" in face.messages()[-1]


def test_an_age_starts_over_from_the_default_set(face):
    face.click("Furrows/Old")
    wrinkle = face.studio.document.wrinkle
    assert (wrinkle.furrows, wrinkle.age) == ((), 1.0)
    face.studio.undo()
    assert furrows_of(face) == FURROWS


def test_mirroring_one_side_by_hand(face):
    furrows = tool(face, "Furrows").set
    face.click("Tools/Both sides")
    furrows.chosen = 1
    deeper = replace(FURROWS[1], depth=0.0111)
    furrows.put(1, deeper, "Depth")
    assert furrows_of(face)[2] == FURROWS[2]
    face.frames()
    face.click("Furrow/Mirror")
    assert furrows_of(face)[2].depth == deeper.depth


def test_a_direction_is_dragged_turned_and_taken_away(face, hand):
    hand("Directions")
    canvas = head_canvas(face)
    start, end, other = on_screen(canvas, (0.02, -0.045), (0.03, -0.045), (0.02, -0.035))
    face.drag(start, end)
    vectors = face.studio.document.fine.vectors
    assert {vector.field for vector in vectors} == {0}
    assert len(vectors) > 20, "those placed from the shape stay beside it"
    added = vectors[-1]
    assert added.du > 0.25
    assert abs(added.dv) < 0.25 * added.du
    assert face.studio.work.history.undo_label == "Add direction"
    face.drag(end, other)
    turned = face.studio.document.fine.vectors[-1]
    assert turned.dv > 0.25
    assert abs(turned.du) < 0.3 * turned.dv
    face.click_at(other, keys=(CTRL,))
    assert face.studio.document.fine.vectors == vectors[:-1]
    face.click("Tools/Regenerate")
    assert face.studio.document.fine.vectors == ()
    for _ in range(4):
        face.studio.undo()
    assert not face.studio.work.modified


def test_a_click_adds_no_direction(face, hand):
    hand("Directions")
    face.click_at(on_screen(head_canvas(face), (0.02, -0.045))[0])
    assert len(face.studio.document.fine.vectors) % 2 == 1, "only those that the shape gives"
    face.click("Tools/Field 2")
    assert tool(face, "Directions").field == 1


@pytest.mark.parametrize("where", ["head", "texture"])
def test_tissue_is_painted_as_one_change(face, hand, where):
    hand("Tissue")
    if where == "texture":
        face.click("Views/Texture space")
        face.frames(2)
    canvas = head_canvas(face) if where == "head" else texture_canvas(face)
    painter = tool(face, "Tissue")
    before = painter.painted_image(canvas.faces).pixels
    chart = np.array([[0.025, -0.04], [0.03, -0.045]])
    draw_stroke(face, on_screen(canvas, *chart))
    painted = face.studio.document.face.painted_tissue.pixels
    places, _ = canvas.faces.of_chart(np.concatenate([chart, chart * [-1, 1], [[0.0, 0.04]]]))
    column, row = (canvas.faces.uv(places) * len(before)).astype(int).T
    gain = (painted - before)[row, column]
    assert gain[:4].min() > 0.3, "on both sides"
    assert gain[4] == 0
    draw_stroke(face, on_screen(canvas, *chart), keys=(CTRL,))
    lowered = face.studio.document.face.painted_tissue.pixels
    assert (lowered - painted)[row, column][:4].max() < -0.3
    face.studio.undo()
    face.studio.undo()
    assert face.studio.document.face.painted_tissue is None


def test_the_strength_of_fine_wrinkles_is_painted_smoothed_and_forgotten(face, hand):
    hand("Fine strength")
    canvas = head_canvas(face)
    path = on_screen(canvas, (0.0, 0.03), (0.01, 0.03))
    draw_stroke(face, path, keys=(CTRL,))
    painted = face.studio.document.fine.painted_strength
    assert painted.pixels.min() < 0.7
    assert np.mean(painted.pixels == 1) > 0.8
    draw_stroke(face, path, keys=(SHIFT,))
    assert face.studio.document.fine.painted_strength.pixels.min() > painted.pixels.min()
    face.click("Tools/Reset")
    assert face.studio.document.fine.painted_strength is None


def test_what_is_painted_is_shown_on_the_head(face, hand):
    stage = face.studio.stage
    hand("Tissue")
    face.frames()
    shown = face.app.viewport.tool.dress(stage).overlays
    assert len(shown.triangles) == len(places_of(face.studio).layout.part.faces)
    assert face.app.viewport.tool.dress(stage).overlays is shown, "and made once"


def test_texture_space_zooms_at_the_mouse_pans_and_closes(face):
    face.key(imgui.Key.m)
    face.frames(2)
    point = np.floor(face.rect("Texture").at(0.3, 0.6))  # ImGui knows whole pixels only
    under = texture_canvas(face).to_uv(*point)
    far = texture_canvas(face).to_uv(*face.rect("Texture").at(0.9, 0.9))
    face.wheel(point, 3)
    np.testing.assert_allclose(texture_canvas(face).to_uv(*point), under, atol=1e-9)
    assert (
        np.abs(texture_canvas(face).to_uv(*face.rect("Texture").at(0.9, 0.9)) - under).max() < np.abs(far - under).max()
    )
    face.drag(point, (point[0] + 40, point[1] + 10), button=2)
    np.testing.assert_allclose(texture_canvas(face).to_uv(point[0] + 40, point[1] + 10), under, atol=1e-9)
    face.click("Texture space/Triangles")
    face.click("Texture space/Frame")
    assert not face.studio.work.modified
    face.key(imgui.Key.m)
    face.frames()
    assert not face.shown("Texture")


@pytest.fixture
def proposed(face, monkeypatch):
    """Two furrows that the program proposes, without the minute that it takes to find some."""
    controls = (((0.02, -0.03), (0.025, -0.034), (0.03, -0.038), (0.034, -0.042)),)
    controls += (tuple((-x, y + 0.012) for x, y in controls[0]),)
    found = tuple(Furrow(f"proposal {k}", "inferred", controls=line) for k, line in enumerate(controls, 1))

    def propose(posing, layout, expressions):
        for _ in expressions.values():
            posing.pose(FaceSettings(smile=0.5))
        return found

    monkeypatch.setattr(proposals, "propose_furrows", propose)
    face.click("Proposals/Propose from expressions")
    face.until(lambda: face.studio.document.wrinkle.proposals)
    face.frames()
    return found


def test_proposals_are_accepted_rejected_and_taken_back(face, proposed):
    studio = face.studio
    grown = studio.grown
    assert studio.document.wrinkle.proposals == proposed
    assert studio.work.history.undo_label == "Propose furrows"
    face.frames(3)
    assert studio.grown is grown, "what is only proposed changes nothing on the skin"
    face.click_at(on_screen(head_canvas(face), proposed[0].chain.at(0.5))[0])
    assert studio.document.wrinkle.proposals == proposed, "a click looks at it"
    face.click("Proposals/Accept")
    assert studio.document.wrinkle.proposals == proposed[1:]
    assert furrows_of(face) == (*FURROWS, proposed[0])
    assert tool(face, "Furrows").set.chosen == len(FURROWS)
    studio.undo()
    assert studio.document.wrinkle.proposals == proposed
    face.frames()
    face.click("Proposals/Accept all")
    assert furrows_of(face) == (*FURROWS, *proposed)
    studio.undo()
    face.frames()
    face.click_at(on_screen(head_canvas(face), proposed[1].chain.at(0.5))[0])
    face.click("Proposals/Reject")
    assert studio.document.wrinkle.proposals == proposed[:1]
    face.click("Proposals/Reject all")
    assert studio.document.wrinkle.proposals == ()
    assert furrows_of(face) == FURROWS


def test_a_proposal_that_is_dragged_is_a_furrow_there(face, proposed):
    canvas = head_canvas(face)
    face.drag(*on_screen(canvas, proposed[0].chain.at(0.5), np.add(proposed[0].chain.at(0.5), [0.003, 0.0])))
    moved = furrows_of(face)[-1]
    np.testing.assert_allclose(np.array(moved.controls) - proposed[0].controls, [[0.003, 0.0]] * 4, atol=1.5e-3)
    assert face.studio.document.wrinkle.proposals == proposed[1:]
    assert face.studio.work.history.undo_label == "Move proposal"
    face.studio.undo()
    assert face.studio.document.wrinkle.proposals == proposed
    assert furrows_of(face) == FURROWS


def test_a_search_for_proposals_can_be_cancelled(face, monkeypatch):
    going = threading.Event()

    def propose(posing, layout, expressions):
        for _ in expressions.values():
            going.wait(10.0)
        return FURROWS

    monkeypatch.setattr(proposals, "propose_furrows", propose)
    face.click("Proposals/Propose from expressions")
    face.frames(2)
    face.click("Proposals/Cancel")
    going.set()
    face.frames(20)
    assert face.studio.document.wrinkle.proposals == ()
    assert face.shown("Proposals/Propose from expressions")
