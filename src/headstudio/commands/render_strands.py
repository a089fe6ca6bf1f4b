"""``headstudio render STRANDS``: strands on plain meshes, with the camera, light and hair that a JSON file states.

The fields are those of a path tracer's scene, so that its pictures and ours can be laid side by side.
"""

from __future__ import annotations

import json
import math
from dataclasses import MISSING, dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..head.mesh import TriangleMesh
from ..head.read import read_mesh
from ..params import ParameterError
from ..render.context import headless_context
from ..render.fibre import Fibre, followed, melanin_absorption
from ..render.strand_hair import StrandMaterial
from ..render.strand_picture import StrandScene, shown, strand_picture
from ..render.view import perspective_view
from ..wisp.strands import Strands
from .hair_sources import file_strands
from .pictures import check_is_picture, save_picture
from .reporting import counting, say, working

Triple = tuple[float, float, float]

_MOST_PIXELS = 4096
_REQUIRED_DISTANCE = 1e-6


@dataclass(frozen=True)
class StatedView:
    """Everything a picture of strands is made of, besides the strands and the meshes.

    eye, target: of the camera [m]; +Y is up. fov_degrees: across and up. size: pixels a side. hair_melanin, hair_redness,
    hair_roughness: 0 to 1. hair_radius_root, hair_radius_tip: of a strand [m]. sun_direction: towards the sun, of any
    length. sun_strength: irradiance [W/m2]. ambient: radiance from everywhere, also the background. skin_rgb: linear
    albedo. max_bounces: light is followed over so many bounces between strands; a path tracer ends its ways somewhere.
    """

    eye: Triple
    target: Triple
    fov_degrees: float
    size: int
    hair_melanin: float
    hair_redness: float
    hair_roughness: float
    hair_radius_root: float
    hair_radius_tip: float
    sun_direction: Triple
    sun_strength: float
    ambient: float
    skin_rgb: Triple
    max_bounces: int = 12


_RANGES: dict[str, tuple[float, float]] = {
    "fov_degrees": (0.1, 170.0),
    "size": (1, _MOST_PIXELS),
    "hair_melanin": (0.0, 1.0),
    "hair_redness": (0.0, 1.0),
    "hair_roughness": (0.01, 1.0),
    "hair_radius_root": (0.0, 0.01),
    "hair_radius_tip": (0.0, 0.01),
    "sun_strength": (0.0, 1e4),
    "ambient": (0.0, 1e4),
    "skin_rgb": (0.0, 1.0),
    "max_bounces": (1, 1e6),
}


def read_view(path: Path) -> StatedView:
    """The view in a JSON file; fields it does not know are passed over. Raises ParameterError, one line, or OSError."""
    try:
        stated = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ParameterError(f"{path.name} is no JSON file: {error}") from None
    if not isinstance(stated, dict):
        raise ParameterError(f"{path.name} holds no view: an object with eye, target and so on is expected")
    values: dict[str, Any] = {}
    for field in fields(StatedView):
        if field.name in stated:
            values[field.name] = _checked(path.name, field.name, stated[field.name], str(field.type))
        elif field.default is MISSING:
            raise ParameterError(f"{path.name} does not say {field.name}")
    view = StatedView(**values)
    if math.dist(view.eye, view.target) < _REQUIRED_DISTANCE:
        raise ParameterError(f"{path.name}: eye and target are the same place")
    if math.hypot(*view.sun_direction) < _REQUIRED_DISTANCE:
        raise ParameterError(f"{path.name}: sun_direction has no length")
    return view


def render_stated(strands: Path, heads: list[str], view: str | None, out: Path) -> None:
    """Draw strands in final quality. Raises ParameterError, HairFileError, HeadError, RenderError, OSError."""
    check_is_picture(out)
    if view is None:
        raise ParameterError("strands need --view FILE.json, which states camera, light and hair")
    stated = read_view(Path(view))
    scene = scene_of(file_strands(strands), [plain_mesh(head) for head in heads], stated)
    camera = perspective_view(np.array(stated.eye), np.array(stated.target), math.radians(stated.fov_degrees), 1.0)
    context = headless_context()
    with counting("drawing", 1) as bar:

        def progress(done: int, of: int) -> bool:
            bar.update(bar.task_ids[0], completed=done, total=of)
            return True

        picture = strand_picture(context, scene, camera, stated.size, progress=progress)
    if picture is not None:
        save_picture(shown(picture), out)
        say(str(out))


def scene_of(strands: Strands, meshes: list[TriangleMesh], stated: StatedView) -> StrandScene:
    """The scene that a view states."""
    place = np.arange(len(strands.points)) - np.repeat(strands.first[:-1], strands.counts)
    along = place / np.repeat(strands.counts - 1, strands.counts)
    radius = stated.hair_radius_root + along * (stated.hair_radius_tip - stated.hair_radius_root)
    sun = np.array(stated.sun_direction)
    red, green, blue = melanin_absorption(stated.hair_melanin, stated.hair_redness)
    return StrandScene(
        strands=replace(strands, radius=radius.astype(np.float32), colour=None),
        meshes=meshes,
        material=StrandMaterial(
            Fibre(stated.hair_roughness), (float(red), float(green), float(blue)), followed=followed(stated.max_bounces)
        ),
        diffuse=np.array(stated.skin_rgb),
        sun_direction=sun / np.linalg.norm(sun),
        sun=np.full(3, stated.sun_strength),
        sky=np.full(3, stated.ambient),
    )


def plain_mesh(path: str) -> TriangleMesh:
    """A mesh in a file, with one vertex at each place. Raises HeadError."""
    with working(f"reading {Path(path).name}"):
        soup = read_mesh(path)
        places, same = np.unique(soup.vertices, axis=0, return_inverse=True)
        return TriangleMesh(places, same.reshape(-1)[soup.faces])


def _checked(name: str, field: str, value: object, kind: str) -> Any:
    parts = value if kind == "Triple" and isinstance(value, list) else [value]
    if len(parts) != (3 if kind == "Triple" else 1):
        raise ParameterError(f"{name}: {field} is three numbers, got {value!r}")
    low, high = _RANGES.get(field, (-math.inf, math.inf))
    for part in parts:
        if isinstance(part, bool) or not isinstance(part, int | float) or not math.isfinite(part):
            raise ParameterError(f"{name}: {field} is no number: {part!r}")
        if not low <= part <= high:
            raise ParameterError(f"{name}: {field} lies between {low:g} and {high:g}, got {part!r}")
        if kind == "int" and part != int(part):
            raise ParameterError(f"{name}: {field} is a whole number, got {part!r}")
    numbers = [float(part) for part in parts if isinstance(part, int | float)]
    return tuple(numbers) if kind == "Triple" else int(numbers[0]) if kind == "int" else numbers[0]
