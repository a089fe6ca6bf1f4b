import numpy as np
import pytest

from headstudio.wisp.operations import AlongPath, Bun, Constrain, InDirection, Tie, ToPoint, Updo
from headstudio.wisp.paths import off_skin
from headstudio.wisp.selection import Selection

from .dressed import body, hair, styled


@pytest.fixture(scope="module")
def rest():
    return hair(body()[1], 200, 0.42)


def place_of(place, clearance: float) -> np.ndarray:
    _, _, surroundings = body()
    return off_skin(surroundings, surroundings.proportions.place(np.array(place))[None], clearance)[0]


def nearest_to(joints: np.ndarray, point: np.ndarray) -> np.ndarray:
    return np.linalg.norm(joints - point, axis=2).min(axis=1)


@pytest.mark.parametrize("place", [(0.0, 0.45, -1.15), (1.1, -0.1, -0.3), (0.0, 1.3, -0.2), (0.0, -0.4, -1.0)])
@pytest.mark.parametrize("tolerance", [0.004, 0.014])
@pytest.mark.parametrize("kappa", [0.5, 4.0])
def test_a_point_gathers_every_wisp_within_its_tolerance(rest, place, tolerance, kappa):
    laid, report = styled(rest, operations=(Tie(place=place, tolerance=tolerance, lift=0.0),), bending_stiffness=kappa)
    assert nearest_to(laid.joints, place_of(place, tolerance + 0.002)).max() <= tolerance + 1e-9
    assert report.queues[0].selected == 200
    assert report.queues[0].too_short == 0


def test_hair_that_is_too_short_is_reported_and_holds_nobody_up():
    short = hair(body()[1], 120, 0.15)
    laid, report = styled(short, operations=(Tie(),))
    reached = nearest_to(laid.joints, place_of(Tie().place, 0.016)) <= Tie().tolerance
    assert 0 < report.queues[0].too_short == np.count_nonzero(~reached) < 120
    assert report.segments == short.counts.sum()


def test_wisps_that_met_a_point_wait_for_the_others(rest):
    """After the point all set out together: at the same distance along the path all have the same length left or less."""
    path = ((0.0, 0.45, -1.4), (0.0, 0.45, -3.0))
    steps = (ToPoint((0.0, 0.45, -1.3), 0.012), AlongPath(path, 0.012))
    laid, _ = styled(rest, operations=(Constrain(steps=steps),))
    # All hair leaves the knot along the path: nothing of it was spent on the wait, which would show as loops around it.
    _, _, surroundings = body()
    knot = surroundings.proportions.place(np.array([0.0, 0.45, -1.3]))
    near = np.linalg.norm(laid.joints - knot, axis=2) < 0.03
    assert near.sum(axis=1).max() <= 10


def test_a_trajectory_is_followed_within_its_tolerance(rest):
    _, _, surroundings = body()
    places = np.array([[0.0, 0.5, -1.3], [0.6, 0.3, -1.9], [0.0, -0.2, -1.6], [-0.6, -0.6, -1.9]])
    steps = (ToPoint(tuple(places[0]), 0.015), AlongPath(tuple(map(tuple, places)), 0.015))
    laid, report = styled(rest, operations=(Constrain(steps=steps),))
    assert report.queues[0].too_short == 0
    end = surroundings.proportions.place(places[2])
    assert nearest_to(laid.joints, end).max() < 0.025


def test_a_direction_acts_inside_its_radius_only(rest):
    comb = Constrain(steps=(InDirection(((1.2, 0.2, 0.6), (1.2, 0.2, -1.0)), 0.05, 1.0),))
    free, combed = styled(rest)[0], styled(rest, operations=(comb,))[0]
    _, _, surroundings = body()
    far = surroundings.proportions.measure(rest.roots)[:, 0] < -0.2
    # Not quite still: hair that is combed makes room elsewhere.
    assert np.median(np.linalg.norm(combed.joints[far] - free.joints[far], axis=2)) < 0.001
    start, end = surroundings.proportions.place(np.array([[1.2, 0.2, 0.6], [1.2, 0.2, -1.0]]))
    middle = 0.5 * (combed.joints[:, 1:] + combed.joints[:, :-1])
    near = np.linalg.norm(middle - 0.5 * (start + end), axis=2) < 0.03
    assert combed.directions[near][:, 2].mean() < -0.7
    assert free.directions[near][:, 2].mean() > -0.5


def test_weight_mixes_constraint_and_styling_force(rest):
    """Equation 7: with w = 0 the constraint does nothing to where hair flows."""
    weak = Constrain(steps=(ToPoint(weight=0.0),))
    half = Constrain(steps=(ToPoint(weight=0.6),))
    point = place_of(ToPoint().place, 0.016)
    distance = [np.median(nearest_to(styled(rest, operations=(each,))[0].joints, point)) for each in (weak, half)]
    assert distance[0] > 0.03
    assert distance[1] < 0.014


def test_tied_wisps_are_pressed_together_and_widen_again(rest):
    laid, _ = styled(rest, operations=(Tie(tolerance=0.01),))
    at_knot = np.linalg.norm(laid.joints - place_of(Tie().place, 0.012), axis=2) <= 0.01
    assert laid.radii[at_knot].max() <= 0.005
    assert np.all(laid.radii <= rest.radii)
    assert np.median(laid.radii[:, -1]) > 0.005


@pytest.mark.parametrize("operation", [Bun(), Updo()])
def test_hair_that_is_put_up_stays_up(rest, operation):
    laid, report = styled(rest, operations=(operation,))
    assert sum(queue.too_short for queue in report.queues) == 0
    tips = laid.joints[:, -1] - place_of(operation.place, 0.01)
    assert np.linalg.norm(tips, axis=1).max() < 0.12


def test_queues_act_on_their_selection(rest):
    _, scalp, _ = body()
    right = Selection("right")
    laid, report = styled(rest, operations=(Tie(right, (-1.1, 0.0, -0.4)),))
    chosen = right.of(scalp.locate(rest.roots))
    reached = nearest_to(laid.joints, place_of((-1.1, 0.0, -0.4), 0.016)) <= 0.014
    assert np.array_equal(reached, chosen)
    assert report.queues[0].selected == chosen.sum()
