"""The furrows of a head, moved and sized to a scan of it; those that the scan has besides are added."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from ..head.head import Head
from ..head.mesh import Floats, TriangleMesh
from .face_chart import FaceChart
from .face_creases import face_layout
from .fitting import FurrowFit, Progress, fit_grooves
from .furrow import Furrow
from .groove import Groove

# A furrow is taken for a groove when this part of it runs this near to it on the chart [m].
_NEAR, _SHARE = 5e-3, 0.6
# Nearer than this to what the scan covers [m], a furrow that it does not show is not there at rest.
_COVERED = 4e-3


@dataclass(frozen=True, eq=False)
class ScanFit:
    """furrows: of the face chart, the fitted ones first. fitted: how many these are. moved: names of those that were
    there before. fit: grooves and what is left, in texture space."""

    furrows: tuple[Furrow, ...]
    fitted: int
    moved: tuple[str, ...]
    fit: FurrowFit


def fit_face(
    head: Head, scan: TriangleMesh, furrows: Sequence[Furrow], progress: Progress = lambda what, part: None
) -> ScanFit:
    """Fit ``furrows``, of the face chart, to a scan in the frame of the head [m].

    A furrow near a groove of the scan is moved onto it and keeps its name and region. One that the scan would show, but
    does not, is kept for expressions and is not there at rest; one that the scan does not cover stays as it is. Fitted
    furrows are all there at rest.
    """
    layout = face_layout(head)
    chart = FaceChart(head, layout)
    fit = fit_grooves(layout, scan, progress)
    fitted: list[Furrow] = []
    taken: set[int] = set()
    lines = [furrow.chain.sampled(40)[1] for furrow in furrows]
    for number, groove in enumerate(sorted(fit.grooves, key=_strongest, reverse=True), 1):
        laid = chart.to_chart(groove.furrow(f"groove {number}"))
        found = _nearest_known(laid, lines, taken)
        if found is not None:
            taken.add(found)
            laid = replace(laid, name=furrows[found].name, region=furrows[found].region)
        fitted.append(laid)
    covered = fit.texels.positions[np.isfinite(fit.left)]
    others = [_at_rest(furrow, chart, covered) for k, furrow in enumerate(furrows) if k not in taken]
    return ScanFit((*fitted, *others), len(fitted), tuple(furrows[k].name for k in sorted(taken)), fit)


def _strongest(groove: Groove) -> float:
    return groove.floor * len(groove.controls)


def _nearest_known(furrow: Furrow, lines: Sequence[Floats], taken: set[int]) -> int | None:
    """The line that runs along a furrow, most of it near; None when there is none."""
    tree = cKDTree(furrow.chain.sampled(40)[1])
    best, found = _SHARE, None
    for k, line in enumerate(lines):
        share = float((tree.query(line)[0] < _NEAR).mean())
        if k not in taken and share > best:
            best, found = share, k
    return found


def _at_rest(furrow: Furrow, chart: FaceChart, covered: Floats) -> Furrow:
    """The furrow, without what it would show at rest where the scan shows nothing."""
    skin = chart.on_skin(furrow.chain.sampled(40)[1])
    skin = skin[np.isfinite(skin[:, 0])]
    if not len(skin) or not len(covered):
        return furrow
    seen = np.isfinite(cKDTree(covered).query(skin, distance_upper_bound=_COVERED)[0]).mean()
    return replace(furrow, initial=0.0) if seen > 0.5 else furrow
