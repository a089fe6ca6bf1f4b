"""The project file ``NAME.headstudio``: a zip of readable JSON and the maps and curves beside it.

    project.json         program, version, schema, and every parameter by part and name
    scalp/curves.json    the scalp's curves, if they were moved
    scalp/lengths.png    the painted length map, if there is one

The JSON is made from the declarations of the parameters, so a new part of the document is saved without a line here.
What this version does not know is left out with a warning; what it misses keeps its default. A change that the
declarations cannot express raises SCHEMA by one and adds one function to MIGRATORS.
"""

from __future__ import annotations

import dataclasses
import io
import json
import math
import os
import zipfile
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import __version__
from ..head.head import HeadError
from ..head.makehuman_data import data_folder
from ..params import ParameterError, assign, walk
from .attachments import ATTACHMENTS, Attachment
from .document import Document
from .files import write_atomically

SUFFIX = ".headstudio"
PROGRAM = "headstudio"
SCHEMA = 2
MANIFEST = "project.json"

# Bytes when unpacked. A dozen maps of 4096 x 4096 pixels are below this; what is above is no project.
LARGEST = 512 * 2**20

Manifest = dict[str, Any]


def _temperature_by_coordinate(manifest: Manifest) -> Manifest:
    """Of Choe and Ko's eq. 4, T was counted by point until schema 2; a point has three coordinates."""
    parts = manifest.get("parameters")
    wisp = parts.get("wisp") if isinstance(parts, dict) else None
    if isinstance(wisp, dict) and isinstance(wisp.get("temperature"), int | float):
        wisp["temperature"] /= math.sqrt(3.0)
    return manifest


# From schema k to k + 1: takes the manifest of the one and returns that of the other.
MIGRATORS: Mapping[int, Callable[[Manifest], Manifest]] = {1: _temperature_by_coordinate}


class ProjectError(ValueError):
    """A file that is no project, or a damaged one. The message is one line for the user."""


@dataclass(frozen=True)
class Project:
    """What was read: the document, and a line for everything in the file that found no place in it."""

    document: Document
    warnings: tuple[str, ...] = ()


def new_project() -> Project:
    """What an artist starts from: the default document, with the mannequin where MakeHuman's human is not installed."""
    document = Document()
    try:
        data_folder()
    except HeadError:
        warning = "MakeHuman's human is not installed, so this is the mannequin; ./studio installs it"
        return Project(assign(document, {"head.source": "mannequin"}), (warning,))
    return Project(document)


def save_project(document: Document, path: Path) -> None:
    """Write ``document`` to ``path``, all of it or nothing. The same document gives the same bytes. Raises OSError."""
    parameters: dict[str, dict[str, Any]] = {}
    for name, _, value in walk(document):
        part, _, field = name.rpartition(".")
        parameters.setdefault(part, {})[field] = value
    manifest = {"program": PROGRAM, "version": __version__, "schema": SCHEMA, "parameters": parameters}
    members = {MANIFEST: json.dumps(manifest, indent=2, allow_nan=False).encode() + b"\n"}
    default = Document()
    for attachment in ATTACHMENTS:
        value = _value_at(document, attachment.path)
        if value != _value_at(default, attachment.path):
            members[attachment.file] = attachment.encode(value)
    write_atomically(path, _zip(members))


def load_project(path: Path) -> Project:
    """Read a project. Raises ProjectError for a file that is foreign, damaged or newer, OSError when it cannot be read.

    A head that was given as a file and is no longer there is looked for beside the project, which is where it is after
    both were moved.
    """
    try:
        members = _unzip(path)
        manifest = _manifest(members)
        document, warnings = _read_parameters(manifest["parameters"])
        document = _read_attachments(document, members)
    except (ProjectError, ParameterError) as error:
        raise ProjectError(f"{path}: {error}") from None
    warnings += [f"{name} is not known to this version and was left out" for name in _strangers(members)]
    document, found = _find_head_beside(document, path)
    return Project(document, tuple(warnings + found))


