"""Furrows that the program proposes from how the skin shrinks, for the artist to accept, drag or reject."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from ...head.head import Head
from ...wrinkle.face import Face
from ...wrinkle.face_creases import face_layout
from ...wrinkle.furrow import Furrow
from ...wrinkle.inference import EXPRESSIONS, propose_furrows
from ..studio import Studio, explain
from .choosing import OneChosen


class _Stopped(Exception):
    """The artist does not want proposals any more."""


class _Watched(Mapping[str, Mapping[str, float]]):
    """The expressions, telling as each is taken how many have been."""

    def __init__(self, taken: Callable[[int], None]) -> None:
        self._taken = taken

    def __getitem__(self, name: str) -> Mapping[str, float]:
        return EXPRESSIONS[name]

    def __len__(self) -> int:
        return len(EXPRESSIONS)

    def __iter__(self) -> Iterator[str]:
        for number, name in enumerate(EXPRESSIONS):
            self._taken(number)
            yield name
        self._taken(len(EXPRESSIONS))


class _Search:
    """One look at all expressions, in a thread of its own. done: 0 to 1. found: None until it has ended."""

    def __init__(self, head: Head) -> None:
        self.head = head
        self.stopped = False
        self.done = 0.0
        self.found: tuple[Furrow, ...] | Exception | None = None
        # A daemon: the program does not wait for proposals that nobody will see.
        threading.Thread(target=self._work, name="proposals", daemon=True).start()

    def _work(self) -> None:
        try:
            # A face of its own, since the one on show moves.
            self.found = propose_furrows(Face(self.head), face_layout(self.head), _Watched(self._taken))
        except Exception as error:  # every failure is the user's to read and must not end the window
            self.found = error

    def _taken(self, number: int) -> None:
        if self.stopped:
            raise _Stopped
        # What follows the last expression takes about as long as all of them.
        self.done = (0.5 + number) / (2 * len(EXPRESSIONS) + 0.5)


class Proposals(OneChosen):
    """The proposals of the document: asks for them, and every answer is one change of the document."""

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self._search: _Search | None = None

    @property
    def furrows(self) -> tuple[Furrow, ...]:
        """Those that have no answer yet."""
        return self.studio.document.wrinkle.proposals

    @property
    def progress(self) -> float | None:
        """How far the search is, 0 to 1; None when there is none."""
        return self._search.done if self._search is not None else None

    def search(self) -> None:
        """Begin to look at the skin in every expression."""
        if self._search is None and self.studio.grown is not None:
            self._search = _Search(self.studio.grown.animation.head)

    def cancel(self) -> None:
        """Want no proposals any more."""
        if self._search is not None:
            self._search.stopped, self._search = True, None

    def poll(self) -> None:
        """Take what was found. Call once a frame."""
        search = self._search
        if search is None or search.found is None:
            return
        self._search = None
        grown = self.studio.grown
        if isinstance(search.found, Exception):
            self.studio.messages.say(explain(search.found), "error")
        elif grown is None or grown.animation.head is not search.head:
            self.studio.messages.say("The proposals were for another head.", "warning")
        elif not search.found:
            self.studio.messages.say("No expression shrinks the skin enough for a furrow.", "warning")
        else:
            self._replace(search.found, (), "Propose furrows")
            self.studio.messages.say(f"{len(search.found)} furrows are proposed.", "good")

    def accept(self, number: int, label: str = "Accept proposal") -> int:
        """Make a proposal a furrow; returns its number among the furrows."""
        left = self.furrows[:number] + self.furrows[number + 1 :]
        self._replace(left, (self.furrows[number],), label)
        return len(self.studio.document.wrinkle.furrows) - 1

    def accept_all(self) -> None:
        """Make all of them furrows."""
        self._replace((), self.furrows, "Accept all proposals")

    def reject(self, number: int) -> None:
        """Take a proposal away."""
        self._replace(self.furrows[:number] + self.furrows[number + 1 :], (), "Reject proposal")

    def reject_all(self) -> None:
        """Take all of them away."""
        self._replace((), (), "Reject all proposals")

    def _replace(self, proposals: tuple[Furrow, ...], accepted: tuple[Furrow, ...], label: str) -> None:
        document = self.studio.document
        wrinkle = replace(document.wrinkle, proposals=proposals)
        if accepted:
            # The default set becomes the document's own, as with every furrow that comes to it.
            wrinkle = replace(wrinkle, furrows=wrinkle.chosen + accepted)
        self._chosen = None
        self.studio.work.change(replace(document, wrinkle=wrinkle), label)
