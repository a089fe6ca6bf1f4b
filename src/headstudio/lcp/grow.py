"""From a scalp to particles: Bando et al. 2006, section 3.2, in its order."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats
from ..head.rows import in_columns, row_length
from ..head.scalp import Scalp
from .beam import beam_directions
from .body import Body
from .density import density
from .distribute import distribute
from .links import connect, lifelines
from .model import HairModel
from .neighbours import find_pairs
from .settings import HairSettings
from .spread import spread

# Of the mean distance to the nearest neighbours: h_1 "a little larger", h_2 "a little smaller" than it.
_LINK_SMOOTHING = 1.4
# Particles whose roots are this many mean distances apart still share strands.
_SAME_STRANDS = 1.1
_HAIR_SMOOTHING = 0.9
_NEAREST = 6
_BEAM_JOINTS = 64


def grow_hair(scalp: Scalp, body: Body, settings: HairSettings) -> HairModel:
    """Grow hair on ``scalp`` and let it fall on ``body``: particles, their initial shape and their links."""
    rng = np.random.default_rng(settings.seed)
    coordinates = distribute(scalp, settings.length, settings.root_depth, settings.particles, rng)
    coordinates = coordinates[np.argsort(coordinates[:, 2], kind="stable")]
    uv, arc_length = coordinates[:, :2], coordinates[:, 2]
    roots = scalp.points(uv)
    length = np.asarray(scalp.lengths(uv)) * settings.length
    root_directions = scalp.root_directions(uv, settings.lie_down, settings.stand_up)
    positions, directions = hang(roots, root_directions, arc_length, length, settings.bending_length, body)

    spacing = _mean_distance(positions)
    positions = spread(positions, directions, roots, arc_length, spacing, body)
    # Hair that falls over other hair lies denser in space than in (u, v, s), where it is the next of its own strands.
    strand_spacing = _mean_distance(np.column_stack([roots, arc_length]))
    link_smoothing, hair_smoothing = _LINK_SMOOTHING * strand_spacing, _HAIR_SMOOTHING * spacing
    links = connect(positions, directions, roots, arc_length, link_smoothing, _SAME_STRANDS * strand_spacing)
    fixed = arc_length < 0
    # Poisson discs sample the volume evenly, so each particle stands for as much hair as any other.
    above = int(np.count_nonzero(~fixed))
    mass = np.full(len(arc_length), settings.mass / max(above, 1))
    return HairModel(
        coordinates=coordinates,
        root_points=in_columns(roots),
        rest_positions=in_columns(positions),
        rest_directions=in_columns(directions),
        mass=mass,
        fixed=fixed,
        links=links.pairs,
        rest_length=links.rest_length,
        alignment=links.alignment,
        strength=links.strength,
        rest_cosine=links.rest_cosine,
        lifeline=lifelines(links, arc_length, link_smoothing),
        smoothing_length_links=link_smoothing,
        smoothing_length=hair_smoothing,
        spacing=spacing,
        rest_density=density(positions, mass, find_pairs(positions, 2 * hair_smoothing), hair_smoothing),
        rest_clearance=body.clearance(positions),
        bending_length=settings.bending_length,
    )


def _mean_distance(points: Floats) -> float:
    """Mean distance to the nearest neighbours, (n, d)."""
    return float(cKDTree(points).query(points, k=_NEAREST + 1)[0][:, 1:].mean())


def hang(
    roots: Floats, root_directions: Floats, arc_length: Floats, length: Floats, bending_length: float, body: Body
) -> tuple[Floats, Floats]:
    """Where the point at each arc length of a hair comes to lie: positions [m] and unit directions, (n, 3) each.

    arc_length and length: of the point and of the whole hair that it belongs to [m], (n,). A root particle lies below the
    scalp, against its root direction. Every other hair is a cantilever beam, and slides along the body where it meets it.
    What the body turned it by, its stiffness hands on for a bending length: hair that lands on a shoulder goes on over it.

    The paper takes the end point of a beam of length s_i instead. The ends of beams of different lengths do not lie on one
    hair: between them the arc length no longer measures distance, and the links would start out on the wrong foot.
    """
    positions = roots + arc_length[:, None] * root_directions
    directions = root_directions.copy()
    grown = np.flatnonzero(arc_length >= 0)
    pieces = beam_directions(root_directions[grown], length[grown], bending_length, _BEAM_JOINTS)
    step = length[grown] / _BEAM_JOINTS
    kept = np.exp(-step / bending_length)[:, None]
    here, turned = roots[grown], np.zeros_like(roots[grown])
    for k in range(_BEAM_JOINTS):
        wanted = pieces[:, k] + kept * turned
        along = body.slide(here, wanted / np.maximum(row_length(wanted), 1e-9)[:, None])
        turned = along - pieces[:, k]
        beyond = arc_length[grown] - k * step
        ends = (beyond >= 0) & ((beyond < step) | (k == _BEAM_JOINTS - 1))
        positions[grown[ends]] = here[ends] + beyond[ends, None] * along[ends]
        directions[grown[ends]] = along[ends]
        here = here + step[:, None] * along
    return positions, directions
