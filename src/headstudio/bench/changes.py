"""What an artist waits for: from a change of a hairstyle to the first picture that shows it, and to the whole of it, as the
window builds and draws them."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np

from ..head.scalp_settings import GrayImage
from ..params import assign
from ..render.renderer import Renderer
from ..scene.animation import Animation
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.drafts import next_to_build, same_hair
from ..scene.styles import load_style
from ..wisp.maps import length_map
from ..wisp.operations import Tie
from ..wisp.selection import Selection

SIZE = (840, 720)  # about that of the view in a window as it opens
REPEATS = 3


def changes_of(document: Document) -> dict[str, Document]:
    """One change of every kind that the seven steps have, by its name: the document after it."""
    lengths = length_map(document.wisp).pixels.copy()
    lengths[: len(lengths) // 3] *= 0.8
    tie = Tie(Selection("v < 0.4"))
    tied = replace(document, styling=replace(document.styling, operations=(tie,)))
    moved = replace(tied, styling=replace(tied.styling, operations=(replace(tie, place=(0.1, 0.6, -1.1)),)))
    drawn = tuple((0.004 * np.sin(9.0 * t), 0.12 * t, 0.004 * np.cos(9.0 * t)) for t in np.linspace(0, 1, 12).tolist())
    return {
        "colour": assign(document, {"colour.pigment": "red"}),
        "fuzziness": assign(document, {"wisp.fuzziness": 0.3}),
        "length distribution": assign(document, {"wisp.length_distribution": "frayed"}),
        "prototype chosen": assign(document, {"wisp.prototype": "wavy"}),
        "prototype drawn": replace(document, wisp=replace(document.wisp, prototype_curve=drawn)),
        "stroke on the length map": replace(document, wisp=replace(document.wisp, painted_lengths=GrayImage(lengths))),
        "weight of a field": assign(document, {"styling.back": 0.5}),
        "bending stiffness": assign(document, {"styling.bending_stiffness": 1.0}),
        "hair tied": tied,
        "tie moved": moved,
        "preset chosen": load_style("bob").on(document),
    }


@dataclass(frozen=True)
class ChangeCost:
    """Milliseconds from a change to what is seen of it, in the middle one of REPEATS runs.

    build, draw: of the first picture that shows the change, and seen_ms: both. whole_ms: until all strands are there, the
    first picture included; the same where there is no draft before.
    """

    build_ms: float
    draw_ms: float
    whole_ms: float

    @property
    def seen_ms(self) -> float:
        """From the change to the first picture that shows it."""
        return self.build_ms + self.draw_ms


def change_costs(document: Document, builder: Builder, renderer: Renderer) -> dict[str, ChangeCost]:
    """What every kind of change costs at the detail of the window, in its size, all strands of ``document`` being there."""
    document = assign(document, {"look.hair_as": "strands"})
    costs = {}
    for name, after in changes_of(document).items():
        runs = []
        for _ in range(REPEATS):
            _pictures(document, None, builder, renderer)
            runs.append(_pictures(after, document, builder, renderer))
        costs[name] = ChangeCost(*sorted(runs, key=lambda run: run[-1])[REPEATS // 2])
    return costs


def _pictures(
    wanted: Document, shown: Document | None, builder: Builder, renderer: Renderer
) -> tuple[float, float, float]:
    """Build and draw until all of ``wanted`` is there: milliseconds to build and to draw the first picture, and in all."""
    start = time.perf_counter()
    marks: list[float] = []
    while not (shown and same_hair(shown, wanted)):
        shown = next_to_build(wanted, shown)
        stage = Animation(builder, shown, shown.look.strands_shown).stage()
        marks.append(time.perf_counter())
        renderer.render(stage, wanted.look, wanted.camera, SIZE)
        renderer.context.finish()
        marks.append(time.perf_counter())
    return 1e3 * (marks[0] - start), 1e3 * (marks[1] - marks[0]), 1e3 * (marks[-1] - start)
