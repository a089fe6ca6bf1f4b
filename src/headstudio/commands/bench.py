"""``headstudio bench``: what the animation costs on this machine, stage by stage, beside the paper and a k-d tree."""

from __future__ import annotations

import functools
import os
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.table import Table

from ..bench.animation import (
    PAPER_FPS,
    PAPER_SIMULATION_SHARE,
    AnimationCost,
    animation_cost,
    frames_to_draw,
)
from ..render.context import headless_context
from ..render.renderer import Renderer
from ..scene.builder import Builder
from ..scene.document import Document
from .reporting import counting, results
from .simulate import check_can_be_written, write_report
from .versions import versions


def bench(document: Document, counts: tuple[int, ...], frames: int, out: Path | None) -> None:
    """Measure the animation for each count of particles; print a table and write JSON to ``out`` unless it is None."""
    if out is not None:
        check_can_be_written(out)
    renderer, builder = Renderer(headless_context()), Builder()
    with counting("measuring", len(counts) * frames_to_draw(frames)) as progress:
        tick = functools.partial(progress.advance, progress.task_ids[0])
        costs = [animation_cost(document, count, frames, builder, renderer, tick) for count in counts]
    results.print(_table(costs), soft_wrap=False)
    if out is not None:
        write_report(_report(costs, str(renderer.context.info["GL_RENDERER"])), out)


def _report(costs: list[AnimationCost], renderer: str) -> dict[str, Any]:
    derived = ("fps", "real_time", "simulation_share")
    return {
        "versions": versions(),
        "renderer": renderer,
        "cores": os.cpu_count(),
        "paper": {"particles": 2000, "fps": PAPER_FPS, "simulation_share": PAPER_SIMULATION_SHARE},
        "animations": [
            asdict(cost)
            | {name: getattr(cost, name) for name in derived}
            | {"neighbours": asdict(cost.neighbours) | {"part_of_kdtree": cost.neighbours.part_of_kdtree}}
            for cost in costs
        ],
    }


def _table(costs: list[AnimationCost]) -> Table:
    """A column for each count of particles; milliseconds are for a frame of 1/30 s unless a row says otherwise."""
    table = Table("one frame of 1/30 s", *(f"{cost.particles:,}" for cost in costs), "paper: 2,000")
    for column in table.columns[1:]:
        column.justify = "right"

    def row(name: str, values: list[str], paper: str = "") -> None:
        table.add_row(name, *values, paper)

    row("links", [f"{cost.links:,}" for cost in costs])
    row("pairs within 2 h", [f"{cost.neighbours.pairs:,}" for cost in costs])
    table.add_section()
    for stage in dict.fromkeys(stage for cost in costs for stage in cost.stages):
        row(f"{stage}, ms", [f"{cost.stages.get(stage, 0.0):.2f}" for cost in costs])
    table.add_section()
    row("simulation, ms", [f"{cost.simulation_ms:.1f}" for cost in costs], "49")
    row("picture, ms", [f"{cost.picture_ms:.1f}" for cost in costs], "100")
    row("frames a second", [f"{cost.fps:.1f}" for cost in costs], f"{PAPER_FPS}")
    shares = [f"{100 * cost.simulation_share:.0f} %" for cost in costs]
    row("part of the simulation", shares, f"{100 * PAPER_SIMULATION_SHARE:.0f} %")
    row("simulated s a second", [f"{cost.real_time:.2f}" for cost in costs])
    table.add_section()
    row("cKDTree.query_pairs, once, ms", [f"{cost.neighbours.kdtree_ms:.2f}" for cost in costs])
    row("grid, one search, ms", [f"{cost.neighbours.search_ms:.2f}" for cost in costs])
    row("list, an internal step, ms", [f"{cost.neighbours.step_ms:.2f}" for cost in costs])
    row("list over cKDTree", [f"{cost.neighbours.part_of_kdtree:.2f}" for cost in costs])
    row("searches in steps", [f"{cost.neighbours.searches} in {cost.neighbours.steps}" for cost in costs])
    return table
