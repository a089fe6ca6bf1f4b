"""Where one can look into a surface that is not closed."""

from __future__ import annotations

import igl
import numpy as np

from ..head.mesh import Floats, TriangleMesh

# Smaller holes [m around] are where eyes and teeth sit, and show nothing of the inside.
_LEAST_PERIMETER = 0.3


class Openings:
    """The large holes of a mesh, such as where a bust ends, each as a plane through its rim."""

    def __init__(self, mesh: TriangleMesh) -> None:
        rims = [mesh.vertices[np.asarray(loop)] for loop in igl.boundary_loop_all(mesh.faces)]
        planes = [_plane(rim) for rim in rims if _perimeter(rim) >= _LEAST_PERIMETER]
        self._centres = np.array([centre for centre, _ in planes]).reshape(-1, 3)
        self._normals = np.array([normal for _, normal in planes]).reshape(-1, 3)

    def shown_to(self, eye: Floats) -> bool:
        """True if an eye at this place [m], (3,), stands outside of an opening and may see the inside through it."""
        return bool((np.einsum("ni,ni->n", eye - self._centres, self._normals) > 0).any())


def _perimeter(rim: Floats) -> float:
    return float(np.linalg.norm(rim - np.roll(rim, 1, axis=0), axis=1).sum())


def _plane(rim: Floats) -> tuple[Floats, Floats]:
    """Middle and unit normal of a closed curve (Newell). Along a rim the surface lies to the left, so the normal that
    the curve turns about points into the surface, and the outside is the other way."""
    middle = rim.mean(axis=0)
    normal = np.cross(rim - middle, np.roll(rim, -1, axis=0) - middle).sum(axis=0)
    return middle, -normal / np.linalg.norm(normal)
