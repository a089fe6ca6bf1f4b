"""Eyes, teeth, tongue, lashes: what moves with the head and is no skin."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np

from ..head.head import Head, Part
from ..head.mesh import Floats
from ..scene.settings import Look
from .buffers import bytes_of, floats_of
from .context import set_uniforms
from .detail import Surface
from .detailed_faces import DetailedFaces
from .scene_block import linear
from .skin_paint import dental_arch, gums, standing_out
from .view import View

# How part.frag tells the parts apart.
_KINDS = {"eye": 0, "teeth": 1, "tongue": 2, "lashes": 3, "brows": 3, "other": 4}
_HAIRS = ("lashes", "brows")


class BodyParts:
    """The parts of one head; what is painted on them is found on the head at rest, once."""

    def __init__(
        self, context: moderngl.Context, program: moderngl.Program, head: Head, hidden: Sequence[Floats]
    ) -> None:
        """hidden: of the sky, of every vertex of each part, see ``HeadShade``."""
        self._program = program
        self._shown = list(head.parts)
        details = [_detail(head, part) for part in head.parts]
        surfaces = [
            Surface(part.mesh.faces, part.mesh.vertices, part.mesh.vertex_normals, detail)
            for part, detail in zip(head.parts, details)
        ]
        self._faces = [DetailedFaces(context, surface) for surface in surfaces]
        self._levels = [-1] * len(head.parts)
        self._surfaces = [context.buffer(floats_of(_surface(part))) for part in head.parts]
        self._arrays = [
            context.vertex_array(
                program,
                [
                    (surface, "3f 3f", "position", "normal"),
                    (context.buffer(bytes_of(np.column_stack([dark, detail]))), "4f1", "paint"),
                ],
                faces.buffer,
            )
            for surface, dark, detail, faces in zip(self._surfaces, hidden, details, self._faces)
        ]
        # Lashes are translucent, and so the last.
        self._order = sorted(range(len(head.parts)), key=lambda k: _KINDS[head.parts[k].kind] == _KINDS["lashes"])

    def move(self, parts: Sequence[Part]) -> None:
        """Show the parts as they are now; one that is the same object as before is not sent again."""
        for k, part in enumerate(parts):
            if part is not self._shown[k]:
                self._surfaces[k].write(floats_of(_surface(part)))
                self._shown[k] = part

    def look_from(self, view: View, shift: Floats, height: int) -> None:
        """Be as detailed as the next picture needs, ``height`` pixels high, of the head moved by ``shift`` [m], (3,)."""
        self._levels = [
            # Hairs are few triangles, and thinner than any pixel.
            -1 if part.kind in _HAIRS else faces.level_for(view, shift, height)
            for part, faces in zip(self._shown, self._faces)
        ]

    def draw(self, look: Look) -> None:
        """Into the framebuffer in use; texture 0 is the shadow map, 1 the light map."""
        set_uniforms(
            self._program,
            shadow_map=0,
            light_map=1,
            skin_colour=tuple(linear(look.skin_colour)),
            hair_colour=tuple(linear(look.hair_colour)),
            iris_colour=tuple(linear(look.iris_colour)),
        )
        for k in self._order:
            self._draw_part(k)

    def _draw_part(self, k: int) -> None:
        part = self._shown[k]
        kind = part.kind
        if part.centre is not None and part.axis is not None:
            set_uniforms(self._program, ball=(*part.centre.tolist(), part.radius), pupil=tuple(part.axis.tolist()))
        elif kind == "eye":
            kind = "other"
        set_uniforms(self._program, kind=_KINDS[kind])
        self._faces[k].render(self._arrays[k], self._levels[k])


def _detail(head: Head, part: Part) -> Floats:
    """What else the shader must know of a part, 0 to 1, (n, 3): where a vertex is along a row of teeth, or along a hair;
    how far it is gum; and nothing."""
    none = np.zeros(len(part.mesh.vertices))
    if part.kind != "teeth":
        return np.column_stack([standing_out(head, part), none, none])
    level = np.mean([each.mesh.vertices[:, 1].mean() for each in head.parts if each.kind == "teeth"])
    upper = bool(part.mesh.vertices[:, 1].mean() > level)
    return np.column_stack([dental_arch(part.mesh), gums(part.mesh, upper), none])


def _surface(part: Part) -> Floats:
    return np.concatenate([part.mesh.vertices, part.mesh.vertex_normals], axis=1)
