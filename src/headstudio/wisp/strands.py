"""Strands as everything else takes them: points in one packed array, and no object per strand."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Singles = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Strands:
    """Hair strands, root first, in the head frame.

    points: of all strands, one strand after the other [m], (p, 3). first: where each strand starts in ``points``, and at
    the end p, (n + 1,); a strand has two points or more. radius: half the thickness of the shaft at every point [m],
    (p,). colour: what colour the hair looks in even light, linear RGB, at every point, (p, 3). wisp: which wisp a strand
    belongs to, (n,), -1 for none. None: not known, whoever draws decides. stands_for: how many strands of the whole
    hairstyle each of these stands for, when they are a sample of it.
    """

    points: Singles
    first: NDArray[np.int64]
    radius: Singles | None = None
    colour: Singles | None = None
    wisp: NDArray[np.int32] | None = None
    stands_for: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", np.ascontiguousarray(self.points, dtype=np.float32))
        object.__setattr__(self, "first", np.ascontiguousarray(self.first, dtype=np.int64))

    @classmethod
    def of_equal_count(
        cls,
        points: Singles,
        radius: Singles | None = None,
        colour: Singles | None = None,
        wisp: NDArray[np.int32] | None = None,
    ) -> Strands:
        """Strands of k points each: points (n, k, 3), radius (n, k), colour (n, k, 3), wisp (n,)."""
        strands, count, _ = points.shape
        return cls(
            points.reshape(-1, 3),
            np.arange(strands + 1) * count,
            None if radius is None else radius.reshape(-1),
            None if colour is None else colour.reshape(-1, 3),
            wisp,
        )

    @property
    def count(self) -> int:
        """How many strands there are, n."""
        return len(self.first) - 1

    @property
    def counts(self) -> NDArray[np.int64]:
        """How many points each strand has, (n,)."""
        return np.diff(self.first)

    def picked(self, chosen: NDArray[np.int64]) -> Strands:
        """The strands ``chosen`` by their numbers, (k,), in that order."""
        counts = self.counts[chosen]
        first = np.concatenate([[0], np.cumsum(counts)])
        index = np.repeat(self.first[chosen] - first[:-1], counts) + np.arange(first[-1])
        return replace(
            self,
            points=self.points[index],
            first=first,
            radius=None if self.radius is None else self.radius[index],
            colour=None if self.colour is None else self.colour[index],
            wisp=None if self.wisp is None else self.wisp[chosen],
        )

    @property
    def lengths(self) -> NDArray[np.float64]:
        """How long each strand is along its points, (n,), in the unit of the points."""
        steps = np.linalg.norm(np.diff(self.points, axis=0), axis=1).astype(np.float64)
        steps[self.first[1:-1] - 1] = 0.0  # from the tip of one strand to the root of the next
        return np.add.reduceat(np.append(steps, 0.0), self.first[:-1])
