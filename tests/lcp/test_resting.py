"""Hair that lies on the body, within the solution: against all choices of what is held, and against Coulomb's law."""

from itertools import product

import numpy as np
import pytest

from headstudio.lcp.bending import Bending
from headstudio.lcp.contact import LONGEST_REACH, Touching
from headstudio.lcp.resting import Meeting, solve_at_body
from headstudio.lcp.settings import DynamicsSettings
from headstudio.lcp.spring_matrix import SpringMatrix
from headstudio.lcp.springs import Springs

from .dome import hanging_chain

G = 2.0 / 3.0 / 180.0
EXACT = 1e-6
SETTINGS = DynamicsSettings(inner_friction=0.0)


class Lying:
    """A chain, each particle of which meets a plane of its own: it starts on it, or a little above."""

    def __init__(self, seed=0, count=5, elastic_modulus=1e4):
        rng = np.random.default_rng(seed)
        self.model = hanging_chain(count, arc_length=0.01 * np.arange(count))
        springs = Springs(self.model)
        links = springs.at(self.model.rest_positions, elastic_modulus)
        self.matrix = SpringMatrix(self.model, springs)
        self.fill = lambda: self.matrix.update(links, springs.load(links, SETTINGS), G, self.model.mass)
        self.fill()
        normals = rng.normal(size=(count, 3))
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        self.velocities = 0.2 * rng.normal(size=(count, 3)) * ~self.model.fixed[:, None]
        touch = Touching(rng.choice([0.0, 5e-4], count), normals, np.zeros((count, 3)), np.zeros(count))
        self.meeting = Meeting.ahead(touch, self.velocities, G)
        self.right = self.model.mass[:, None] * 0.3 * rng.normal(size=(count, 3)) * ~self.model.fixed[:, None]

    def solve(self, pressing=None, friction=0.0):
        pressing = np.zeros(self.model.count) if pressing is None else pressing
        guess = np.zeros_like(self.right)
        fixed = self.model.fixed
        return solve_at_body(
            self.matrix, self.right, guess, self.meeting, fixed, pressing, friction, G, tolerance=EXACT
        )

    def dense(self):
        """A, column by column, as the solution without contact shows it."""
        free = np.flatnonzero(~self.model.fixed)
        none = np.zeros(0, dtype=int)
        self.matrix.hold(none, np.zeros((0, 3)), np.zeros(0))
        inverse = []
        for i, axis in product(free, range(3)):
            unit = np.zeros_like(self.right)
            unit[i, axis] = 1.0
            inverse.append(self.matrix.solve(unit, np.zeros_like(unit), EXACT)[0][free].ravel())
        return np.linalg.inv(np.array(inverse))

    def by_trying_all(self):
        """dv and lambda: the one choice of held particles where nothing pulls and nothing leads into the body."""
        free = np.flatnonzero(~self.model.fixed)
        matrix, right = self.dense(), self.right[free].ravel()
        normals = np.zeros((len(free), 3 * len(free)))
        for row, i in enumerate(free):
            normals[row, 3 * row : 3 * row + 3] = self.meeting.touch.normals[i]
        wanted = (self.meeting.least - self.meeting.leaving)[free]
        planes = self.meeting.touch.normals[free].any(axis=1)
        for choice in product([False, True], repeat=len(free)):
            if np.any(~planes[list(choice)]):
                continue
            n = normals[list(choice)]
            size = len(n)
            whole = np.block([[matrix, -G * n.T], [n, np.zeros((size, size))]])
            solved = np.linalg.solve(whole, np.concatenate([right, wanted[list(choice)]]))
            change, force = solved[: len(right)], solved[len(right) :]
            if np.all(force >= 0) and np.all(normals @ change >= wanted - 1e-9):
                pressing = np.zeros(self.model.count)
                pressing[free[list(choice)]] = force
                return change.reshape(-1, 3), pressing
        raise AssertionError("contact has no solution")


