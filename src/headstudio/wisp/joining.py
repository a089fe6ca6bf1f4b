"""Several sets of strands as one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .strands import Strands


def join_strands(sets: Sequence[Strands]) -> Strands:
    """All strands of ``sets``, which know their radius, colour and wisp, in one; wisps are numbered on from set to set.

    The sets are mixed evenly: the first part of the strands has the same part of every set, so that it is still a thinned
    picture of the whole.
    """
    if len(sets) == 1:
        return sets[0]
    turn = np.concatenate([(np.arange(part.count) + 0.5) / max(part.count, 1) for part in sets])
    wisps, offset = [], 0
    for part in sets:
        assert part.wisp is not None
        wisps.append(part.wisp + np.int32(offset))
        offset += int(part.wisp.max(initial=-1)) + 1
    joined = Strands(
        np.concatenate([part.points for part in sets]),
        np.concatenate([[0], np.cumsum(np.concatenate([part.counts for part in sets]))]),
        np.concatenate([part.radius for part in sets]),
        np.concatenate([part.colour for part in sets]),
        np.concatenate(wisps),
        stands_for=sets[0].stands_for,
    )
    return joined.picked(np.argsort(turn, kind="stable"))
