"""Figures that tell how hair is doing, one instant at a time: the columns of the stats file."""

from __future__ import annotations

import numpy as np

from ..head.depth import SkinDepth
from ..head.frame import HeadFrame
from ..head.mesh import Floats, Ints
from ..head.rows import row_dot, row_length
from ..lcp.density import density
from ..lcp.links import LENGTHWISE
from ..lcp.model import HairModel, HairState
from ..lcp.neighbours import find_pairs
from ..lcp.parting import Parting, gap


def hair_figures(model: HairModel, state: HairState) -> dict[str, float]:
    """Energy [J], stretch, reach, closeness and evenness of the hair at one instant.

    stretch_rms, stretch_max: strain of the links with a_ij >= 0.9, compression counting as none. reach_max: largest
    |x_i - root_i| / s_i over particles with s_i of at least one smoothing length. min_pair_distance [m]. close_pairs: pairs
    closer than a third of the mean distance at rest. density_variance: of the density over its mean at rest.
    """
    pairs = find_pairs(state.positions, 2.0 * model.smoothing_length)
    apart = _distances(state.positions, pairs)
    stretch = link_stretch(model, state.positions)
    relative = density(state.positions, model.mass, pairs, model.smoothing_length) / model.rest_density.mean()
    return {
        "kinetic_energy": 0.5 * float(np.sum(model.mass * row_dot(state.velocities, state.velocities))),
        "stretch_rms": float(np.sqrt(np.mean(stretch**2))) if len(stretch) else 0.0,
        "stretch_max": float(stretch.max(initial=0.0)),
        "reach_max": float(reach(model, state.positions).max(initial=0.0)),
        "min_pair_distance": float(apart.min(initial=2.0 * model.smoothing_length)),
        "close_pairs": float(np.count_nonzero(apart < model.spacing / 3.0)),
        "density_variance": float(np.var(relative[~model.fixed])) if not model.fixed.all() else 0.0,
    }


def link_stretch(model: HairModel, positions: Floats) -> Floats:
    """Strain of the lengthwise links in tension, 0 for compressed ones, (k,)."""
    lengthwise = model.alignment >= LENGTHWISE
    length = _distances(positions, model.links[lengthwise])
    return np.maximum(length / model.rest_length[lengthwise] - 1.0, 0.0)


def reach(model: HairModel, positions: Floats) -> Floats:
    """|x_i - root_i| / s_i of the particles far enough out for it to mean something, (k,)."""
    out = model.arc_length >= model.smoothing_length
    return row_length(positions[out] - model.root_points[out]) / model.arc_length[out]


def head_figures(frame: HeadFrame) -> dict[str, float]:
    """Where the head is: rotation vector [rad] and translation [m]."""
    turn = frame.rotation.as_rotvec()
    return {f"head_r{axis}": float(turn[k]) for k, axis in enumerate("xyz")} | {
        f"head_{axis}": float(frame.translation[k]) for k, axis in enumerate("xyz")
    }


def contact_figures(model: HairModel, state: HairState, skin: SkinDepth, frame: HeadFrame) -> dict[str, float]:
    """penetration_max: depth below the skin of the particle that is deepest [m], root particles aside."""
    return {"penetration_max": skin.deepest(state.positions[~model.fixed], frame)}


def parting_figures(model: HairModel, parting: Parting | None, state: HairState) -> dict[str, float]:
    """gap: width of the gap that the hands hold open or have left behind [m]."""
    return {"gap": gap(model, parting, state.positions)} if parting is not None else {}


def _distances(positions: Floats, pairs: Ints) -> Floats:
    return row_length(positions[pairs[:, 1]] - positions[pairs[:, 0]])