@pytest.mark.parametrize("seed", range(20))
def test_forces_explain_the_motion(seed):
    """A dv = b + g lambda n, and hair that is pressed leaves just as fast as it must."""
    lying = Lying(seed)
    free, meeting = ~lying.model.fixed, lying.meeting
    change, force = lying.solve()
    normals = meeting.touch.normals[free]
    left = (lying.dense() @ change[free].ravel() - lying.right[free].ravel()).reshape(-1, 3) / G
    along = np.einsum("ij,ij->i", left, normals)
    np.testing.assert_allclose(left, along[:, None] * normals, atol=1e-5)
    np.testing.assert_allclose(np.maximum(along, 0.0), force[free], atol=1e-5)
    speed = meeting.leaving + np.einsum("ij,ij->i", change, meeting.touch.normals)
    np.testing.assert_allclose(speed[force > 0], meeting.least[force > 0], atol=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_what_is_held_is_what_has_to_be(seed):
    """Of all choices of held particles it is the one where nothing pulls and nothing leads into the body."""
    lying = Lying(seed)
    wanted, pressing = lying.by_trying_all()
    change, force = lying.solve()
    np.testing.assert_allclose(change[~lying.model.fixed], wanted, atol=1e-5)
    np.testing.assert_allclose(force, pressing, atol=1e-5)


def test_what_is_let_go_is_filled_in_as_it_was():
    lying = Lying(3)
    before = lying.dense()
    lying.solve(np.full(lying.model.count, 1e-3), friction=0.7)
    np.testing.assert_array_equal(lying.dense(), before)


@pytest.mark.parametrize("seed", range(10))
def test_taut_hair_ends_at_its_reach_and_pulls_the_rest(seed):
    """The same law with planes square to the roots: springs know of a tether before they are solved."""
    lying = Lying(seed, elastic_modulus=1e3)
    model, count = lying.model, lying.model.count
    nowhere = Touching(np.full(count, np.inf), np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count))
    lying.velocities = 2.0 * np.random.default_rng(seed).normal(size=(count, 3)) * ~model.fixed[:, None]
    start = model.root_points + 1.02 * (model.rest_positions - model.root_points)
    ahead = start + G * lying.velocities
    lying.meeting = Meeting.ahead(nowhere, lying.velocities, G).taut(model, ahead, lying.velocities, G)
    wanted, pulling = lying.by_trying_all()
    change, force = lying.solve(friction=0.5)
    np.testing.assert_allclose(change[~model.fixed], wanted, atol=1e-5)
    np.testing.assert_allclose(force, pulling, atol=1e-5)
    held = force > 0
    assert held.any()
    outward = (ahead - model.root_points)[held]
    reach = np.linalg.norm(outward, axis=1)
    along = reach + G * np.einsum("ij,ij->i", change[held], outward) / reach
    np.testing.assert_allclose(along, LONGEST_REACH * model.arc_length[held], rtol=1e-4)


def test_stiff_bending_is_in_the_solution_by_its_own_derivative():
    """What T^T R T adds to the matrix is what the force of bending loses for a velocity to come, held particles and all."""
    lying, settings = Lying(3, count=8), DynamicsSettings(stiffness=10.0)
    model, bending = lying.model, Bending(lying.model)
    stiff = bending.too_stiff(settings, 1.0)
    assert len(stiff.rigidity) == 6
    before = lying.dense()
    lying.matrix.stiffen(stiff, G)
    lying.fill()
    added = (lying.dense() - before).reshape(7, 3, 7, 3)
    for particle, axis in product(range(7), range(3)):
        faster = np.zeros_like(model.rest_positions)
        faster[particle + 1, axis] = 1.0
        rest_turn = bending.rest_turn(model.rest_directions)
        force = bending.curvature_force(
            model.rest_positions + G * faster, faster, rest_turn, bending.rigidity(settings)
        )
        np.testing.assert_allclose(added[:, :, particle, axis], -G * force[1:], atol=1e-6 * np.abs(added).max())


@pytest.fixture
def sliding():
    """One particle on a floor, hardly linked, under its weight."""
    lying = Lying(count=2, elastic_modulus=1e-6)
    lying.velocities = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    up = np.array([[0.0, 1.0, 0.0]] * 2)
    lying.meeting = Meeting.ahead(Touching(np.zeros(2), up, np.zeros((2, 3)), np.zeros(2)), lying.velocities, G)
    lying.right = lying.model.mass[:, None] * np.array([[0.0, 0.0, 0.0], [0.0, -9.81 * G, 0.0]])
    return lying


def test_the_floor_carries_the_weight(sliding):
    change, pressing = sliding.solve()
    np.testing.assert_allclose(change[1], 0, atol=1e-6)
    assert pressing[1] == pytest.approx(9.81 * sliding.model.mass[1], rel=1e-6)


def test_friction_slows_hair_by_coulombs_law(sliding):
    _, pressing = sliding.solve()
    change, _ = sliding.solve(pressing, friction=0.5)
    np.testing.assert_allclose(change[1], [-0.5 * 9.81 * G, 0, 0], rtol=0.05, atol=1e-6)


def test_hair_that_is_hardly_pushed_sticks(sliding):
    """A push of less than mu times the weight does not get it going."""
    sliding.meeting = Meeting.ahead(sliding.meeting.touch, np.zeros((2, 3)), G)
    sliding.right[1, 0] = 0.3 * 9.81 * G * sliding.model.mass[1]
    _, pressing = sliding.solve()
    change, _ = sliding.solve(pressing, friction=0.5)
    assert 0 < change[1, 0] < 0.005
