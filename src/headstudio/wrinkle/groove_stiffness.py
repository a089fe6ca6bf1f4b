"""What keeps a fitted groove plain where the scan does not ask for more: a straight curve, a round section, an even depth.

A furrow that winds about after noise, or that makes good between its control heights what it spoils at others, comes nearer
to a scan and is of no use to an artist. So bends cost: of the curve, of its section, and of how it swells.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from .cross_profile import SPACING
from .groove import GrooveBed

# A curve costs so much for each 1/m of its bends squared along it [m^4]: a circle of 1 cm some 0.6 mm^3.
_WINDING = 1e-12
# The second differences of a section and of a swell cost this part of what such misfits of the skin would.
_ROUGH, _UNEVEN = 1e-3, 1e-3


def bends_of(bed: GrooveBed, noise: float) -> tuple[Floats, Floats]:
    """The bends of a groove, half of whose squares is what they cost [m^3], (s,), and how they change with its unknowns,
    (s, unknowns). noise: what misfits are compared with [m]."""
    groove, free = bed.groove, len(bed.free)
    section, swell = len(groove.section), len(groove.swell)
    curve, by_controls = bed.curving()
    # The bend of a cubic with controls P is 6 (P0 - 2 P1 + P2) / length^2 at its start, and such a half of it counts.
    pieces = groove.chain.count
    size = np.sqrt(36.0 * _WINDING / (bed.length / pieces) ** 3)
    bends, slopes = [size * curve], [_placed(size * by_controls, 0, bed.unknowns)]
    if section:
        differences = _second_differences(section)
        size = np.sqrt(_ROUGH * bed.length * SPACING * groove.width / noise)
        bends.append(size * groove.depth * differences @ np.array(groove.section))
        slopes.append(_placed(size * differences, free + 3, bed.unknowns))
    if swell > 2:
        differences = _second_differences(swell)[2:-2]
        size = np.sqrt(_UNEVEN * bed.length * groove.width / noise) * groove.depth
        bends.append(size * differences @ np.array(groove.swell))
        slopes.append(_placed(size * differences, bed.unknowns - swell, bed.unknowns))
    return np.concatenate(bends), np.concatenate(slopes)


def _second_differences(count: int) -> Floats:
    """Of a row of ``count`` values with nothing beyond its ends, (count + 2, count)."""
    return np.diff(np.pad(np.eye(count), ((2, 2), (0, 0))), 2, axis=0)


def _placed(block: Floats, first: int, count: int) -> Floats:
    """A block of columns among ``count`` of them."""
    whole = np.zeros((len(block), count))
    whole[:, first : first + block.shape[1]] = block
    return whole
