"""A living face for other programs: posed meshes, wrinkle maps, furrow sets that move to another head."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from ..params import ParameterError
from ..scene.files import write_atomically
from ..scene.stage import Stage
from ..wrinkle.bake import Bake, BakedSkin
from ..wrinkle.expressions import FACES
from ..wrinkle.face_settings import FaceSettings
from ..wrinkle.furrow import Furrow, decode_furrows, encode_furrows
from ..wrinkle.living_skin import Skin
from .maps import write_gray16, write_normals
from .meshes import write_head

MAPS = ("height", "normal", "ao", "weights")
FURROW_SUFFIX = ".json"


def write_stage_mesh(stage: Stage, path: Path) -> None:
    """The skin and parts on stage as a mesh file [m]: .obj, .ply or .glb. Raises OSError."""
    skin = stage.skin
    if skin is None:
        write_head(stage.head.skin, stage.head.skin.vertex_normals, stage.head.parts, path)
    else:
        mesh = skin.surface.mesh(skin.skin.positions)
        write_head(mesh, skin.skin.normals, skin.parts, path)


def write_maps(baked: BakedSkin, maps: Sequence[str], folder: Path) -> list[Path]:
    """Those of ``maps`` that show one instant, in ``folder``, and what their gray levels mean; returns what was written.

    Raises OSError.
    """
    low, high = float(baked.height.min()), float(baked.height.max())
    high = high if high > low else low + 1e-6
    meaning = {"height_black_m": low, "height_white_m": high, "texel_m": baked.texel}
    files = {"height": folder / "height.png", "normal": folder / "normal.png", "ao": folder / "ao.png"}
    if "height" in maps:
        write_gray16(baked.height, low, high, files["height"])
    if "normal" in maps:
        level = np.array([0, 0, 1], np.float32)
        write_normals(np.where(baked.mapped[..., None], baked.normals, level), files["normal"])
    if "ao" in maps:
        write_gray16(baked.occlusion, 0.0, 1.0, files["ao"])
    write_atomically(folder / "maps.json", json.dumps(meaning, indent=1).encode() + b"\n")
    return [files[name] for name in maps if name in files] + [folder / "maps.json"]


def write_weights(baking: Bake, skin: Skin, folder: Path, done: Callable[[], object] = lambda: None) -> list[Path]:
    """How far each of the named faces brings large wrinkles out, a map each; ``done`` is told after every one.

    Raises OSError.
    """
    written = []
    for name, weights in FACES.items():
        path = folder / f"weight-{name}.png"
        write_gray16(baking.weight(skin.at(FaceSettings(**weights))), 0.0, 1.0, path)  # type: ignore[arg-type]
        written.append(path)
        done()
    return written


def write_furrows(furrows: Sequence[Furrow], path: Path) -> None:
    """A furrow set as JSON, on the face chart, so that it fits any head. Raises OSError."""
    write_atomically(path, encode_furrows(furrows))


def read_furrows(path: Path) -> tuple[Furrow, ...]:
    """A furrow set. Raises OSError, and ParameterError for a file that holds none."""
    try:
        furrows = decode_furrows(path.read_bytes())
    except ValueError as problem:
        raise ParameterError(f"{path.name} {problem}") from None
    if not furrows:
        raise ParameterError(f"{path.name} holds no furrow")
    return furrows
