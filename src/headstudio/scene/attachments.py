"""What a project file holds besides parameters: painted maps as PNG, curves as JSON.

A part of the document that is no parameter is listed here once, with how it becomes a file inside the project and how
it is read back. Reading checks everything and raises ValueError with a phrase for the user; the project file adds the
rest of the sentence.
"""

from __future__ import annotations

import io
import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from PIL import Image, UnidentifiedImageError

from ..head.scalp_settings import GrayImage
from ..params import ParameterError
from ..wisp import styling_codec
from ..wisp.curves import checked_curve
from ..wisp.groom import Groom
from ..wisp.settings import CurvePoints, Path3D
from ..wisp.strands import Strands
from ..wrinkle.face_settings import SLIDERS
from ..wrinkle.fine_settings import DirectionVector
from ..wrinkle.furrow import decode_furrows, encode_furrows
from ..wrinkle.performance import Performance, check_performance, keyframe

Curves = tuple[tuple[tuple[float, float, float], ...], ...]

SCALP_SIDES = 4


@dataclass(frozen=True)
class Attachment:
    """One file of a project: the dotted ``path`` in the document, the ``file`` in the zip, and the way between them."""

    path: str
    file: str
    encode: Callable[[Any], bytes]
    decode: Callable[[bytes], Any]


def encode_gray(image: GrayImage) -> bytes:
    """A gray image as a PNG of 16 bits, which holds every level that a GrayImage can have."""
    levels = np.rint(image.pixels.astype(np.float64) * GrayImage.LEVELS).astype(np.uint16)
    file = io.BytesIO()
    Image.fromarray(levels).save(file, "PNG")
    return file.getvalue()


def decode_gray(content: bytes) -> GrayImage:
    """A PNG as a gray image; one that was edited elsewhere may have 8 bits or colours. Raises ValueError."""
    try:
        with Image.open(io.BytesIO(content), formats=["PNG"]) as picture:
            if picture.mode.startswith("I"):
                return GrayImage(np.asarray(picture, dtype=np.float32) / np.float32(GrayImage.LEVELS))
            return GrayImage(np.asarray(picture.convert("L"), dtype=np.float32) / np.float32(255))
    except (UnidentifiedImageError, Image.DecompressionBombError, OSError, SyntaxError):
        raise ValueError("is no PNG picture") from None


def encode_curves(curves: Curves) -> bytes:
    """The control points of the scalp's curves [m] as JSON, a line each."""
    lines = ",\n".join(" " + json.dumps(curve, allow_nan=False) for curve in curves)
    return f"[\n{lines}\n]\n".encode()


def decode_curves(content: bytes) -> Curves:
    """Four curves of at least two control points [m]. Raises ValueError."""
    try:
        curves = tuple(tuple((float(x), float(y), float(z)) for x, y, z in curve) for curve in json.loads(content))
    except (TypeError, ValueError, OverflowError, RecursionError):
        raise ValueError("is no list of curves") from None
    if len(curves) != SCALP_SIDES or min(map(len, curves)) < 2:
        raise ValueError("does not hold four curves of two points or more")
    if not all(math.isfinite(number) for curve in curves for point in curve for number in point):
        raise ValueError("holds numbers that are not finite")
    return curves


def encode_points(points: CurvePoints | Path3D) -> bytes:
    """Points as JSON, a line each."""
    lines = ",\n".join(" " + json.dumps(point, allow_nan=False) for point in points)
    return f"[\n{lines}\n]\n".encode()


def decode_curve(content: bytes) -> CurvePoints:
    """The control points of a curve over 0 to 1. Raises ValueError."""
    points: CurvePoints = _decode_points(content, 2)
    try:
        checked_curve(points)
    except ParameterError as error:
        raise ValueError(f"cannot be used: {error}") from None
    return points


def decode_line(content: bytes) -> CurvePoints:
    """Points (u, v) of a line on the scalp square. Raises ValueError."""
    points: CurvePoints = _decode_points(content, 2)
    return points


def decode_path(content: bytes) -> Path3D:
    """Points of a line in space [m]. Raises ValueError."""
    points: Path3D = _decode_points(content, 3)
    return points


def _decode_points(content: bytes, dimensions: int) -> Any:
    try:
        points = tuple(tuple(float(number) for number in point) for point in json.loads(content))
    except (TypeError, ValueError, OverflowError, RecursionError):
        raise ValueError("is no list of points") from None
    if len(points) < 2 or any(len(point) != dimensions for point in points):
        raise ValueError(f"does not hold two or more points of {dimensions} numbers")
    if not all(math.isfinite(number) for point in points for number in point):
        raise ValueError("holds numbers that are not finite")
    return points


def encode_performance(performance: Performance) -> bytes:
    """Keyframes as JSON, a line each: {"time": seconds, "weights": {slider: strength}}."""
    keys = ({"time": key.time, "weights": dict(key.weights)} for key in performance)
    lines = ",\n".join(" " + json.dumps(key, allow_nan=False) for key in keys)
    return f"[\n{lines}\n]\n".encode()


