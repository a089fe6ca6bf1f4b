"""How much of the sky a head hides from its own skin and parts, with its mouth shut and wide open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import moderngl
import numpy as np

from ..head.head import Head
from ..head.mesh import Floats
from .sky import hidden_from_sky

_IN_MOUTH = ("teeth", "tongue")


@dataclass(frozen=True, eq=False)
class HeadShade:
    """The part of the sky that is hidden, 0 to 1. skin: from every vertex of the skin whatever the mouth does, (n,).
    mouth: what of the rest a mouth that is shut hides, (n,). parts: from every vertex of each part."""

    skin: Floats
    mouth: Floats
    parts: Sequence[Floats]


def shade_of_head(context: moderngl.Context, rest: Head, wide: Head | None = None) -> HeadShade:
    """The shade of a head at ``rest``. wide: the same head with its mouth as wide open as it goes, if it opens: what is in
    a mouth is seen when that is open."""
    skin, *parts = _hidden(context, rest)
    if wide is None:
        return HeadShade(skin, np.zeros(len(skin)), parts)
    open_skin, *open_parts = _hidden(context, wide)
    always = np.minimum(skin, open_skin)
    mouth = (skin - always) / np.maximum(1.0 - always, 1e-9)
    shown = [seen if part.kind in _IN_MOUTH else own for part, own, seen in zip(rest.parts, parts, open_parts)]
    return HeadShade(always, mouth, shown)


def _hidden(context: moderngl.Context, head: Head) -> list[Floats]:
    meshes = [head.skin, *(part.mesh for part in head.parts)]
    points = np.concatenate([mesh.vertices for mesh in meshes])
    normals = np.concatenate([mesh.vertex_normals for mesh in meshes])
    hidden = hidden_from_sky(context, head.skin, points, normals)
    return np.split(hidden, np.cumsum([len(mesh.vertices) for mesh in meshes])[:-1])
