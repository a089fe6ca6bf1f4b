"""Large wrinkles on a head: from settings to creases that follow its poses."""

from __future__ import annotations

from collections.abc import Sequence

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


def face_bed(head: Head, furrows: Sequence[Furrow], fineness: float) -> FurrowBed:
    """A head's skin prepared for furrows of the face chart; those that its face does not reach are left out."""
    chart = FaceChart(head, face_layout(head))
    laid = [chart.to_texture(furrow) for furrow in furrows]
    return prepare_bed(chart.layout, [furrow for furrow in laid if furrow is not None], fineness)


def face_creases(head: Head, settings: WrinkleSettings, bed: FurrowBed | None = None) -> Creases:
    """The furrows of ``settings`` on a head, or on a bed that was prepared for them before."""
    bed = bed or face_bed(head, settings.furrow_set(), settings.fineness)
    return Creases(
        bed,
        strength=settings.strength if settings.shown else 0.0,
        measure=settings.shrinkage,  # type: ignore[arg-type]  # a choice is one of MEASURES
        self_contact=settings.self_contact,
    )
