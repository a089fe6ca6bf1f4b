"""The time integration against the decay and the oscillation that it must reproduce in closed form."""

import numpy as np
import pytest

from headstudio.lcp.generalised_alpha import _KEPT, FORCE_AT, WEIGHT, gone_on, looking_back, on_the_way, way_begun


def followed(rate: complex, dt: float, steps: int) -> np.ndarray:
    """y' = rate y from 1, a solution of the implicit equation in every step, (steps + 1,)."""
    g = WEIGHT / FORCE_AT * dt
    now, before = 1.0 + 0.0j, 1.0 - dt * rate
    path = [now]
    for _ in range(steps):
        # y' = y^ + g f at the point on the way, which is linear in y'.
        then = (gone_on(now, before) + g * rate * (1.0 - FORCE_AT) * now) / (1.0 - g * rate * FORCE_AT)
        assert then == pytest.approx(gone_on(now, before) + g * rate * on_the_way(now, then))
        now, before = then, looking_back(then, now, before)
        path.append(now)
    return np.array(path)


@pytest.mark.parametrize("rate", [-1.0, 1.0j, -0.5 + 2.0j])
def test_the_error_grows_with_the_constant_of_the_method(rate: complex) -> None:
    dt, steps = 1e-3, 1000
    path = followed(rate, dt, 2 * steps)
    error = path / np.exp(rate * dt * np.arange(2 * steps + 1)) - 1.0
    constant = 1.0 / 12.0 + 0.25 * ((1.0 - _KEPT) / (1.0 + _KEPT)) ** 2
    # The start leaves an error of its own, which stays as it is.
    assert error[-1] - error[steps] == pytest.approx(constant * rate**3 * dt**3 * steps, rel=0.01)


def test_what_is_far_too_fast_keeps_its_part_in_every_step() -> None:
    path = np.abs(followed(-1e9, 1.0, 40))
    late = path[20:] / path[0]
    assert late[-1] < 1e-6
    # A double root: the rate is reached from above as slowly as steps are counted.
    assert (late[-1] / late[0]) ** (1.0 / 20.0) == pytest.approx(_KEPT, rel=0.1)


def test_an_oscillator_that_starts_at_the_right_slope_is_followed_to_second_order() -> None:
    def error(steps: int) -> float:
        dt = 2.0 * np.pi / steps
        x, v = np.array([1.0]), np.array([0.0])
        x_before, v_before = x - dt * v, v + dt * x
        g = WEIGHT * dt
        for _ in range(steps):
            x_hat, v_hat = gone_on(x, x_before) + way_begun(v, dt), gone_on(v, v_before)
            # v' = v^ - g / a (x + a (x^ + g v' - x)) of the oscillator x'' = -x.
            v_new = (v_hat - g / FORCE_AT * on_the_way(x, x_hat)) / (1.0 + g * g)
            x_new = x_hat + g * v_new
            x_before, v_before = looking_back(x_new, x, x_before), looking_back(v_new, v, v_before)
            x, v = x_new, v_new
        return float(np.hypot(x - 1.0, v)[0])

    assert error(200) / error(400) == pytest.approx(4.0, rel=0.05)
    assert error(400) < 2e-3
