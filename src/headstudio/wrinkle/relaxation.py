"""Smoothing a projected body part: springs along its edges, its border fixed (Bando's thesis, section 2.4).

The spring constants are those that Eck et al. (1995) build harmonic maps with. A harmonic map is sure to be one to one
only with positive constants and a convex border. So the border becomes less concave, step by step, and the constants
fall back to mean value weights (Floater 2003), until no triangle is turned over; the last step, a circle (or two
straight lines around a cylinder) with positive constants, cannot fail but by rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import igl
import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.linalg import splu

from ..head.harmonic import mean_value_weights
from ..head.mesh import Floats, Ints, TriangleMesh
from .one_to_one import signed_areas, why_not_one_to_one
from .projection import Layout, TextureMapError, border_cycles, loop_steps, winding

# How strongly the k-th wave of the border is flattened, by 1 / (1 + smoothing k^2), in the order they are tried.
_SMOOTHINGS = (0.0, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1.0, np.inf)


@dataclass(frozen=True, eq=False)
class Relaxed:
    """A smoothed layout and how it was reached, for the user."""

    layout: Layout
    note: str


def relax(mesh: TriangleMesh, layout: Layout) -> Relaxed:
    """Minimise the energy of the springs along the edges, the border fixed as far as it can be.

    Raises TextureMapError for a layout that shows the surface from inside, and when the triangles are so thin that
    rounding defeats even the safe form.
    """
    if signed_areas(layout.corners(mesh.faces)).sum() < 0:
        raise TextureMapError("this part of the body shows its inside; look at it from the other side")
    filled, turns = _with_holes_filled(mesh, layout)
    solvers = {
        "harmonic": _solver(filled, turns, harmonic_weights),
        "mean value": _solver(filled, turns, mean_value_weights),
    }
    cycles = _fixed_cycles(mesh, layout)
    fixed = np.concatenate(cycles)
    for smoothing in _SMOOTHINGS:
        placed = np.concatenate([_less_concave(layout, mesh.vertices, cycle, smoothing) for cycle in cycles])
        for name, solve in solvers.items():
            places = solve(fixed, placed, layout.period)[: len(mesh.vertices)]
            relaxed = Layout(places, layout.turns, layout.period)
            if why_not_one_to_one(mesh, relaxed) is None:
                border = "border as projected" if not smoothing else f"border made less concave ({smoothing:g})"
                return Relaxed(relaxed, f"relaxed with {name} springs, {border}")
    raise TextureMapError("this part of the body cannot be flattened: its triangles are too thin; repair or remesh it")


def harmonic_weights(mesh: TriangleMesh) -> csr_array:
    """Spring constants of Eck et al. (1995) for every edge, (n, n), symmetric; negative across obtuse corners."""
    weights = igl.cotmatrix(mesh.vertices, mesh.faces).tocsr()
    weights.setdiag(0)
    return csr_array(weights)


def _solver(mesh: TriangleMesh, turns: Ints, weights_of: Callable[[TriangleMesh], csr_array]) -> Callable[..., Floats]:
    """A function that places all vertices at equilibrium when some are fixed; equations are set up once."""
    count = len(mesh.vertices)
    weights = weights_of(mesh)
    # The way from i to j crosses the seam as often as the corner of j is turned further than that of i.
    start, end = mesh.faces[:, [0, 1, 2, 1, 2, 0]].ravel(), mesh.faces[:, [1, 2, 0, 0, 1, 2]].ravel()
    crossing = (turns[:, [1, 2, 0, 0, 1, 2]] - turns[:, [0, 1, 2, 1, 2, 0]]).ravel()
    seam = coo_array((crossing.astype(np.float64), (start, end)), shape=(count, count)).tocsr()
    sides = coo_array((np.ones(len(start)), (start, end)), shape=(count, count)).tocsr()
    sides.data = 1.0 / sides.data
    pull = np.asarray(weights.multiply(seam).multiply(sides).sum(axis=1)).ravel()
    total = np.asarray(weights.sum(axis=1)).ravel()

    def solve(fixed: Ints, placed: Floats, period: float) -> Floats:
        inner = np.setdiff1d(np.arange(count), fixed)
        places = np.empty((count, 2))
        places[fixed] = placed
        rows = weights[inner]
        system = coo_array((total[inner], (np.arange(len(inner)),) * 2), shape=(len(inner),) * 2).tocsc()
        force = rows[:, fixed] @ placed
        force[:, 0] += period * pull[inner]
        places[inner] = splu((system - rows[:, inner]).tocsc()).solve(force)
        return places

    return solve


def _fixed_cycles(mesh: TriangleMesh, layout: Layout) -> list[Ints]:
    """What is held: both ends of a tube, or the outline of a disc; holes are free."""
    cycles = border_cycles(mesh.faces)
    if layout.period:
        return [cycle for cycle in cycles if winding(layout, cycle)]
    # The outline is the longest way around in the plane, whichever way the projection turned it.
    return [max(cycles, key=lambda cycle: np.linalg.norm(loop_steps(layout, cycle), axis=1).sum())]


def _with_holes_filled(mesh: TriangleMesh, layout: Layout) -> tuple[TriangleMesh, Ints]:
    """The mesh with a fan of triangles over every free hole, and the turns of all its corners."""
    held = {int(cycle[0]) for cycle in _fixed_cycles(mesh, layout)}
    vertices, faces, turns = [mesh.vertices], [mesh.faces], [layout.turns]
    count = len(mesh.vertices)
    for cycle in border_cycles(mesh.faces):
        if int(cycle[0]) in held:
            continue
        vertices.append(mesh.vertices[cycle].mean(axis=0, keepdims=True))
        ahead = np.roll(cycle, -1)
        faces.append(np.stack([ahead, cycle, np.full(len(cycle), count)], axis=1))
        turns.append(_fan_turns(layout, cycle))
        count += 1
    return TriangleMesh(np.concatenate(vertices), np.concatenate(faces)), np.concatenate(turns)


def _fan_turns(layout: Layout, cycle: Ints) -> Ints:
    """Turns of the corners next, this, middle of the triangles of a fan, (k, 3); the middle belongs to the first vertex."""
    if not layout.period:
        return np.zeros((len(cycle), 3), dtype=np.int64)
    walked = np.cumsum(loop_steps(layout, cycle)[:, 0])
    turn = np.rint(
        (layout.places[cycle[0], 0] + np.concatenate([[0.0], walked[:-1]]) - layout.places[cycle, 0]) / layout.period
    )
    turn = turn.astype(np.int64)
    return np.stack([np.roll(turn, -1), turn, np.zeros_like(turn)], axis=1)


def _less_concave(layout: Layout, vertices: Floats, cycle: Ints, smoothing: float) -> Floats:
    """The border flattened: places, (k, 2), whose waves are damped until a circle or a straight line is left.

    Vertices are spaced as they are along the border of the surface, so that none of them meet.
    """
    if smoothing == 0.0:
        return layout.places[cycle]
    lengths = np.linalg.norm(np.roll(vertices[cycle], -1, axis=0) - vertices[cycle], axis=1)
    lengths = np.maximum(lengths, 1e-3 * lengths.mean())
    part = np.concatenate([[0.0], np.cumsum(lengths)[:-1]]) / lengths.sum()
    turns = winding(layout, cycle)
    straight = np.stack([turns * layout.period * part, np.zeros(len(part))], axis=1) - _whole_turns(layout, cycle)
    walked = layout.places[cycle] - straight

    # Evenly spaced samples have a Fourier series; the smoothed one is read at the vertices.
    count = 4 * len(cycle)
    even = np.arange(count) / count
    wave = (
        np.fft.fft(sum(unit * np.interp(even, part, walked[:, k], period=1.0) for k, unit in ((0, 1.0), (1, 1j))))
        / count
    )
    number = np.fft.fftfreq(count, 1.0 / count)
    # The base shape is kept: the place of a loop, and its first wave where that is a circle run through the right way.
    base = (number == 0) | ((number == 1) & (turns == 0))
    factor = np.where(base, 1.0, 0.0 if np.isinf(smoothing) else 1.0 / (1.0 + smoothing * number**2))
    kept = np.flatnonzero(factor * np.abs(wave) > 1e-12 * np.abs(wave).max())
    smooth = np.exp(2j * np.pi * np.outer(part, number[kept])) @ (factor * wave)[kept]
    return np.stack([smooth.real, smooth.imag], axis=1) + straight


def _whole_turns(layout: Layout, cycle: Ints) -> Floats:
    """What makes a border one unbroken line when it is walked from its first vertex, (k, 2)."""
    if not layout.period:
        return np.zeros((len(cycle), 2))
    walked = layout.places[cycle[0]] + np.concatenate(
        [np.zeros((1, 2)), np.cumsum(loop_steps(layout, cycle)[:-1], axis=0)]
    )
    return walked - layout.places[cycle]
