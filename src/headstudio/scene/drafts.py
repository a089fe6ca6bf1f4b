"""Hair that changes is shown twice: at once as a draft of some thousand strands, and whole as soon as that is there."""

from __future__ import annotations

from dataclasses import replace

from .animation import needs
from .document import Document

DRAFT = 4000
"""Strands of a draft."""


def drafted(document: Document) -> Document:
    """The document with no more strands than somebody can wait for who has just changed something."""
    look = document.look
    if look.hair_as != "strands" or min(look.strands_shown, document.wisp.strands) <= DRAFT:
        return document
    return replace(document, look=replace(look, strands_shown=DRAFT))


def next_to_build(document: Document, shown: Document | None, *, dragging: bool = False) -> Document:
    """What is to be built towards ``document`` while ``shown`` is what can be seen: a draft of strands of another shape, and
    then all of it. Other colours on strands that are there need no draft.

    dragging: the document will change again in a moment, and a draft is enough.
    """
    if shown is None or _shape(shown) != _shape(document):
        return drafted(document)
    is_draft = shown.look.strands_shown < document.look.strands_shown
    return drafted(document) if dragging and is_draft else document


def same_hair(one: Document, other: Document) -> bool:
    """Whether the same head of hair grows from both."""
    return needs(one) == needs(other)


def _shape(document: Document) -> object:
    return needs(replace(document, colour=_ANY.colour, look=replace(document.look, strands_shown=DRAFT)))


_ANY = Document()
