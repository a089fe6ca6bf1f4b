"""Undo and redo: a list of documents.

Documents are immutable and share every part that a change leaves alone, so a list of them costs little. One entry is
one thing the user did: a click, or a whole gesture such as the drag of a slider or a stroke of a brush.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

DocumentT = TypeVar("DocumentT")

LONGEST = 500


@dataclass(frozen=True)
class _Entry(Generic[DocumentT]):
    label: str
    before: DocumentT
    after: DocumentT


class History(Generic[DocumentT]):
    """The present document, the ways back and forth, and whether it differs from what is on disk.

    Every change names itself ("Hair length"), which is what the menu prints behind Undo and Redo. At most ``limit``
    entries are kept; the oldest go first.
    """

    def __init__(self, document: DocumentT, limit: int = LONGEST) -> None:
        self._limit = limit
        self.reopen(document)

    def reopen(self, document: DocumentT) -> None:
        """Start over with a document that is as it is on disk: nothing to undo, nothing modified."""
        self._present = document
        self._saved = document
        self._past: list[_Entry[DocumentT]] = []
        self._future: list[_Entry[DocumentT]] = []
        self._gesture: tuple[str, DocumentT] | None = None

    @property
    def document(self) -> DocumentT:
        """The document as it is now, in the middle of a gesture as well."""
        return self._present

    def change(self, document: DocumentT, label: str) -> None:
        """Make ``document`` the present one. Outside a gesture this is an entry; an equal document is no change."""
        if document == self._present:
            return
        before, self._present = self._present, document
        if self._gesture is None:
            self._record(label, before)

    def begin_gesture(self, label: str) -> None:
        """From here to ``end_gesture`` all changes are one entry. A gesture that is still open ends first."""
        self.end_gesture()
        self._gesture = (label, self._present)

    def end_gesture(self) -> None:
        """Close the gesture, if one is open; it becomes an entry when it changed anything."""
        if self._gesture is None:
            return
        (label, before), self._gesture = self._gesture, None
        if before != self._present:
            self._record(label, before)

    def cancel_gesture(self) -> None:
        """Give the gesture up and return to where it began."""
        if self._gesture is not None:
            self._present = self._gesture[1]
            self._gesture = None

    @property
    def in_gesture(self) -> bool:
        """Whether a gesture is open."""
        return self._gesture is not None

    def undo(self) -> bool:
        """Take back the last entry (an open gesture counts as one). False when there is none."""
        self.end_gesture()
        if not self._past:
            return False
        entry = self._past.pop()
        self._future.append(entry)
        self._present = entry.before
        return True

    def redo(self) -> bool:
        """Do again what was taken back last. False when there is nothing."""
        self.end_gesture()
        if not self._future:
            return False
        entry = self._future.pop()
        self._past.append(entry)
        self._present = entry.after
        return True

    @property
    def undo_label(self) -> str | None:
        """What ``undo`` would take back, or None."""
        if self._gesture is not None and self._gesture[1] != self._present:
            return self._gesture[0]
        return self._past[-1].label if self._past else None

    @property
    def redo_label(self) -> str | None:
        """What ``redo`` would do again, or None."""
        return self._future[-1].label if self._future else None

    @property
    def modified(self) -> bool:
        """Whether the document differs from the one last opened or saved; undoing all the way makes it equal again."""
        return self._present is not self._saved and self._present != self._saved

    def mark_saved(self) -> None:
        """The present document is on disk now."""
        self._saved = self._present

    def _record(self, label: str, before: DocumentT) -> None:
        self._past.append(_Entry(label, before, self._present))
        del self._past[: -self._limit]
        self._future.clear()
