"""Numbers declared once.

A parameter is a field of a frozen dataclass, declared with its label, unit, range and help. Everything else is
generated from the declaration: the panels of the window, ``--set lcp.elastic_modulus=3e5``, the project file, the
sweeps of the bench and the page that ``headstudio params`` prints.

    @dataclass(frozen=True)
    class Wind:
        speed: float = number(3.0, "Speed", "m/s", 0, 20, "Speed of the air far away from the head.")

Groups nest: a dataclass whose fields are such dataclasses is a group of groups, and a dotted path names one parameter
inside it.
"""

from __future__ import annotations

import dataclasses
import difflib
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

_KEY = "parameter"
Group = TypeVar("Group")

# What the window shows for an SI unit, and by how much it multiplies.
SHOWN_UNITS: dict[str, tuple[str, float]] = {
    "m": ("m", 1.0),
    "cm": ("m", 100.0),
    "mm": ("m", 1000.0),
    "g": ("kg", 1000.0),
    "kPa": ("Pa", 0.001),
    "deg": ("rad", 180.0 / math.pi),
}


class ParameterError(ValueError):
    """A value that a parameter cannot take, or a path that names none. The message is one line for the user."""


@dataclass(frozen=True)
class Parameter:
    """The declaration of one parameter.

    ``kind`` is "number", "integer", "switch", "choice", "text" or "colour". ``low`` and ``high`` are in ``unit`` (SI).
    ``shown`` is the unit in the window ("mm" for a length), ``log`` asks for a logarithmic slider. ``live`` tells that
    a running simulation takes the new value at its next step; otherwise the hair is built again.
    """

    kind: str
    label: str
    doc: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    shown: str = ""
    log: bool = False
    options: tuple[str, ...] = ()
    live: bool = False

    @property
    def shown_unit(self) -> str:
        """The unit the window prints behind the value."""
        return self.shown or self.unit

    @property
    def shown_scale(self) -> float:
        """What an SI value is multiplied with to be shown."""
        return SHOWN_UNITS[self.shown][1] if self.shown else 1.0

    def check(self, value: Any, path: str = "") -> Any:
        """Return ``value`` in the parameter's own type, or raise ParameterError saying what it may be.

        Accepts text (from the command line or JSON) as well as the value itself.
        """
        name = path or self.label
        match self.kind:
            case "number" | "integer":
                return self._check_number(value, name)
            case "switch":
                return self._check_switch(value, name)
            case "choice":
                if value not in self.options:
                    raise ParameterError(f"{name} is one of {', '.join(self.options)}; got {value!r}")
                return value
            case "colour":
                return self._check_colour(value, name)
            case _:
                return str(value)

    def _check_number(self, value: Any, name: str) -> float | int:
        try:
            number_ = float(value)
        except (TypeError, ValueError, OverflowError):
            raise ParameterError(f"{name} takes a number, got {value!r}") from None
        if not math.isfinite(number_):
            raise ParameterError(f"{name} takes a finite number, got {value!r}")
        if self.kind == "integer":
            if number_ != int(number_):
                raise ParameterError(f"{name} takes a whole number, got {value!r}")
            number_ = int(number_)
        low, high = self.low, self.high
        if (low is not None and number_ < low) or (high is not None and number_ > high):
            raise ParameterError(f"{name} goes from {low:g} to {high:g} {self.unit}".rstrip() + f"; got {number_:g}")
        return number_

    @staticmethod
    def _check_switch(value: Any, name: str) -> bool:
        words = {
            "true": True,
            "yes": True,
            "on": True,
            "1": True,
            "false": False,
            "no": False,
            "off": False,
            "0": False,
        }
        answer = words.get(str(value).lower())
        if answer is None:
            raise ParameterError(f"{name} is on or off, got {value!r}")
        return answer

    @staticmethod
    def _check_colour(value: Any, name: str) -> tuple[float, float, float]:
        try:
            if isinstance(value, str):
                text = value.lstrip("#")
                if len(text) != 6:
                    raise ValueError
                red, green, blue = (int(text[k : k + 2], 16) / 255 for k in (0, 2, 4))
            else:
                red, green, blue = (float(part) for part in value)
        except (TypeError, ValueError):
            raise ParameterError(f"{name} is a colour like #8a5a3c, got {value!r}") from None
        if not all(0 <= part <= 1 for part in (red, green, blue)):
            raise ParameterError(f"{name} has parts from 0 to 1, got {value!r}")
        return (red, green, blue)


