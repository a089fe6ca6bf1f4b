"""Reads a recorded head motion from a table of comma-separated values."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..scene.take import Take, TakeError

COLUMNS = ("time", "rx", "ry", "rz", "x", "y", "z")


def read_take(path: Path) -> Take:
    """Read a take. Raises TakeError with the number of the line that is wrong, OSError when there is no such file.

    The first line names the columns: time [s], rx, ry, rz (pitch, yaw, roll [degrees]), x, y, z [m]. Their order is
    free, columns other than time may be left out (they are zero), others are not read; empty lines and lines that
    start with # are passed over.
    """
    try:
        lines = path.read_text("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise TakeError(f"{path}: this is no text file") from None
    numbered = [(k, line) for k, line in enumerate(lines, 1) if line.strip() and not line.lstrip().startswith("#")]
    if not numbered:
        raise TakeError(f"{path}: the file is empty")
    (first, names), *rows = numbered
    header = [name.lower() for name in _cells(names)]
    _check_header(header, f"{path}, line {first}")
    table = np.zeros((len(rows), len(COLUMNS)))
    for row, (line, content) in enumerate(rows):
        cells = _cells(content)
        if len(cells) != len(header):
            raise TakeError(f"{path}, line {line}: {len(cells)} values for {len(header)} columns")
        for name, cell in zip(header, cells, strict=True):
            if name in COLUMNS:
                table[row, COLUMNS.index(name)] = _number(cell, f"{path}, line {line}: {name}")
        if row and table[row, 0] <= table[row - 1, 0]:
            raise TakeError(f"{path}, line {line}: the time does not rise")
    if len(table) < 2:
        raise TakeError(f"{path}: a take has two moments or more")
    return Take(table[:, 0], np.radians(table[:, 1:4]), table[:, 4:7])


def _cells(line: str) -> list[str]:
    return [cell.strip().strip('"') for cell in line.split(",")]


def _check_header(header: list[str], where: str) -> None:
    if "time" not in header:
        raise TakeError(f"{where}: the first line names the columns, one of them time; got {', '.join(header)}")
    if not set(header) & set(COLUMNS[1:]):
        raise TakeError(f"{where}: besides time there is none of {', '.join(COLUMNS[1:])}")
    if len(set(header)) != len(header):
        raise TakeError(f"{where}: a column is there twice")


def _number(cell: str, where: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        raise TakeError(f"{where} is no number: {cell!r}") from None
    if not math.isfinite(value):
        raise TakeError(f"{where} is not finite: {cell!r}")
    return value
