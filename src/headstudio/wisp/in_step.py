"""Waves in step: side by side, locks wave together, though one has come from the parting and the next is rooted here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats
from .outlines import Outlines

# Hair that passes a root within so far [m] lies beside the lock that grows there.
_BESIDE = 0.02
# So many roots, of a lock and its neighbours, agree on how far hair has come.
_AGREE = 8


@dataclass(frozen=True, eq=False)
class InStep:
    """Where the waves of W locks begin when all wave together.

    come: how far hair has come that passes over each root [m], (W,): what grows there begins as if it had come as far.
    side: 1 or -1, (W,): the halves of a head of waves are each other's mirror images, as a comb makes them.
    """

    come: Floats
    side: Floats

    @classmethod
    def along(cls, outlines: Outlines) -> InStep:
        """For locks that lie along ``outlines``."""
        joints = outlines.joints
        count = joints.shape[1]
        laid = np.arange(count) <= outlines.counts[:, None]
        reached = np.broadcast_to(outlines.segment * np.arange(count), laid.shape)[laid]
        near = cKDTree(joints[laid]).query_ball_point(outlines.roots, _BESIDE, workers=-1)
        farthest = np.array([reached[passing].max() for passing in near])
        agree = min(_AGREE, len(near))
        neighbours = cKDTree(outlines.roots).query(outlines.roots, k=[*range(1, agree + 1)])[1]
        # At the rim all neighbours lie on one side, whence hair comes.
        onward = outlines.roots[:, None] - outlines.roots[neighbours]
        ahead = np.einsum("wkj,wj->wk", onward, outlines.directions[:, 0])
        middle = joints[np.arange(len(near)), outlines.counts // 2]
        return cls((farthest[neighbours] + ahead).mean(axis=1), np.where(middle[:, 0] < 0, -1.0, 1.0))
