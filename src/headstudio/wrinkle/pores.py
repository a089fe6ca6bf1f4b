"""Pores: dimples that keep a distance from one another. Not in the thesis."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from .drawing import Images
from .texels import Flags, TexelMap

# Of the largest pores: how far their centres are apart, in diameters.
_SPACING = 2.6
# Candidates for every place that there is: enough to leave no hole.
_CANDIDATES = 4
# Where pores are fewer they are smaller, too: the smallest are this part of the largest.
_SMALLEST = 0.45
# Spacings are sorted by size, so many sizes to twice a size.
_RANKS = 3
# Where pores are few their centres are at most this much farther apart, inverse.
_SPARSEST = 0.3


def dimples(
    texels: TexelMap, density: Floats, *, diameter: Floats, depth: float, rng: np.random.Generator
) -> NDArray[np.float32]:
    """Heights of pores over the skin, never positive [m], (size, size).

    density: at every vertex, 0 none to 1 as close as pores stand on a nose, (n,). diameter: of the largest at every
    vertex [texels], (n,). depth: of the largest [m].
    """
    height = np.zeros((texels.size, texels.size), dtype=np.float32)
    share = texels.spread(density.clip(0, 1)).ravel()
    widths = texels.spread(diameter).ravel()
    mapped = np.flatnonzero(texels.mapped)
    # As many candidates everywhere as there are places.
    wanted = share[mapped] / (_SPACING * widths[mapped]) ** 2
    count = int(_CANDIDATES * wanted.sum())
    if count == 0:
        return height
    drawn = np.searchsorted(np.cumsum(wanted), rng.random(count) * wanted.sum(), side="right")
    chosen = mapped[drawn.clip(max=len(mapped) - 1)]
    points = texels.centres(chosen) + rng.uniform(-0.5, 0.5, (count, 2))
    free = _keep_apart(points, _SPACING * widths[chosen] / np.sqrt(share[chosen]).clip(_SPARSEST, 1), texels)
    points, chosen = points[free], chosen[free]
    size = _SMALLEST + (1 - _SMALLEST) * share[chosen] * rng.uniform(0.5, 1.0, len(chosen))
    images = Images(height, np.zeros(height.shape, dtype=bool), texels.period)
    drawn_widths = size * widths[chosen]
    images.draw(points, np.zeros_like(points), drawn_widths, size * depth, drawn_widths, 0.0)
    return height


def _keep_apart(points: Floats, spacings: Floats, texels: TexelMap) -> Flags:
    """Which points stay, (k,), when each takes its place in turn unless one that did is too near.

    A point with no earlier one near it stays, and drives away the later ones near it; then the rule holds for those that
    are left. Each round only the pairs among these are looked at.
    """
    box = None
    if texels.period:
        # No distance around the image in y: a box so high that its ends are far apart.
        points = np.stack([points[:, 0] % texels.period, points[:, 1] + texels.size], axis=1)
        box = [texels.period, 4 * texels.size]
    everywhere = cKDTree(points, boxsize=box)
    # Points that keep about the same distance look for others together; of two it is the one that keeps more.
    ranks = np.floor(_RANKS * np.log2(spacings)).astype(np.int64)
    found = []
    for rank in np.unique(ranks):
        own = np.flatnonzero(ranks == rank)
        near = cKDTree(points[own], boxsize=box).sparse_distance_matrix(
            everywhere, spacings[own].max(), output_type="ndarray"
        )
        one, other = own[near["i"]], near["j"]
        close = (near["v"] < spacings[one]) & (one != other)
        found.append(np.stack([one[close], other[close]]))
    pairs: Ints = np.concatenate(found, axis=1)
    earlier, later = pairs.min(axis=0), pairs.max(axis=0)
    stays, undecided = np.zeros((2, len(points)), dtype=bool)
    undecided[:] = True
    while len(earlier):
        free = undecided.copy()
        free[later] = False
        stays |= free
        undecided &= ~free
        undecided[later[free[earlier]]] = False
        left = undecided[earlier] & undecided[later]
        earlier, later = earlier[left], later[left]
    return stays | undecided
