import numpy as np

from headstudio.wisp.resample import resampled
from headstudio.wisp.strands import Strands


def helix(count):
    t = np.linspace(0, 1, count)
    return np.stack([0.02 * np.cos(6 * t), -0.2 * t, 0.02 * np.sin(6 * t)], axis=1).astype(np.float32)


def mixed():
    counts = [40, 2, 25, 40]
    first = np.concatenate([[0], np.cumsum(counts)])
    points = np.concatenate([helix(count) for count in counts])
    radius = np.concatenate([np.linspace(4e-5, 1e-5, count) for count in counts]).astype(np.float32)
    colour = np.tile(np.array([0.2, 0.1, 0.05], dtype=np.float32), (len(points), 1))
    return Strands(points, first, radius, colour, np.arange(4, dtype=np.int32))


def test_strands_keep_shape_ends_and_what_belongs_to_them():
    found = resampled(mixed(), 32)
    points = found.points.reshape(4, 32, 3)
    assert found.counts.tolist() == [32] * 4
    assert np.allclose(points[[0, 2, 3]], helix(32), atol=1e-4)
    assert np.allclose(points[1, [0, -1]], helix(2), atol=1e-6)
    assert np.allclose(found.radius.reshape(4, 32), np.linspace(4e-5, 1e-5, 32), atol=1e-7)
    assert np.allclose(found.colour, [0.2, 0.1, 0.05])
    assert found.wisp.tolist() == [0, 1, 2, 3]


def test_the_same_count_changes_nothing():
    strands = Strands.of_equal_count(np.stack([helix(16)] * 3))
    assert resampled(strands, 16) is strands
