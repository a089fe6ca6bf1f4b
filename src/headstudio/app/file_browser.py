"""A file dialog of the studio's own, for systems without one: a folder, what is in it, and a name."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from . import theme
from .ui import Ui


@dataclass(frozen=True)
class FileWish:
    """What is asked for: the title, the endings that may be chosen ("" for a folder), and whether it is to be written."""

    title: str
    endings: tuple[str, ...]
    saving: bool = False
    suggestion: str = ""


class FileBrowser:
    """The dialog. ``draw`` returns the chosen path once, and ``closed`` tells that the user is done with it."""

    def __init__(self, wish: FileWish, folder: Path) -> None:
        self.wish = wish
        self.closed = False
        self._name = wish.suggestion
        self._complaint = ""
        self._opened = False
        self._enter(folder)

    def draw(self, ui: Ui) -> Path | None:
        """Draw it over everything else; the path that was chosen in this frame, or None."""
        title = self.wish.title
        if not self._opened:
            imgui.open_popup(title)
            self._opened = True
        imgui.set_next_window_size((ui.px(640), ui.px(460)))
        centre = imgui.get_main_viewport().get_center()
        imgui.set_next_window_pos((centre.x, centre.y), imgui.Cond_.appearing.value, (0.5, 0.5))
        shown, stays = imgui.begin_popup_modal(title, True, imgui.WindowFlags_.no_resize.value)
        if not shown:
            self.closed = True
            return None
        with ui.within(title):
            self._draw_folder(ui)
            self._draw_entries(ui)
            chosen = self._draw_answer(ui)
        if chosen is not None or not stays or imgui.is_key_pressed(imgui.Key.escape):
            self.closed = True
            imgui.close_current_popup()
        imgui.end_popup()
        return chosen

    def _enter(self, folder: Path) -> None:
        """Show what is in ``folder``: folders first, then files that may be chosen."""
        try:
            entries = sorted(folder.iterdir(), key=lambda path: path.name.lower())
            self._folders = [path for path in entries if path.is_dir() and not path.name.startswith(".")]
        except OSError as error:
            self._complaint = f"{folder} cannot be read: {error.strerror}"
            return
        self._files = [path for path in entries if path.suffix.lower() in self.wish.endings and path.is_file()]
        self._folder, self._complaint = folder, ""
        self._typed_folder = str(folder)

    def _draw_folder(self, ui: Ui) -> None:
        if ui.button("Up", "To the folder above.", icon=icons.ICON_FA_ARROW_UP):
            self._enter(self._folder.parent)
        imgui.same_line()
        if ui.button("Home", icon=icons.ICON_FA_HOUSE):
            self._enter(Path.home())
        imgui.same_line()
        imgui.set_next_item_width(-1)
        _, self._typed_folder = imgui.input_text("##folder", self._typed_folder)
        ui.note("Folder")
        if imgui.is_item_deactivated_after_edit():
            self._enter(Path(self._typed_folder).expanduser())

    def _draw_entries(self, ui: Ui) -> None:
        below = 2.6 * imgui.get_frame_height_with_spacing()
        imgui.push_style_color(imgui.Col_.child_bg.value, theme.rgba(theme.GROUND))
        if imgui.begin_child("##entries", (0, -below), imgui.ChildFlags_.always_use_window_padding.value):
            for folder in self._folders:
                if imgui.selectable(f"{icons.ICON_FA_FOLDER}  {folder.name}", False)[0]:
                    self._enter(folder)
                    break
            for file in self._files:
                if imgui.selectable(f"{icons.ICON_FA_FILE}  {file.name}", file.name == self._name)[0]:
                    self._name = file.name
        imgui.end_child()
        imgui.pop_style_color()

    def _draw_answer(self, ui: Ui) -> Path | None:
        verb = "Save" if self.wish.saving else "Open"
        imgui.set_next_item_width(-ui.px(190))
        entered, self._name = imgui.input_text("##name", self._name, imgui.InputTextFlags_.enter_returns_true.value)
        ui.note("Name")
        imgui.same_line()
        agreed = ui.button(verb, width=ui.px(86), enabled=bool(self._name)) or entered
        imgui.same_line()
        if ui.button("Cancel", width=ui.px(86)):
            self.closed = True
            imgui.close_current_popup()
        imgui.push_style_color(imgui.Col_.text.value, theme.rgba(theme.WARNING))
        imgui.text_unformatted(self._complaint)
        imgui.pop_style_color()
        return self._answer() if agreed and self._name else None

    def _answer(self) -> Path | None:
        """The path, or None with a complaint when it cannot be what is asked for."""
        path = self._folder / Path(self._name).expanduser()
        if path.is_dir() and "" not in self.wish.endings:
            self._enter(path)
            return None
        if not self.wish.saving and not path.exists():
            self._complaint = f"There is no {path.name} here."
            return None
        if self.wish.saving and path.exists() and self._complaint != self._overwrite(path):
            self._complaint = self._overwrite(path)
            return None
        return path

    @staticmethod
    def _overwrite(path: Path) -> str:
        return f"{path.name} is there already. Save once more to replace it."
