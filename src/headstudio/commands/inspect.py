"""``headstudio inspect``: what a head file holds and what was done to it."""

from __future__ import annotations

from collections import Counter

from ..head.head import Head
from ..head.scalp import grow_scalp
from ..params import assign
from ..scene.builder import Builder
from ..scene.document import Document
from .reporting import say, working


def inspect(source: str) -> None:
    """Print what is known of the head: counts, size, parts, notes of its import, scalp. Raises HeadError."""
    document = assign(Document(), {"head.source": source})
    with working("reading the head"):
        head = Builder().head(document.head)
    for line in describe(head):
        say(line)
    with working("growing the scalp"):
        scalp = grow_scalp(head, document.scalp)
    for line in scalp.notes:
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
        *head.notes,
    ]
