"""What holds single particles: its force, and what the matrix of the implicit solver makes of it."""

from itertools import product

import numpy as np
import pytest

from headstudio.lcp import spring_matrix
from headstudio.lcp.bending import Bending
from headstudio.lcp.hold import Hold
from headstudio.lcp.settings import DynamicsSettings
from headstudio.lcp.spring_matrix import SpringMatrix
from headstudio.lcp.springs import Springs

from .dome import hanging_chain

G = 2.0 / 3.0 / 180.0
EXACT = 1e-6


def some_hold(which, seed=0):
    """On particles ``which``, in directions of their own."""
    rng = np.random.default_rng(seed)
    direction, slip = rng.normal(size=(2, len(which), 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return Hold(np.asarray(which), direction, rng.normal(size=len(which)), slip, *rng.random((4, len(which))))


class Matrix:
    """The matrix of a chain, and what it is when written out."""

    def __init__(self, count):
        self.model = hanging_chain(count, arc_length=0.01 * np.arange(count))
        self.springs = Springs(self.model)
        self.matrix = SpringMatrix(self.model, self.springs)

    def dense(self, *holds):
        """Column by column, between the free particles."""
        settings = DynamicsSettings(inner_friction=0.0)
        links = self.springs.at(self.model.rest_positions, 1e4)
        self.matrix.update(links, self.springs.load(links, settings), holds, G, self.model.mass)
        inverse = []
        for i, axis in product(range(1, self.model.count), range(3)):
            unit = np.zeros_like(self.model.rest_positions)
            unit[i, axis] = 1.0
            inverse.append(self.matrix.solve(unit, np.zeros_like(unit), EXACT)[1:].ravel())
        return np.linalg.inv(np.array(inverse))


def test_the_spring_pushes_along_and_damping_takes_of_the_slip():
    hold = Hold(
        np.array([4]), np.array([[0.0, 1.0, 0.0]]), np.array([5.0]), np.array([[3.0, 2.0, 0.0]]),
        stiffness_along=np.array([7.0]), stiffness_across=np.array([1.0]),
        damping_along=np.array([0.5]), damping_across=np.array([0.25]),
    )  # fmt: skip
    np.testing.assert_allclose(hold.forces(), [[-0.75, 5.0 - 1.0, 0.0]])
    np.testing.assert_allclose(hold.along(0.1), 0.05 + 0.07)
    np.testing.assert_allclose(hold.across(0.1), 0.025 + 0.01)


def test_in_explicit_steps_damping_never_turns_the_slip_round():
    """However strong: a step over the mass takes no more than there is."""
    direction, slip = np.array([[1.0, 0.0, 0.0]]), np.array([[1.0, -2.0, 0.5]])
    strong, none = np.array([1e9]), np.zeros(1)
    hold = Hold(np.zeros(1, int), direction, none, slip, none, none, strong, strong)
    load = np.array([0.1])
    np.testing.assert_allclose(load[:, None] * hold.forces(load), -slip, rtol=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_the_matrix_takes_a_hold_by_its_own_derivative(seed):
    """What a velocity to come changes of the force, and of no other particle's."""
    chain = Matrix(5)
    holds = some_hold([2, 4], seed), some_hold([2], seed + 100)
    wanted = np.zeros((5, 3, 5, 3))
    for hold in holds:
        for k, i in enumerate(hold.which):
            along = np.outer(hold.direction[k], hold.direction[k])
            wanted[i, :, i] += hold.along(G)[k] * along + hold.across(G)[k] * (np.eye(3) - along)
    added = (chain.dense(*holds) - chain.dense()).reshape(4, 3, 4, 3)
    np.testing.assert_allclose(added, wanted[1:, :, 1:], atol=1e-5 * wanted.max())


@pytest.mark.parametrize("two_products", [10_000, -10_000], ids=["worked out", "two products"])
def test_stiff_bending_is_in_the_matrix_by_its_own_derivative(monkeypatch, two_products):
    """What T^T R T adds is what the force of bending loses for a velocity to come."""
    monkeypatch.setattr(spring_matrix, "_TWO_PRODUCTS", two_products)
    chain, settings = Matrix(8), DynamicsSettings(stiffness=10.0)
    model, bending = chain.model, Bending(chain.model)
    stiff = bending.too_stiff(settings, 1.0)
    assert len(stiff.rigidity) == 6
    before = chain.dense()
    chain.matrix.stiffen(stiff, G)
    added = (chain.dense() - before).reshape(7, 3, 7, 3)
    for particle, axis in product(range(7), range(3)):
        faster = np.zeros_like(model.rest_positions)
        faster[particle + 1, axis] = 1.0
        rest_turn = bending.rest_turn(model.rest_directions)
        force = bending.curvature_force(
            model.rest_positions + G * faster, faster, rest_turn, bending.rigidity(settings)
        )
        np.testing.assert_allclose(added[:, :, particle, axis], -G * force[1:], atol=1e-6 * np.abs(added).max())
