"""Wrinkles over several body parts: Bando's thesis, section 2.6.4.

Two parts share a strip of skin. What was carved on it in the one is copied to the other, furrows that leave the one grow
on in the other, and no furrow of the other enters the strip: so both show the same skin there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from ..head.mesh import Floats, Ints
from .body_part import BodyPart
from .carving import CarvedField
from .segments import Segments
from .texels import Flags, TexelMap
from .texture_map import TextureMap


@dataclass(frozen=True, eq=False)
class SharedSkin:
    """Triangles that two body parts have in common, with their corners in the same order.

    first: in the part that was carved first, second: in the other, both (k,), second ascending.
    """

    first: Ints
    second: Ints

    @staticmethod
    def of_parts(first: BodyPart, second: BodyPart) -> SharedSkin:
        """The triangles that two parts of one skin share. Raises ValueError when there are none."""
        _, in_first, in_second = np.intersect1d(first.faces, second.faces, return_indices=True)
        if len(in_first) == 0:
            raise ValueError("these body parts share no skin")
        order = np.argsort(in_second)
        return SharedSkin(in_first[order], in_second[order])

    def strip(self, texels: TexelMap) -> Flags:
        """The texels of the second part that lie on the shared skin, (size, size)."""
        return np.isin(texels.triangle, self.second)

    def copied(self, image: NDArray[np.float32], first: TexelMap, second: TexelMap) -> NDArray[np.float32]:
        """An image of the first part at the texels of the strip in the second, row after row, (k,)."""
        texels = np.flatnonzero(self.strip(second))
        triangle = second.triangle.ravel()[texels]
        weights = second.weights(triangle, second.centres(texels))
        corners = first.map.corner_uv[self.first[np.searchsorted(self.second, triangle)]]
        place = np.einsum("ki,kij->jk", weights, corners) * first.size - 0.5
        if first.period:
            # One column more on both sides, so that the last and the first are neighbours.
            image = np.pad(image, ((0, 0), (1, 1)), mode="wrap")
            place[0] = place[0] % first.period + 1
        return map_coordinates(image, place[::-1], order=1, mode="nearest")

    def vectors(self, vectors: Floats, first: TextureMap, second: TextureMap) -> tuple[Ints, Floats]:
        """The shared vertices in the second part, (s,), and what ``vectors`` of the first, (n, 2), are there, (s, 2)."""
        vertices, corner = np.unique(second.mesh.faces[self.second], return_index=True)
        triangle = corner // 3
        theirs = vectors[first.mesh.faces[self.first].ravel()[corner]]
        turned = _carried(theirs, first.corner_uv[self.first[triangle]], second.corner_uv[self.second[triangle]])
        length = np.linalg.norm(turned, axis=1, keepdims=True)
        magnitude = np.linalg.norm(theirs, axis=1, keepdims=True)
        return vertices, turned * magnitude / np.where(length == 0, 1.0, length)

    def onward(self, carved: CarvedField, second: TexelMap) -> Segments | None:
        """The segments with which furrows of the first part leave it across the strip, in the second; None if none do."""
        first, segments = carved.texels, carved.segments
        home = first.triangle_at(segments.starts)
        leaves = (segments.reach == 1) & np.isin(home, self.first) & (first.triangle_at(segments.ends) < 0)
        leaving, home = segments[leaves], home[leaves]
        if len(leaving) == 0:
            return None
        order = np.argsort(self.first)
        match = order[np.searchsorted(self.first, home, sorter=order)]
        theirs, mine = first.map.corner_uv[home], second.map.corner_uv[self.second[match]]
        start = (first.weights(home, leaving.starts)[:, :, None] * mine).sum(axis=1) * second.size
        step = _carried(leaving.steps / first.size, theirs, mine) * second.size
        into = second.triangle_at(start + step) >= 0
        return Segments(
            starts=start,
            steps=step,
            reach=leaving.reach,
            furrows=leaving.furrows,
            sides=leaving.sides,
            order=leaving.order,
            left=leaving.left,
            directions=_carried(leaving.directions, theirs, mine),
            magnitudes=leaving.magnitudes,
            units=leaving.units * np.linalg.norm(step, axis=1) / np.linalg.norm(leaving.steps, axis=1),
        )[into]


def _carried(vectors: Floats, first: Floats, second: Floats) -> Floats:
    """Vectors in triangles ``first``, (k, 3, 2), as they lie in triangles ``second``, (k, 3, 2): (k, 2)."""
    edges = first[:, 1:] - first[:, :1]
    carry = np.linalg.solve(edges, second[:, 1:] - second[:, :1])
    return np.einsum("ki,kij->kj", vectors, carry)