def _zip(members: Mapping[str, bytes]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
    return file.getvalue()


def _unzip(path: Path) -> dict[str, bytes]:
    try:
        with zipfile.ZipFile(path) as archive:
            infos = archive.infolist()
            if sum(info.file_size for info in infos) > LARGEST:
                raise ProjectError("this is no headstudio project: it is far too large")
            return {info.filename: archive.read(info) for info in infos}
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, UnicodeDecodeError):
        kind = "a damaged headstudio project" if zipfile.is_zipfile(path) else "no headstudio project"
        raise ProjectError(f"this is {kind}") from None


def _manifest(members: Mapping[str, bytes]) -> Manifest:
    if MANIFEST not in members:
        raise ProjectError(f"this is no headstudio project: there is no {MANIFEST} in it")
    try:
        manifest = json.loads(members[MANIFEST])
    except (ValueError, RecursionError) as error:
        raise ProjectError(f"{MANIFEST} is damaged: {error}") from None
    if not isinstance(manifest, dict) or manifest.get("program") != PROGRAM:
        raise ProjectError("this is no headstudio project")
    manifest = _migrated(manifest)
    if not isinstance(manifest.get("parameters"), dict):
        raise ProjectError(f"{MANIFEST} is damaged: it has no parameters")
    return manifest


def _migrated(manifest: Manifest) -> Manifest:
    schema = manifest.get("schema")
    if not isinstance(schema, int) or isinstance(schema, bool) or schema < 1:
        raise ProjectError(f"{MANIFEST} is damaged: its schema is {schema!r}")
    if schema > SCHEMA:
        raise ProjectError(
            f"this was made by a newer headstudio (schema {schema}; this one reads up to {SCHEMA}); update headstudio"
        )
    for step in range(schema, SCHEMA):
        manifest = MIGRATORS[step](manifest)
    return manifest


def _read_parameters(parts: Mapping[str, Any]) -> tuple[Document, list[str]]:
    document = Document()
    known = {name for name, _, _ in walk(document)}
    values: dict[str, Any] = {}
    warnings: list[str] = []
    for part, fields in parts.items():
        if not isinstance(fields, dict):
            raise ProjectError(f"{MANIFEST} is damaged: {part!r} is no group of parameters")
        for field, value in fields.items():
            name = f"{part}.{field}"
            if name in known:
                values[name] = value
            else:
                warnings.append(f"parameter {name} is not known to this version and was left out")
    return assign(document, values), warnings


def _read_attachments(document: Document, members: Mapping[str, bytes]) -> Document:
    for attachment in ATTACHMENTS:
        if attachment.file in members:
            document = _with_value(document, attachment, _decoded(attachment, members[attachment.file]))
    return document


def _decoded(attachment: Attachment, content: bytes) -> Any:
    try:
        return attachment.decode(content)
    except ValueError as error:
        raise ProjectError(f"{attachment.file} {error}") from None


def _strangers(members: Mapping[str, bytes]) -> list[str]:
    ours = {MANIFEST, *(attachment.file for attachment in ATTACHMENTS)}
    return [name for name in members if name not in ours and not name.endswith("/")]


def _find_head_beside(document: Document, path: Path) -> tuple[Document, list[str]]:
    warnings = []
    for parameter in ("head.source", "head.eyes"):
        file = str(_value_at(document, parameter))
        # A path of another system may hold backslashes.
        name = file.replace("\\", "/").rpartition("/")[2]
        beside = path.parent / name
        if name != file and not os.path.exists(file) and os.path.isfile(beside):
            document = assign(document, {parameter: str(beside)})
            warnings.append(f"{file} is not there; taking {beside}, which lies beside the project")
    return document, warnings


def _value_at(document: Any, path: str) -> Any:
    for name in path.split("."):
        document = getattr(document, name)
    return document


def _with_value(document: Document, attachment: Attachment, value: Any) -> Document:
    part, _, field = attachment.path.partition(".")
    return dataclasses.replace(document, **{part: dataclasses.replace(getattr(document, part), **{field: value})})
