"""``headstudio bench``: what animation, hairstyles and faces cost on this machine, stage by stage, beside the papers."""

from __future__ import annotations

import functools
import os
from dataclasses import asdict, dataclass
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
from ..bench.changes import ChangeCost, change_costs
from ..bench.face import PAPER_CARVING_S, CarvingCost, FaceCost, carving_cost, face_cost
from ..bench.face import PAPER_FPS as PAPER_FACE_FPS
from ..bench.face import WARM_UP as FACE_WARM_UP
from ..bench.hairstyle import PAPER_PICTURE_S, PAPER_PREVIEW_S, REPEATS, HairstyleCost, hairstyle_cost
from ..params import ParameterError
from ..render.context import headless_context
from ..render.renderer import Renderer
from ..scene.builder import Builder
from ..scene.document import Document
from .reporting import counting, results
from .simulate import write_report
from .versions import versions

SUBJECTS = ("animation", "hairstyle", "face")


@dataclass(frozen=True)
class Amounts:
    """How much of each is measured: counts of particles and of strands, edges of fine fields in texels, frames."""

    particles: tuple[int, ...]
    strands: tuple[int, ...]
    texels: tuple[int, ...]
    frames: int


def parse_subjects(words: str) -> tuple[str, ...]:
    """``animation,face`` as names. Raises ParameterError."""
    names = tuple(word.strip() for word in words.split(","))
    if not set(names) <= set(SUBJECTS):
        raise ParameterError(f"what is measured is {', '.join(SUBJECTS)}, with commas between; got {words!r}")
    return names


def bench(document: Document, subjects: tuple[str, ...], amounts: Amounts, out: Path | None) -> None:
    """Measure each of ``subjects``; print a table for each and write JSON to ``out`` unless it is None."""
    renderer, builder = Renderer(headless_context()), Builder()
    frames = amounts.frames
    steps = {
        "animation": len(amounts.particles) * frames_to_draw(frames),
        "hairstyle": len(amounts.strands) * (REPEATS + 2),
        "face": 2 * (FACE_WARM_UP + frames) + len(amounts.texels),
    }
    report: dict[str, Any] = {
        "versions": versions(),
        "renderer": str(renderer.context.info["GL_RENDERER"]),
        "cores": os.cpu_count(),
    }
    with counting("measuring", sum(steps[subject] for subject in subjects)) as progress:
        tick = functools.partial(progress.advance, progress.task_ids[0])
        if "animation" in subjects:
            costs = [animation_cost(document, count, frames, builder, renderer, tick) for count in amounts.particles]
            report |= _animations(costs)
        if "hairstyle" in subjects:
            styles = [hairstyle_cost(document, count, builder, renderer, tick) for count in amounts.strands]
            changes = change_costs(document, builder, renderer)
            report["hairstyles"] = [asdict(cost) for cost in styles]
            report["changes"] = {name: asdict(cost) | {"seen_ms": cost.seen_ms} for name, cost in changes.items()}
        if "face" in subjects:
            face = face_cost(document, frames, builder, renderer, tick)
            carvings = [carving_cost(document, texels, builder) for texels in amounts.texels]
            progress.advance(progress.task_ids[0], len(carvings))
            report |= {"face": asdict(face) | {"fps": face.fps}, "carvings": [asdict(cost) for cost in carvings]}
    if "animation" in subjects:
        results.print(_table(costs), soft_wrap=False)
    if "hairstyle" in subjects:
        results.print(_hairstyle_table(styles), soft_wrap=False)
        results.print(_changes_table(changes), soft_wrap=False)
    if "face" in subjects:
        results.print(_face_table(face, carvings), soft_wrap=False)
    if out is not None:
        write_report(report, out)


