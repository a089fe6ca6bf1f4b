"""Which of some furrows the artist looks at or edits: one rule for those of the document and those that are proposed."""

from __future__ import annotations

from abc import ABC, abstractmethod

from ...wrinkle.furrow import Furrow


class OneChosen(ABC):
    """Furrows of which one may be chosen, by its number."""

    _chosen: int | None = None

    @property
    @abstractmethod
    def furrows(self) -> tuple[Furrow, ...]:
        """Those to choose from."""

    @property
    def chosen(self) -> int | None:
        """The number of the furrow that is looked at; None when there is none, or there is no such furrow any more."""
        return self._chosen if self._chosen is not None and self._chosen < len(self.furrows) else None

    @chosen.setter
    def chosen(self, number: int | None) -> None:
        self._chosen = number
