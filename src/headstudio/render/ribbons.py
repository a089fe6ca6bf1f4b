"""Hair as ribbons: every particle becomes a few narrow curved billboards that follow the hair around it.

One particle stands for thousands of strands across a centimetre. Bando et al. 2006 draw it as one billboard and name
the interpolation between particles as future work; here each particle carries several narrower ribbons, spread over
the space between it and its neighbours and bent along the directions of its rootward and tipward neighbours.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, diags_array
from scipy.spatial import cKDTree

from ..head.frame import HeadFrame
from ..head.mesh import Floats, Ints
from ..lcp.model import HairModel
from ..scene.settings import Look
from ..scene.stage import HairOnStage

RIBBON_DTYPE = np.dtype(
    [
        ("centre", "f4", 3),
        ("rootward", "f4", 3),
        ("direction", "f4", 3),
        ("tipward", "f4", 3),
        ("extent", "f4", 3),
        ("strand", "f4", 4),
    ]
)
"""centre [m]; directions of the hair at the rootward end, the middle and the tipward end; extent: half length towards
the root and the tip and half width [m]; strand: window of the strand texture, tone, particle, openness to the sky."""

_GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))
# How much farther than to its neighbours a ribbon reaches, and so how far their change of direction is carried on.
_CARRY_ON = 1.4


@dataclass(frozen=True, eq=False)
class HairFrames:
    """The hair around every particle at one instant, in the world; all (n, 3).

    position [m]; unit directions at the particle, and where its rootward and tipward neighbours are; ``sideways`` is a
    unit vector across the hair that turns with it.
    """

    position: Floats
    direction: Floats
    rootward: Floats
    tipward: Floats
    sideways: Floats


class RibbonBuilder:
    """What can be said of the ribbons of a model before it moves; made once per model."""

    def __init__(self, model: HairModel, per_particle: int) -> None:
        n = model.count
        self.model = model
        self.per_particle = per_particle
        root, tip = model.links[:, 0], model.links[:, 1]
        self._rootward_mean = _mean_over(tip, root, model.alignment, n)
        self._tipward_mean = _mean_over(root, tip, model.alignment, n)
        self._rest_sideways = _across(model.rest_directions)
        self._openness = _openness(model)

        # The spread of the ribbons around their particle: a sunflower, turned by a random angle for every particle.
        rng = np.random.default_rng(0)
        k = np.arange(per_particle)
        radius = np.sqrt(k / per_particle)[None, :] * rng.uniform(0.85, 1.15, (n, per_particle))
        angle = k[None, :] * _GOLDEN_ANGLE + rng.uniform(0, 2 * np.pi, (n, 1))
        self._spread = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
        self._lean = rng.normal(0, 0.05, (n, per_particle, 2))
        self._window = rng.uniform(0, 1, (n, per_particle))
        self.windows = self._window[:, 0]
        self._tone = rng.normal(0, 1, (n, per_particle)) * 0.6 + rng.normal(0, 1, (n, 1)) * 0.4
        self._length = rng.uniform(0.85, 1.2, (n, per_particle))

    def frames(self, hair: HairOnStage, frame: HeadFrame) -> HairFrames:
        """The hair around every particle, in the world."""
        direction = hair.directions
        # Minimal rotation of the rest frame onto the hair; undefined only for hair turned by exactly 180 degrees.
        rest, side = self.model.rest_directions, self._rest_sideways
        cosine = np.einsum("ni,ni->n", rest, direction)
        along = np.einsum("ni,ni->n", side, direction) / np.maximum(1 + cosine, 1e-3)
        sideways = side - along[:, None] * (rest + direction)
        turn = frame.rotation.as_matrix().T
        return HairFrames(
            position=hair.positions @ turn + frame.translation,
            direction=direction @ turn,
            rootward=self._carried_on(self._rootward_mean, direction) @ turn,
            tipward=self._carried_on(self._tipward_mean, direction) @ turn,
            sideways=_unit(sideways) @ turn,
        )

    def ribbons(self, frames: HairFrames, look: Look) -> NDArray[np.void]:
        """All ribbons, particle by particle, of ``RIBBON_DTYPE``, shape (n * per_particle,)."""
        n, k = self.model.count, self.per_particle
        out = np.empty((n, k), RIBBON_DTYPE)
        width = look.billboard_width * self.model.spacing
        half_length = 0.5 * width * look.billboard_stretch * self._length
        other = np.cross(frames.direction, frames.sideways)
        reach = 0.5 * width * self._spread
        offset = reach[..., :1] * frames.sideways[:, None] + reach[..., 1:] * other[:, None]
        lean = self._lean[..., :1] * frames.sideways[:, None] + self._lean[..., 1:] * other[:, None]
        out["centre"] = frames.position[:, None] + offset
        out["direction"] = frames.direction[:, None] + lean
        out["rootward"] = frames.rootward[:, None] - lean
        out["tipward"] = frames.tipward[:, None] + 2 * lean
        # No ribbon starts deeper under the scalp than its hair does.
        depth = self.model.arc_length - self.model.arc_length.min()
        out["extent"][..., 0] = np.minimum(half_length, depth[:, None])
        out["extent"][..., 1] = half_length
        out["extent"][..., 2] = 0.5 * width * ribbon_narrowing(k)
        out["strand"][..., 0] = self._window
        out["strand"][..., 1] = self._tone
        out["strand"][..., 2] = np.arange(n)[:, None]
        out["strand"][..., 3] = self._openness[:, None]
        return out.reshape(-1)

    @staticmethod
    def _carried_on(mean: csr_array, direction: Floats) -> Floats:
        there = mean @ direction
        known = np.einsum("ni,ni->n", there, there) > 0
        return _unit(np.where(known[:, None], direction + _CARRY_ON * (there - direction), direction))


def ribbon_narrowing(per_particle: int) -> float:
    """Width of a ribbon as a part of the particle's billboard, so that together they cover somewhat more than it."""
    return float(min(1.0, 1.35 / np.sqrt(per_particle)))


def _mean_over(rows: Ints, columns: Ints, weights: Floats, n: int) -> csr_array:
    """The operator that gives each particle the weighted mean of its neighbours; a row of zeros where it has none."""
    matrix = csr_array((weights, (rows, columns)), shape=(n, n))
    total = np.asarray(matrix.sum(axis=1)).ravel()
    return csr_array(diags_array(np.divide(1.0, total, out=np.zeros(n), where=total > 0)) @ matrix)


def _across(directions: Floats) -> Floats:
    """Some unit vector normal to each direction, (n, 3)."""
    axis = np.eye(3)[np.argmin(np.abs(directions), axis=1)]
    return _unit(np.cross(directions, axis))


def _unit(vectors: Floats) -> Floats:
    length = np.sqrt(np.einsum("...i,...i->...", vectors, vectors))
    return vectors / np.maximum(length, 1e-12)[..., None]


def _openness(model: HairModel) -> Floats:
    """How open to the soft light each particle lies, 0 deep in the hair to 1 on its surface, (n,).

    A particle inside has neighbours all around, so that their mean is where it is itself; on the surface the mean lies
    inside.
    """
    above = ~model.fixed
    tree = cKDTree(model.rest_positions[above])
    _, near = tree.query(model.rest_positions, k=min(24, max(1, int(above.sum()))))
    around = model.rest_positions[above][near].reshape(model.count, -1, 3)
    mean = around.mean(axis=1) - model.rest_positions
    size = np.linalg.norm(around - model.rest_positions[:, None], axis=2).mean(axis=1)
    return np.clip(np.linalg.norm(mean, axis=1) / np.maximum(0.75 * size, 1e-12), 0.0, 1.0)
