"""Strands as one UsdGeomBasisCurves: text is written here, read by Pixar's own library."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...wisp.strands import Strands
from .contents import Contents, HairFileError, as_text

_PRIM = "Hair"


def write(strands: Strands, path: Path) -> None:
    """A .usda with metres, +Y up, cubic Catmull-Rom curves pinned to their end points."""
    low, high = strands.points.min(axis=0), strands.points.max(axis=0)
    counts = ", ".join(map(str, strands.counts.tolist()))
    with path.open("w", encoding="ascii") as file:
        file.write(
            f'#usda 1.0\n(\n    defaultPrim = "{_PRIM}"\n    metersPerUnit = 1\n    upAxis = "Y"\n)\n\n'
            f'def BasisCurves "{_PRIM}"\n{{\n'
            '    uniform token type = "cubic"\n    uniform token basis = "catmullRom"\n    uniform token wrap = "pinned"\n'
            f"    float3[] extent = [{_tuples(np.stack([low, high]))}]\n"
            f"    int[] curveVertexCounts = [{counts}]\n"
            f"    point3f[] points = [{_tuples(strands.points)}]\n"
        )
        if strands.radius is not None:
            widths = as_text(2 * strands.radius[:, None], "%.9g, ").rstrip(", ")
            file.write(f'    float[] widths = [{widths}] (\n        interpolation = "vertex"\n    )\n')
        if strands.colour is not None:
            file.write(
                f"    color3f[] primvars:displayColor = [{_tuples(strands.colour)}] (\n"
                '        interpolation = "vertex"\n    )\n'
            )
        file.write("}\n")


def read(path: Path) -> Contents:
    """All BasisCurves of a stage, in metres, each moved to its place. Needs usd-core."""
    try:
        from pxr import Tf, Usd, UsdGeom
    except ImportError:
        raise HairFileError(f"{path}: reading USD needs usd-core: pip install 'headstudio[usd]'") from None
    if not path.exists():
        raise FileNotFoundError(2, "No such file or directory", str(path))
    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException:
        raise HairFileError(f"{path}: this is no USD file, or it is damaged") from None
    metres = UsdGeom.GetStageMetersPerUnit(stage)
    places = UsdGeom.XformCache()
    found = [UsdGeom.BasisCurves(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.BasisCurves)]
    if not found:
        raise HairFileError(f"{path}: no BasisCurves in it")
    pieces = []
    for curves in found:
        points = np.array(curves.GetPointsAttr().Get() or [], dtype=np.float64).reshape(-1, 3)
        counts = np.array(curves.GetCurveVertexCountsAttr().Get() or [], dtype=np.int64)
        place = np.array(places.GetLocalToWorldTransform(curves.GetPrim()))
        # A curve that does not reach its outer points is shorter than its points: left as it is, for control points
        # are what this studio works with.
        moved = points @ place[:3, :3] + place[3, :3]
        widths = np.array(curves.GetWidthsAttr().Get() or [], dtype=np.float32)
        colours = np.array(curves.GetDisplayColorAttr().Get() or [], dtype=np.float32).reshape(-1, 3)
        radius, colour = _per_point(widths * metres / 2, counts), _per_point(colours, counts)
        pieces.append(Contents(moved * metres, counts, radius, colour))
    return _joined(pieces)


def _per_point(values: np.ndarray, counts: np.ndarray) -> np.ndarray | None:
    """One value for all, for each curve or for each point, as one for each point; None when it is none of these."""
    total = int(counts.sum())
    if len(values) == total:
        return values
    if len(values) == len(counts):
        return np.repeat(values, counts, axis=0)
    return np.repeat(values, total, axis=0) if len(values) == 1 else None


def _joined(pieces: list[Contents]) -> Contents:
    def together(values: list[np.ndarray | None]) -> np.ndarray | None:
        return np.concatenate(values) if all(value is not None for value in values) else None  # type: ignore[arg-type]

    return Contents(
        np.concatenate([piece.points for piece in pieces]),
        np.concatenate([piece.counts for piece in pieces]),
        together([piece.radius for piece in pieces]),
        together([piece.colour for piece in pieces]),
    )


def _tuples(rows: np.ndarray) -> str:
    return as_text(rows, "(%.9g, %.9g, %.9g), ").rstrip(", ")
