"""What the face shows: faces by one click, and a slider for each expression, of both sides and of either."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from imgui_bundle import imgui

from ...wrinkle.expressions import FACES
from ...wrinkle.face_settings import SLIDERS, FaceSettings
from ..parameter_rows import ParameterRows
from ..ui import Ui

SIDES = {"Left side": "_left", "Right side": "_right"}
BOTH = tuple(name for name in SLIDERS if not name.endswith(tuple(SIDES.values())))
COLUMNS = 3


class ExpressionPanel:
    """Sets the sliders of a face that holds still; in a performance it sets keyframes where the playhead is."""

    def __init__(self, rows: ParameterRows) -> None:
        self.rows = rows

    def draw(self, ui: Ui) -> None:
        """Faces, sliders of both sides, and folded away those of either."""
        self._draw_faces(ui)
        self._draw_sliders(ui, BOTH)
        for title, ending in SIDES.items():
            if imgui.tree_node_ex(title):
                ui.note(title)
                with ui.within(title):
                    self._draw_sliders(ui, tuple(name for name in SLIDERS if name.endswith(ending)))
                imgui.tree_pop()
            else:
                ui.note(title)
        self.rows.rows(ui, "face", ("driver",))

    def _draw_faces(self, ui: Ui) -> None:
        gap = imgui.get_style().item_spacing.x
        width = (imgui.get_content_region_avail().x - gap * (COLUMNS - 1)) / COLUMNS
        shown = {name: weight for name, weight in _strengths(self._face()).items() if weight > 0}
        with ui.within("Faces"):
            for k, (name, weights) in enumerate(FACES.items()):
                if k % COLUMNS:
                    imgui.same_line()
                label = name.replace("-", " ").capitalize()
                if ui.button(label, f"Show this face: {_listed(weights)}.", on=shown == weights, width=width):
                    self._set(dict.fromkeys(SLIDERS, 0.0) | dict(weights), label)
            imgui.same_line()
            if ui.button("Swap sides", "What the left side shows goes to the right, and back.", width=width):
                strengths = _strengths(self._face())
                self._set({name: strengths[_other_side(name)] for name in SLIDERS}, "Swap sides of the face")

    def _draw_sliders(self, ui: Ui, names: tuple[str, ...]) -> None:
        before = self._face()
        after = self.rows.item(ui, before, names)
        if after != before:
            changes = {name: getattr(after, name) for name in names if getattr(after, name) != getattr(before, name)}
            self._set(changes, "Expression")

    def _face(self) -> FaceSettings:
        """The face as it is now, at the playhead."""
        studio = self.rows.studio
        return studio.document.face.at(studio.face_time)

    def _set(self, changes: Mapping[str, float], label: str) -> None:
        studio = self.rows.studio
        document = studio.document
        if document.face.performance:
            # Keyframes are set where the playhead stands.
            studio.playback.playing = False
        face = document.face.with_sliders(changes, studio.face_time)
        self.rows.change(replace(document, face=face), label)


def _strengths(face: FaceSettings) -> dict[str, float]:
    return {name: float(getattr(face, name)) for name in SLIDERS}


def _other_side(name: str) -> str:
    turns = {"left": "right", "right": "left"}
    stem, _, side = name.rpartition("_")
    return f"{stem}_{turns[side]}" if side in turns else name


def _listed(weights: Mapping[str, float]) -> str:
    return ", ".join(f"{name.replace('_', ' ')} {weight:g}" for name, weight in weights.items()) or "all sliders at 0"
