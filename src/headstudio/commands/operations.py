"""Hairdressing on the command line: operations by word, or as a JSON file like those inside a project."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..params import ParameterError
from ..scene.document import Document
from ..wisp import styling_codec as codec
from ..wisp.operations import Cut, Operation
from ..wisp.selection import Selection, StylingError

_KINDS = {**codec.OPERATIONS, **codec.CUTS}


def with_operations(document: Document, words: Sequence[str], file: Path | None) -> Document:
    """The document with operations done to its hair after those it has.

    words: such as "tie back and u > 0.5": a kind, and the part of the scalp it is for, by named regions and comparisons
    of u and v; nothing after the kind is all hair. file: a list of operations and cuts as JSON. Raises ParameterError,
    OSError.
    """
    items: list[Operation | Cut] = [_operation(word) for word in words]
    if file is not None:
        try:
            items += codec.from_plain(json.loads(file.read_bytes()), _KINDS)
        except (ValueError, RecursionError) as error:
            reason = f"is no JSON ({error})" if isinstance(error, json.JSONDecodeError) else error
            raise ParameterError(f"{file}: this is no list of operations: it {reason}") from None
    cuts = tuple(item for item in items if isinstance(item, Cut))
    operations = tuple(item for item in items if not isinstance(item, Cut))
    styling = document.styling
    return replace(
        document, styling=replace(styling, operations=styling.operations + operations, cuts=styling.cuts + cuts)
    )


def _operation(words: str) -> Operation | Cut:
    kind, _, where = words.strip().partition(" ")
    if kind not in _KINDS or kind == "constrain":
        raise ParameterError(f"an operation begins with {', '.join(_KINDS)[len('constrain, ') :]}; got {words!r}")
    try:
        item: Operation | Cut = _KINDS[kind](selection=Selection(where.strip() or "all"))
        return item
    except StylingError as error:
        raise ParameterError(f"{words!r}: {error}") from None
