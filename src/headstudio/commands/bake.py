"""``headstudio bake``: the wrinkles of a face as maps for other programs."""

from __future__ import annotations

from pathlib import Path

from ..io.faces import MAPS, write_maps, write_weights
from ..params import ParameterError, assign
from ..scene.builder import Builder
from ..scene.document import Document
from ..wrinkle.bake import Bake
from ..wrinkle.expressions import FACES
from .reporting import counting, say, working


def parse_maps(words: str) -> tuple[str, ...]:
    """``height,normal,ao`` as names. Raises ParameterError."""
    names = tuple(word.strip() for word in words.split(","))
    for name in names:
        if name not in MAPS:
            raise ParameterError(f"maps are {', '.join(MAPS)}, with commas between; got {words!r}")
    return names


def bake(document: Document, maps: tuple[str, ...], size: int, out: Path) -> None:
    """Write the maps of a document's face into the folder ``out``. Raises HeadError, ParameterError, OSError.

    What the gray levels mean stands in maps.json beside them.
    """
    document = assign(document, {"fine.texture_size": size})
    out.mkdir(parents=True, exist_ok=True)
    with working("laying out the skin"):
        skin = Builder().skin(document)
        baking = Bake(skin.surface, size)
    written: list[Path] = []
    if set(maps) - {"weights"}:
        with working("baking"):
            baked = baking.at(skin.at(document.face))
            written += write_maps(baked, maps, out)
    if "weights" in maps:
        with counting("baking expressions", len(FACES)) as progress:
            written += write_weights(baking, skin, out, lambda: progress.advance(progress.task_ids[0]))
    for path in written:
        say(str(path))