def _field(default: Any, declaration: Parameter) -> Any:
    return dataclasses.field(default=default, metadata={_KEY: declaration})


def number(
    default: float,
    label: str,
    unit: str,
    low: float,
    high: float,
    doc: str,
    *,
    shown: str = "",
    log: bool = False,
    live: bool = False,
) -> Any:
    """Declare a real number: ``default``, ``low`` and ``high`` in SI ``unit``."""
    if shown and SHOWN_UNITS[shown][0] != unit:
        raise ValueError(f"{label}: {shown} does not show {unit}")
    if log and low <= 0:
        raise ValueError(f"{label}: a logarithmic range starts above 0")
    return _field(default, Parameter("number", label, doc, unit, low, high, shown, log, live=live))


def integer(default: int, label: str, low: int, high: int, doc: str, *, log: bool = False, live: bool = False) -> Any:
    """Declare a whole number."""
    return _field(default, Parameter("integer", label, doc, "", low, high, log=log, live=live))


def switch(default: bool, label: str, doc: str, *, live: bool = False) -> Any:
    """Declare something that is on or off."""
    return _field(default, Parameter("switch", label, doc, live=live))


def choice(default: str, label: str, options: tuple[str, ...], doc: str, *, live: bool = False) -> Any:
    """Declare one word out of ``options``."""
    return _field(default, Parameter("choice", label, doc, options=options, live=live))


def text(default: str, label: str, doc: str) -> Any:
    """Declare a line of text, such as the name of a file."""
    return _field(default, Parameter("text", label, doc))


def colour(default: str, label: str, doc: str) -> Any:
    """Declare a colour, sRGB, written ``#rrggbb``; the value is three numbers from 0 to 1."""
    declaration = Parameter("colour", label, doc, live=True)
    return _field(declaration.check(default), declaration)


def parameters_of(group: Any) -> dict[str, Parameter]:
    """The parameters declared by the fields of one dataclass (class or instance), by field name."""
    return {f.name: f.metadata[_KEY] for f in dataclasses.fields(group) if _KEY in f.metadata}


def walk(group: Any, prefix: str = "") -> Iterator[tuple[str, Parameter, Any]]:
    """All parameters below ``group`` as (dotted path, declaration, value), in the order they are declared."""
    for f in dataclasses.fields(group):
        value = getattr(group, f.name)
        if _KEY in f.metadata:
            yield prefix + f.name, f.metadata[_KEY], value
        elif dataclasses.is_dataclass(value):
            yield from walk(value, f"{prefix}{f.name}.")


def assign(group: Group, values: Mapping[str, Any]) -> Group:
    """``group`` with the parameters at the dotted paths replaced; every value is checked.

    Raises ParameterError for a path that names no parameter (with the nearest ones) and for a value out of range.
    """
    known = {path: parameter for path, parameter, _ in walk(group)}
    for path, value in values.items():
        if path not in known:
            near = difflib.get_close_matches(path, known, n=3, cutoff=0.5)
            hint = f"; did you mean {' or '.join(near)}?" if near else "; headstudio params lists them all"
            raise ParameterError(f"there is no parameter {path!r}{hint}")
        group = _replace_at(group, path.split("."), known[path].check(value, path))
    return group


def _replace_at(group: Group, path: list[str], value: Any) -> Group:
    head, *rest = path
    inner = _replace_at(getattr(group, head), rest, value) if rest else value
    return dataclasses.replace(group, **{head: inner})  # type: ignore[type-var]


def parse_assignments(words: list[str]) -> dict[str, str]:
    """``["lcp.elastic_modulus=3e5"]`` as a mapping. Raises ParameterError for a word without ``=``."""
    pairs = {}
    for word in words:
        path, equals, value = word.partition("=")
        if not equals or not path.strip():
            raise ParameterError(f"--set takes NAME=VALUE, got {word!r}")
        pairs[path.strip()] = value.strip()
    return pairs
