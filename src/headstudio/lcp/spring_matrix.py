"""The matrix of the implicit solver: the springs between the free particles and along their strands, and its solution.

The pattern of the links never changes, so where each number goes is worked out once. A link adds the same symmetric
3 x 3 block, six different numbers, to the diagonal at both of its ends and takes it from the two places that couple them.
Bending that is too stiff for an explicit step adds the same numbers all the time, where they are few; those of much
stiff hair are not worked out, but left as the product of two matrices.

What holds single particles only adds to their own blocks.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from scipy import sparse

from ..head.mesh import Floats, Ints
from ..head.rows import OnColumns, rows_at
from .bending import StiffTurning
from .hold import Hold
from .model import HairModel
from .springs import LinkState, Load, Springs

_MOST_ITERATIONS = 60
# What two products more cost beside their entries: as much as so many entries of one along x, y and z.
_TWO_PRODUCTS = 7000
# The places of a symmetric 3 x 3 block, row by row, among its six numbers xx, xy, xz, yy, yz, zz.
_SIX_OF_NINE = np.array([0, 1, 2, 1, 3, 4, 2, 4, 5])


class SpringMatrix:
    """M + g D + g^2 K of the free particles, and conjugate gradients on it.

    K and D are those of the springs, and of bending where it is too stiff for an explicit step.
    """

    def __init__(self, model: HairModel, springs: Springs) -> None:
        self._free = np.flatnonzero(~model.fixed)
        self._around = OnColumns(springs.around[self._free], 6)
        count, links = len(self._free), len(model.links)
        place = np.full(model.count, -1)
        place[self._free] = np.arange(count)
        self._place = place
        rootward, tipward = place[model.links].T
        inner = np.flatnonzero((rootward >= 0) & (tipward >= 0))
        # Every block by the six numbers it is made of: those of the links first, then those of the diagonal.
        block = np.concatenate([links + np.arange(count), inner, inner])
        rows = np.concatenate([np.arange(count), rootward[inner], tipward[inner]])
        columns = np.concatenate([np.arange(count), tipward[inner], rootward[inner]])
        # All x, then all y, then all z: what is done to every block is done to long rows.
        entry_rows = (rows[:, None] + count * np.repeat(np.arange(3), 3)).ravel()
        entry_columns = (columns[:, None] + count * np.tile(np.arange(3), 3)).ravel()
        self._entries = entry_rows, entry_columns
        self._number_of_entry = (_SIX_OF_NINE * (links + count) + block[:, None]).ravel()
        self._six = np.zeros((6, links + count))
        self._inverse = np.zeros((3, 3, count))
        self.stiffen(StiffTurning(sparse.csr_array((0, model.count)), np.zeros(0)), 0.0)

    def stiffen(self, bending: StiffTurning, g: float) -> None:
        """Add T^T R T for bending, which is alike in all directions, with g of the implicit step [s]. Before ``update``."""
        turn, rigidity = bending.turn[:, self._free], bending.damped(g)
        self._bending_diagonal = turn.power(2).T @ rigidity
        turn_back = turn.T @ sparse.diags_array(rigidity)
        worked_out = turn_back @ turn
        if worked_out.nnz <= 2 * turn.nnz + _TWO_PRODUCTS:
            self._turns = ()
            self._arrange(worked_out)
        else:
            self._turns = tuple(sparse.block_diag([part] * 3, format="csr") for part in (turn, turn_back))
            self._arrange(sparse.csr_array(worked_out.shape))

    def _arrange(self, bending: sparse.csr_array) -> None:
        """Lay out the numbers of the blocks, and with them those of ``bending``, which are always the same."""
        added = sparse.block_diag([bending] * 3, format="coo")
        rows, columns = (np.concatenate(both) for both in zip(self._entries, added.coords, strict=True))

        def sorted_in(of_entries: Floats, of_added: Floats) -> sparse.csr_array:
            shape = 2 * (3 * len(self._free),)
            matrix = sparse.csr_array((np.concatenate([of_entries, of_added]), (rows, columns)), shape=shape)
            matrix.sort_indices()
            return matrix

        # Numbering the entries and letting scipy sort them tells where each one goes; those that are only added have none.
        numbers = np.arange(1.0, len(self._number_of_entry) + 1.0)
        numbered = sorted_in(numbers, np.zeros(added.nnz))
        of_bending = sorted_in(np.zeros(len(numbers)), added.data).data
        entry = numbered.data.astype(np.int64) - 1
        self._source = self._number_of_entry[np.maximum(entry, 0)]
        self._bent = np.flatnonzero((of_bending != 0.0) | (entry < 0))
        self._of_bending, self._shared = of_bending[self._bent], np.where(entry[self._bent] < 0, 0.0, 1.0)
        # Products with indices of 64 bits are the faster ones.
        indices, begins = numbered.indices.astype(np.int64), numbered.indptr.astype(np.int64)
        self._matrix = sparse.csr_array((np.zeros(len(indices)), indices, begins), shape=numbered.shape)

    def update(self, links: LinkState, load: Load, holds: Iterable[Hold], g: float, inertia: Floats) -> None:
        """Fill the matrix for the links and holds at one instant. inertia: what else the diagonal has [kg], (n,)."""
        # A pulled link also resists turning; a pushed one would help it, and is left out to keep the matrix definite.
        turning = g * g * np.maximum(load.pull, 0.0) / np.maximum(links.length, 1e-9)
        along = g * g * load.stiffness + g * load.damping - turning
        across = turning + g * load.friction
        count = len(along)
        x, y, z = links.unit.T
        of_links, of_diagonal = self._six[:, :count], self._six[:, count:]
        pushed = along * x
        of_links[0], of_links[1], of_links[2] = pushed * x + across, pushed * y, pushed * z
        pushed = along * y
        of_links[3], of_links[4] = pushed * y + across, pushed * z
        of_links[5] = along * z * z + across
        of_diagonal[:] = (self._around @ of_links.T).T
        of_diagonal[[0, 3, 5]] += inertia[self._free]
        for hold in holds:
            _add(of_diagonal, self._place[hold.which], hold, g)
        of_links *= -1.0
        entries = self._six.ravel().take(self._source)
        entries[self._bent] = entries[self._bent] * self._shared + self._of_bending
        self._matrix.data = entries
        block = of_diagonal.copy()
        block[[0, 3, 5]] += self._bending_diagonal
        _invert_symmetric(block, self._inverse)

    def solve(self, right: Floats, guess: Floats, tolerance: float) -> Floats:
        """Preconditioned conjugate gradients from ``guess``: the solution for ``right``, (n, 3), zero at root particles.

        tolerance: of what is left of the right side, as a part of it.
        """
        inverse = self._inverse
        wanted, solution = (rows_at(vectors, self._free).ravel(order="F") for vectors in (right, guess))
        residual = wanted - self._of(solution)
        z = _times(inverse, residual)
        direction = z.copy()
        rho = residual @ z
        if not np.isfinite(rho):
            # A force that is no number must not pass for one that is solved.
            return np.full_like(right, np.nan)
        goal = tolerance**2 * (wanted @ _times(inverse, wanted))
        taken = 0
        while rho > goal and taken < _MOST_ITERATIONS:
            image = self._of(direction)
            step = rho / (direction @ image)
            solution += step * direction
            residual -= step * image
            z = _times(inverse, residual)
            rho, last = residual @ z, rho
            direction *= rho / last
            direction += z
            taken += 1
        return self._at_all(solution)

    def _of(self, vectors: Floats) -> Floats:
        """The matrix times vectors, all x first, then all y, then all z."""
        product: Floats = self._matrix @ vectors
        if self._turns:
            turn, turn_back = self._turns
            product += turn_back @ (turn @ vectors)
        return product

    def _at_all(self, of_free: Floats) -> Floats:
        at_all = np.zeros((len(self._place), 3), order="F")
        at_all.T[:, self._free] = of_free.reshape(3, -1)
        return at_all


def _add(six: Floats, which: Ints, hold: Hold, g: float) -> None:
    """Add what holds particles, ``which`` of the blocks (6, n), to them."""
    x, y, z = hold.direction.T
    across = hold.across(g)
    six[:, which] += (hold.along(g) - across) * np.stack([x * x, x * y, x * z, y * y, y * z, z * z])
    for diagonal in (0, 3, 5):
        six[diagonal, which] += across


def _times(blocks: Floats, vectors: Floats) -> Floats:
    """Blocks (3, 3, n) times as many vectors, all x first, then all y, then all z, of the shape of ``vectors``."""
    product: Floats = np.einsum("ijk,jk->ik", blocks, vectors.reshape(3, -1))
    return product.reshape(vectors.shape)


def _invert_symmetric(six: Floats, out: Floats) -> None:
    """The inverses of symmetric 3 x 3 matrices by their cofactors. six: xx, xy, xz, yy, yz, zz, (6, n). out: (3, 3, n)."""
    a, b, c, d, e, f = six
    first, second, third = d * f - e * e, c * e - b * f, b * e - c * d
    scale = 1.0 / (a * first + b * second + c * third)
    out[0, 0] = first * scale
    out[0, 1] = out[1, 0] = second * scale
    out[0, 2] = out[2, 0] = third * scale
    out[1, 1] = (a * f - c * c) * scale
    out[1, 2] = out[2, 1] = (b * c - a * e) * scale
    out[2, 2] = (a * d - b * b) * scale
