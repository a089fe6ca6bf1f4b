"""``headstudio params``: every parameter with its default, range, unit and help."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import astuple, dataclass
from typing import Any

from rich.markup import escape
from rich.table import Table

from ..params import Parameter, ParameterError, walk
from ..scene.document import Document
from .reporting import results, say

INTRODUCTION = """\
# Parameters

Every number an artist can set, in SI units. This page is made by `headstudio params --markdown` from the declarations
in the source. A parameter is set with `--set NAME=VALUE`, for example `--set lcp.elastic_modulus=3e5`, or with its
slider in the window, which shows millimetres, grams and degrees. *Live* ones take effect while hair moves; the others
grow it anew.
"""


@dataclass(frozen=True)
class Row:
    """One parameter in words."""

    name: str
    default: str
    range: str
    unit: str
    live: str
    help: str


def parameter_rows(part_of_name: str = "") -> list[Row]:
    """The parameters whose name holds ``part_of_name``. Raises ParameterError if there is none."""
    rows = [_row(name, parameter, value) for name, parameter, value in walk(Document()) if part_of_name in name]
    if not rows:
        raise ParameterError(f"no parameter has {part_of_name!r} in its name; headstudio params lists them all")
    return rows


def print_parameters(part_of_name: str = "") -> None:
    """A table on a terminal; a line each, fields apart by tabs, when piped."""
    rows = parameter_rows(part_of_name)
    if not results.is_terminal:
        for row in rows:
            say("\t".join(astuple(row)))
        return
    table = Table("Parameter", "Default", "Range", "Unit", "", "What it is", header_style="bold")
    for row in rows:
        table.add_row(*(escape(cell) for cell in astuple(row)))
    results.print(table, soft_wrap=False)


def markdown() -> str:
    """The reference page of the documentation: a table for each part of the document."""
    return INTRODUCTION + "".join(_section(part, rows) for part, rows in _by_part())


def _by_part() -> Iterator[tuple[str, list[Row]]]:
    parts: dict[str, list[Row]] = {}
    for row in parameter_rows():
        parts.setdefault(row.name.rpartition(".")[0], []).append(row)
    yield from parts.items()


def _section(part: str, rows: list[Row]) -> str:
    lines = [f"\n## {part}\n", "| Parameter | Default | Range | Unit | | What it is |", "|---|---|---|---|---|---|"]
    lines += [f"| `{row.name}` | {' | '.join(astuple(row)[1:])} |" for row in rows]
    return "\n".join(lines) + "\n"


def _row(name: str, parameter: Parameter, value: Any) -> Row:
    live = "live" if parameter.live else ""
    return Row(name, _value(parameter, value), _range(parameter), parameter.unit, live, parameter.doc)


def _value(parameter: Parameter, value: Any) -> str:
    match parameter.kind:
        case "switch":
            return "on" if value else "off"
        case "colour":
            return "#" + "".join(f"{round(255 * part):02x}" for part in value)
        case "number":
            return _number(parameter, value)
        case _:
            return str(value)


def _range(parameter: Parameter) -> str:
    match parameter.kind:
        case "number" | "integer":
            return f"{_number(parameter, parameter.low)} to {_number(parameter, parameter.high)}"
        case "switch":
            return "on, off"
        case "choice":
            return ", ".join(parameter.options)
        case "colour":
            return "#rrggbb"
        case _:
            return "text"


def _number(parameter: Parameter, value: float | None) -> str:
    if value is None:
        return "any"
    if parameter.kind == "integer":
        return str(value)
    if parameter.shown == "deg":
        return f"{value:.4g} ({math.degrees(value):.4g}°)"
    return f"{value:.4g}".replace("e+0", "e")
