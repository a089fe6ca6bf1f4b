"""From the document to what can be simulated and drawn: head, scalp, body and hair, in that order."""

from __future__ import annotations

import functools
import math
import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from ..head.facial_hair import REGIONS
from ..head.head import Head
from ..head.load import load_head
from ..head.scalp import Scalp, grow_scalp
from ..head.scalp_settings import ScalpSettings
from ..lcp.body import Body
from ..lcp.grow import grow_hair
from ..lcp.model import HairModel
from ..wisp.adopt import place_on_head
from ..wisp.facial_hair import FacialPatch, facial_patches
from ..wisp.groom import groomed_hairdo, lay_on_head, mixed
from ..wisp.hairdo import Hairdo, Stylist
from ..wisp.joining import join_strands
from ..wisp.strands import Strands
from ..wisp.surroundings import Surroundings
from ..wrinkle.face import Face
from ..wrinkle.face_creases import face_bed, face_creases
from ..wrinkle.fine_guides import face_guides
from ..wrinkle.fine_wrinkles import FineWrinkles, grow_fine_wrinkles
from ..wrinkle.furrow_bed import FurrowBed
from ..wrinkle.living_skin import Skin, SkinSurface
from ..wrinkle.settings import WrinkleSettings
from ..wrinkle.texture_map import TextureMap
from .document import Document
from .settings import HeadSettings

PartT = TypeVar("PartT")


@dataclass(frozen=True, eq=False)
class Built:
    """Everything that follows from a document and stays as it is while hair moves."""

    head: Head
    scalp: Scalp
    body: Body
    hair: HairModel


