"""A posed head as a mesh for other programs: OBJ, PLY or GLB, in metres."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import trimesh
from trimesh.exchange.ply import export_ply

from ..head.head import Part
from ..head.mesh import Floats, TriangleMesh

MESH_SUFFIXES = (".obj", ".ply", ".glb")


def write_head(skin: TriangleMesh, normals: Floats, parts: Sequence[Part], path: Path) -> None:
    """Write the skin with its normals, (n, 3), and the parts beside it; PLY, which knows one mesh only, gets all as one.

    Raises OSError.
    """
    pieces = {"skin": _piece(skin, normals)}
    for number, part in enumerate(parts):
        pieces[f"{part.kind}_{number}"] = _piece(part.mesh, part.mesh.vertex_normals)
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix.lower() == ".ply":
        path.write_bytes(export_ply(trimesh.util.concatenate(list(pieces.values())), vertex_normal=True))
    else:
        scene = trimesh.Scene()
        for name, piece in pieces.items():
            scene.add_geometry(piece, geom_name=name, node_name=name)
        scene.export(path, include_normals=True)


def _piece(mesh: TriangleMesh, normals: Floats) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, mesh.faces, vertex_normals=np.asarray(normals), process=False)
