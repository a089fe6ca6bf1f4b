import numpy as np
import pytest

from headstudio.wisp.cutting import Blade, cut_strands, scissor_stroke
from headstudio.wisp.operations import Cut
from headstudio.wisp.proportions import Proportions
from headstudio.wisp.selection import Selection

UNIT = Proportions(np.zeros(3), np.ones(3))
EARLY = np.linspace(1.0, 0.0, 60, dtype=np.float32)
UV = np.array([[0.2, 0.5], [0.8, 0.5]])


def hanging(count: int = 60, points: int = 32) -> tuple[np.ndarray, np.ndarray]:
    """Strands of different lengths that hang from a bar with waves in them, and their wisps."""
    length = np.linspace(0.05, 0.4, count)[:, None]
    along = np.linspace(0, 1, points)
    x = np.linspace(-0.1, 0.1, count)[:, None] + 0.004 * np.sin(40 * along * length)
    y = -along * length
    strands = np.stack([x, y, 0 * y], axis=2).astype(np.float32)
    return strands, (np.arange(count) % 2).astype(np.int32)


def cut(strands, owner, **fields):
    blade = Blade.of(Cut(**fields), UNIT, UV)
    return cut_strands(strands.copy(), owner, EARLY, [blade])


def test_hair_ends_at_the_plane():
    strands, owner = hanging()
    shorter = cut(strands, owner, place=(0.0, -0.2, 0.0), normal=(0.0, -3.0, 0.0))
    reached = strands[:, -1, 1] < -0.2
    assert shorter[reached, -1, 1] == pytest.approx(np.full(reached.sum(), -0.2), abs=1e-5)
    assert np.array_equal(shorter[~reached], strands[~reached])
    assert np.array_equal(shorter[:, 0], strands[:, 0])


def test_what_is_left_keeps_its_shape():
    strands, owner = hanging()
    shorter = cut(strands, owner, place=(0.0, -0.2, 0.0), normal=(0.0, -1.0, 0.0))
    for old, new in zip(strands, shorter):
        expected = np.interp(-new[:, 1], -old[:, 1], old[:, 0])
        assert new[:, 0] == pytest.approx(expected, abs=1e-5)


def test_only_the_selected_hair_is_cut_and_only_where_the_blade_reaches():
    strands, owner = hanging()
    left = cut(strands, owner, place=(0.0, -0.1, 0.0), normal=(0, -1, 0), selection=Selection("left"))
    assert np.array_equal(left[owner == 0], strands[owner == 0])
    assert np.all(left[owner == 1, -1, 1] >= -0.1001)
    short = cut(strands, owner, place=(0.1, -0.1, 0.0), normal=(0, -1, 0), reach=0.05)
    far = np.abs(strands[:, :, 0] - 0.1).min(axis=1) > 0.05
    assert np.array_equal(short[far], strands[far])
    assert short[-1, -1, 1] == pytest.approx(-0.1, abs=1e-4)


def test_a_blade_that_ends_in_the_hair_curves_away():
    across = np.linspace(0.0, 0.2, 41)
    down = np.linspace(0.0, -0.4, 64)
    strands = np.stack(np.broadcast_arrays(across[:, None], down, 0.0), axis=2).astype(np.float32)
    ends = cut(strands, np.zeros(41, dtype=int), place=(0.0, -0.2, 0.0), normal=(0, -1, 0), reach=0.12)[:, -1, 1]
    assert ends[0] == pytest.approx(-0.2, abs=1e-4)
    met = across < 0.1
    assert (np.diff(ends[met]) < 0).all()
    assert ends[met][-1] < -0.215
    assert ends[across > 0.121] == pytest.approx(-0.4)


def test_hair_rooted_beyond_the_plane_is_shorn():
    strands, owner = hanging()
    shorn = cut(strands, owner, place=(0.0, 0.1, 0.0), normal=(0.0, -1.0, 0.0))
    assert np.linalg.norm(shorn[:, -1] - shorn[:, 0], axis=1).max() < 0.01
    assert np.isfinite(shorn).all()


def test_a_ragged_cut_ends_strands_before_its_plane_by_parts_of_it():
    strands, owner = hanging()
    shorter = cut(strands, owner, place=(0.0, -0.2, 0.0), normal=(0.0, -1.0, 0.0), ragged=0.03)
    ends = -0.2 + 0.03 * EARLY
    reached = strands[:, -1, 1] < ends
    assert shorter[reached, -1, 1] == pytest.approx(ends[reached], abs=1e-5)
    assert np.array_equal(shorter[~reached], strands[~reached])


def test_cuts_add_up():
    strands, owner = hanging()
    blades = [Blade.of(Cut(place=(0, -y, 0), normal=(0, -1, 0)), UNIT, UV) for y in (0.3, 0.1, 0.2)]
    assert cut_strands(strands.copy(), owner, EARLY, blades)[:, -1, 1].min() == pytest.approx(-0.1, abs=1e-4)


def test_a_stroke_of_scissors_cuts_away_from_the_head_as_it_is_seen():
    eye = np.array([0.0, -0.2, 2.0])
    stroke = scissor_stroke(np.array([-0.1, -0.3, 0.1]), np.array([0.1, -0.3, 0.1]), eye, UNIT)
    strands, owner = hanging()
    blade = Blade.of(stroke, UNIT, UV)
    shorter = cut_strands(strands.copy(), owner, EARLY, [blade])
    # On the plane through the eye and the stroke, at the depth of the hair, a little below the stroke.
    at = -0.3 - 0.1 * (0.1 / 1.9)
    assert shorter[-1, -1, 1] == pytest.approx(at, abs=1e-3)
