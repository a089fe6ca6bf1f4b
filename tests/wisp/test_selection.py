import numpy as np
import pytest

from headstudio.head.scalp_settings import GrayImage
from headstudio.wisp.selection import REGIONS, Selection, StylingError, evaluate

UV = np.random.default_rng(1).random((500, 2))
U, V = UV.T


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("v < 0.3 and u > 0.5", (V < 0.3) & (U > 0.5)),
        ("left and not nape", (U > 0.5) & ~(V > 0.85)),
        ("0.2 <= u < 0.8", (U >= 0.2) & (U < 0.8)),
        ("abs(2 * u - 1) > v or v / 2 >= 0.4", (np.abs(2 * U - 1) > V) | (V / 2 >= 0.4)),
        (
            "hypot(u - 0.5, v - 0.5) < min(0.3, max(u, v))",
            np.hypot(U - 0.5, V - 0.5) < np.minimum(0.3, np.maximum(U, V)),
        ),
        ("u > -1", np.ones(500, dtype=bool)),
        ("1 > 2", np.zeros(500, dtype=bool)),
    ],
)
def test_expressions(expression, expected):
    assert np.array_equal(evaluate(expression, UV), expected)


@pytest.mark.parametrize("name", sorted(REGIONS))
def test_every_region_chooses_some_hair(name):
    assert evaluate(name, UV).any()


@pytest.mark.parametrize(
    "expression",
    [
        "",
        "u +",
        "u",
        "w < 1",
        "__import__('os').system('true')",
        "u.real > 0",
        "(lambda: 1)() > 0",
        "u < 'a'",
        "left + 1 > 0",
        "not u",
        "abs(u, v) > 0",
        "[u for u in (1,)] > 0",
        "u ** 99999 > 0",
        "u == v",
        "hypot(u, v, key=1) > 0",
        "(" * 300 + "u" + ")" * 300 + "> 0",
        "\x00",
    ],
)
def test_what_is_no_expression_is_one_line(expression):
    with pytest.raises(StylingError) as error:
        Selection(expression)
    assert "\n" not in str(error.value)


def test_a_lasso_chooses_what_it_holds():
    corner = ((0.0, 0.0), (0.5, 0.0), (0.5, 0.5), (0.0, 0.5))
    notch = ((0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.5, 0.4), (0.2, 0.8))
    assert np.array_equal(Selection(lasso=(corner,)).of(UV), (U < 0.5) & (V < 0.5))
    inside = Selection(lasso=(notch,)).of(UV)
    above_notch = 0.8 - (0.4 / 0.3) * np.minimum(U - 0.2, 0.8 - U) > V
    assert np.array_equal(inside, (U > 0.2) & (U < 0.8) & (V > 0.2) & above_notch)
    assert np.array_equal(Selection(lasso=(corner, notch)).of(UV), inside | (U < 0.5) & (V < 0.5))


def test_all_ways_to_choose_must_agree():
    mask = np.zeros((64, 64), dtype=np.float32)
    mask[:, 32:] = 1.0
    chosen = Selection("v < 0.5", (((0.0, 0.0), (1.0, 0.0), (1.0, 0.3), (0.0, 0.3)),), GrayImage(mask)).of(UV)
    assert np.array_equal(chosen, (V < 0.3) & (U >= 0.5))
