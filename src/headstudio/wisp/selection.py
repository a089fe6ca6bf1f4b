"""Which wisps an operation is for: named regions of the scalp square, expressions over it, lassos and painted masks."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..head.length_maps import sample
from ..head.mesh import Floats
from ..head.scalp_settings import GrayImage

Chosen = NDArray[np.bool_]


class StylingError(ValueError):
    """Styling that cannot be carried out. The message is one line for the user."""


REGIONS = {
    "all": "u >= 0",
    "left": "u > 0.5",
    "right": "u <= 0.5",
    "front": "v < 0.3",
    "back": "v > 0.6",
    "top": "v > 0.15 and v < 0.6 and u > 0.25 and u < 0.75",
    "crown": "hypot(u - 0.5, v - 0.45) < 0.2",
    "nape": "v > 0.85",
    "bang": "v < 0.2 and u > 0.2 and u < 0.8",
    "sides": "(u < 0.2 or u > 0.8) and v < 0.75",
    "temples": "(u < 0.15 or u > 0.85) and v < 0.35",
    "upper": "v < 0.5 and u > 0.12 and u < 0.88",
}
"""Named parts of the scalp square. u runs from the person's right (0) to the left (1), v from forehead (0) to nape (1)."""


@dataclass(frozen=True)
class Selection:
    """What is chosen on the scalp: everything that all three of these choose.

    where: names of REGIONS and comparisons of u and v, joined by and, or, not, as ``back and not (u > 0.4 and v < 0.8)``.
    lasso: polygons in (u, v), of which one must hold the wisp; none choose everything. mask: a painted map that is at
    least half white there.
    """

    where: str = "all"
    lasso: tuple[tuple[tuple[float, float], ...], ...] = ()
    mask: GrayImage | None = None

    def __post_init__(self) -> None:
        self.of(np.full((1, 2), 0.5))

    def of(self, uv: Floats) -> Chosen:
        """Which of the points (u, v), (k, 2), are chosen, (k,). Raises StylingError for an expression that is none."""
        chosen = evaluate(self.where, uv)
        if self.lasso:
            chosen = chosen & np.any([_inside(np.asarray(polygon, dtype=float), uv) for polygon in self.lasso], axis=0)
        if self.mask is not None:
            chosen = chosen & (sample(self.mask, uv) >= 0.5)
        return chosen


def evaluate(expression: str, uv: Floats) -> Chosen:
    """Where ``expression`` holds among points (u, v), (k, 2): (k,). Raises StylingError, one line, when it is none.

    The expression is taken apart by Python's parser and only names of regions, u, v, numbers, comparisons, arithmetic,
    and, or, not, abs, min, max and hypot mean anything; nothing is executed.
    """
    try:
        tree = ast.parse(expression.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise StylingError(f"{expression!r} is no expression over u and v such as 'v < 0.3 and u > 0.5'") from None
    with np.errstate(all="ignore"):
        value = _value(tree, uv, expression)
    if np.asarray(value).dtype != bool:
        raise StylingError(f"{expression!r} compares nothing: it needs a region or <, <=, > or >=")
    return np.broadcast_to(value, len(uv))


_ARITHMETIC: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: np.divide,
}
_COMPARISONS: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
_FUNCTIONS: dict[str, tuple[int, Callable[..., Any]]] = {
    "abs": (1, np.abs),
    "min": (2, np.minimum),
    "max": (2, np.maximum),
    "hypot": (2, np.hypot),
}


def _value(node: ast.expr, uv: Floats, source: str) -> Any:
    match node:
        case ast.Constant(value=bool() | int() | float() as constant):
            return np.asarray(constant)
        case ast.Name(id="u"):
            return uv[:, 0]
        case ast.Name(id="v"):
            return uv[:, 1]
        case ast.Name(id=name) if name in REGIONS:
            return evaluate(REGIONS[name], uv)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_number(operand, uv, source)
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return ~_truth(operand, uv, source)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _ARITHMETIC:
            return _ARITHMETIC[type(op)](_number(left, uv, source), _number(right, uv, source))
        case ast.BoolOp(op=op, values=values):
            join = np.logical_and if isinstance(op, ast.And) else np.logical_or
            return join.reduce(np.broadcast_arrays(*(_truth(value, uv, source) for value in values)))
        case ast.Compare(left=left, ops=ops, comparators=comparators) if all(type(op) in _COMPARISONS for op in ops):
            sides = [_number(side, uv, source) for side in (left, *comparators)]
            pairs = [_COMPARISONS[type(op)](a, b) for op, a, b in zip(ops, sides, sides[1:])]
            return np.logical_and.reduce(np.broadcast_arrays(*pairs))
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in _FUNCTIONS:
            count, function = _FUNCTIONS[name]
            if len(args) == count:
                return function(*(_number(arg, uv, source) for arg in args))
    part = ast.unparse(node)
    raise StylingError(f"{part!r} means nothing in {source!r}; there are u, v, numbers and {', '.join(REGIONS)}")


def _truth(node: ast.expr, uv: Floats, source: str) -> Any:
    value = np.asarray(_value(node, uv, source))
    if value.dtype != bool:
        raise StylingError(f"{ast.unparse(node)!r} in {source!r} is a number and neither true nor false")
    return value


def _number(node: ast.expr, uv: Floats, source: str) -> Any:
    value = np.asarray(_value(node, uv, source))
    if value.dtype == bool:
        raise StylingError(f"{ast.unparse(node)!r} in {source!r} is true or false and no number")
    return value


def _inside(polygon: Floats, points: Floats) -> Chosen:
    """Which points, (k, 2), a polygon, (n, 2), holds: those whose ray to the right crosses it an odd number of times."""
    start, end = polygon, np.roll(polygon, -1, axis=0)
    x, y = points[:, 0, None], points[:, 1, None]
    crosses = (start[:, 1] > y) != (end[:, 1] > y)
    slope = (end[:, 0] - start[:, 0]) / np.where(end[:, 1] == start[:, 1], 1.0, end[:, 1] - start[:, 1])
    return (crosses & (x < start[:, 0] + (y - start[:, 1]) * slope)).sum(axis=1) % 2 == 1
