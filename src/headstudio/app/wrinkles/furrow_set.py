"""The furrows of the document in the artist's hands: which one is chosen, and every change of them as one entry."""

from __future__ import annotations

from dataclasses import replace

from ...wrinkle.furrow import Furrow
from ...wrinkle.furrow_editing import mirrored
from ..studio import Studio
from .choosing import OneChosen


class FurrowSet(OneChosen):
    """Reads and replaces the furrows of the document. mirror: whether the other side of the face follows.

    The default set becomes the document's own with the first change.
    """

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self.mirror = True

    @property
    def furrows(self) -> tuple[Furrow, ...]:
        """Those of the document, or the default set at the age of the skin."""
        return self.studio.document.wrinkle.chosen

    def put(self, number: int, furrow: Furrow, label: str) -> None:
        """Another furrow in the place of one; with ``mirror`` the one across the face follows."""
        furrows = list(self.furrows)
        across = self.across(number) if self.mirror else None
        furrows[number] = furrow
        if across is not None:
            furrows[across] = replace(mirrored(furrow), name=furrows[across].name)
        self.replace(tuple(furrows), label)

    def add(self, furrow: Furrow, label: str) -> None:
        """One more furrow, which is chosen; with ``mirror`` another one across the face, unless it crosses the middle."""
        furrows = [*self.furrows, furrow]
        number = len(furrows) - 1
        sides = {x > 0 for x, _ in furrow.controls if x}
        if self.mirror and len(sides) == 1:
            side = "left" if True in sides else "right"
            furrows[number] = replace(furrow, name=f"{furrow.name} {side}")
            furrows.append(mirrored(furrows[number], furrows))
        self.replace(tuple(furrows), label)
        self._chosen = number

    def remove(self, number: int) -> None:
        """Take a furrow away, with ``mirror`` the one across the face as well. The last one stays."""
        gone = {number, self.across(number) if self.mirror else number}
        kept = tuple(furrow for k, furrow in enumerate(self.furrows) if k not in gone)
        if not kept:
            self.studio.messages.say('The last furrow stays: switch "Wrinkles" off to see none.', "warning")
            return
        self._chosen = None
        self.replace(kept, "Remove furrow")

    def mirror_over(self, number: int) -> None:
        """A furrow as it is over to the other side: a new one there, or that which is there takes its shape."""
        furrow, across = self.furrows[number], self.across(number)
        furrows = list(self.furrows)
        if across is None:
            furrows.append(mirrored(furrow, furrows))
        else:
            furrows[across] = replace(mirrored(furrow), name=furrows[across].name)
        self.replace(tuple(furrows), "Mirror furrow")

    def across(self, number: int) -> int | None:
        """The furrow with the same name on the other side of the face."""
        name = self.furrows[number].name
        wanted = mirrored(self.furrows[number]).name
        found = (k for k, furrow in enumerate(self.furrows) if furrow.name == wanted and furrow.name != name)
        return next(found, None)

    def replace(self, furrows: tuple[Furrow, ...], label: str) -> None:
        """Another set; an empty one is the default set."""
        document = self.studio.document
        self.studio.work.change(replace(document, wrinkle=replace(document.wrinkle, furrows=furrows)), label)
