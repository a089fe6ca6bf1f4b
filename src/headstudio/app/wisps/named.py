"""A choice among what ships, in whose place the user's own may stand: maps, curves, the prototype, the parting."""

from __future__ import annotations

from dataclasses import replace

from ..parameter_rows import ParameterRows, defaults
from ..parameter_widgets import begin_row
from ..ui import Ui


class Named:
    """A field of the wisp settings that names one of those that ship, and the field that, when it holds something, stands
    in its place. word: what the user's own is called.
    """

    def __init__(self, rows: ParameterRows, name: str, own: str, word: str) -> None:
        self.rows = rows
        self.declared, _ = defaults()[f"wisp.{name}"]
        self._name, self._own, self._word = name, own, word

    @property
    def is_own(self) -> bool:
        """Whether the user's own stands in the place of what is named."""
        return bool(getattr(self.rows.studio.document.wisp, self._own))

    def row(self, ui: Ui) -> None:
        """The choice with its label before it."""
        _, default = defaults()[f"wisp.{self._name}"]
        begin_row(ui, self.declared.label, changed=self.is_own or self._value != default)
        self.draw(ui)

    def draw(self, ui: Ui) -> None:
        """The choice alone. One of those that ship takes the place of the user's own."""
        shown = self._word if self.is_own else self._value
        chosen = ui.choose(self.declared.label, shown, self.declared.options, self.declared.doc)
        if chosen is not None:
            self.put(None, **{self._name: chosen})

    def put(self, own: object, **more: object) -> None:
        """Make ``own`` the user's own, or take it away if it is None; ``more`` fields change with it."""
        document = self.rows.studio.document
        empty = getattr(type(document.wisp)(), self._own)
        wisp = replace(document.wisp, **{self._own: empty if own is None else own}, **more)  # type: ignore[arg-type]
        self.rows.change(replace(document, wisp=wisp), self.declared.label)

    @property
    def _value(self) -> str:
        return str(getattr(self.rows.studio.document.wisp, self._name))
