"""A hairstyle from its settings to a picture: what each step costs (Choe, Ko 2005: 10 s to a preview of 20,000 strands,
30 minutes to a picture of 80,000 to 100,000)."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median

from ..params import assign
from ..render.renderer import Renderer
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.stage import Stage
from ..wisp.hairdo import Hairdo, Stylist
from .memory import peak_memory

SIZE = (512, 512)
FINAL_SIZE = (1024, 1024)
REPEATS = 3
PREVIEW = 20_000
PAPER_PREVIEW_S = 10.0
PAPER_PICTURE_S = 30 * 60.0


@dataclass(frozen=True)
class HairstyleCost:
    """One hairstyle. strands, points: how many, and how many points each. Milliseconds are medians.

    stages: of making it, by name. style_ms: making all of it, head and scalp being there. preview_ms: making the first
    20,000 strands. show_ms: a picture of 512 x 512 at the detail of the window, light in the hair included. final_ms: a
    picture of 1024 x 1024 in final quality with every strand. memory_bytes: the most that a process had that made head and
    strands and nothing else; None where the system does not tell.
    """

    strands: int
    points: int
    stages: dict[str, float]
    style_ms: float
    preview_ms: float
    show_ms: float
    final_ms: float
    memory_bytes: int | None


def hairstyle_cost(
    document: Document, strands: int, builder: Builder, renderer: Renderer, tick: Callable[[], None] = lambda: None
) -> HairstyleCost:
    """Style ``strands`` strands and draw them; ``tick`` is called REPEATS + 2 times."""
    document = assign(document, {"wisp.strands": strands, "look.hair_as": "strands"})
    memory = peak_memory(document)
    costs, stages = [], []
    for _ in range(REPEATS):
        spent, total, hairdo = _styled(document, builder, None)
        stages.append(spent)
        costs.append(total)
        tick()
    preview = median(_styled(document, builder, PREVIEW)[1] for _ in range(REPEATS))
    stage = Stage(builder.head(document.head), strands=hairdo.strands)
    show = _drawn(lambda: renderer.render(stage, document.look, document.camera, SIZE), renderer)
    tick()
    final = _drawn(lambda: renderer.render_final(stage, document.look, document.camera, FINAL_SIZE), renderer)
    tick()
    return HairstyleCost(
        strands=hairdo.strands.count,
        points=document.wisp.points,
        stages={name: median(spent[name] for spent in stages) for name in stages[0]},
        style_ms=median(costs),
        preview_ms=preview,
        show_ms=show,
        final_ms=final,
        memory_bytes=memory[1] if memory else None,
    )


def _styled(document: Document, builder: Builder, strands: int | None) -> tuple[dict[str, float], float, Hairdo]:
    """Milliseconds of each step and of all, and the hairdo, made anew."""
    scalp, surroundings = builder.scalp(document), builder.surroundings(document)
    marks: list[tuple[str, float]] = []
    start = time.perf_counter()
    hairdo = Stylist().style(
        scalp,
        surroundings,
        document.wisp,
        document.colour,
        document.styling,
        strands,
        announce=lambda step: marks.append((step, time.perf_counter())),
    )
    end = time.perf_counter()
    ends = [when for _, when in marks[1:]] + [end]
    spent: dict[str, float] = {}
    for (name, begun), ended in zip(marks, ends, strict=True):
        spent[name] = spent.get(name, 0.0) + 1e3 * (ended - begun)
    return spent, 1e3 * (end - start), hairdo


def _drawn(draw: Callable[[], object], renderer: Renderer) -> float:
    start = time.perf_counter()
    draw()
    renderer.context.finish()
    return 1e3 * (time.perf_counter() - start)
