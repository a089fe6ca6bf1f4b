"""The cross section of a groove in a scan, and the strands of a furrow that come nearest to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats
from .cross_profile import Strands
from .shape import bounded_shape

# The section is taken at distances this far apart, to so many widths on either side, within limits [m].
_SPACING, _WIDTHS, _NEAREST, _FARTHEST = 4e-4, 8.0, 8e-3, 28e-3
# Fewer texels than this at a distance do not count.
_FEWEST = 6
# Fewer distances than this tell nothing.
_FEWEST_PLACES = 12
# Where a groove is at least this part of its depth it shows its section.
_WHOLE = 0.8
# Strands that are tried: widths [m], how far apart in widths but not nearer than [m], and how far from the curve [m].
_STRAND_WIDTHS = tuple(0.6e-3 * 2 ** (k / 2) for k in range(10))
_APART, _NEAREST_APART, _FARTHEST_OFFSET = 0.5, 5e-4, 12e-3
# No more pairs than this, and only as long as one lowers the misfit by this part.
_MOST, _WORTH = 8, 0.04
# Depths count a little by themselves, so that strands do not cancel each other out.
_RIDGE = 2e-2


@dataclass(frozen=True, eq=False)
class CrossSection:
    """Heights square to a groove. across: to the left [m], (n,). height: [m], (n,). weight: how much each counts, (n,)."""

    across: Floats
    height: Floats
    weight: Floats


def cross_section(
    across: Floats, height: Floats, others: Floats, wholeness: Floats, clear: float, width: float
) -> CrossSection:
    """The median section of texels beside a groove, (i,) each, where it is whole.

    height: of the scan. others: what other grooves make there [m]; where that is more than ``clear``, nothing is
    seen. wholeness: how much of the groove is there at each. width: of the groove [m].
    """
    reach = float(np.clip(_WIDTHS * width, _NEAREST, _FARTHEST))
    kept = (wholeness > _WHOLE) & (np.abs(across) < reach) & np.isfinite(height)
    kept &= np.abs(others) <= clear
    height = (height - others) / np.maximum(wholeness, _WHOLE)
    place = np.rint(across[kept] / _SPACING).astype(np.int64)
    order = np.lexsort((height[kept], place))
    places, first, count = np.unique(place[order], return_index=True, return_counts=True)
    middle = first + count // 2
    enough = count >= _FEWEST
    at = np.asarray(places * _SPACING, dtype=np.float64)
    return CrossSection(at[enough], height[kept][order][middle][enough], np.sqrt(count[enough] / count.max(initial=1)))


def strands_for(section: CrossSection, width: float) -> Strands:
    """Strands that come near a section, in widths of ``width`` [m], depths in metres; none where too little is seen.

    The strand, or pair on both sides, that lowers the misfit most is added to those that are there until none lowers it
    much: orthogonal matching pursuit (Pati and others 1993).
    """
    if len(section.across) < _FEWEST_PLACES:
        return ()
    tried = _tried()
    columns = np.stack([sum(_strand(section.across, o, v) for o in offsets) for offsets, v in tried], axis=1)
    columns, target = section.weight[:, None] * columns, section.weight * section.height
    gram, pull = columns.T @ columns, columns.T @ target
    gram[np.diag_indices_from(gram)] += _RIDGE
    chosen: list[int] = []
    misfit, depths = float(target @ target), np.zeros(0)
    while len(chosen) < _MOST:
        best = min(
            ((_misfit(gram, pull, [*chosen, k], target), k) for k in range(len(tried)) if k not in chosen),
        )
        if best[0] > (1.0 - _WORTH) ** 2 * misfit:
            break
        misfit = best[0]
        chosen.append(best[1])
        depths = np.linalg.solve(gram[np.ix_(chosen, chosen)], pull[chosen])
    return tuple(
        (offset / width, float(depth), tried[k][1] / width)
        for k, depth in zip(chosen, depths)
        for offset in tried[k][0]
    )


def _tried() -> list[tuple[tuple[float, ...], float]]:
    """Strands and pairs of them: offsets and width [m]."""
    tried: list[tuple[tuple[float, ...], float]] = []
    for width in _STRAND_WIDTHS:
        tried.append(((0.0,), width))
        step = max(_APART * width, _NEAREST_APART)
        for offset in np.arange(step, _FARTHEST_OFFSET, step):
            tried += [((float(offset), -float(offset)), width), ((float(offset),), width), ((-float(offset),), width)]
    return tried


def _strand(across: Floats, offset: float, width: float) -> Floats:
    return bounded_shape(np.abs(across - offset), 1.0, width)


def _misfit(gram: Floats, pull: Floats, chosen: list[int], target: Floats) -> float:
    own = pull[chosen]
    return float(target @ target - own @ np.linalg.solve(gram[np.ix_(chosen, chosen)], own))
