"""The face in and out of files: its mesh, its maps, its furrows."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ...io.faces import (
    FURROW_SUFFIX,
    read_furrows,
    write_furrows,
    write_maps,
    write_stage_mesh,
    write_weights,
)
from ...io.meshes import MESH_SUFFIXES
from ...wrinkle.bake import Bake
from ..commands import Command
from ..dialogs import Dialogs
from ..file_browser import FileWish
from ..studio import Studio

MAP_SIZE = 2048  # texels along an edge, where no fine wrinkles say otherwise
SHOWN_MAPS = ("height", "normal", "ao")


class FaceFiles:
    """Asks where to, and reads or writes there."""

    def __init__(self, studio: Studio, dialogs: Dialogs) -> None:
        self._studio = studio
        self._dialogs = dialogs

    def commands(self) -> list[Command]:
        """For the menu of files."""
        return [
            Command("File", "Import furrows...", self.import_furrows),
            Command("File", "Export furrows...", self.export_furrows),
            Command("File", "Export face mesh...", self.export_mesh, enabled=lambda: self._studio.stage is not None),
            Command("File", "Export wrinkle maps...", self.export_maps, enabled=self._has_skin),
        ]

    def import_furrows(self) -> None:
        """Ask for a furrow set and put it on the face, as one change."""
        self._dialogs.ask_file(FileWish("Import furrows", (FURROW_SUFFIX,)), self.load_furrows)

    def export_furrows(self) -> None:
        """Ask where to, and write the furrows of the document there; they fit any other head."""
        wish = FileWish("Export furrows", (FURROW_SUFFIX,), saving=True, suggestion=f"furrows{FURROW_SUFFIX}")
        self._dialogs.ask_file(wish, self.save_furrows)

    def export_mesh(self) -> None:
        """Ask where to, and write the head as it is now, with its wrinkles."""
        wish = FileWish("Export the face as a mesh", MESH_SUFFIXES, saving=True, suggestion="face.obj")
        self._dialogs.ask_file(wish, self.save_mesh)

    def export_maps(self) -> None:
        """Ask for a folder, and bake the maps of the face as it is now, and the weights of the named faces, into it."""
        wish = FileWish("Export wrinkle maps into a folder", ("",), saving=True, suggestion="wrinkle-maps")
        self._dialogs.ask_file(wish, self.save_maps)

    def _has_skin(self) -> bool:
        return self._studio.stage is not None and self._studio.stage.skin is not None

    def load_furrows(self, path: Path) -> None:
        """Put the furrow set of a file on the face; what is wrong with it becomes a message."""
        with self._studio.reporting() as outcome:
            furrows = read_furrows(path)
            document = self._studio.document
            wrinkle = replace(document.wrinkle, furrows=furrows)
            self._studio.work.change(replace(document, wrinkle=wrinkle), "Import furrows")
        if outcome.good:
            self._studio.messages.say(f"{len(furrows)} furrows from {path.name}", "good")

    def save_furrows(self, path: Path) -> None:
        """Write the furrows of the document."""
        path = path if path.suffix else path.with_suffix(FURROW_SUFFIX)
        with self._studio.reporting() as outcome:
            write_furrows(self._studio.document.wrinkle.chosen, path)
        if outcome.good:
            self._studio.messages.say(f"Wrote {path}", "good")

    def save_mesh(self, path: Path) -> None:
        """Write the head as it is now; its ending decides the format."""
        stage = self._studio.stage
        if path.suffix.lower() not in MESH_SUFFIXES:
            path = path.with_name(f"{path.name}{MESH_SUFFIXES[0]}")
        if stage is None:
            return

        def write() -> str:
            write_stage_mesh(stage, path)
            return f"Wrote {path}"

        self._studio.chores.run(write)

    def save_maps(self, folder: Path) -> None:
        """Bake into a folder while the window goes on."""
        stage, grown = self._studio.stage, self._studio.grown
        if stage is None or stage.skin is None or grown is None or grown.animation.skin is None:
            return
        living, skin = stage.skin, grown.animation.skin

        def bake() -> str:
            fine = skin.surface.fine
            baking = Bake(skin.surface, fine.texels.size if fine is not None else MAP_SIZE)
            written = write_maps(baking.at(living), SHOWN_MAPS, folder) + write_weights(baking, skin, folder)
            return f"Wrote {len(written)} files into {folder}"

        self._studio.messages.say("Baking the maps of the face...")
        self._studio.chores.run(bake)
