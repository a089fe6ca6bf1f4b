"""Members of a wisp: the recurrence of eq. 1 and the cut at the length u."""

import numpy as np
import pytest

from headstudio.wisp.catmull_rom import catmull_rom_matrix
from headstudio.wisp.members import Cuts, Masters, displacements, member_points

STRANDS = 4000
PROFILES = {
    "constant": np.full(12, 0.01),
    "tapering": np.linspace(0.01, 0.001, 12),
    "flaring": np.linspace(0.001, 0.03, 12),
    "pinched": 0.01 * np.abs(np.linspace(-1, 1, 13))[:12],
    "pinched to a point": np.array([0.01, 0.005, 0.0, 0.0, 0.004, 0.0, 0.01]),
    "nothing": np.zeros(5),
}


def even(steps: int, seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).random((steps, 3, STRANDS), dtype=np.float32)


def inside(radius: float, strands: int = STRANDS) -> np.ndarray:
    rng = np.random.default_rng(2)
    direction = rng.normal(size=(3, strands))
    direction *= radius * rng.random(strands) ** (1 / 3) / np.linalg.norm(direction, axis=0)
    return direction.astype(np.float32)


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("sigma", [0.0, 0.1, 1.0])
def test_members_stay_within_the_deviation_radius_at_every_control_point(profile, sigma):
    radii = np.repeat(PROFILES[profile].astype(np.float32)[:, None], STRANDS, axis=1)
    moved = displacements(radii, inside(radii[0, 0]), sigma, even(len(radii) - 1))
    assert np.isfinite(moved).all()
    assert (np.linalg.norm(moved, axis=0) <= radii * (1 + 1e-5)).all()


def test_without_fuzziness_members_are_similar_to_the_master():
    radii = np.repeat(PROFILES["tapering"].astype(np.float32)[:, None], STRANDS, axis=1)
    first = inside(0.01)
    moved = displacements(radii, first, 0.0, even(len(radii) - 1))
    np.testing.assert_allclose(moved, first[:, None] * (radii / radii[0]), rtol=1e-4, atol=1e-9)


def test_after_a_pinch_growth_starts_again_from_noise():
    radii = np.repeat(PROFILES["pinched to a point"].astype(np.float32)[:, None], STRANDS, axis=1)
    length = np.linalg.norm(displacements(radii, inside(0.01), 0.5, even(len(radii) - 1)), axis=0)
    assert length[2].max() == length[3].max() == 0
    assert length[4].mean() == pytest.approx(0.25 * radii[4, 0], rel=0.1)


def test_the_noise_is_even_up_to_sigma_r_for_a_member_on_its_master():
    """Step 2 of section 2.1: from the middle the sphere is at r in all directions, so y is even in [0, sigma r]."""
    radii = np.full((2, STRANDS), 0.01, dtype=np.float32)
    noise = displacements(radii, np.zeros((3, STRANDS), dtype=np.float32), 0.6, even(len(radii) - 1))[:, 1]
    size = np.sort(np.linalg.norm(noise, axis=0))
    np.testing.assert_allclose(size, 0.006 * (np.arange(STRANDS) + 0.5) / STRANDS, atol=2e-4)
    assert np.abs((noise / np.linalg.norm(noise, axis=0)).mean(axis=1)).max() < 0.05


def test_members_gather_less_at_the_border_than_if_they_were_clamped_to_it():
    radii = np.full((40, STRANDS), 0.01, dtype=np.float32)
    first = inside(0.01)
    bounded = np.linalg.norm(displacements(radii, first, 1.0, even(len(radii) - 1))[:, -1], axis=0)
    clamped = first.T.copy()
    rng = np.random.default_rng(1)
    for _ in range(39):
        step = rng.normal(size=clamped.shape)
        clamped += 0.01 * rng.random((STRANDS, 1)) * step / np.linalg.norm(step, axis=1, keepdims=True)
        clamped *= np.minimum(1, 0.01 / np.linalg.norm(clamped, axis=1, keepdims=True))
    assert (bounded > 0.0099).mean() < 0.6 * (np.linalg.norm(clamped, axis=1) > 0.0099).mean()


def masters(per_segment: int = 1) -> Masters:
    """Coils of different pace, about seven control points a turn."""
    joints = 10
    at = np.arange(joints * per_segment + 1)
    turn = np.linspace(0.8, 1.0, 5)[:, None] * at
    controls = np.stack([np.cos(turn), np.sin(turn), np.broadcast_to(at / per_segment, turn.shape)], axis=2)
    controls = controls.astype(np.float32)
    return Masters(
        controls, per_segment, np.ones((5, joints + 1), dtype=np.float32), np.array([10.0, 7.3, 3.0, 1.0, 0.2])
    )


@pytest.mark.parametrize("per_segment", [1, 3])
def test_a_member_is_the_spline_through_its_control_points_cut_at_its_length(per_segment):
    made = masters(per_segment)
    rng = np.random.default_rng(4)
    wisp = rng.integers(0, 5, 60)
    lengths = rng.uniform(0.05, 1.0, 60)
    offsets = 0.1 * rng.normal(size=(3, 11, 60)).astype(np.float32)
    points = member_points(made, Cuts.of(made, 60), wisp, offsets, lengths)
    for strand, (own, length) in enumerate(zip(wisp, lengths)):
        at = np.linspace(0, length * made.ends[own], 60)
        expected = catmull_rom_matrix(11, at) @ offsets[:, :, strand].T
        expected += catmull_rom_matrix(made.controls.shape[1], per_segment * at) @ made.controls[own]
        np.testing.assert_allclose(points[strand], expected, atol=0.01)


def test_lengths_of_straight_members_are_exact():
    joints = 24
    straight = np.zeros((1, joints + 1, 3), dtype=np.float32)
    straight[0, :, 1] = -0.01 * np.arange(joints + 1)
    made = Masters(straight, 1, np.ones((1, joints + 1), dtype=np.float32), np.array([23.4]))
    lengths = np.random.default_rng(5).uniform(0.01, 1, 500)
    offsets = np.zeros((3, joints + 1, 500), dtype=np.float32)
    points = member_points(made, Cuts.of(made, 32), np.zeros(500, dtype=int), offsets, lengths)
    np.testing.assert_allclose(-points[:, -1, 1], 0.234 * lengths, atol=1e-6)
    assert np.abs(np.diff(points[:, :, 1], 2, axis=1)).max() < 1e-6


def test_a_member_without_displacement_lies_on_its_master():
    made = masters()
    none = np.zeros((3, 11, 1), dtype=np.float32)
    points = member_points(made, Cuts.of(made, 11), np.array([0]), none, np.array([1.0]))
    np.testing.assert_allclose(points[0], made.controls[0], atol=1e-5)
