"""Furrows inferred from how the skin moves: the future work of Bando's thesis, section 2.8.

Every named expression is shown once. Where it presses skin together, furrows run across the direction in which the skin
shrinks most. What all expressions ask for is joined into one field: in each direction the most that any of them shrinks
the skin by. Its ridges are where furrows are proposed, as deep as the tissue that has to go somewhere.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy import ndimage

from ..head.mesh import Floats
from .bezier import fit_stroke
from .face import Face
from .face_chart import FaceChart
from .face_settings import FaceSettings
from .furrow import Furrow
from .metric import face_metrics, perpendicular
from .skin_layout import SkinLayout
from .texels import texel_map
from .tissue_thickness import thickness_of
from .valley_lines import ValleyLine, valley_lines
from .valleys import ANGLES, ValleyField

EXPRESSIONS: Mapping[str, Mapping[str, float]] = {
    name: {name: 1.0} for name in ("thinking", "smile", "troubled", "angry", "surprise", "squint", "look_down")
}
"""The faces that furrows are inferred from, as settings of the sliders."""

# Texels along an edge of the map, and over how many of them shrinkage is evened out.
_SIZE, _EVEN = 320, 1.5
# A furrow is proposed where skin shrinks by this much; at half as much it runs on.
_LEAST = 0.06
# Furrows lie this far apart [m], which is how wide the field's valleys are taken to be.
_APART = 3.2e-3
# No furrow is proposed that is shorter than this [m], and no more than so many.
_SHORTEST, _MOST = 0.016, 40
# A furrow is as wide as this part of the tissue under it, within limits [m]; so that it folds what shrinks, it is as deep
# as this part of the tissue for skin that shrinks by all of itself.
_WIDTH_PART, _WIDTHS, _DEPTH_PART = 0.35, (8e-4, 3.5e-3), 0.6
_DEEPEST = 8e-3
# Skin that moves much is creased at rest, too: r for the largest shrinkage, reached at this much.
_MOST_AT_REST, _WORN = 0.25, 0.35
_TOLERANCE = 4e-4


def propose_furrows(
    face: Face, layout: SkinLayout, expressions: Mapping[str, Mapping[str, float]] = EXPRESSIONS
) -> tuple[Furrow, ...]:
    """Furrows of the face chart for an artist to accept or to drag, the most shrunken skin first.

    layout: of the face's skin. expressions: names and sliders, see FaceSettings.
    """
    thickness = thickness_of(face.head, FaceSettings().tissue)
    shrinkage = np.zeros((ANGLES, len(layout.part.faces)))
    for sliders in expressions.values():
        posed = face.pose(FaceSettings(**sliders)).positions  # type: ignore[arg-type]  # names of sliders
        np.maximum(shrinkage, shrinkage_across(layout, posed), out=shrinkage)
    field = _field(layout, shrinkage)
    chart = FaceChart(face.head, layout)
    tissue = thickness[layout.part.vertices][layout.texture_map.mesh.faces].mean(axis=1)
    proposed = []
    for number, line in enumerate(valley_lines(field, _LEAST)[:_MOST], 1):
        if line.length >= _SHORTEST:
            proposed.append(_furrow(f"proposal {number}", line, layout, chart, tissue))
    return tuple(proposed)


def shrinkage_across(layout: SkinLayout, posed: Floats) -> Floats:
    """How much every mapped triangle shrinks square to each of the ANGLES of texture space, (ANGLES, m), 0 where it does
    not; only where that is also nearly the direction in which it shrinks most.

    posed: positions of the whole skin [m], (n, 3). From the metric before and after: a length a in texture space is
    sqrt(a . G a) on the skin, so that the skin is stretched by sqrt(a . G' a / a . G a) along a.
    """
    mesh, corners = layout.texture_map.mesh, layout.texture_map.corner_uv
    before = face_metrics(mesh, corners)
    after = face_metrics(mesh.moved(posed[layout.part.vertices]), corners)
    found = np.zeros((ANGLES, len(before)))
    for k in range(ANGLES):
        angle = np.pi * k / ANGLES
        along = np.broadcast_to([np.cos(angle), np.sin(angle)], (len(before), 2))
        across = perpendicular(along, before)
        stretch = np.sqrt(_form(after, across) / np.maximum(_form(before, across), np.finfo(float).tiny))
        along_stretch = np.sqrt(_form(after, along) / np.maximum(_form(before, along), np.finfo(float).tiny))
        # Skin that shrinks as much along a furrow as across it does not fold into this one more than into another.
        found[k] = np.clip(1.0 - stretch, 0.0, None) * np.clip(along_stretch - stretch, 0.0, 0.05) / 0.05
    return found


def _field(layout: SkinLayout, shrinkage: Floats) -> ValleyField:
    """Shrinkage as a field of valleys, which lines can be followed in."""
    drawn = texel_map(layout.texture_map, _SIZE)
    inside = drawn.mapped
    share = ndimage.gaussian_filter(inside.astype(float), _EVEN)
    images = np.zeros((ANGLES, _SIZE, _SIZE))
    for k in range(ANGLES):
        image = np.where(inside, shrinkage[k][np.maximum(drawn.triangle, 0)], 0.0)
        smooth = ndimage.gaussian_filter(image, _EVEN) / np.maximum(share, 1e-6)
        images[k] = np.where(ndimage.binary_erosion(inside, iterations=3), smooth, 0.0)
    highest = ndimage.maximum_filter1d(images, 7, axis=0, mode="wrap")
    peak = ndimage.maximum_filter1d((images == highest).view(np.uint8), 3, axis=0, mode="wrap").view(bool)
    width = np.full(images.shape, _APART)
    return ValleyField(
        np.where(peak, images, 0.0), width, np.zeros(2, dtype=np.int64), layout.texture_map.metres / _SIZE
    )


def _furrow(name: str, line: ValleyLine, layout: SkinLayout, chart: FaceChart, tissue: Floats) -> Furrow:
    places = ndimage.gaussian_filter1d(line.points / _SIZE, 2.0, axis=0, mode="nearest")
    found, _ = layout.locate(places)
    thickness = float(np.median(tissue[found.faces]))
    width = float(np.clip(_WIDTH_PART * thickness, *_WIDTHS))
    # M(s) multiplies d by the shrinkage itself (2.4), so d is what skin would give that shrinks by all of itself.
    depth = min(_DEPTH_PART * thickness, _DEEPEST)
    chain = fit_stroke(places, _TOLERANCE / layout.texture_map.metres)
    controls = tuple((float(x), float(y)) for x, y in chain.controls)
    initial = float(_MOST_AT_REST * min(line.depth / _WORN, 1.0))
    return chart.to_chart(Furrow(name, "inferred", depth, width, initial, controls))


def _form(metrics: Floats, a: Floats) -> Floats:
    return np.einsum("ki,kij,kj->k", a, metrics, a)
