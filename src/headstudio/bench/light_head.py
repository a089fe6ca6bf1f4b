"""A head with fewer triangles, for measures that are given for so many."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..head.head import Expression, Head
from ..head.mesh import TriangleMesh
from ..render.detail import Surface, coarser

# As much of the skin as is left out [m]: what is left, with the coarsest furrows, comes to some 20,000 triangles.
_PIXEL = 0.002


def light_head(head: Head) -> Head:
    """The same head with only the triangles that show in pixels of 2 mm; its vertices are among those of the whole one."""
    skin = head.skin
    bare = np.zeros((len(skin.vertices), 0))
    faces = coarser(Surface(skin.faces, skin.vertices, skin.vertex_normals, bare), _PIXEL)
    kept = np.unique(faces)
    place = np.full(len(skin.vertices), -1)
    place[kept] = np.arange(len(kept))
    expressions = {
        name: Expression(place[unit.vertices[stays]], unit.offsets[stays])
        for name, unit in head.expressions.items()
        for stays in [place[unit.vertices] >= 0]
    }
    return replace(
        head,
        skin=TriangleMesh(skin.vertices[kept], place[faces]),
        expressions=expressions,
    )
