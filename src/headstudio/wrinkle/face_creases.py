"""Large wrinkles on a head: from settings to creases that follow its poses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache

from ..head.head import Head
from .creases import Creases
from .face_chart import FaceChart
from .furrow import Furrow
from .furrow_bed import FurrowBed, prepare_bed
from .mapping import map_face
from .settings import WrinkleSettings
from .skin_layout import SkinLayout


def face_layout(head: Head) -> SkinLayout:
    """The skin of a head and the texture map of its face."""
    part, texture_map = map_face(head)
    return SkinLayout(head.skin, part, texture_map)


def face_bed(
    head: Head,
    furrows: Sequence[Furrow],
    fineness: float,
    known: FurrowBed | None = None,
    tick: Callable[[], None] = lambda: None,
    *,
    settled: bool = True,
) -> FurrowBed:
    """Prepare a head's skin for furrows of the face chart. Only where they run and how wide they are counts here.

    Those that the face does not reach are left out (a short neck may lack the lowest); ``chosen`` tells which are there.
    known, tick, settled: see ``prepare_bed``.
    """
    chart = _chart(head)
    laid = {k: _on_chart(chart, furrow) for k, furrow in enumerate(furrows)}
    found = {k: furrow for k, furrow in laid.items() if furrow is not None}
    bed = prepare_bed(chart.layout, list(found.values()), fineness, known, tick, settled=settled)
    return replace(bed, chosen=tuple(found))


@lru_cache(maxsize=2)
def _chart(head: Head) -> FaceChart:
    return FaceChart(head, face_layout(head))


@lru_cache(maxsize=256)
def _on_chart(chart: FaceChart, furrow: Furrow) -> Furrow | None:
    """The furrow in texture space. Of many, one is drawn or moved: the others are where they were."""
    return chart.to_texture(furrow)


def face_creases(head: Head, settings: WrinkleSettings, bed: FurrowBed | None = None) -> Creases:
    """The furrows of ``settings`` on a head, or on its skin as ``face_bed`` prepared it for where they run."""
    furrows = settings.furrow_set()
    bed = bed or face_bed(head, furrows, settings.fineness)
    return Creases(
        bed,
        [furrows[k] for k in bed.chosen],
        strength=settings.strength if settings.shown else 0.0,
        measure=settings.shrinkage,  # type: ignore[arg-type]  # a choice is one of MEASURES
        self_contact=settings.self_contact,
    )
