"""The curve by which things begin and end."""

import numpy as np
import pytest

from headstudio.head.smooth import smoothstep


@pytest.mark.parametrize(("start", "end"), [(0.0, 1.0), (-2.0, 0.5), (3.0, 1.0)])
def test_it_leads_from_nothing_to_all_and_is_level_at_both_ends(start, end):
    t = np.linspace(-0.5, 1.5, 2001)
    curve = smoothstep(start + t * (end - start), start, end)
    assert np.all(curve[t <= 0] == 0)
    np.testing.assert_allclose(curve[t >= 1], 1, atol=1e-12)
    assert np.all(np.diff(curve) >= -1e-12)
    np.testing.assert_allclose(curve + curve[::-1], 1, atol=1e-12)
    slope = np.gradient(curve, t)
    assert np.abs(slope[np.abs(t) < 1e-3]).max() < 0.01
    assert slope.max() == pytest.approx(1.5, rel=1e-3)


def test_single_numbers_stay_single():
    assert smoothstep(np.linspace(0, 1, 5, dtype=np.float32)).dtype == np.float32
