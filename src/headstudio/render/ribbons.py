"""Each particle becomes a few narrow ribbons along the curve of its hair, spread over the space it stands for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints
from .strands import SECTIONS, HairCurves
from .view import View

CURVE_DTYPE = np.dtype(
    [("path", "f4", (SECTIONS, 4)), ("tangent", "f4", (SECTIONS, 4)), ("sideways", "f4", 4)],
)
"""The curve of one particle as texels: path [m] with the place along it in w, tangents with ``grown`` in w, sideways with
the openness in w."""

RIBBON_DTYPE = np.dtype(
    [
        ("spread", "f4", 2), ("lean", "f4", 2), ("window", "f4"), ("tone", "f4"), ("curve", "f4"), ("lit_as", "f4"),
        ("ending", "f4"), ("_unused", "f4", 3),
    ]
)  # fmt: skip
"""What one ribbon keeps for ever, as texels. spread: place across the hair in half widths of the particle's billboard;
lean: how its direction departs from the curve's; window of the strand texture; tone: how much lighter its strands are
than most, in standard deviations; curve: which one it follows; lit_as: the particle whose light falls on it; ending: 0
where hair goes on at its tipward end, and goes over into what follows, 1 where its strands come to their end."""

_GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))


def lay_out_ribbons(ending: Floats, per_particle: int, undergrowth: Ints) -> NDArray[np.void]:
    """The ribbons of n particles, particle by particle, then one for each curve of the undergrowth, of ``RIBBON_DTYPE``.

    ending: the part of the ribbons of each particle that end there, (n,). undergrowth: the particles that its curves take
    their light from, (c,).
    """
    n, k = len(ending), np.arange(per_particle)
    rng = np.random.default_rng(0)
    out = np.zeros((n, per_particle), RIBBON_DTYPE)
    # A sunflower around the particle, turned by a random angle of its own.
    radius = np.sqrt((k + 0.5) / per_particle) * rng.uniform(0.8, 1.2, (n, per_particle))
    angle = k * _GOLDEN_ANGLE + rng.uniform(0, 2 * np.pi, (n, 1))
    out["spread"] = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    out["lean"] = rng.normal(0, 0.035, (n, per_particle, 2))
    out["window"] = rng.uniform(0, 1, (n, per_particle))
    # Locks of hair share most of their colour, ribbons of a lock differ a little.
    out["tone"] = 0.8 * rng.normal(size=(n, per_particle)) + 0.6 * rng.normal(size=(n, 1))
    out["curve"] = out["lit_as"] = np.arange(n)[:, None]
    out["ending"] = rng.uniform(size=(n, per_particle)) < ending[:, None]
    short = np.zeros(len(undergrowth), RIBBON_DTYPE)
    short["window"] = rng.uniform(0, 1, len(short))
    short["tone"] = rng.normal(0, 0.5, len(short))
    short["curve"] = n + np.arange(len(short))
    short["lit_as"] = undergrowth
    return np.concatenate([out.reshape(-1), short])


def ribbon_narrowing(per_particle: int) -> float:
    """Width of a ribbon as a part of the particle's billboard, so that together they cover somewhat more than it."""
    return float(min(1.0, 1.3 / np.sqrt(per_particle)))


def farthest_first(ribbons: NDArray[np.void], curves: HairCurves, half_width: float, view: View) -> Ints:
    """The order in which ribbons are drawn: by the depth of their middles, farthest first, (r,).

    half_width: of a particle's billboard [m], the unit of ``spread``.
    """
    curve = ribbons["curve"].astype(np.int64)
    side = curves.sideways @ view.forward
    other = np.cross(curves.direction, curves.sideways) @ view.forward
    spread = ribbons["spread"]
    aside = spread[:, 0] * side[curve] + spread[:, 1] * other[curve]
    return np.argsort(-(view.depth(curves.position)[curve] + half_width * aside), kind="stable")


def curve_texels(curves: HairCurves, openness: Floats) -> NDArray[np.void]:
    """The curves as the shader reads them, of ``CURVE_DTYPE``, (n,). openness: of each particle, (n,)."""
    out = np.zeros(len(curves.position), CURVE_DTYPE)
    out["path"][..., :3] = curves.path
    out["path"][..., 3] = curves.along
    out["tangent"][..., :3] = curves.tangent
    out["tangent"][..., 3] = curves.grown
    out["sideways"][:, :3] = curves.sideways
    out["sideways"][:, 3] = openness
    return out
