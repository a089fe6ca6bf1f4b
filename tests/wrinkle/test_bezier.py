"""Bezier chains: fitting strokes, and the nearest point to 0.1 % of a furrow's width."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from headstudio.wrinkle.bezier import BezierChain, fit_stroke, straight
from headstudio.wrinkle.nearest import nearest_on_curve


def brute_force(chain: BezierChain, point: np.ndarray, metric: np.ndarray) -> float:
    """The distance by dense samples, the best of them polished by bounded search."""

    def squared(t: float) -> float:
        away = chain.at(np.array(t)) - point
        return float(away @ metric @ away)

    t, samples = chain.sampled(4000)
    away = samples - point
    best = int(np.einsum("ij,jk,ik->i", away, metric, away).argmin())
    bounds = t[max(best - 1, 0)], t[min(best + 1, len(t) - 1)]
    return float(np.sqrt(min(minimize_scalar(squared, bounds=bounds, method="bounded", options={"xatol": 1e-12}).fun,
                             squared(t[best]))))  # fmt: skip


@pytest.mark.parametrize("seed", range(5))
def test_distances_are_exact(seed):
    rng = np.random.default_rng(seed)
    chain = BezierChain(rng.normal(size=(3 * rng.integers(1, 4) + 1, 2)))
    points = rng.normal(size=(60, 2)) * 1.5
    roots = rng.normal(size=(60, 2, 2))
    metrics = roots @ roots.transpose(0, 2, 1) + 0.2 * np.eye(2)
    found = nearest_on_curve(chain, points, metrics)
    wanted = [brute_force(chain, point, metric) for point, metric in zip(points, metrics)]
    # 0.1 % of a width is 1e-3 when the width is a tenth of the curve's size; this is far below.
    assert np.abs(found.distance - wanted).max() < 1e-6


def test_sides_and_ends():
    line = straight((0.0, 0.0), (1.0, 0.0))
    found = nearest_on_curve(line, np.array([[0.5, 0.2], [0.5, -0.2], [1.3, 0.4], [-0.3, 0.0]]))
    assert found.side[:2].tolist() == [1.0, -1.0]
    assert np.allclose(found.distance, [0.2, 0.2, 0.5, 0.3])
    assert found.beyond.tolist() == [False, False, True, True]


@pytest.mark.parametrize("tolerance", [3e-2, 3e-3, 3e-4])
def test_a_fit_keeps_its_error_bound(tolerance):
    x = np.linspace(0, 4, 200)
    stroke = np.stack([x, np.sin(2 * x) + 0.2 * np.cos(7 * x)], axis=1)
    chain = fit_stroke(stroke, tolerance)
    assert nearest_on_curve(chain, stroke).distance.max() <= tolerance
    assert np.allclose(chain.controls[[0, -1]], stroke[[0, -1]])
    assert chain.count <= 40
    # Neighbouring curves go on in the same direction.
    joints = np.arange(1, chain.count)
    before, after = (chain.controls[3 * joints] - chain.controls[3 * joints - 1],
                     chain.controls[3 * joints + 1] - chain.controls[3 * joints])  # fmt: skip
    assert (np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
            <= 1e-6 * np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1) + 1e-15).all()  # fmt: skip


def test_a_cubic_is_recovered_as_one_curve():
    wanted = BezierChain([[0, 0], [0.3, 0.5], [0.7, 0.4], [1, 0]])
    chain = fit_stroke(wanted.sampled(80)[1], 1e-4)
    assert chain.count == 1
    assert np.abs(chain.controls - wanted.controls).max() < 0.02


def test_a_stroke_of_the_mouse_need_not_be_clean():
    """Points that repeat, as a mouse at rest gives them, and a stroke that comes back to its start."""
    angle = np.repeat(np.linspace(0, 2 * np.pi, 60), 3)
    loop = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    chain = fit_stroke(loop, 1e-2)
    assert nearest_on_curve(chain, loop).distance.max() <= 1e-2
    with pytest.raises(ValueError, match="two points"):
        fit_stroke(np.zeros((5, 2)), 1e-3)


def test_a_chain_has_3k_plus_1_control_points():
    for controls in ([[0, 0]] * 3, [[0, 0]] * 5, [[0, np.nan]] * 4):
        with pytest.raises(ValueError, match="control points"):
            BezierChain(controls)


@pytest.mark.parametrize(("start", "end"), [(0.0, 2.0), (0.3, 0.7), (0.25, 1.5), (1.0, 2.0)])
def test_a_part_of_a_chain_runs_where_the_chain_does(start, end):
    chain = BezierChain(np.random.default_rng(4).random((7, 2)))
    part = chain.between(start, end)
    places = np.linspace(start, end, 9)
    for t in places:
        away = np.linalg.norm(part.sampled(400)[1] - chain.at(t), axis=1).min()
        assert away < 3e-3
    assert np.allclose(part.controls[[0, -1]], chain.at(np.array([start, end])))
