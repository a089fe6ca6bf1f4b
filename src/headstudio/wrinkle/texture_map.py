"""A body part laid out in texture space (Bando's thesis, section 2.4)."""

from __future__ import annotations

from dataclasses import dataclass

from ..head.mesh import Floats, TriangleMesh


@dataclass(frozen=True, eq=False)
class TextureMap:
    """A mesh and where its vertices lie in the unit square.

    mesh: the body part at rest [m], n vertices, m triangles. uv: of every vertex, in [0, 1), (n, 2). corner_uv: of every
    corner, (m, 3, 2); the same as ``uv`` except in triangles that cross the seam of a cylindrical map, whose corners left
    of the seam have 1 added to u: so every triangle is whole, and u wraps around. metres: edge of the unit square on the
    skin, so that d [m] on the skin is about d / metres in the square. wrapped: whether u wraps around.
    note: how the map was found, for the user.
    """

    mesh: TriangleMesh
    uv: Floats
    corner_uv: Floats
    metres: float
    wrapped: bool
    note: str = ""