class Builder:
    """Builds documents one after the other and makes again only what a change concerns.

    ``announce`` is told what is being made ("head", "scalp", "body", "hair", "surroundings", and the steps of a hairdo)
    before it is. Not for several threads at once.
    """

    def __init__(self, announce: Callable[[str], None] = lambda part: None) -> None:
        # The part of each kind that was made last, with what it was made from.
        self._made: dict[str, tuple[Any, Any]] = {}
        self._stylists: dict[str, Stylist] = {}
        self._announce = announce

    def build(self, document: Document) -> Built:
        """Build ``document``. Raises HeadError for a head or scalp curves that cannot be used."""
        head, scalp = self.head(document.head), self.scalp(document)
        body = self._part("body", head, lambda: Body.around(head))
        hair = self._part("hair", (scalp, body, document.hair), lambda: grow_hair(scalp, body, document.hair))
        return Built(head, scalp, body, hair)

    def head(self, settings: HeadSettings) -> Head:
        """Only the head. A file that was written again is read again."""
        return self._part(
            "head",
            (settings, _last_written(settings.source), _last_written(settings.eyes)),
            lambda: load_head(settings.source, eyes=settings.eyes, age=settings.age, masculine=settings.masculine),
        )

    def scalp(self, document: Document) -> Scalp:
        """The scalp on the head of ``document``. Raises HeadError for a head or curves that cannot be used."""
        head = self.head(document.head)
        return self._part("scalp", (head, document.scalp), lambda: grow_scalp(head, document.scalp))

    def surroundings(self, document: Document) -> Surroundings:
        """The space around the head of ``document``, as styled hair meets it. Raises HeadError."""
        head = self.head(document.head)
        return self._part("surroundings", head, lambda: Surroundings.around(head))

    def hairdo(self, document: Document, strands: int | None = None) -> Hairdo:
        """The hair of ``document``, made on demand: what was imported, or else the hairstyle; its strands are those of head
        and face. ``strands``: only the first so many of the head's, and as large a part of the face's.

        Raises HeadError, ParameterError for curves that cannot be used, AdoptError for hair that fits no head.
        """
        scalp, surroundings = self.scalp(document), self.surroundings(document)
        wanted = (scalp, surroundings, document.wisp, document.colour, document.styling, strands)
        if document.groom.hair is not None:
            hairdo = self._groomed(document, document.groom.hair.strands, strands)
        else:
            hairdo = self._part("hairdo", wanted, lambda: self._stylist("head").style(*wanted, announce=self._announce))
        faces = [
            self._facial_hair(document, patch, hairdo.strands.stands_for) for patch in facial_patches(document.beard)
        ]
        if not faces:
            return hairdo
        joined = self._part(
            "joined hair", (hairdo, *faces), lambda: join_strands([h.strands for h in (hairdo, *faces)])
        )
        return replace(hairdo, strands=joined)

    def _groomed(self, document: Document, file: Strands, strands: int | None) -> Hairdo:
        """Hair of another program, on the head of ``document``."""
        head, scalp, surroundings = self.head(document.head), self.scalp(document), self.surroundings(document)
        groom = document.groom
        placement = self._part("placement", (head, scalp, groom.hair), lambda: place_on_head(file, head, scalp))
        lying = self._part(
            "groom",
            (placement, surroundings, groom),
            lambda: mixed(lay_on_head(file, placement, head, surroundings, groom)[0]),
        )
        count = lying.count if strands is None else strands
        wanted = (lying, count, surroundings, document.wisp, document.colour, document.styling)
        return self._part("hairdo", wanted, lambda: groomed_hairdo(*wanted))

    def _stylist(self, region: str) -> Stylist:
        return self._stylists.setdefault(region, Stylist())

    def _facial_hair(self, document: Document, patch: FacialPatch, stands_for: float) -> Hairdo:
        skin, surroundings = self._facial_skin(document, patch.region), self.surroundings(document)
        strands = math.ceil(patch.wisp.strands / stands_for)
        wanted = (skin, surroundings, patch.wisp, document.colour, patch.styling, strands)
        return self._part(patch.region, wanted, lambda: self._stylist(patch.region).style(*wanted))

    def _facial_skin(self, document: Document, region: str) -> Scalp:
        """The skin that a beard or a moustache grows on. Its hair leans away from the middle of the lips."""
        head = self.head(document.head)

        def grow() -> Scalp:
            return grow_scalp(head, ScalpSettings(curves=REGIONS[region](head), whorl_u=0.5, whorl_v=1.0))

        return self._part(f"{region} skin", head, grow)

    def skin(self, document: Document, *, settled: bool = True) -> Skin:
        """The skin of the head of ``document`` with its furrows and fine wrinkles, ready for any expression.

        settled: False is quicker where a furrow was moved or taken away, see ``prepare_bed``. Raises HeadError.
        """
        head = self.head(document.head)
        # What is only proposed changes nothing.
        wrinkle = replace(document.wrinkle, proposals=())
        face = self._part("face", head, lambda: Face(head))
        bed = self._bed(head, wrinkle, settled)
        creases = self._part("creases", (bed, wrinkle), lambda: face_creases(head, wrinkle, bed))
        fine = self._fine_wrinkles(document, bed.layout.texture_map)
        # Who draws it keeps what it made of a surface, so a change of depth alone must not make another one.
        surface = self._part("surface", (bed, fine), lambda: SkinSurface(head, bed, fine))
        return self._part("skin", (face, surface, creases), lambda: Skin(face, surface, creases))

    def _bed(self, head: Head, wrinkle: WrinkleSettings, settled: bool) -> FurrowBed:
        """The skin prepared for furrows; what a bed that was made before has in common with it is taken over."""
        known_for, known = self._made.get("furrows", (None, None))
        if settled and known is not None and not known.settled:
            del self._made["furrows"]

        def make() -> FurrowBed:
            earlier = known if known_for is not None and known_for[0] is head else None
            step = functools.partial(self._announce, "furrows")
            return face_bed(head, wrinkle.furrow_set(), wrinkle.fineness, earlier, step, settled=settled)

        return self._part("furrows", (head, wrinkle.lines(), wrinkle.fineness), make)

    def _fine_wrinkles(self, document: Document, texture_map: TextureMap) -> FineWrinkles | None:
        if not document.fine.on:
            return None
        head = self.head(document.head)

        def grow() -> FineWrinkles:
            return grow_fine_wrinkles(texture_map, document.fine, face_guides(texture_map, head.landmarks))

        # How far they are out at rest changes nothing that is carved.
        at_rest = document.fine.initial_amplitude
        fine = self._part("fine wrinkles", (texture_map, replace(document.fine, initial_amplitude=1.0)), grow)
        return self._part("amplitude", (fine, at_rest), lambda: replace(fine, initial_amplitude=at_rest))

    def _part(self, kind: str, wanted: Any, make: Callable[[], PartT]) -> PartT:
        if kind not in self._made or self._made[kind][0] != wanted:
            self._announce(kind)
            self._made[kind] = (wanted, make())
        part: PartT = self._made[kind][1]
        return part


def _last_written(source: str) -> float | None:
    try:
        return os.path.getmtime(source)
    except (OSError, ValueError):
        return None
