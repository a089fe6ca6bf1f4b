"""The cross section of a groove in a scan: seen texel by texel, and as the control heights of a furrow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats
from .cross_profile import SPACING, section_places, section_shares

# The section is taken at distances this far apart [m].
_STEP = 4e-4
# Fewer texels than this at a distance do not count.
_FEWEST = 6
# Fewer distances than this tell nothing.
_FEWEST_PLACES = 12
# Where a groove is at least this part of its depth it shows its section.
_WHOLE = 0.8
# Control heights of a section: from so many widths on one side to as many on the other, within this of the line [m].
_WIDTHS, _FARTHEST = 4.5, 18e-3
# A groove ends where this part of its depth is left.
_LEVEL = 0.1
# How much bends count against the misfit, and heights themselves, so that nothing is made of what is not seen.
_STIFF, _FLAT = 0.02, 2e-3


@dataclass(frozen=True, eq=False)
class CrossSection:
    """Heights square to a groove. across: to the left [m], (n,). height: [m], (n,). weight: how much each counts, (n,)."""

    across: Floats
    height: Floats
    weight: Floats

    @property
    def told(self) -> bool:
        """Whether so much is seen that it tells something."""
        return len(self.across) >= _FEWEST_PLACES


def cross_section(across: Floats, height: Floats, others: Floats, wholeness: Floats, clear: float) -> CrossSection:
    """The median section of texels beside a groove, (i,) each, where it is whole.

    height: of the scan. others: what other grooves make there [m]; where that is more than ``clear``, nothing is
    seen. wholeness: how much of the groove is there at each.
    """
    kept = (wholeness > _WHOLE) & np.isfinite(height) & (np.abs(others) <= clear)
    height = (height - others) / np.maximum(wholeness, _WHOLE)
    place = np.rint(across[kept] / _STEP).astype(np.int64)
    order = np.lexsort((height[kept], place))
    places, first, count = np.unique(place[order], return_index=True, return_counts=True)
    middle = first + count // 2
    enough = count >= _FEWEST
    at = np.asarray(places * _STEP, dtype=np.float64)
    return CrossSection(at[enough], height[kept][order][middle][enough], np.sqrt(count[enough] / count.max(initial=1)))


def half_width(section: CrossSection, width: float) -> float:
    """How far it is from the floor of a groove to where the nearer side of it ends [m]; ``width`` [m] if it does not.

    The floor is looked for within ``width``.
    """
    near = np.abs(section.across) <= width
    if not near.any() or section.height[near].min() >= 0:
        return width
    floor = np.flatnonzero(near)[section.height[near].argmin()]
    ended = section.height > _LEVEL * section.height[floor]
    return float(np.abs(section.across[ended] - section.across[floor]).min(initial=np.inf if ended.any() else width))


def control_heights(section: CrossSection, width: float) -> Floats:
    """The control heights of a furrow ``width`` [m] wide that come nearest to a section [m], (c,): smoothing by penalties
    on bends (Eilers and Marx 1996)."""
    half = int(min(_WIDTHS, _FARTHEST / width) / SPACING)
    count = 2 * half + 1
    columns = section.weight[:, None] * section_shares(section.across, width, count)
    bends = np.diff(np.eye(count), 2, axis=0)
    # What is far from the line is more likely something else.
    far = np.diag((section_places(count) / section_places(count)[-1]) ** 2)
    normal = columns.T @ columns + _STIFF * bends.T @ bends + _FLAT * (np.eye(count) + 10 * far)
    heights: Floats = np.linalg.solve(normal, columns.T @ (section.weight * section.height))
    return heights
