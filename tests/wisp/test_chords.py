"""Between their points strands stay out of ears, too."""

import numpy as np

from headstudio.head.depth import SkinDepth
from headstudio.head.frame import HeadFrame
from headstudio.head.sampling import sample_surface
from headstudio.wisp.chords import keep_chords_outside

from .dressed import body

MARGIN = 0.0005
CHORD = 0.009


def strands_over_ears() -> np.ndarray:
    """Strands of three points outside of the skin, (S, 3, 3), whose chords cut a little into the left or the right ear."""
    head, _, surroundings = body()
    points, normals = sample_surface(head.skin, 0.002)
    ears = surroundings.proportions.measure(points)
    at_ear = (np.abs(ears[:, 0]) > 1.0) & (np.abs(ears[:, 1] + 0.4) < 0.5) & (np.abs(ears[:, 2]) < 0.4)
    middle, normal = points[at_ear], normals[at_ear]
    rng = np.random.default_rng(3)
    along = np.cross(normal, rng.normal(size=normal.shape))
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    ways = np.array([-1.5, -0.5, 0.5])[None, :, None] * CHORD
    strands = ((middle - 0.001 * normal)[:, None] + ways * along[:, None]).astype(np.float32)
    free = surroundings.distance(strands.reshape(-1, 3)).reshape(-1, 3).min(axis=1) > MARGIN
    return strands[free]


def strands_through_ears() -> np.ndarray:
    """Strands of two points, one on either side of the left or the right ear, (S, 2, 3)."""
    head, _, surroundings = body()
    points, normals = sample_surface(head.skin, 0.003)
    places = surroundings.proportions.measure(points)
    at_ear = (np.abs(places[:, 0]) > 1.05) & (np.abs(places[:, 1] + 0.4) < 0.4) & (np.abs(places[:, 2] + 0.2) < 0.3)
    ways = np.array([0.005, -0.012])[None, :, None]
    strands = (points[at_ear][:, None] + ways * normals[at_ear][:, None]).astype(np.float32)
    free = surroundings.distance(strands.reshape(-1, 3)).reshape(-1, 2).min(axis=1) > 0.002
    return strands[free]


def depth_between(strands: np.ndarray) -> float:
    head, _, _ = body()
    parts = np.linspace(0, 1, 9)[:, None, None, None]
    between = (1 - parts) * strands[:, :-1] + parts * strands[:, 1:]
    return SkinDepth(head).deepest(between.reshape(-1, 3).astype(np.float64), HeadFrame())


def test_chords_over_an_ear_are_moved_out_of_it():
    _, _, surroundings = body()
    strands = strands_over_ears()
    assert len(strands) > 20
    assert depth_between(strands) > 0.001
    moved = keep_chords_outside(surroundings, strands.copy(), MARGIN)
    assert depth_between(moved) < 0.001
    assert surroundings.distance(moved.reshape(-1, 3)).min() > 0.9 * MARGIN


def test_what_goes_through_an_ear_is_taken_around_it():
    _, _, surroundings = body()
    strands = strands_through_ears()
    assert len(strands) > 20
    moved = keep_chords_outside(surroundings, strands.copy(), MARGIN)
    before, after = (np.array([depth_between(strand[None]) for strand in each]) for each in (strands, moved))
    assert np.median(before) > 0.001
    assert np.mean(after < 0.001) > 0.9
    assert np.linalg.norm(moved - strands, axis=2).max() < 0.03


def test_strands_away_from_all_that_is_thin_stay_where_they_are():
    _, scalp, surroundings = body()
    uv = np.array([[0.5, 0.3], [0.5, 0.5], [0.4, 0.4]])
    roots, up = scalp.points(uv), scalp.normals(uv)
    strands = (roots[:, None] + np.linspace(0.001, 0.1, 5)[None, :, None] * up[:, None]).astype(np.float32)
    np.testing.assert_array_equal(keep_chords_outside(surroundings, strands.copy(), MARGIN), strands)
