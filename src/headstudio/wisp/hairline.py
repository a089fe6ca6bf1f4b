"""A hairline is no edge: toward the border of the scalp hair is finer and sparser, here more and there less."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp
from ..head.scalp_curves import SPACING
from ..head.smooth import smoothstep
from .strands import Singles

_FINEST = 0.2  # of a shaft at the border, as a part of its thickness elsewhere
_SPARSEST = 0.12  # hair at the border, as a part of its density elsewhere
_NAPE = 2.0  # at the nape hair thins out over so many times the breadth
# Waves whose lengths never meet let the line wander [m], by a part of its breadth; hairs stray from it by another.
_WAVES, _WANDER, _STRAY = (0.0037, 0.0061, 0.0113), 0.35, 0.5


def fineness(scalp: Scalp, roots: Floats, breadth: float, seed: int) -> Singles:
    """The thickness of strands rooted at ``roots`` [m], (S, 3), as a part of what it is far from the border, (S,).

    breadth: over which it rises from the border inward [m]; 0 makes all strands alike.
    """
    near, within = _within(scalp, roots, breadth)
    stray = 2.0 * np.random.default_rng([seed, 6]).random(len(roots))[near] - 1.0
    fine = np.ones(len(roots), dtype=np.float32)
    fine[near] = _FINEST + (1.0 - _FINEST) * smoothstep(within + _STRAY * stray)
    return fine


def thinning(scalp: Scalp, places: Floats, breadth: float) -> Floats:
    """The density of hair at ``places`` of the scalp [m], (n, 3), as a part of what it is far from the border, (n,).

    breadth: as for ``fineness``.
    """
    near, within = _within(scalp, places, breadth)
    density = np.ones(len(places))
    density[near] = _SPARSEST + (1.0 - _SPARSEST) * smoothstep(within)
    return density


def _within(scalp: Scalp, places: Floats, breadth: float) -> tuple[Ints, Floats]:
    """Which of ``places`` are near to the hairline, (k,), and how far within it they are, as a part of its breadth, (k,)."""
    if breadth <= 0 or len(places) == 0:
        return np.zeros(0, dtype=np.int64), np.zeros(0)
    front, left, back, right = scalp.curves
    within = np.full(len(places), np.inf)
    for curves, stretch in (((front, left, right), breadth), ((back,), _NAPE * breadth)):
        # Between points of the border a place is nearer to the line than to them by half their distance at most.
        tree = cKDTree(np.concatenate(curves))
        distance, _ = tree.query(places, distance_upper_bound=2.0 * stretch + SPACING, workers=-1)
        np.minimum(within, distance / stretch, out=within)
    near = np.flatnonzero(np.isfinite(within))
    wander = sum(np.sin(places[near] / wave).sum(axis=1) for wave in _WAVES) / (3 * len(_WAVES))
    return near, within[near] + _WANDER * wander
