"""Hair out to the files of other programs, and strands and prototypes in from them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ...io.hair import READABLE, WRITABLE, read_strands, write_strands
from ...scene.builder import Builder
from ...wisp.groom import GroomSettings
from ...wisp.sample_strand import sample_strand
from ..commands import Command
from ..dialogs import Dialogs
from ..file_browser import FileWish
from ..studio import Studio
from .import_strands import ImportStrands


class HairFiles:
    """Asks where to, and reads or writes there."""

    def __init__(self, studio: Studio, dialogs: Dialogs) -> None:
        self._studio = studio
        self._dialogs = dialogs

    def commands(self) -> list[Command]:
        """For the menu of files."""
        return [
            Command("File", "Import strands...", self.import_strands, enabled=lambda: self._studio.grown is not None),
            Command("File", "Import a prototype strand...", self.import_prototype),
            Command("File", "Export hair...", self.export_hair, enabled=self._has_strands),
        ]

    def import_strands(self) -> None:
        """Ask for a hair file, show what is in it, and put its strands on the head as one change."""
        self._dialogs.ask_file(FileWish("Import strands", READABLE), self.look_into)

    def look_into(self, path: Path) -> None:
        """Show what is in a hair file and ask how its strands are to lie; what is wrong with it becomes a message."""
        grown = self._studio.grown
        if grown is None:
            return
        animation = grown.animation
        self._dialogs.ask(ImportStrands(path, animation.head, animation.scalp, self._take_strands, self._refuse))

    def _take_strands(self, groom: GroomSettings) -> None:
        document = self._studio.document
        shown = replace(document.look, hair_as="strands")
        self._studio.work.change(replace(document, groom=groom, look=shown), "Import strands")

    def _refuse(self, error: BaseException) -> None:
        with self._studio.reporting():
            raise error

    def import_prototype(self) -> None:
        """Ask for a hair file and make one of its strands the prototype, as one change."""
        self._dialogs.ask_file(FileWish("Import a prototype strand", READABLE), self.load_prototype)

    def export_hair(self) -> None:
        """Ask where to, and write all strands of the hairstyle there; the ending chooses the format."""
        wish = FileWish("Export the hair", WRITABLE, saving=True, suggestion=f"{self._studio.work.name}{WRITABLE[0]}")
        self._dialogs.ask_file(wish, self.save_hair)

    def _has_strands(self) -> bool:
        return self._studio.stage is not None and self._studio.stage.strands is not None

    def load_prototype(self, path: Path) -> None:
        """Take the strand of middle length of a file as the prototype; what is wrong with it becomes a message."""
        with self._studio.reporting() as outcome:
            curve = sample_strand(read_strands(path))
            document = self._studio.document
            self._studio.work.change(
                replace(document, wisp=replace(document.wisp, prototype_curve=curve)), "Import prototype"
            )
        if outcome.good:
            self._studio.messages.say(f"All strands resemble one of {path.name}", "good")

    def save_hair(self, path: Path) -> None:
        """Write all strands, more than are shown, while the window goes on."""
        if path.suffix.lower() not in WRITABLE:
            path = path.with_name(f"{path.name}{WRITABLE[0]}")
        document = self._studio.document

        def write() -> str:
            # The window's own builder is at work for what is shown, in another thread.
            strands = Builder().hairdo(document).strands
            write_strands(strands, path)
            return f"Wrote {strands.count:,} strands to {path}"

        self._studio.messages.say("Growing all strands of the hair...")
        self._studio.chores.run(write)
