"""Hair in other programs' files: the ending of the name chooses the format."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ...wisp.strands import Strands
from . import cem_yuksel, numpy_points, obj_lines, ply_strands, rib_curves, tressfx, usc_data, usd_curves
from .contents import HairFileError

__all__ = ["READABLE", "WRITABLE", "HairFileError", "read_strands", "write_strands"]

_FORMATS = {
    ".hair": cem_yuksel,
    ".data": usc_data,
    ".npy": numpy_points,
    ".obj": obj_lines,
    ".ply": ply_strands,
    ".usda": usd_curves,
    ".rib": rib_curves,
    ".tfx": tressfx,
}
# usd-core reads these as well; writing stays text, which needs no library.
_ONLY_READ = {".usd": usd_curves, ".usdc": usd_curves, ".usdz": usd_curves}

READABLE = (*_FORMATS, *_ONLY_READ)
WRITABLE = tuple(_FORMATS)


def read_strands(
    path: Path, points_per_strand: int | None = None, remark: Callable[[str], None] = lambda line: None
) -> Strands:
    """All strands of a file, in the file's own unit and axes.

    points_per_strand: for files that hold bare points. ``remark`` is told in a line what was left out. Raises
    HairFileError for a file that cannot be used, OSError when there is no such file.
    """
    form = (_FORMATS | _ONLY_READ).get(path.suffix.lower())
    if form is None:
        raise HairFileError(f"{path}: hair is read from {_listed(READABLE)}")
    if form is ply_strands:
        return ply_strands.read(path, points_per_strand).checked(path, remark)
    return form.read(path).checked(path, remark)


def write_strands(strands: Strands, path: Path) -> None:
    """Write all strands [m], +Y up, to the format that the ending of ``path`` names. Raises HairFileError, OSError."""
    form = _FORMATS.get(path.suffix.lower())
    if form is None:
        raise HairFileError(f"{path}: hair is written to {_listed(WRITABLE)}")
    form.write(strands, path)


def _listed(suffixes: tuple[str, ...]) -> str:
    return ", ".join(suffixes[:-1]) + " or " + suffixes[-1]
