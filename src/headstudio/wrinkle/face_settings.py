"""What an artist decides about the face that moves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from ..head.scalp_settings import GrayImage
from ..params import choice, number, parameters_of
from .performance import Performance, check_performance, keyframe, weights_at, with_key

DRIVERS = ("muscles", "units", "both")
TISSUES = ("average", "lean", "full")


def _slider(label: str, doc: str) -> Any:
    return number(0.0, label, "", 0.0, 1.0, doc, live=True)


def _left(name: str) -> Any:
    return _slider(f"{name}, left", f"{name} on the person's left, added to both.")


def _right(name: str) -> Any:
    return _slider(f"{name}, right", f"{name} on the person's right, added to both.")


@dataclass(frozen=True)
class FaceSettings:
    """Expressions, what drives them, and the tissue under the skin.

    painted_tissue: a thickness map over the texture square that takes the place of the named one; white is
    MAX_THICKNESS. performance: keyframes that move the sliders over time; empty for a face that holds still.
    """

    driver: str = choice(
        "both",
        "Driver",
        DRIVERS,
        "What moves the skin: muscles, MakeHuman's expression units, or half of each. A head without units has muscles.",
        live=True,
    )
    smile: float = _slider("Smile", "A smile.")
    smile_left: float = _left("Smile")
    smile_right: float = _right("Smile")
    thinking: float = _slider("Thinking", "Knitted brows, pursed lips.")
    thinking_left: float = _left("Thinking")
    thinking_right: float = _right("Thinking")
    troubled: float = _slider("Troubled", "Brows raised in the middle, corners of the mouth drawn down.")
    troubled_left: float = _left("Troubled")
    troubled_right: float = _right("Troubled")
    angry: float = _slider("Angry", "Brows drawn down and together, nose wrinkled.")
    angry_left: float = _left("Angry")
    angry_right: float = _right("Angry")
    surprise: float = _slider("Surprise", "Brows raised, eyes wide, jaw dropped.")
    surprise_left: float = _left("Surprise")
    surprise_right: float = _right("Surprise")
    squint: float = _slider("Squint", "Eyes narrowed against the light.")
    squint_left: float = _left("Squint")
    squint_right: float = _right("Squint")
    look_down: float = _slider("Look down", "Eyes turned down; the upper lids follow.")
    look_down_left: float = _left("Look down")
    look_down_right: float = _right("Look down")
    blink: float = _slider("Blink", "Lids closed.")
    blink_left: float = _left("Blink")
    blink_right: float = _right("Blink")
    jaw_open: float = _slider("Jaw", "How far the jaw opens.")
    tissue: str = choice("average", "Tissue", TISSUES, "How thick the tissue under the skin is.", live=True)
    tissue_lift: float = number(
        1.0, "Tissue lift", "", 0.0, 2.0, "How much tissue lifts skin that is pressed together; 0 for none.", live=True
    )
    painted_tissue: GrayImage | None = None
    performance: Performance = field(default=())

    def __post_init__(self) -> None:
        check_performance(self.performance, SLIDERS)

    def strength(self, expression: str, side: str) -> float:
        """How strongly one side ("left" or "right") shows an expression: its own slider and that of both, up to 1."""
        return min(float(getattr(self, expression)) + float(getattr(self, f"{expression}_{side}")), 1.0)

    def at(self, time: float) -> FaceSettings:
        """The face at a time of its performance [s]: the sliders that it moves take its place."""
        moved: Mapping[str, Any] = weights_at(self.performance, time)
        return replace(self, **moved) if moved else self

    def with_sliders(self, changes: Mapping[str, float], time: float) -> FaceSettings:
        """The face with other strengths of some sliders: for good, or in a performance by a keyframe at ``time`` [s]."""
        if not self.performance:
            return replace(self, **changes)  # type: ignore[arg-type]  # sliders are numbers
        return self.with_key(time, changes)

    def with_key(self, time: float, changes: Mapping[str, float] | None = None) -> FaceSettings:
        """The face with a keyframe of how it is at ``time`` [s] apart from ``changes``.

        A slider that moves from now on keeps what it had at the other keyframes.
        """
        now, named = self.at(time), {name for key in self.performance for name, _ in key.weights}
        weights = {name: float(getattr(now, name)) for name in SLIDERS} | dict(changes or {})
        weights = {name: weight for name, weight in weights.items() if weight > 0 or name in named}
        still = {name: float(getattr(self, name)) for name in weights if name not in named}
        others = tuple(keyframe(key.time, still | dict(key.weights)) for key in self.performance)
        return replace(self, performance=with_key(others, keyframe(time, weights)))


SLIDERS: tuple[str, ...] = tuple(
    name
    for name, parameter in parameters_of(FaceSettings).items()
    if parameter.kind == "number" and name != "tissue_lift"
)
"""The sliders that a performance may move."""
