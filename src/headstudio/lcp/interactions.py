"""What hair does to hair nearby: attraction and repulsion, collision, friction. Bando et al. 2006, section 3.4."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats, Ints
from .kernel import kernel, kernel_slope
from .model import HairModel, HairState
from .settings import DynamicsSettings

# Rate at which collision damping at its default stops hair that approaches on all sides [1/s].
_COLLISION_RATE = 5.0
# The slope of the kernel is nothing at its middle: particles that come close feel no pressure and stay together, the more
# so when negative pressure pulls. So cohesion is bounded, as a part of the pressure at which the density has doubled, and
# pairs nearer than this part of the mean distance repel each other.
_COHESION = 0.1
_ELBOW_ROOM = 0.7
_SHORTEST_WAVE = 2.5  # wave number that the kernel still resolves, times h
# |t_i x t_j| below which two hairs count as parallel.
_PARALLEL = 0.1


def hair_hair_forces(
    model: HairModel,
    settings: DynamicsSettings,
    state: HairState,
    pairs: Ints,
    dt: float,
) -> tuple[Floats, Floats]:
    """Forces of neighbouring hair on every particle [N], (n, 3), and the densities [kg/m^3], (n,).

    pairs: every pair closer than 2 h_2 once, (p, 2). dt: the step to come [s]; forces too strong for it are weakened to
    what it can carry, and the weakening vanishes with dt.
    """
    h = model.smoothing_length
    i, j = pairs.T
    x = _between(state.positions, i, j)
    distance = np.sqrt(_dot(x, x))
    near = np.flatnonzero(distance < 2.0 * h)
    i, j, x, distance = i.take(near), j.take(near), x.take(near, axis=1), distance.take(near)
    count, mass = model.count, model.mass
    weight = kernel(distance, h)
    density = mass * kernel(np.zeros(1), h) + _gather(mass[j] * weight, mass[i] * weight, i, j, count)

    radial = _pressure(model, settings, density, i, j, distance, dt) / np.maximum(distance, 1e-9)
    drag = _contact_drag(model, settings, density, state, i, j, x, weight, dt)
    force = radial * x + drag
    return np.stack([_gather(part, -part, i, j, count) for part in force]).T, density


def _pressure(
    model: HairModel, settings: DynamicsSettings, density: Floats, i: Ints, j: Ints, distance: Floats, dt: float
) -> Floats:
    """Eq. 16 along x_ij: the force on i, positive toward j [N], per pair. P = k_a (rho - rho_0)."""
    h, mass = model.smoothing_length, model.mass
    rest = settings.rest_density * model.rest_density
    # Sound of speed sqrt(k_a) must not swing through a wave as short as the kernel shows in a step.
    gain = settings.pressure / max(settings.pressure * (_SHORTEST_WAVE * dt / h) ** 2, 1.0)
    pressure = gain * np.maximum(density - rest, -_COHESION * rest)
    over_square: Floats = pressure / density**2
    both = over_square[i] + over_square[j]
    # dW/dx_i = -W' x_ij / |x_ij|, so repulsion (P > 0, W' < 0) points away from j.
    force: Floats = mass[i] * mass[j] * both * kernel_slope(distance, h)
    crowded = np.maximum(1.0 - distance / (_ELBOW_ROOM * model.spacing), 0.0)
    return force - gain / model.spacing * np.minimum(mass[i], mass[j]) * crowded


def _contact_drag(
    model: HairModel,
    settings: DynamicsSettings,
    density: Floats,
    state: HairState,
    i: Ints,
    j: Ints,
    x: Floats,
    weight: Floats,
    dt: float,
) -> Floats:
    """Eq. 17 and 18: collision along d_n, friction along d_t, the force on i per pair [N], (3, p)."""
    v = _between(state.velocities, i, j)
    t = np.ascontiguousarray(state.directions.T)
    t_i, t_j = t.take(i, axis=1), t.take(j, axis=1)
    normal = np.stack(
        [
            t_i[1] * t_j[2] - t_i[2] * t_j[1],
            t_i[2] * t_j[0] - t_i[0] * t_j[2],
            t_i[0] * t_j[1] - t_i[1] * t_j[0],
        ]
    )
    size = _dot(normal, normal)
    parallel = size < _PARALLEL**2
    # Parallel hairs meet along what joins them, across the hair: the journal version of the direction.
    normal = np.where(parallel, x - _dot(x, t_i) * t_i, normal)
    normal /= np.sqrt(np.maximum(np.where(parallel, _dot(normal, normal), size), 1e-24))
    along = _dot(v, normal)
    approaching = _dot(x, normal) * along < 0
    unit_rate = _COLLISION_RATE * model.mass.mean() ** 2 / model.rest_density.mean()
    # All neighbours together must not turn a velocity round within a step.
    load = (settings.collision + settings.friction) * unit_rate * density / model.mass**2
    bound = weight / np.maximum(2.0 * dt * np.maximum(load[i], load[j]), 1.0)
    collision = unit_rate * settings.collision * np.where(approaching, along, 0.0)
    # (v . d_t) d_t is the part of v across d_n.
    friction = unit_rate * settings.friction
    drag: Floats = bound * (friction * v + (collision - friction * along) * normal)
    return drag


def _between(vectors: Floats, i: Ints, j: Ints) -> Floats:
    """What j has more than i of (n, 3) vectors, pair by pair, as columns, (3, p)."""
    columns = np.ascontiguousarray(vectors.T)
    return columns.take(j, axis=1) - columns.take(i, axis=1)


def _dot(a: Floats, b: Floats) -> Floats:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _gather(at_i: Floats, at_j: Floats, i: Ints, j: Ints, count: int) -> Floats:
    gathered = np.zeros(count)
    gathered += np.bincount(i, at_i, count)
    gathered += np.bincount(j, at_j, count)
    return gathered
