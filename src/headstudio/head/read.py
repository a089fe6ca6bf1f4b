"""Reading a mesh file as it is, before anything is repaired."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh

from .head import HeadError
from .mesh import Floats, Ints

FORMATS = (".obj", ".ply", ".stl", ".off", ".glb")


@dataclass(frozen=True, eq=False)
class TriangleSoup:
    """What a mesh file holds, in its own unit and axes.

    vertices: shape (n, 3). faces: shape (m, 3). corner_uv: shape (m, 3, 2), or None when no part has any.
    """

    vertices: Floats
    faces: Ints
    corner_uv: Floats | None

    def with_(self, other: TriangleSoup) -> TriangleSoup:
        """Both in one list, this one first."""
        uvs = [
            np.zeros((len(each.faces), 3, 2)) if each.corner_uv is None else each.corner_uv for each in (self, other)
        ]
        return TriangleSoup(
            np.concatenate([self.vertices, other.vertices]),
            np.concatenate([self.faces, other.faces + len(self.vertices)]),
            None if self.corner_uv is None else np.concatenate(uvs),
        )


def read_mesh(path: str | Path) -> TriangleSoup:
    """All triangles of an OBJ, PLY, STL, OFF or GLB file, in one list.

    Raises HeadError, one line for the user, when there is no such file, its ending is another one, it is damaged, it
    has no triangles or some of its coordinates are no numbers.
    """
    path = Path(path)
    name = path.name or str(path)
    if path.suffix.lower() not in FORMATS:
        endings = ", ".join(ending[1:].upper() for ending in FORMATS)
        known = "makehuman, mannequin or a mesh file"
        raise HeadError(f"{name!r} is no head: give {known} ({endings})")
    if not path.exists():
        raise HeadError(f"there is no file {path}")
    if not path.is_file():
        raise HeadError(f"{path} is no file")
    try:
        data_size = path.stat().st_size
        scene = trimesh.load_scene(path, process=False) if data_size else trimesh.Scene()
        pieces = scene.dump() if data_size else []
    except OSError as error:
        raise HeadError(f"{path} cannot be read: {error.strerror or error}") from None
    # A damaged file makes the parsers fail in whatever way the damage happens to reach: any of it means the same here.
    except Exception as error:
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise HeadError(f"{name} is damaged or no {path.suffix[1:].upper()} file ({reason}): export it again") from None
    if not data_size:
        raise HeadError(f"{name} is empty: export it again")
    return _joined(name, pieces)


def _joined(name: str, pieces: list) -> TriangleSoup:
    meshes = [piece for piece in pieces if isinstance(piece, trimesh.Trimesh) and len(piece.faces)]
    if not meshes:
        found = sum(len(getattr(piece, "vertices", ())) for piece in pieces)
        points = f"{found:,} points but no faces" if found else "no faces"
        raise HeadError(f"{name} holds {points}: export a surface made of polygons")
    starts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes])
    vertices = np.concatenate([np.asarray(mesh.vertices, dtype=np.float64) for mesh in meshes])
    faces = np.concatenate([np.asarray(mesh.faces, dtype=np.int64) + start for mesh, start in zip(meshes, starts)])
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise HeadError(f"{name} is damaged: a face names a vertex that is not there; export it again")
    broken = np.unique(faces[~np.isfinite(vertices[faces]).all(axis=2)])
    if len(broken):
        bad = int((~np.isfinite(vertices[broken]).all(axis=1)).sum())
        raise HeadError(
            f"{name} has {bad:,} of {len(vertices):,} vertices whose coordinates are not finite numbers: export it again"
        )
    uvs = [_corner_uv(mesh) for mesh in meshes]
    if all(uv is None for uv in uvs):
        return TriangleSoup(vertices, faces, None)
    filled = [np.zeros((len(mesh.faces), 3, 2)) if uv is None else uv for mesh, uv in zip(meshes, uvs)]
    return TriangleSoup(vertices, faces, np.concatenate(filled))


def _corner_uv(mesh: trimesh.Trimesh) -> Floats | None:
    uv = getattr(mesh.visual, "uv", None)
    if uv is None or len(uv) != len(mesh.vertices):
        return None
    return np.nan_to_num(np.asarray(uv, dtype=np.float64)[:, :2])[mesh.faces]
