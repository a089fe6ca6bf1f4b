"""The hairstyles that ship: presets of a document's hair, as data in assets/styles.

A style is a JSON object: "title" and "description", each a line; "parameters", values by dotted path in the parts of the
document that make hair; and "attachments", what else these parts hold, by dotted path, written as in a project.
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ..params import ParameterError, assign
from ..resources import asset
from .attachments import ATTACHMENTS
from .document import Document

PARTS = ("wisp", "styling", "beard", "colour")
"""The parts of the document that a style sets; all others stay as they are."""


@dataclass(frozen=True)
class Style:
    """A hairstyle by its name. title and description: a line each, for people. hair: a document with this hair, of which
    only PARTS count.
    """

    name: str
    title: str
    description: str
    hair: Document

    def on(self, document: Document) -> Document:
        """``document`` with this hair in the place of its own, styled or imported."""
        parts = {part: getattr(self.hair, part) for part in PARTS}
        return dataclasses.replace(document, groom=self.hair.groom, **parts)


def style_names() -> tuple[str, ...]:
    """The names of the styles that ship, in the order of the alphabet."""
    return tuple(sorted(path.stem for path in asset("styles").glob("*.json")))


@cache
def load_style(name: str) -> Style:
    """The style called ``name``. Raises ParameterError for a name that is none."""
    if name not in style_names():
        raise ParameterError(f"there is no style {name!r}; headstudio styles lists them")
    return read_style(asset(f"styles/{name}.json"))


def read_style(path: Path) -> Style:
    """A style from a file. Raises ParameterError for one that is damaged, OSError when it cannot be read."""
    try:
        content = json.loads(path.read_bytes())
        strangers = set(content) - {"title", "description", "parameters", "attachments"}
        if strangers:
            raise ValueError(f"it holds {', '.join(sorted(strangers))}, which no style has")
        hair = assign(Document(), _of_hair(content.get("parameters", {})))
        for place, value in _of_hair(content.get("attachments", {})).items():
            hair = _attached(hair, place, value)
        return Style(path.stem, str(content["title"]), str(content["description"]), hair)
    except (AttributeError, KeyError, TypeError, ValueError, RecursionError) as error:
        raise ParameterError(f"{path}: this is no hairstyle: {error}") from None


def _of_hair(values: Mapping[str, Any]) -> Mapping[str, Any]:
    for path in values:
        if path.partition(".")[0] not in PARTS:
            raise ValueError(f"it sets {path}, which is no part of the hair")
    return values


def _attached(hair: Document, path: str, value: Any) -> Document:
    known = {attachment.path: attachment for attachment in ATTACHMENTS if attachment.file.endswith(".json")}
    if path not in known:
        raise ValueError(f"there is nothing to attach at {path}")
    part, _, field = path.partition(".")
    try:
        decoded = known[path].decode(json.dumps(value).encode())
    except ValueError as error:
        raise ValueError(f"its {path} {error}") from None
    return dataclasses.replace(hair, **{part: dataclasses.replace(getattr(hair, part), **{field: decoded})})
