"""``headstudio wrinkle --compare``: how near a head's wrinkles come to a scan of it, and furrows fitted to the scan."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from rich.table import Table
from scipy.spatial import cKDTree

from ..head.from_file import head_from_mesh
from ..head.head import Head, HeadError
from ..head.mesh import Floats, TriangleMesh
from ..head.read import read_mesh
from ..head.repair import repair
from ..params import ParameterError, assign
from ..scene.builder import Builder
from ..scene.document import Document
from ..wrinkle.alignment import Alignment, align, moved, plausible_units
from ..wrinkle.comparison import Comparison, Distances, around, compare
from ..wrinkle.default_furrows import default_furrows
from ..wrinkle.face_chart import FaceChart
from ..wrinkle.face_creases import face_layout
from ..wrinkle.fitting import change_of_shape
from ..wrinkle.scan_fit import fit_face
from ..wrinkle.scan_heights import ScanHeights
from .furrow_files import FURROW_SUFFIXES, keep_furrows
from .reporting import counting, results, say, working

# Where the scan departs from the smooth skin by more than this [m], it is wrinkled.
_WRINKLED = 5e-4
# Parts of the face that are reported by themselves.
_REGIONS = ("forehead", "eye corner")
_MM = 1e3


@dataclass(frozen=True, eq=False)
class Report:
    """Distances [m] by the name of where and what is measured: without wrinkles and with them."""

    rows: dict[str, tuple[Distances, Distances]]
    shape: float


def read_scan(path: Path, head: Head) -> tuple[TriangleMesh, Alignment]:
    """A scan as it lies on a head [m], and how it was laid there. Raises HeadError, ScanError."""
    mesh, repairs = repair(read_mesh(path))
    starts = plausible_units(mesh)
    if head.from_file is not None:
        starts.insert(0, head.from_file)
    try:
        whole = head_from_mesh(mesh, repairs, path)
    except HeadError:
        whole = None
    if whole is not None and whole.from_file is not None:
        starts.append(whole.from_file)
    alignment = align(mesh, head.skin, starts)
    return moved(mesh, alignment.matrix), alignment


def measure(document: Document, scan: TriangleMesh, builder: Builder, laid: Floats | None = None) -> Report:
    """Distances between a scan [m] and the face of a document as it is posed, without its wrinkles and with them.

    laid: how the scan is moved to lie on the wrinkled skin, (4, 4), each skin having the alignment that is best for it.
    Raises ScanError when they do not overlap.
    """
    states = []
    for shown in (False, True):
        skin = builder.skin(assign(document, {"wrinkle.shown": shown, "fine.on": False}))
        living = skin.at(document.face)
        mesh = skin.creases.mesh(living.skin)
        there = scan if laid is None or not shown else moved(scan, laid)
        states.append((mesh, there, compare(mesh, there, skin.surface.mapped > 0.5)))
    heights = ScanHeights.measured(face_layout(builder.head(document.head)), scan)
    shape = change_of_shape(heights)
    nearest = cKDTree(heights.texels.positions)

    smooth = [_at_both(mesh, at, each, lambda points: shape[nearest.query(points)[1]]) for mesh, at, each in states]
    comparison = states[0][2]

    def figures(*, changed: bool, places: Floats | None = None) -> tuple[Distances, Distances] | None:
        """Without wrinkles and with them: with the change of shape or not, everywhere or around some places."""
        found = []
        for (mesh, at, each), change in zip(states, smooth):
            here = np.ones(len(change), dtype=bool)
            if places is not None:
                here = _at_both(mesh, at, each, partial(around, wrinkled=places))
            if not here.any():
                return None
            distances = each.both_ways if changed else each.both_ways - change
            found.append(Distances.of(distances[here], each.area[here]))
        return found[0], found[1]

    departs = np.abs(comparison.to_skin - smooth[0][len(comparison.to_scan) :]) > _WRINKLED
    wrinkled = scan.vertices[comparison.scan_vertices[departs]]
    removed = "smooth change of shape removed"
    rows = {
        "the whole overlap": figures(changed=True),
        "around its wrinkles": figures(changed=True, places=wrinkled),
        f"the whole overlap, {removed}": figures(changed=False),
        f"around its wrinkles, {removed}": figures(changed=False, places=wrinkled),
    }
    for region, line in _region_lines(builder.head(document.head)).items():
        rows[f"{region}, {removed}"] = figures(changed=False, places=line)
    told = {where: pair for where, pair in rows.items() if pair is not None}
    return Report(told, float(np.sqrt(np.mean(shape[heights.covered] ** 2))))


def _region_lines(head: Head) -> dict[str, Floats]:
    """Points of the skin [m], (k, 3), along which a forehead and eye corners wrinkle."""
    chart = FaceChart(head, face_layout(head))
    lines = {}
    for region in _REGIONS:
        samples = [furrow.chain.sampled(40)[1] for furrow in default_furrows(1.0) if furrow.region == region]
        points = chart.on_skin(np.concatenate(samples))
        lines[region] = points[np.isfinite(points[:, 0])]
    return lines


def fitted(document: Document, scan: TriangleMesh, builder: Builder) -> tuple[Document, Floats, str]:
    """The document with its furrows moved and sized to a scan [m], how the scan then lies best on it, (4, 4), and a note."""
    wrinkle = document.wrinkle
    before = [replace(furrow, depth=min(wrinkle.strength * furrow.depth, 0.015)) for furrow in wrinkle.furrow_set()]
    steps = 100
    with counting("fitting furrows", steps) as bar:

        def progress(what: str, part: float) -> None:
            bar.update(bar.task_ids[0], completed=steps * part, description=what)

        fit = fit_face(builder.head(document.head), scan, before, progress)
    changed = replace(wrinkle, furrows=fit.furrows, strength=1.0, breadth=1.0, shown=True)
    names = f": {', '.join(fit.moved)}" if fit.moved else ""
    note = f"{fit.fitted} furrows, {len(fit.moved)} of them moved there{names}"
    return replace(document, wrinkle=changed), fit.fit.motion, note


def compare_scan(document: Document, path: Path, fit: bool, out: Path | None) -> None:
    """Report distances to a scan; with ``fit``, those of fitted furrows, kept in ``out`` (.headstudio or .json).

    Raises HeadError, ParameterError, ScanError, OSError.
    """
    if out is not None and (not fit or out.suffix.lower() not in FURROW_SUFFIXES):
        raise ParameterError(
            f"fitted furrows (--fit) are kept in a project (.headstudio) or a furrow set (.json); got {out.name!r}"
        )
    builder = Builder()
    with working("laying the scan on the head"):
        scan, _ = read_scan(path, builder.head(document.head))
    laid = None
    if fit:
        document, laid, note = fitted(document, scan, builder)
        say(note)
        if out is not None:
            # Minutes of work, and measuring takes a while: they are there if it is interrupted.
            keep_furrows(document, out)
    with working("measuring"):
        report = measure(document, scan, builder, laid)
    results.print(_table(report))
    say(f"smooth change of shape: {_MM * report.shape:.2f} mm RMS")


def _at_both(
    mesh: TriangleMesh, scan: TriangleMesh, comparison: Comparison, of_points: Callable[[Floats], np.ndarray]
) -> np.ndarray:
    """Something of the points that a comparison measures at, on the mesh and on the scan, (k + l,)."""
    return np.concatenate(
        [of_points(mesh.vertices[comparison.vertices]), of_points(scan.vertices[comparison.scan_vertices])]
    )


def _table(report: Report) -> Table:
    table = Table(box=None, pad_edge=False)
    table.add_column("distance to the scan [mm]")
    table.add_column("wrinkles")
    for name in ("mean", "RMS", "max"):
        table.add_column(name, justify="right")
    table.add_column("less", justify="right")
    for where, (without, with_) in report.rows.items():
        table.add_row(where, "without", *_figures(without), "")
        table.add_row("", "with", *_figures(with_), f"{1 - with_.mean / without.mean:.0%}")
    return table


def _figures(distances: Distances) -> list[str]:
    return [f"{_MM * value:.3f}" for value in (distances.mean, distances.rms, distances.largest)]