def _animations(costs: list[AnimationCost]) -> dict[str, Any]:
    derived = ("fps", "real_time", "simulation_share")
    return {
        "paper": {"particles": 2000, "fps": PAPER_FPS, "simulation_share": PAPER_SIMULATION_SHARE},
        "animations": [
            asdict(cost)
            | {name: getattr(cost, name) for name in derived}
            | {"neighbours": asdict(cost.neighbours) | {"part_of_kdtree": cost.neighbours.part_of_kdtree}}
            for cost in costs
        ],
    }


def _hairstyle_table(costs: list[HairstyleCost]) -> Table:
    """A column for each count of strands, milliseconds."""
    table = Table("one hairstyle, ms", *(f"{cost.strands:,} strands" for cost in costs), "paper: 80,000-100,000")
    for column in table.columns[1:]:
        column.justify = "right"
    table.add_row("points a strand", *(f"{cost.points}" for cost in costs), "")
    for stage in costs[0].stages:
        table.add_row(stage, *(f"{cost.stages[stage]:.0f}" for cost in costs), "")
    table.add_section()
    table.add_row("settings to strands", *(f"{cost.style_ms:.0f}" for cost in costs), "")
    table.add_row("the first 20,000", *(f"{cost.preview_ms:.0f}" for cost in costs), f"{1e3 * PAPER_PREVIEW_S:.0f}")
    table.add_row("first picture, 512 x 512", *(f"{cost.show_ms:.0f}" for cost in costs), "")
    table.add_row("final, 1024 x 1024", *(f"{cost.final_ms:.0f}" for cost in costs), f"{1e3 * PAPER_PICTURE_S:.0f}")
    table.add_section()
    known = [cost.memory_bytes for cost in costs]
    table.add_row("memory of head and strands, MB", *("?" if n is None else f"{n / 1e6:.0f}" for n in known), "")
    return table


def _changes_table(changes: dict[str, ChangeCost]) -> Table:
    """A row for each kind of change, milliseconds."""
    table = Table("from a change to its picture, ms", "build", "draw", "seen", "whole")
    for column in table.columns[1:]:
        column.justify = "right"
    for name, cost in changes.items():
        table.add_row(name, *(f"{ms:.0f}" for ms in (cost.build_ms, cost.draw_ms, cost.seen_ms, cost.whole_ms)))
    return table


def _face_table(face: FaceCost, carvings: list[CarvingCost]) -> Table:
    """The frame of an animated face, and the carving of its fine wrinkles, milliseconds."""
    table = Table("one frame of a face, ms", "here", "thesis")
    for column in table.columns[1:]:
        column.justify = "right"
    table.add_row("triangles, and with furrows", f"{face.triangles:,} / {face.refined:,}", "")
    table.add_row("muscles, jaw, lids, tissue", f"{face.muscles_ms:.1f}", "")
    table.add_row("shrinkage, furrows, normals", f"{face.furrows_ms:.1f}", "")
    table.add_row("amplitudes of fine wrinkles", f"{face.fine_ms:.1f}", "")
    table.add_row("all of the skin", f"{face.skin_ms:.1f}", "")
    table.add_row("picture, 512 x 512", f"{face.picture_ms:.1f}", "")
    table.add_row("frames a second", f"{face.fps:.1f}", f"{PAPER_FACE_FPS}")
    table.add_row(f"muscles to normals at {face.light_refined:,} triangles", f"{face.light_ms:.1f}", "")
    table.add_section()
    for cost in carvings:
        paper = f"{1e3 * PAPER_CARVING_S:.0f}" if cost.texels == 512 else ""
        table.add_row(f"two fine fields of {cost.texels} x {cost.texels}", f"{cost.carving_ms:.0f}", paper)
    return table


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
    row("list, an integration, ms", [f"{cost.neighbours.step_ms:.2f}" for cost in costs])
    row("list over cKDTree", [f"{cost.neighbours.part_of_kdtree:.2f}" for cost in costs])
    row("searches in integrations", [f"{cost.neighbours.searches} in {cost.neighbours.steps}" for cost in costs])
    return table
