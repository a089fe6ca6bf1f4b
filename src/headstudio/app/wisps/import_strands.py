"""The question before strands of another program are put on the head: what is in the file, how it stands, what is done."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

from imgui_bundle import imgui

from ...head.head import Head
from ...head.scalp import Scalp
from ...io.hair import read_strands
from ...params import assign, parameters_of
from ...wisp.adopt import place_on_head
from ...wisp.groom import Groom, GroomSettings, describe
from ..ui import Ui

TITLE = "Import strands"


@dataclass(frozen=True, eq=False)
class Found:
    """What a file holds, and lines about it for the user."""

    groom: Groom
    lines: tuple[str, ...]


def look_into(path: Path, head: Head, scalp: Scalp) -> Found:
    """Read the strands of a file and find out how they stand on a head. Raises HairFileError, AdoptError, OSError."""
    remarks: list[str] = []
    strands = read_strands(path, remark=remarks.append)
    placement = place_on_head(strands, head, scalp)
    if placement.reversed:
        remarks.append("the strands begin at their tips, and are turned around")
    return Found(Groom(path.name, strands), (*describe(strands), placement.note, *remarks))


class ImportStrands:
    """The question. ``take`` gets the answer, if there is one; ``fail`` gets what is wrong with the file."""

    def __init__(
        self,
        path: Path,
        head: Head,
        scalp: Scalp,
        take: Callable[[GroomSettings], object],
        fail: Callable[[BaseException], object],
    ) -> None:
        self._name = path.name
        self._take, self._fail = take, fail
        self._settings = GroomSettings()
        reader = ThreadPoolExecutor(1, thread_name_prefix="import")
        self._looking: Future[Found] = reader.submit(look_into, path, head, scalp)
        reader.shutdown(wait=False)

    def draw(self, ui: Ui) -> bool:
        """Draw the question; True once it is answered."""
        done = self._looking.done()
        error = self._looking.exception() if done else None
        if error is not None:
            self._fail(error)
            return True
        imgui.open_popup(TITLE)
        centre = imgui.get_main_viewport().get_center()
        imgui.set_next_window_pos((centre.x, centre.y), imgui.Cond_.always.value, (0.5, 0.5))
        if not imgui.begin_popup_modal(TITLE, None, imgui.WindowFlags_.always_auto_resize.value)[0]:
            return False
        answer: GroomSettings | None = None
        with ui.within(TITLE):
            imgui.text_unformatted(self._name)
            imgui.dummy((0, ui.px(6)))
            if done:
                self._draw_found(ui, self._looking.result())
                imgui.dummy((0, ui.px(6)))
                if ui.button("Import", on=True, width=ui.px(110)):
                    answer = replace(self._settings, hair=self._looking.result().groom)
                imgui.same_line()
            else:
                ui.muted("Reading it, and looking for its place on the head...")
            cancelled = ui.button("Cancel", width=ui.px(110)) or imgui.is_key_pressed(imgui.Key.escape)
        if answer is not None or cancelled:
            imgui.close_current_popup()
        imgui.end_popup()
        if answer is not None:
            self._take(answer)
        return answer is not None or cancelled

    def _draw_found(self, ui: Ui, found: Found) -> None:
        for line in found.lines:
            imgui.text_unformatted(line[:1].upper() + line[1:])
        imgui.dummy((0, ui.px(6)))
        for name, declared in parameters_of(self._settings).items():
            value = ui.checkbox(declared.label, getattr(self._settings, name), declared.doc)
            self._settings = assign(self._settings, {name: value})
