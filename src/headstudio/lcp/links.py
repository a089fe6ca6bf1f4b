"""Which particles are linked, and how strongly: Bando et al. 2006, section 3.2, eq. 5 and 6."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from ..head.rows import row_dot, row_length
from .kernel import kernel
from .neighbours import find_pairs

SMALLEST_ALIGNMENT = 0.5  # a_0 of the paper
LENGTHWISE = 0.9  # alignment from which a link runs along the hair, and its stretch is the hair's
WANTED_LINKS = 12  # N_n of the paper
_KEPT_ROOTWARD = 3
# Shortest rest length as a part of the distance along the hair, and weakest link as a part of a particle's strongest.
_CLOSEST = 0.5
_FAINTEST = 0.15
_CANDIDATES = 64


@dataclass(frozen=True, eq=False)
class Links:
    """m links, the rootward particle first. The arrays are those of HairModel."""

    pairs: Ints
    rest_length: Floats
    alignment: Floats
    strength: Floats
    rest_cosine: Floats


def connect(
    positions: Floats,
    directions: Floats,
    roots: Floats,
    arc_length: Floats,
    smoothing_length: float,
    same_strands: float,
) -> Links:
    """Link particles that are aligned in a row, about ``WANTED_LINKS`` each.

    positions [m] and unit directions of the initial state, (n, 3); roots: where the hair of each leaves the scalp [m],
    (n, 3); arc_length: s [m], below 0 for root particles, (n,); smoothing_length: h_1 [m].

    Particles are linked because they share strands. A pair that meets in space but grows from roots farther apart than
    ``same_strands`` [m], that lies much closer in space than along the hair (eq. 3), or whose arc lengths run against
    its order in space, shares none and is left out, as are pairs of root particles. Every other particle gets a link
    toward the root, if need be one that a_0 would forbid: hair grows out of the head and nowhere else.
    """
    pairs = find_pairs(positions, 2.0 * smoothing_length)
    fixed = arc_length < 0
    apart = row_length(roots[pairs[:, 0]] - roots[pairs[:, 1]])
    pairs = pairs[(apart < same_strands) & ~(fixed[pairs[:, 0]] & fixed[pairs[:, 1]])]
    links = _measure(positions, directions, pairs)
    offset = np.column_stack([roots, arc_length])[links.pairs]
    along_hair = row_length(offset[:, 1] - offset[:, 0])
    fit = (
        (links.alignment >= SMALLEST_ALIGNMENT)
        & (offset[:, 0, 3] < offset[:, 1, 3])
        & (links.rest_length > _CLOSEST * along_hair)
    )
    links = _prune(_select(links, fit), len(positions), smoothing_length)
    carried = np.zeros(len(positions), dtype=bool)
    carried[links.pairs[:, 1]] = True
    loose = np.flatnonzero(~carried & ~fixed)
    if len(loose) == 0:
        return links
    anchors = _anchor(loose, positions, directions, roots, arc_length)
    return _join(_select(links, ~np.isin(_names(links.pairs), _names(anchors.pairs))), anchors)


def _names(pairs: Ints) -> Ints:
    """One number for each pair, whichever way round, (m,)."""
    return pairs.min(axis=1) * 2**32 + pairs.max(axis=1)


def lifelines(links: Links, arc_length: Floats, smoothing_length: float) -> Ints:
    """For each particle the index of the strongest link that it hangs on, -1 for root particles, (n,)."""
    weight = links.strength * kernel(links.rest_length, smoothing_length)
    order = np.argsort(weight, kind="stable")
    lifeline = np.full(len(arc_length), -1)
    # Assigned from weak to strong: the strongest stays.
    lifeline[links.pairs[order, 1]] = order
    lifeline[arc_length < 0] = -1
    return lifeline


def alignment(cosine_ij: Floats, cosine_ji: Floats) -> Floats:
    """a_ij of eq. 6, from the cosines of theta_ij (t_i against x_ij) and theta_ji (t_j against x_ji); any shape.

    1 when both directions lie along the connection and point the same way, 0 when they do not pass on hair.
    """
    return np.where(cosine_ij * cosine_ji < 0, 0.5 * np.abs(cosine_ij - cosine_ji), 0.0)


def _measure(positions: Floats, directions: Floats, pairs: Ints) -> Links:
    """Rest length, alignment and strength of ``pairs``, each turned so that its first particle is the rootward one."""
    i, j = pairs.T
    offset = positions[j] - positions[i]
    length = row_length(offset)
    unit = offset / np.maximum(length, 1e-12)[:, None]
    cosine_ij = row_dot(directions[i], unit)
    cosine_ji = -row_dot(directions[j], unit)
    a = alignment(cosine_ij, cosine_ji)
    rootward_first = cosine_ij > 0
    pairs = np.where(rootward_first[:, None], pairs, pairs[:, ::-1])
    cosines = np.column_stack([cosine_ij, cosine_ji])
    cosines = np.where(rootward_first[:, None], cosines, cosines[:, ::-1])
    return Links(pairs, length, a, a * length, cosines)  # strength: eq. 5


def _anchor(loose: Ints, positions: Floats, directions: Floats, roots: Floats, arc_length: Floats) -> Links:
    """Links from particles that hang on nothing to one that is nearer to the root.

    Of those next to them on their hair (eq. 3) it is the one that lies nearest: of hair from roots side by side some may
    have fallen to the other side of a shoulder.
    """
    place = np.column_stack([roots, arc_length])
    nearby = cKDTree(place).query(place[loose], k=min(_CANDIDATES, len(place)))[1]
    rootward = arc_length[nearby] < arc_length[loose][:, None]
    away = np.linalg.norm(positions[nearby] - positions[loose][:, None], axis=2)
    chosen = nearby[np.arange(len(loose)), np.argmin(np.where(rootward, away, np.inf), axis=1)]
    # Where all of those lie tipward, the root particle closest by is left.
    fixed = np.flatnonzero(arc_length < 0)
    last_resort = fixed[cKDTree(place[fixed]).query(place[loose])[1]]
    chosen = np.where(rootward.any(axis=1), chosen, last_resort)
    offset = positions[loose] - positions[chosen]
    length = row_length(offset)
    unit = offset / np.maximum(length, 1e-12)[:, None]
    cosines = np.column_stack([row_dot(directions[chosen], unit), -row_dot(directions[loose], unit)])
    a = np.maximum(alignment(*cosines.T), SMALLEST_ALIGNMENT)
    return Links(np.column_stack([chosen, loose]), length, a, a * length, cosines)


def _join(first: Links, second: Links) -> Links:
    return Links(*(np.concatenate([getattr(first, f.name), getattr(second, f.name)]) for f in fields(Links)))


def _select(links: Links, which: np.ndarray) -> Links:
    return Links(*(getattr(links, f.name)[which] for f in fields(Links)))


def _prune(links: Links, count: int, smoothing_length: float) -> Links:
    """Drop links that count for nothing, then weak ones, until no particle has many more than ``WANTED_LINKS``.

    This goes in rounds: every particle with too many gives up its weakest link (the smallest c_ij W(l_ij, h_1)). The
    strongest rootward links of a particle are never given up: particles on the border of the hair have few, and come
    off first.
    """
    weight = links.strength * kernel(links.rest_length, smoothing_length)
    order = np.argsort(-weight, kind="stable")
    links, weight = _select(links, order), weight[order]
    strongest = np.zeros(count)
    np.maximum.at(strongest, links.pairs.ravel(), np.repeat(weight, 2))
    notable = weight > _FAINTEST * strongest[links.pairs].max(axis=1)
    links, weight = _select(links, notable), weight[notable]
    kept_rootward = _rank_in_group(links.pairs[:, 1]) < _KEPT_ROOTWARD
    alive = np.ones(len(weight), dtype=bool)
    while True:
        degree = np.bincount(links.pairs[alive].ravel(), minlength=count)
        removable = np.flatnonzero(alive & ~kept_rootward)
        weakest = np.full(count, -1)
        # Links are sorted from strong to weak: the highest index is the weakest link of a particle.
        np.maximum.at(weakest, links.pairs[removable].ravel(), np.repeat(removable, 2))
        victims = weakest[(degree > WANTED_LINKS) & (weakest >= 0)]
        if len(victims) == 0:
            break
        alive[victims] = False
    return _select(links, alive)


def _rank_in_group(group: Ints) -> Ints:
    """How many earlier entries have the same value, for each entry, shape as ``group``."""
    order = np.argsort(group, kind="stable")
    ordered = group[order]
    first = np.searchsorted(ordered, ordered, side="left")
    rank = np.empty(len(group), dtype=np.int64)
    rank[order] = np.arange(len(group)) - first
    return rank