def decode_performance(content: bytes) -> Performance:
    """Keyframes of the face. Raises ValueError."""
    try:
        keys = tuple(keyframe(key["time"], key["weights"]) for key in json.loads(content))
    except (AttributeError, KeyError, TypeError, ValueError, OverflowError, RecursionError):
        raise ValueError("is no list of keyframes") from None
    return check_performance(keys, SLIDERS)


def encode_vectors(vectors: tuple[DirectionVector, ...]) -> bytes:
    """Direction vectors as JSON, a line each: [field, u, v, du, dv]."""
    lines = ",\n".join(" " + json.dumps(list(vector), allow_nan=False) for vector in vectors)
    return f"[\n{lines}\n]\n".encode()


def decode_vectors(content: bytes) -> tuple[DirectionVector, ...]:
    """Direction vectors of fine wrinkles. Raises ValueError."""
    try:
        rows = tuple(tuple(float(number) for number in row) for row in json.loads(content))
    except (TypeError, ValueError, OverflowError, RecursionError):
        raise ValueError("is no list of direction vectors") from None
    if any(len(row) != 5 or row[0] not in (0, 1) or not all(map(math.isfinite, row)) for row in rows):
        raise ValueError("does not hold direction vectors: field 0 or 1, u, v, du, dv")
    return tuple(DirectionVector(int(field), *numbers) for field, *numbers in rows)


# Columns of a table of points: the place, half the thickness, the colour.
_TABLES = {3: (False, False), 4: (True, False), 6: (False, True), 7: (True, True)}


def encode_groom(groom: Groom) -> bytes:
    """Strands as arrays in numpy's format, one after the other: the name of their file in UTF-8, how many points each
    strand has, and a table of points, float32: x, y, z, half the thickness if known, linear red, green and blue if known.
    """
    strands, file = groom.strands, io.BytesIO()
    columns = [strands.points]
    columns += [] if strands.radius is None else [strands.radius[:, None]]
    columns += [] if strands.colour is None else [strands.colour]
    for array in (np.frombuffer(groom.name.encode(), np.uint8), strands.counts, np.hstack(columns)):
        np.save(file, array, allow_pickle=False)
    return file.getvalue()


def decode_groom(content: bytes) -> Groom:
    """Strands of another program. Raises ValueError."""
    file = io.BytesIO(content)
    try:
        name, counts, table = (np.load(file, allow_pickle=False) for _ in range(3))
        text = name.astype(np.uint8).tobytes().decode()
        has_radius, has_colour = _TABLES[table.shape[1]]
    except (EOFError, IndexError, KeyError, OSError, TypeError, ValueError):
        raise ValueError("holds no strands") from None
    whole = counts.ndim == 1 and len(counts) > 0 and counts.dtype.kind in "iu" and counts.min() >= 2
    if not whole or table.dtype != np.float32 or counts.sum() != len(table) or not np.isfinite(table).all():
        raise ValueError("is damaged: its points are not those of its strands")
    radius = table[:, 3].copy() if has_radius else None
    colour = table[:, -3:].copy() if has_colour else None
    first = np.concatenate([[0], np.cumsum(counts, dtype=np.int64)])
    return Groom(text, Strands(table[:, :3], first, radius, colour))


def _styling(field: str, kinds: styling_codec.Kinds) -> Attachment:
    return Attachment(
        f"styling.{field}",
        f"styling/{field}.json",
        lambda items: styling_codec.encode(items, kinds),
        lambda content: styling_codec.decode(content, kinds),
    )


ATTACHMENTS = (
    Attachment("scalp.curves", "scalp/curves.json", encode_curves, decode_curves),
    Attachment("scalp.painted_lengths", "scalp/lengths.png", encode_gray, decode_gray),
    Attachment("wisp.length_curve", "wisp/length_distribution.json", encode_points, decode_curve),
    Attachment("wisp.radius_curve", "wisp/deviation_radius.json", encode_points, decode_curve),
    Attachment("wisp.prototype_curve", "wisp/prototype.json", encode_points, decode_path),
    Attachment("wisp.parting_line", "wisp/parting.json", encode_points, decode_line),
    Attachment("wisp.painted_density", "wisp/density.png", encode_gray, decode_gray),
    Attachment("wisp.painted_lengths", "wisp/lengths.png", encode_gray, decode_gray),
    Attachment("wisp.painted_protrusion", "wisp/protrusion.png", encode_gray, decode_gray),
    Attachment("face.painted_tissue", "face/tissue.png", encode_gray, decode_gray),
    Attachment("wrinkle.furrows", "wrinkle/furrows.json", encode_furrows, decode_furrows),
    Attachment("wrinkle.proposals", "wrinkle/proposals.json", encode_furrows, decode_furrows),
    Attachment("face.performance", "face/performance.json", encode_performance, decode_performance),
    Attachment("fine.vectors", "fine/directions.json", encode_vectors, decode_vectors),
    Attachment("fine.painted_strength", "fine/strength.png", encode_gray, decode_gray),
    Attachment("groom.hair", "groom/strands.npy", encode_groom, decode_groom),
    _styling("strokes", styling_codec.STROKES),
    _styling("operations", styling_codec.OPERATIONS),
    _styling("cuts", styling_codec.CUTS),
    _styling("accessories", styling_codec.ACCESSORIES),
)
