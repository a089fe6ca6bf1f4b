"""What an artist waits for: from a change of a hairstyle to the picture that shows it, as the window builds and draws it."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from ..head.scalp_settings import GrayImage
from ..params import assign
from ..render.renderer import Renderer
from ..scene.animation import Animation
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.styles import load_style
from ..wisp.maps import length_map
from ..wisp.operations import Tie
from ..wisp.selection import Selection

SIZE = (512, 512)


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


def change_costs(document: Document, builder: Builder, renderer: Renderer) -> dict[str, tuple[float, float]]:
    """Milliseconds to build and to draw what each change leads to, at the detail of the window, the document being there."""
    document = assign(document, {"look.hair_as": "strands"})
    shown = document.look.strands_shown

    def spent(after: Document) -> tuple[float, float]:
        start = time.perf_counter()
        stage = Animation(builder, after, shown).stage()
        built = time.perf_counter()
        renderer.render(stage, after.look, after.camera, SIZE)
        renderer.context.finish()
        return 1e3 * (built - start), 1e3 * (time.perf_counter() - built)

    costs = {}
    for name, after in changes_of(document).items():
        spent(document)
        costs[name] = spent(after)
    return costs
