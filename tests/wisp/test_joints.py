import numpy as np
import pytest

from headstudio.wisp.joints import REFERENCE_SEGMENT, bend_toward, joint_stiffness, most_aligned, turn, unit


def random_directions(count: int, seed: int) -> np.ndarray:
    vectors = np.random.default_rng(seed).normal(size=(count, 3))
    return unit(vectors, otherwise=vectors)


def frames_along(directions: np.ndarray) -> np.ndarray:
    across = np.cross(directions, np.eye(3)[np.abs(directions).argmin(axis=1)])
    across = unit(across, otherwise=across)
    return np.stack([across, np.cross(directions, across), directions], axis=2)


@pytest.mark.parametrize("kappa", [0.0, 0.5, 2.5])
def test_no_direction_has_more_energy_than_the_closed_form(kappa):
    force, rest = 2.0 * random_directions(50, 1), random_directions(50, 2)
    others = random_directions(2000, 3)
    best = most_aligned(force, rest, kappa)
    energy = np.einsum("ij,ij->i", force + kappa * rest, best)
    assert np.all(energy[:, None] >= (force + kappa * rest) @ others.T - 1e-12)


def test_kappa_of_the_reference_segment_is_the_paper_s():
    assert joint_stiffness(0.5, REFERENCE_SEGMENT) == pytest.approx(0.5)
    assert joint_stiffness(0.0, 0.003) == 0.0


@pytest.mark.parametrize("kappa", [0.5, 2.5, 10.0])
def test_hair_bends_alike_however_finely_it_is_cut(kappa):
    force = np.array([[0.0, -1.0, 0.0]])

    def after(length: float, segment: float) -> np.ndarray:
        direction = unit(np.array([[1.0, -1.0, 0.0]]), otherwise=force)
        for _ in range(round(length / segment)):
            direction = most_aligned(force, direction, joint_stiffness(kappa, segment))
        return direction[0]

    coarse, fine = after(0.04, 0.02), after(0.04, 0.0025)
    assert np.degrees(np.arccos(coarse @ fine)) < 2.0


def test_frames_turn_the_shortest_way():
    start, end = random_directions(200, 4), random_directions(200, 5)
    frames = frames_along(start)
    turned = turn(frames, start, end)
    assert turned[:, :, 2] == pytest.approx(end)
    assert turned.transpose(0, 2, 1) @ turned == pytest.approx(np.broadcast_to(np.eye(3), turned.shape), abs=1e-12)
    rotation = turned @ frames.transpose(0, 2, 1)
    angle = np.arccos(np.clip((np.trace(rotation, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert angle == pytest.approx(np.arccos(np.einsum("ij,ij->i", start, end)), abs=1e-6)


def test_the_opposite_direction_is_half_a_turn():
    start = random_directions(20, 6)
    turned = turn(frames_along(start), start, -start)
    assert turned[:, :, 2] == pytest.approx(-start)
    assert np.linalg.det(turned) == pytest.approx(np.ones(20))


def test_a_bend_goes_so_far_and_not_beyond_its_goal():
    direction, goal = random_directions(100, 7), random_directions(100, 8)
    apart = np.arccos(np.einsum("ij,ij->i", direction, goal))
    bent = bend_toward(direction, goal, 0.3)
    left = np.arccos(np.clip(np.einsum("ij,ij->i", bent, goal), -1, 1))
    assert left == pytest.approx(np.maximum(apart - 0.3, 0.0), abs=1e-6)
