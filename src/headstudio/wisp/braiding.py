"""Plaits: interleaved paths for three or more groups of hair, and the braid they make as a word of crossings."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats

_OPENING = 0.02  # over this length from either end the groups spread from the tie to the full width [m]


def plait(path: Floats, side: Floats, front: Floats, groups: int, width: float, depth: float, period: float) -> Floats:
    """Paths of ``groups`` locks that are plaited around a path, (groups, n, 3) [m].

    path: [m], (n, 3), evenly spaced. side, front: unit directions across it, (n, 3). width, depth: half the extent to the
    side and to the front [m]. period: length of path after which every lock is back in its place [m].

    The locks follow one another on a figure of eight lying on its side, x = sin t, z = sin 2t, which is the plait of
    three: every lock goes over to the middle from one side and over to the middle from the other. Two locks half a
    figure apart would meet in its middle, so an even number of groups leaves one place of an odd number free.
    """
    if groups < 3:
        raise ValueError(f"a braid has three groups or more, got {groups}")
    places = groups if groups % 2 else groups + 1
    step = np.linalg.norm(np.diff(path, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(step)])
    spread = np.minimum(np.minimum(along, along[-1] - along) / _OPENING, 1.0)
    phase = 2 * np.pi * (along[None, :] / period + np.arange(groups)[:, None] / places)
    x = width * spread * np.sin(phase)
    z = depth * spread * np.sin(2 * phase)
    return path + x[..., None] * side + z[..., None] * front


def braid_word(locks: Floats, path: Floats, side: Floats, front: Floats) -> list[tuple[int, int]]:
    """The braid that locks make, (groups, n, 3) [m], seen from the front: its crossings in order along the path.

    A crossing is (k, sign): the locks that are k-th and (k + 1)-th from the left of ``side``, counted from 0, change
    places; sign is +1 when the one that comes from the k-th place passes in front, else -1. In the words of Artin these are the
    generators sigma_k and their inverses. A plait of three is (0, +1), (1, -1), (0, +1), ... or its mirror image.
    """
    x = np.einsum("gnk,nk->gn", locks - path, side)
    z = np.einsum("gnk,nk->gn", locks - path, front)
    word = []
    order = list(np.argsort(x[:, 0], kind="stable"))
    for sample in range(1, x.shape[1]):
        # Between two samples the order changes by neighbours changing places: sort as bubbles do, and note each change.
        for _ in range(len(order)):
            for k in range(len(order) - 1):
                left, right = order[k], order[k + 1]
                if x[left, sample] > x[right, sample]:
                    word.append((k, 1 if z[left, sample] > z[right, sample] else -1))
                    order[k], order[k + 1] = right, left
    return word


def crossings(locks: Floats, path: Floats, side: Floats, front: Floats) -> int:
    """How many crossings the braid has that cannot be undone: the length of its word, freely reduced.

    A crossing followed at once by its inverse is no crossing: the locks only swayed. In a plait of three locks every
    lock crosses each of the others twice a period, so there are six a period.
    """
    reduced: list[tuple[int, int]] = []
    for letter in braid_word(locks, path, side, front):
        if reduced and reduced[-1] == (letter[0], -letter[1]):
            reduced.pop()
        else:
            reduced.append(letter)
    return len(reduced)
