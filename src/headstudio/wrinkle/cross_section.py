"""The cross section of a groove in a scan, and the furrows side by side that come nearest to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from ..head.mesh import Floats
from .groove import Strand
from .shape import bounded_shape

# The section is taken at distances this far apart, to so many widths on either side, within limits [m].
_SPACING, _WIDTHS, _NEAREST, _FARTHEST = 4e-4, 5.0, 8e-3, 16e-3
# Fewer texels than this at a distance do not count.
_FEWEST = 6
# Fewer distances than this tell nothing.
_FEWEST_PLACES = 12
# Where a groove is at least this part of its depth it shows its section.
_WHOLE = 0.85
# Within this [m] of the curve differences count so many times.
_DENSE = (3e-3, 1.8)
# Differences beyond this [m] count by their size, below by their square.
_NOISE = 1e-4
_POWER = 6.0
# What one more unknown has to gain, as a part of the misfit.
_WORTH = 0.02
_DEPTH_PARTS, _WIDTHS_OF_STRAND, _FARTHEST_OFFSET = (5e-3, 6.0), (1.2e-3, 4e-3), 8e-3
_ROUNDS = 60

# Ways to begin: pairs (both sides of the curve) and single strands, each as (depth, width, offset) over d and w of the
# one furrow that fits best; offset 0 for a single one.
_BEGINNINGS: tuple[tuple[tuple[float, float, float], ...], ...] = (
    ((1.0, 1.0, 0.0),),
    ((0.8, 0.6, 0.25),),
    ((0.8, 0.5, 0.5),),
    ((0.8, 0.6, 0.25), (0.3, 1.5, 0.0)),
    ((0.8, 0.5, 0.5), (0.5, 0.6, 0.0)),
    ((0.8, 0.6, 0.25), (0.2, 0.8, 1.2)),
    ((0.8, 0.6, 0.25), (0.15, 0.8, 2.0)),
)
# What lies lower all around does so by at most this part of the depth.
_DEEPEST_BASE = 0.4


@dataclass(frozen=True, eq=False)
class CrossSection:
    """Heights square to a groove. across: to the left [m], (n,). height: [m], (n,). weight: how much each counts, (n,)."""

    across: Floats
    height: Floats
    weight: Floats


def cross_section(
    across: Floats,
    height: Floats,
    others: Floats,
    wholeness: Floats,
    clear: float,
    strand: Strand,
    upright: Floats,
) -> CrossSection:
    """The median section of texels beside a groove that ``strand`` comes near, (i,) each.

    height: of the scan. others: what other grooves make there [m]; where that is more than ``clear``, nothing is
    seen. wholeness: how much of the groove is there at each. upright: see groove_fit.py.
    """
    reach = float(np.clip(_WIDTHS * strand.width, _NEAREST, _FARTHEST))
    kept = (wholeness > _WHOLE) & (np.abs(across) < reach) & np.isfinite(height)
    kept &= np.abs(others) <= clear
    height = height - others
    place = np.rint(across[kept] / _SPACING).astype(np.int64)
    order = np.lexsort((height[kept], place))
    places, first, count = np.unique(place[order], return_index=True, return_counts=True)
    middle = first + count // 2
    enough = count >= _FEWEST
    # The wrinkled mesh has more vertices at the floors of furrows: what they miss counts more.
    steepness = np.zeros(len(places))
    if len(places):
        steepness = np.bincount(place - places[0], upright[kept])[places - places[0]] / count
    at = np.asarray(places * _SPACING, dtype=np.float64)
    distances = np.abs(at)
    density = np.where(distances < _DENSE[0], _DENSE[1], 1.0)
    return CrossSection(at[enough], height[kept][order][middle][enough], (density * steepness)[enough])


def strands_for(section: CrossSection, strand: Strand) -> tuple[Strand, ...]:
    """The fewest furrows side by side that come near a section, beginning from the one that does so alone.

    By (2.1) a furrow raises as much as it lowers; a groove that is deeper than its rims are high leaves its surroundings
    lower on the whole. How much is found with the furrows and left out of them.
    """
    if len(section.across) < _FEWEST_PLACES:
        return (strand,)
    found: list[tuple[float, tuple[Strand, ...]]] = []
    for beginning in _BEGINNINGS:
        pairs = tuple(offset > 0 for _, _, offset in beginning)
        low, high = _limits(pairs, strand)
        start = [[np.log(d * strand.depth), np.log(w * strand.width), o * strand.width] for d, w, o in beginning]
        values = np.append(np.array(start).ravel(), -_NOISE)

        def misfit(values: Floats, pairs: tuple[bool, ...] = pairs) -> Floats:
            return section.weight * (section.height - _height(section.across, values, pairs))

        # By squares first, which leads farther; then by sizes, so that a few places that do not belong do not pull.
        for loss, scale in (("linear", 1.0), ("soft_l1", 2 * _NOISE)):
            values = least_squares(
                misfit,
                np.clip(values, low + 1e-9, high - 1e-9),
                bounds=(low, high),
                x_scale=np.append(np.tile([0.3, 0.3, 1e-3], len(pairs)), 1e-4),
                loss=loss,
                f_scale=scale,
                max_nfev=_ROUNDS,
            ).x
        cost = float(np.sqrt(misfit(values) ** 2 + _NOISE**2).sum())
        unknowns = sum(3 if pair else 2 for pair in pairs)
        found.append((cost * (1.0 + _WORTH) ** unknowns, _strands(values[:-1], pairs)))
    return min(found, key=lambda each: each[0])[1]


def _limits(pairs: tuple[bool, ...], strand: Strand) -> tuple[Floats, Floats]:
    depths = np.log(np.array(_DEPTH_PARTS) * strand.depth)
    widths = np.log(_WIDTHS_OF_STRAND)
    low = [[depths[0], widths[0], 0.0 if pair else -1e-5] for pair in pairs]
    high = [[depths[1], widths[1], _FARTHEST_OFFSET if pair else 1e-5] for pair in pairs]
    return np.append(low, -_DEEPEST_BASE * strand.depth - 2e-9), np.append(high, 2e-9)


def _height(across: Floats, values: Floats, pairs: tuple[bool, ...]) -> Floats:
    """Heights of strands, and a base that is joined with them as a broad furrow would be."""
    total, powers = np.zeros_like(across), np.full_like(across, max(-values[-1], 0.0) ** _POWER)
    for strand in _strands(values[:-1], pairs):
        height = bounded_shape(np.abs(across - strand.offset), strand.depth, strand.width)
        total += np.maximum(height, 0.0)
        powers += np.maximum(-height, 0.0) ** _POWER
    return total - powers ** (1 / _POWER)


def _strands(values: Floats, pairs: tuple[bool, ...]) -> tuple[Strand, ...]:
    return tuple(
        Strand(float(side * offset), float(np.exp(depth)), float(np.exp(width)))
        for (depth, width, offset), pair in zip(values.reshape(-1, 3), pairs)
        for side in ((1.0, -1.0) if pair else (0.0,))
    )
