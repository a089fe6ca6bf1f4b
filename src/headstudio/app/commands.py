"""What the user can ask for by menu or key: one list, from which the menus, the keys and their help are made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import imgui

_CTRL, _SHIFT = imgui.Key.mod_ctrl.value, imgui.Key.mod_shift.value

_NAMED = {
    "Ctrl": _CTRL,
    "Shift": _SHIFT,
    "Space": imgui.Key.space.value,
    "Right": imgui.Key.right_arrow.value,
    "Home": imgui.Key.home.value,
    "Tab": imgui.Key.tab.value,
    "[": imgui.Key.left_bracket.value,
    "]": imgui.Key.right_bracket.value,
}


def _yes() -> bool:
    return True


def _no() -> bool:
    return False


@dataclass(frozen=True)
class Command:
    """One thing to ask for. ``keys`` as the menu writes them ("Ctrl+Shift+S"), several separated by a space.

    ``name`` may change with the state, as "Undo Length" does; ``label`` is what stays.
    """

    menu: str
    label: str
    run: Callable[[], object]
    keys: str = ""
    enabled: Callable[[], bool] = _yes
    on: Callable[[], bool] = _no
    name: Callable[[], str] | None = None

    @property
    def shown_keys(self) -> str:
        """The keys for the menu's right side."""
        return self.keys.split(" ")[0]

    def pressed(self) -> bool:
        """Whether one of its key chords was pressed in this frame."""
        return any(imgui.is_key_chord_pressed(chord(keys)) for keys in self.keys.split())


def chord(keys: str) -> int:
    """ImGui's number for keys written as "Ctrl+Shift+S"."""
    total = 0
    for key in keys.split("+"):
        total |= _NAMED[key] if key in _NAMED else _key(key)
    return total


def _key(name: str) -> int:
    prefix = "_" if name.isdigit() else ""
    return int(imgui.Key[prefix + name.lower()].value)


def run_pressed(commands: list[Command]) -> None:
    """Run what the keyboard asks for, unless the keys belong to a text that is being typed."""
    if imgui.get_io().want_text_input:
        return
    for command in commands:
        if command.keys and command.enabled() and command.pressed():
            command.run()
            return
