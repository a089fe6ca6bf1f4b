"""``headstudio bake``: the wrinkles of a face as maps for other programs."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from ..io.maps import write_gray16, write_normals
from ..params import ParameterError, assign
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.files import write_atomically
from ..wrinkle.bake import Bake, BakedSkin
from ..wrinkle.expressions import FACES
from ..wrinkle.face_settings import FaceSettings
from .reporting import counting, say, working

MAPS = ("height", "normal", "ao", "weights")


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
            written += _write(baked, maps, out)
    if "weights" in maps:
        with counting("baking expressions", len(FACES)) as progress:
            for name, weights in FACES.items():
                path = out / f"weight-{name}.png"
                write_gray16(baking.weight(skin.at(FaceSettings(**weights))), 0.0, 1.0, path)  # type: ignore[arg-type]
                written.append(path)
                progress.advance(progress.task_ids[0])
    for path in written:
        say(str(path))


def _write(baked: BakedSkin, maps: tuple[str, ...], out: Path) -> list[Path]:
    low, high = float(baked.height.min()), float(baked.height.max())
    high = high if high > low else low + 1e-6
    meaning = {"height_black_m": low, "height_white_m": high, "texel_m": baked.texel}
    files = {"height": out / "height.png", "normal": out / "normal.png", "ao": out / "ao.png"}
    if "height" in maps:
        write_gray16(baked.height, low, high, files["height"])
    if "normal" in maps:
        write_normals(
            np.where(baked.mapped[..., None], baked.normals, np.array([0, 0, 1], np.float32)), files["normal"]
        )
    if "ao" in maps:
        write_gray16(baked.occlusion, 0.0, 1.0, files["ao"])
    write_atomically(out / "maps.json", json.dumps(meaning, indent=1).encode() + b"\n")
    return [files[name] for name in maps if name in files] + [out / "maps.json"]
