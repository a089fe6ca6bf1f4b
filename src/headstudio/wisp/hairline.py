"""A hairline is no edge: toward the border of the scalp hair is finer, here more and there less."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats
from ..head.scalp import Scalp
from ..head.scalp_curves import SPACING
from .strands import Singles

_FINEST = 0.2  # of a shaft at the border, as a part of its thickness elsewhere
# Waves whose lengths never meet let the line wander [m], by a part of its breadth; hairs stray from it by another.
_WAVES, _WANDER, _STRAY = (0.0037, 0.0061, 0.0113), 0.35, 0.5


def fineness(scalp: Scalp, roots: Floats, breadth: float, seed: int) -> Singles:
    """The thickness of strands rooted at ``roots`` [m], (S, 3), as a part of what it is far from the border, (S,).

    breadth: over which it rises from the border inward [m]; 0 makes all strands alike.
    """
    full = np.ones(len(roots), dtype=np.float32)
    if breadth <= 0 or len(roots) == 0:
        return full
    border = np.concatenate(scalp.curves)
    # Between points of the border a root is nearer to the line than to them by half their distance at most.
    distance, _ = cKDTree(border).query(roots, distance_upper_bound=2.0 * breadth + SPACING, workers=-1)
    near = np.flatnonzero(np.isfinite(distance))
    wander = sum(np.sin(roots[near] / wave).sum(axis=1) for wave in _WAVES) / (3 * len(_WAVES))
    stray = 2.0 * np.random.default_rng([seed, 6]).random(len(roots))[near] - 1.0
    part = np.clip(distance[near] / breadth + _WANDER * wander + _STRAY * stray, 0.0, 1.0)
    full[near] = _FINEST + (1.0 - _FINEST) * part * part * (3.0 - 2.0 * part)
    return full
