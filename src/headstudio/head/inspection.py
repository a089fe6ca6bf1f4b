"""What is in a mesh file, for someone who wonders why it loads as it does or why it does not."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .from_file import head_from_mesh
from .head import Head, HeadError
from .mesh import TriangleMesh
from .read import read_mesh
from .repair import Repairs, border_loops, face_components, non_manifold_edge_count, repair

_COARSE = 2_000
_HUGE = 500_000
_SMALL_HOLE = 3


@dataclass(frozen=True, eq=False)
class Inspection:
    """What was found in a mesh file.

    size: extents along the file's axes, in its unit, shape (3,). component_faces: triangles of every connected piece,
    the largest first. hole_edges: length of every open border in edges, the longest first. head: what was made of it,
    or None, and then ``reason`` says why, in a line. warnings: what may look or work badly, a line each.
    """

    name: str
    repairs: Repairs
    vertices: int
    faces: int
    size: tuple[float, float, float]
    component_faces: tuple[int, ...]
    hole_edges: tuple[int, ...]
    non_manifold_edges: int
    head: Head | None
    reason: str
    warnings: tuple[str, ...]

    @property
    def usable(self) -> bool:
        """Whether the file gives a head."""
        return self.head is not None

    def rows(self) -> list[tuple[str, str]]:
        """Everything as rows of a label and a text; labels of several rows in turn are only in the first."""
        loops = _listed(self.hole_edges, "edges")
        rows = [
            ("in the file", f"{self.repairs.vertices_in_file:,} vertices, {self.repairs.faces_in_file:,} triangles"),
            *_labelled("repaired", self.repairs.lines() or ["nothing to repair"]),
            ("surface", f"{self.vertices:,} vertices, {self.faces:,} triangles"),
            ("size", " x ".join(f"{extent:.4g}" for extent in self.size) + " in the file's unit"),
            ("components", f"{len(self.component_faces)}: {_listed(self.component_faces, 'triangles')}"),
            ("holes", f"{len(self.hole_edges)} open borders: {loops}" if self.hole_edges else "none: closed"),
            ("non-manifold edges", f"{self.non_manifold_edges:,}"),
        ]
        if self.head is not None:
            rows += _labelled("head", list(self.head.notes[1 + len(self.repairs.lines()) :]))
        else:
            rows.append(("not usable", self.reason))
        return rows + _labelled("warning", list(self.warnings))

    def lines(self) -> list[str]:
        """The rows as plain text."""
        width = max(len(label) for label, _ in self.rows())
        return [f"{label:<{width}}  {text}" for label, text in self.rows()]


def inspect_head(path: str | Path) -> Inspection:
    """Look into a mesh file, also into one that gives no head.

    Raises HeadError, one line for the user, when the file cannot be read at all.
    """
    mesh, repairs = repair(read_mesh(path))
    head, reason = None, ""
    try:
        head = head_from_mesh(mesh, repairs, Path(path))
    except HeadError as error:
        reason = str(error)
    holes = tuple(len(loop) for loop in border_loops(mesh.faces))
    components = tuple(int(count) for count in np.sort(np.bincount(face_components(mesh.faces)))[::-1])
    broken_edges = non_manifold_edge_count(mesh.faces)
    return Inspection(
        name=Path(path).name,
        repairs=repairs,
        vertices=len(mesh.vertices),
        faces=len(mesh.faces),
        size=_size(mesh),
        component_faces=components,
        hole_edges=holes,
        non_manifold_edges=broken_edges,
        head=head,
        reason=reason,
        warnings=tuple(_warnings(mesh, head, holes, broken_edges)),
    )


def _size(mesh: TriangleMesh) -> tuple[float, float, float]:
    x, y, z = np.ptp(mesh.bounds, axis=0) if len(mesh.vertices) else np.zeros(3)
    return float(x), float(y), float(z)


def _warnings(mesh: TriangleMesh, head: Head | None, holes: tuple[int, ...], broken_edges: int) -> list[str]:
    warnings = []
    if len(mesh.faces) > _HUGE:
        warnings.append(f"{len(mesh.faces):,} triangles are slow to work with: reduce them below {_HUGE:,}")
    if broken_edges:
        warnings.append(f"{broken_edges:,} edges have more than two triangles: the surface is torn apart there")
    tears = sum(1 for hole in holes if hole <= _SMALL_HOLE)
    if tears:
        warnings.append(f"{tears} holes of one triangle each")
    if head is None:
        return warnings
    if len(head.skin.faces) < _COARSE:
        warnings.append(f"the head has only {len(head.skin.faces):,} triangles: its outline will be angular")
    if not any(part.kind == "eye" for part in head.parts):
        warnings.append("no eyeballs found: the eyes stay part of the skin, or empty")
    above = [loop for loop in border_loops(head.skin.faces) if _on_the_skull(head, loop)]
    if above:
        warnings.append(f"{len(above)} holes in the skull: hair over them has no root")
    return warnings


def _on_the_skull(head: Head, loop: np.ndarray) -> bool:
    """Whether an open border lies above the brows and behind the forehead."""
    middle = head.skin.vertices[loop].mean(axis=0)
    return bool(middle[1] > head.landmarks.glabella[1] and middle[2] < head.landmarks.hairline[2])


def _listed(numbers: tuple[int, ...], what: str) -> str:
    shown = ", ".join(f"{number:,}" for number in numbers[:6])
    more = f" and {len(numbers) - 6:,} smaller" if len(numbers) > 6 else ""
    return f"{shown}{more} {what}"


def _labelled(label: str, texts: list[str]) -> list[tuple[str, str]]:
    return [(label if k == 0 else "", text) for k, text in enumerate(texts)]
