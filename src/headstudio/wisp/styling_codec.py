"""Operations, cuts, strokes and accessories as readable JSON, and back.

A list of objects, each with its "kind" and its fields by name. What a field may be comes from the declaration of its
parameter; places are three numbers, paths are lists of places. Reading checks everything and raises ValueError with a
phrase for the user, to which whoever reads adds the name of the file.
"""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Callable, Iterable, Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from ..head.scalp_settings import GrayImage
from ..params import parameters_of
from .accessories import Band, HairTie, Pin, Ribbon
from .operations import AlongPath, Braid, Bun, Constrain, Cut, InDirection, Tie, ToPoint, Updo
from .selection import Selection
from .strokes import Stroke

Kinds = Mapping[str, type[Any]]

OPERATIONS: Kinds = {"constrain": Constrain, "tie": Tie, "braid": Braid, "bun": Bun, "updo": Updo}
STEPS: Kinds = {"to point": ToPoint, "along path": AlongPath, "in direction": InDirection}
CUTS: Kinds = {"cut": Cut}
STROKES: Kinds = {"stroke": Stroke}
ACCESSORIES: Kinds = {"band": Band, "pin": Pin, "ribbon": Ribbon, "hair tie": HairTie}

_FARTHEST = 20.0  # a place, in proportions of the head


def to_plain(items: Iterable[Any], kinds: Kinds) -> list[dict[str, Any]]:
    """Objects of ``kinds`` as plain JSON values. Fields that have their default are left out."""
    names = {kind: name for name, kind in kinds.items()}
    return [{"kind": names[type(item)], **_fields_of(item)} for item in items]


def from_plain(values: Any, kinds: Kinds) -> tuple[Any, ...]:
    """Plain JSON values as objects of ``kinds``. Raises ValueError with a phrase that says what is wrong."""
    if not isinstance(values, list):
        raise ValueError("is no list")
    return tuple(_item(value, kinds) for value in values)


def encode(items: Iterable[Any], kinds: Kinds) -> bytes:
    """Objects of ``kinds`` as JSON, a line each."""
    lines = ",\n".join(" " + json.dumps(plain, allow_nan=False) for plain in to_plain(items, kinds))
    return f"[\n{lines}\n]\n".encode()


def decode(content: bytes, kinds: Kinds) -> tuple[Any, ...]:
    """JSON as objects of ``kinds``. Raises ValueError."""
    try:
        values = json.loads(content)
    except (ValueError, RecursionError):
        raise ValueError("is no JSON") from None
    return from_plain(values, kinds)


def _fields_of(item: Any) -> dict[str, Any]:
    default = {
        field.name: field.default
        for field in dataclasses.fields(item)
        if field.default is not dataclasses.MISSING and field.default != getattr(item, field.name)
    }
    required = [field.name for field in dataclasses.fields(item) if field.default is dataclasses.MISSING]
    names = [field.name for field in dataclasses.fields(item) if field.name in default or field.name in required]
    values = {name: getattr(item, name) for name in names}
    plain = {name: _PLAIN[name](value) if name in _PLAIN else value for name, value in values.items()}
    return {name: value for name, value in plain.items() if not (name == "selection" and value == {})}


def _item(value: Any, kinds: Kinds) -> Any:
    if not isinstance(value, dict) or value.get("kind") not in list(kinds):
        raise ValueError(f"holds something whose kind is none of {', '.join(kinds)}")
    name = value["kind"]
    kind = kinds[name]
    parameters = parameters_of(kind)
    fields = {field.name for field in dataclasses.fields(kind)}
    given: dict[str, Any] = {}
    for field, content in value.items():
        if field == "kind":
            continue
        if field not in fields:
            raise ValueError(f"holds a {name} with {field!r}, which it does not have")
        if field in parameters:
            given[field] = parameters[field].check(content, f"{field} of a {name}")
        else:
            given[field] = _READ[field](content, f"{field} of a {name}")
    try:
        return kind(**given)
    except TypeError:
        raise ValueError(f"holds a {name} that lacks a field") from None


def _place(value: Any, what: str) -> tuple[float, float, float]:
    try:
        x, y, z = (float(number) for number in value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"gives the {what} as something that is no place of three numbers") from None
    if not all(math.isfinite(number) and abs(number) <= _FARTHEST for number in (x, y, z)):
        raise ValueError(f"gives the {what} far away from the head")
    return x, y, z


def _normal(value: Any, what: str) -> tuple[float, float, float]:
    normal = _place(value, what)
    if not any(normal):
        raise ValueError(f"gives the {what} no direction")
    return normal


def _path(value: Any, what: str) -> tuple[tuple[float, float, float], ...]:
    if not isinstance(value, list) or len(value) < 2:
        raise ValueError(f"gives the {what} as something that is no list of two places or more")
    path = tuple(_place(place, what) for place in value)
    if any(a == b for a, b in pairwise(path)):
        raise ValueError(f"gives the {what} the same place twice in a row")
    return path


def _steps(value: Any, what: str) -> tuple[Any, ...]:
    return from_plain(value, STEPS)


def _plain_selection(selection: Selection) -> dict[str, Any]:
    plain: dict[str, Any] = {}
    if selection.where != "all":
        plain["where"] = selection.where
    if selection.lasso:
        plain["lasso"] = selection.lasso
    if selection.mask is not None:
        plain["mask"] = np.rint(selection.mask.pixels * float(GrayImage.LEVELS)).astype(int).tolist()
    return plain


def _selection(value: Any, what: str) -> Selection:
    if isinstance(value, str):
        return Selection(value)
    if not isinstance(value, dict) or not set(value) <= {"where", "lasso", "mask"}:
        raise ValueError(f"gives the {what} as something that has more than where, lasso and mask")
    try:
        lasso = tuple(tuple((float(u), float(v)) for u, v in polygon) for polygon in value.get("lasso", ()))
        mask = (
            (np.asarray(value["mask"], dtype=float) / GrayImage.LEVELS).astype(np.float32) if "mask" in value else None
        )
        image = None if mask is None else GrayImage(mask)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"gives the {what} a lasso or mask that is none") from None
    if not all(len(polygon) >= 3 and np.isfinite(polygon).all() for polygon in lasso):
        raise ValueError(f"gives the {what} a lasso of fewer than three points")
    return Selection(str(value.get("where", "all")), lasso, image)


_PLAIN: dict[str, Callable[[Any], Any]] = {
    "selection": _plain_selection,
    "steps": lambda steps: to_plain(steps, STEPS),
}
_READ: dict[str, Callable[[Any, str], Any]] = {
    "selection": _selection,
    "steps": _steps,
    "place": _place,
    "direction": _place,
    "normal": _normal,
    "path": _path,
}
