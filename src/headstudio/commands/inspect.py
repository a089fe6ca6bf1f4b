"""``headstudio inspect``: what a head file holds and what was done to it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from ..head.head import Head, HeadError
from ..head.inspection import inspect_head
from ..head.load import BUILT_IN
from ..head.scalp import grow_scalp
from ..params import assign
from ..scene.builder import Builder
from ..scene.document import Document
from .reporting import say, working


def inspect(source: str) -> None:
    """Print what is known of the head: counts, holes, size, parts, what its import found, scalp.

    Of a file that gives no head as much is printed as can be told, before HeadError is raised.
    """
    document = assign(Document(), {"head.source": source})
    if source in BUILT_IN:
        with working("reading the head"):
            head = Builder().head(document.head)
        _say_all([*describe(head), *head.notes])
    else:
        with working("reading the file"):
            inspection = inspect_head(source)
        _say_all(inspection.lines())
        if inspection.head is None:
            raise HeadError(inspection.reason)
        head = inspection.head
        _say_all(describe(head))
    with working("growing the scalp"):
        scalp = grow_scalp(head, document.scalp)
    _say_all(scalp.notes)


def _say_all(lines: Iterable[str]) -> None:
    for line in lines:
        say(line)


def describe(head: Head) -> list[str]:
    """A head in lines of text."""
    low, high = head.skin.bounds
    width, height, depth = 1000 * (high - low)
    parts = Counter(part.kind for part in head.parts)
    return [
        f"head: {head.name}",
        f"skin: {len(head.skin.vertices)} vertices, {len(head.skin.faces)} triangles",
        f"size: {width:.0f} mm wide, {height:.0f} mm high, {depth:.0f} mm deep",
        f"parts: {', '.join(f'{count} {kind}' for kind, count in parts.items()) or 'none'}",
        f"expressions: {len(head.expressions)}",
    ]
