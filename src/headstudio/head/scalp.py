"""The scalp: the part of the skin that carries hair, and its map to the unit square.

Bando et al. 2006, section 3.2 and figure 2. u runs from the person's right (0) to the left (1), v from the forehead (0)
to the nape (1). The map from the skin to the square is phi, the way back is phi^-1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import length_maps
from .cut import cut_patch
from .hairline import default_curves, wreath
from .harmonic import map_to_square
from .head import Head, HeadError
from .locate import Locator, locator
from .mesh import Floats, TriangleMesh
from .refine import ShadedMesh, refine_near
from .scalp_curves import sample_curves
from .scalp_settings import GrayImage, ScalpSettings

# Edges longer than this are halved where the curves are cut [m], so that coarse heads get a clean hairline too.
_LARGEST_CUT_TRIANGLE = 0.008


@dataclass(frozen=True, eq=False)
class Scalp:
    """A disc of skin with coordinates (u, v) in the unit square.

    patch: the skin cut out along the curves, head frame [m]. uv: of its vertices, shape (n, 2). vertex_normals: the
    head's normals at its vertices, shape (n, 3). curves: the four sides of the cut in the order front, left, back,
    right, polylines on the skin [m], each of shape (k, 3), and controls: the points that led them. whorl: (u, v) of the
    whorl, shape (2,). length_map: L(u, v). notes: how the map was found, for ``headstudio inspect``.
    """

    patch: TriangleMesh
    uv: Floats
    vertex_normals: Floats
    curves: tuple[Floats, ...]
    controls: tuple[Floats, ...]
    whorl: Floats
    length_map: GrayImage
    notes: tuple[str, ...] = ()

    @property
    def area(self) -> float:
        """Area of the scalp [m^2]."""
        return float(self.patch.face_areas.sum())

    def points(self, uv: Floats) -> Floats:
        """phi^-1: points of the skin [m], (k, 3), at (u, v), (k, 2); outside the square the nearest point inside."""
        found, _ = self._square.nearest(uv)
        return found.blend(self.patch.vertices, self.patch.faces)

    def normals(self, uv: Floats) -> Floats:
        """Unit normals of the head, interpolated between its vertices, (k, 3), at (u, v), (k, 2)."""
        found, _ = self._square.nearest(uv)
        return _unit(found.blend(self.vertex_normals, self.patch.faces))

    def locate(self, points: Floats) -> Floats:
        """phi: (u, v), (k, 2), of the point of the scalp nearest to each of ``points`` [m], (k, 3)."""
        found, _ = self._skin.nearest(points)
        return found.blend(self.uv, self.patch.faces)

    def root_directions(self, uv: Floats, lie_down: float, stand_up: float) -> Floats:
        """Unit directions in which hair leaves the scalp, (k, 3), at (u, v), (k, 2): Bando et al. 2006, eq. 4.

        ``lie_down`` is w_t, ``stand_up`` is w_n. Hair leans away from the whorl; at the whorl itself it stands up.
        """
        normal = self.normals(uv)
        at_whorl = self.normals(self.whorl[None])[0]
        along = at_whorl - (normal @ at_whorl)[:, None] * normal
        return _unit(stand_up * normal - lie_down * along)

    def lengths(self, uv: Floats) -> Floats:
        """L(u, v) as a part of the longest hair, 0 to 1, (k,)."""
        return length_maps.sample(self.length_map, uv)

    def random_points(self, count: int, rng: np.random.Generator) -> Floats:
        """``count`` random (u, v), (count, 2), spread evenly over the skin (not over the square)."""
        shares = np.cumsum(self.patch.face_areas)
        faces = np.searchsorted(shares, rng.random(count) * shares[-1], side="right").clip(max=len(shares) - 1)
        root, part = np.sqrt(rng.random(count)), rng.random(count)
        weights = np.stack([1 - root, root * (1 - part), root * part], axis=1)
        return np.einsum("ij,ijk->ik", weights, self.uv[self.patch.faces[faces]])

    @cached_property
    def _square(self) -> Locator:
        return Locator(self.uv, self.patch.faces)

    @cached_property
    def _skin(self) -> Locator:
        return Locator(self.patch.vertices, self.patch.faces)


def grow_scalp(head: Head, settings: ScalpSettings) -> Scalp:
    """Cut the scalp out of the head's skin and map it to the square.

    A head on which a person's hairline gets lost has a wreath, and says so. Raises HeadError when the curves cannot be used:
    off the skin, not joined, crossing, or not around one piece of it.
    """
    given = tuple(np.array(points, dtype=np.float64) for points in settings.curves)
    if given:
        return _cut_out(head, given, settings)
    try:
        return _cut_out(head, default_curves(head), settings)
    except HeadError as lost:
        note = f"no hairline as a person's ({lost}): a wreath above the ears instead"
        return _cut_out(head, wreath(head), settings, (note,))


def _cut_out(head: Head, curves: Sequence[Floats], settings: ScalpSettings, notes: tuple[str, ...] = ()) -> Scalp:
    samples = sample_curves(curves, locator(head.skin))
    skin = refine_near(ShadedMesh(head.skin, head.skin.vertex_normals), np.concatenate(samples), _LARGEST_CUT_TRIANGLE)
    patch = cut_patch(skin, [locator(skin.mesh).nearest(sample)[0] for sample in samples])
    uv, method = map_to_square(patch)
    mesh = patch.disc.mesh
    return Scalp(
        patch=mesh,
        uv=uv,
        vertex_normals=patch.disc.normals,
        curves=tuple(mesh.vertices[side] for side in patch.sides),
        controls=tuple(curves),
        whorl=np.array([settings.whorl_u, settings.whorl_v]),
        length_map=settings.painted_lengths or length_maps.preset(settings.length_map),
        notes=(*notes, f"scalp: {1e4 * mesh.face_areas.sum():.0f} cm2 in {len(mesh.faces)} triangles, {method} map"),
    )


def _unit(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)
