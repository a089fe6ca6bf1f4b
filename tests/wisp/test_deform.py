import numpy as np
import pytest
from scipy.spatial import ConvexHull

from headstudio.head.depth import SkinDepth
from headstudio.head.frame import HeadFrame
from headstudio.wisp.operations import Braid, Tie
from headstudio.wisp.selection import Selection

from .dressed import body, hair, styled


@pytest.fixture(scope="module")
def rest():
    return hair(body()[1])


def mean_angle_to_rest(outlines, rest) -> float:
    cosine = np.einsum("wjk,wjk->wj", outlines.directions, rest.directions)
    return float(np.arccos(np.clip(cosine, -1, 1)).mean())


def occupied_cells(outlines) -> int:
    return len(np.unique(np.floor(outlines.joints.reshape(-1, 3) / 0.01).astype(int), axis=0))


def test_stiffer_hair_bends_less(rest):
    """Figure 9 (a), (b)."""
    angles = [
        mean_angle_to_rest(styled(rest, bending_stiffness=kappa)[0], rest) for kappa in (0.1, 0.5, 1.0, 2.5, 10.0)
    ]
    assert np.all(np.diff(angles) < 0)


def test_a_smaller_threshold_makes_more_volume(rest):
    """Figure 9 (a), (c)."""
    laid = [styled(rest, density_threshold=tau)[0] for tau in (0.9, 0.5, 0.3, 0.1, 0.05)]
    assert np.all(np.diff([occupied_cells(outlines) for outlines in laid]) > 0)
    assert np.all(np.diff([ConvexHull(outlines.joints.reshape(-1, 3)).volume for outlines in laid]) > 0)


def test_short_segments_make_way_little_by_little():
    """Each would else leap aside by as much as a long one, and hair would stand out as tufts."""
    _, scalp, surroundings = body()
    laid, _ = styled(hair(scalp, segment=0.005), density_threshold=0.02)
    free = surroundings.distance_and_gradient_anywhere(laid.joints[:, 1:-1].reshape(-1, 3))[0] > 0.03
    turns = np.einsum("wjk,wjk->wj", laid.directions[:, 1:], laid.directions[:, :-1]).ravel()[free]
    assert len(turns) > 1000
    # Six bends of a quarter of 12 degrees, and what the force itself turns.
    assert np.degrees(np.arccos(turns.min())) < 40
    assert np.degrees(np.arccos(np.quantile(turns, 0.02))) > 12


@pytest.mark.parametrize("force", [{}, {"back": 2.0}, {"gravity": 0.0, "right": 3.0}, {"density_threshold": 0.05}])
def test_no_joint_is_below_the_skin(rest, force):
    head, _, _ = body()
    laid, _ = styled(rest, **force)
    assert SkinDepth(head).deepest(laid.joints[:, 1:].reshape(-1, 3), HeadFrame()) < 0.001


def test_hair_combed_against_its_growth_leaves_the_skin_that_way(rest):
    """Its first segment turns about the skin's normal, and does not rise the more."""
    _, _, surroundings = body()
    front = np.flatnonzero(rest.directions[:, 0, 2] > 0.6)
    assert len(front) > 10
    outward = surroundings.gradient(rest.roots[front]).astype(float)
    laid = styled(rest, bending_stiffness=50.0, gravity=0.0, back=3.0)[0].directions[front, 0]
    assert np.mean(laid[:, 2] < 0) > 0.8
    rise = [np.einsum("ij,ij->i", each, outward) for each in (rest.directions[front, 0], laid)]
    np.testing.assert_allclose(rise[1], rise[0], atol=0.1)


def test_hair_lies_on_the_hair_that_is_rooted_where_it_passes(rest):
    _, _, surroundings = body()
    joints = styled(rest, bending_stiffness=0.2, density_threshold=1.0, gravity=0.0, back=2.0)[0].joints
    first, farther = (surroundings.distance(joints[:, k]) for k in (3, 12))
    along_scalp = (joints[:, 0, 2] > 0.02) & (
        joints[:, 12, 1] > surroundings.proportions.place(np.array([0, 0.5, 0]))[1]
    )
    assert along_scalp.sum() > 20
    assert np.median(farther[along_scalp]) > np.median(first[along_scalp]) + 0.002


def test_segments_keep_their_length_and_frames_stay_square(rest):
    laid, _ = styled(rest, blown=1.0)
    steps = np.linalg.norm(np.diff(laid.joints, axis=1), axis=2)
    assert steps == pytest.approx(np.full(steps.shape, rest.segment))
    assert np.linalg.det(laid.frames) == pytest.approx(np.ones(laid.frames.shape[:2]))


def test_what_lies_beyond_a_tip_continues_it():
    long = hair(body()[1], 60)
    counts = np.arange(60) % 29 + 1
    mixed = type(long)(long.roots, long.segment, counts, long.frames, long.radii, long.strands)
    laid, report = styled(mixed)
    assert report.segments == counts.sum()
    beyond = np.arange(30) >= counts[:, None]
    last = laid.directions[np.arange(60), counts - 1]
    assert np.array_equal(laid.directions[beyond], np.repeat(last, beyond.sum(axis=1), axis=0))


def test_the_same_hair_lies_the_same_twice(rest):
    first, second = styled(rest, operations=(Tie(),))[0], styled(rest, operations=(Tie(),))[0]
    assert np.array_equal(first.frames, second.frames)


def test_a_preview_with_fewer_strands_has_the_same_shape(rest):
    thin = type(rest)(rest.roots, rest.segment, rest.counts, rest.frames, rest.radii, rest.strands // 3)
    full, few = styled(rest, density_threshold=0.2)[0], styled(thin, density_threshold=0.2)[0]
    assert np.abs(full.joints - few.joints).max() < 1e-6


def test_collisions_are_reported(rest):
    _, loose = styled(rest, density_threshold=0.9)
    _, tight = styled(rest, density_threshold=0.05)
    assert 0 <= loose.unresolved <= loose.colliding < tight.colliding <= tight.segments
    assert tight.unresolved <= tight.colliding


@pytest.mark.parametrize("settings", [{}, {"density_threshold": 0.1}])
def test_unselected_wisps_do_not_move(rest, settings):
    """An operation moves the hair it selects and no other, bit for bit; a second one leaves the first alone."""
    _, scalp, _ = body()
    uv = scalp.locate(rest.roots)
    left, back = Tie(Selection("left and v < 0.5"), (1.1, 0.0, -0.4)), Braid(Selection("v > 0.5"))
    free = styled(rest, **settings)[0]
    one = styled(rest, operations=(left,), **settings)[0]
    two = styled(rest, operations=(left, back), **settings)[0]
    chosen, second = left.selection.of(uv), back.selection.of(uv)
    assert chosen.any()
    assert second.any()
    assert np.array_equal(free.frames[~chosen], one.frames[~chosen])
    assert np.array_equal(one.frames[~second], two.frames[~second])
    assert not np.array_equal(free.frames[chosen], one.frames[chosen])
