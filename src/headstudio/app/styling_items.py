"""The lists of a styling, strokes, operations, cuts and accessories, as things to choose, to move and to put in order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

from ..scene.document import Document
from ..wisp.operations import Place
from ..wisp.selection import Selection

LISTS = ("strokes", "operations", "cuts", "accessories")
"""Fields of the styling settings that are such lists."""

# Fields that say how far around its places something acts [m]; the first one that an item has is its size.
_SIZES = ("tolerance", "radius", "thickness")
_PLACE, _PATH = "place", "path"


@dataclass(frozen=True)
class Chosen:
    """Which item of which list the user is at work on. It is no part of the document."""

    field: str
    index: int

    def of(self, document: Document) -> Any:
        """The item; None when it is there no more."""
        items = getattr(document.styling, self.field)
        return items[self.index] if self.index < len(items) else None

    def put(self, document: Document, item: Any) -> Document:
        """The document with ``item`` in its place."""
        items = getattr(document.styling, self.field)
        return with_items(document, self.field, (*items[: self.index], item, *items[self.index + 1 :]))


@dataclass(frozen=True)
class Handle:
    """A place of an item that can be moved: the fields and indices that lead to it, where it is in proportions of the head,
    and how far around it the item acts [m], 0 if that is not said.
    """

    trail: tuple[str | int, ...]
    place: Place
    size: float


def with_items(document: Document, field: str, items: tuple[Any, ...]) -> Document:
    """The document with another list."""
    changed: dict[str, Any] = {field: items}
    return replace(document, styling=replace(document.styling, **changed))


def selection_of(item: Any) -> Selection | None:
    """Which wisps an item is for; None if it is for no wisps in particular."""
    selection = getattr(item, "selection", None)
    return selection if isinstance(selection, Selection) else None


def handles_of(item: Any) -> Iterator[Handle]:
    """All places of an item, those of its steps as well."""
    size = next((float(getattr(item, name)) for name in _SIZES if hasattr(item, name)), 0.0)
    for field in fields(item):
        value = getattr(item, field.name)
        if field.name == _PLACE:
            yield Handle((field.name,), value, size)
        elif field.name == _PATH:
            for k, place in enumerate(value):
                yield Handle((field.name, k), place, size)
        elif isinstance(value, tuple):
            for k, inner in enumerate(value):
                if is_dataclass(inner):
                    for handle in handles_of(inner):
                        yield replace(handle, trail=(field.name, k, *handle.trail))


def moved(item: Any, trail: tuple[str | int, ...], place: Place) -> Any:
    """The item with the place at the end of ``trail`` moved to ``place``, in proportions of the head."""
    if not trail:
        return place
    first, rest = trail[0], trail[1:]
    if isinstance(first, int):
        return (*item[:first], moved(item[first], rest, place), *item[first + 1 :])
    return replace(item, **{first: moved(getattr(item, first), rest, place)})
