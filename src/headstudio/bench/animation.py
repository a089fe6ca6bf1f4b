"""The whole animation, frame by frame: simulation and picture with shadows, as the paper measured it.

Bando et al. 2006, section 5: 2,000 particles, 512 x 512 pixels for the image and for the shadow buffer, simulated and
drawn at 6.7 frames a second on a Pentium 4 of 2.8 GHz with a Quadro4 900 XGL; the simulation took 33 % of the time.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from statistics import median

from ..params import assign
from ..render.renderer import Renderer
from ..scene.ahead import SimulationAhead
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.motion import Motion, head_motion
from ..scene.simulation import Simulation
from ..scene.views import seen_from
from .neighbours import NeighbourCost, Search, neighbour_cost, search_both

DISPLAY_RATE = 30.0
SIZE = (512, 512)
WARM_UP = 15
TIMED_PICTURES = 5
PAPER_FPS = 6.7
PAPER_SIMULATION_SHARE = 0.33


@dataclass(frozen=True)
class AnimationCost:
    """One head of hair while the head shakes. Milliseconds are medians over the frames.

    particles, links: how many. frames: how many were measured. simulation_ms, picture_ms: of a frame of 1/30 s, each for
    itself; between two of its frames the simulation sees no picture, as in the window, where it has a process of its own.
    frame_ms: of both as the window does them. stages: by name, as the simulation and the renderer time themselves; the
    renderer's in frames of their own, since timing them holds it up.
    """

    particles: int
    links: int
    frames: int
    simulation_ms: float
    picture_ms: float
    frame_ms: float
    stages: dict[str, float]
    neighbours: NeighbourCost

    @property
    def fps(self) -> float:
        """Frames a second of the whole animation."""
        return 1e3 / self.frame_ms

    @property
    def real_time(self) -> float:
        """Simulated seconds for a second of computing."""
        return 1e3 / DISPLAY_RATE / self.simulation_ms

    @property
    def simulation_share(self) -> float:
        """The part of the work that is the simulation's."""
        return self.simulation_ms / (self.simulation_ms + self.picture_ms)


def animation_cost(
    document: Document,
    particles: int,
    frames: int,
    builder: Builder,
    renderer: Renderer,
    tick: Callable[[], None] = lambda: None,
) -> AnimationCost:
    """Shake a head with ``particles`` particles for ``frames`` frames; ``tick`` is called after each."""
    document = assign(document, {"hair.particles": particles, "motion.kind": "shake", "look.shadow_size": SIZE[0]})
    document = replace(document, camera=seen_from(document.camera, "three-quarter"))
    built = builder.build(document)
    simulation = Simulation(built, document)
    motion = head_motion(document.motion)

    def draw(simulation: Simulation) -> None:
        renderer.render(simulation.stage(), document.look, document.camera, SIZE)
        renderer.context.finish()
        tick()

    def simulate() -> tuple[float, Search]:
        start = time.perf_counter()
        simulation.advance(motion, 1 / DISPLAY_RATE)
        simulated = time.perf_counter()
        return 1e3 * (simulated - start), search_both(simulation.state.positions, simulation.dynamics.neighbours.radius)

    def picture() -> float:
        simulation.advance(motion, 1 / DISPLAY_RATE)
        start = time.perf_counter()
        draw(simulation)
        return 1e3 * (time.perf_counter() - start)

    for _ in range(WARM_UP):
        simulate()
    neighbours = simulation.dynamics.neighbours
    searches, questions = neighbours.searches, neighbours.questions
    costs, stages = [], []
    for _ in range(frames):
        costs.append(simulate())
        stages.append(dict(simulation.timings))
    # The paper searches once for every integration; here an internal step is integrated in parts.
    integrations = (neighbours.questions - questions) * simulation.parts
    searches = neighbours.searches - searches
    listed = sum(stage.get("neighbours", 0.0) for stage in stages)
    pictures = [picture() for _ in range(WARM_UP + frames)][WARM_UP:]
    return AnimationCost(
        particles=simulation.built.hair.count,
        links=len(simulation.built.hair.links),
        frames=frames,
        simulation_ms=median(simulated for simulated, _ in costs),
        picture_ms=median(pictures),
        frame_ms=_frame_ms(SimulationAhead(built, document), motion, draw, frames),
        stages=_medians(stages) | _picture_stages(picture, renderer),
        neighbours=neighbour_cost(
            [search for _, search in costs], listed / max(integrations, 1), searches, integrations
        ),
    )


def frames_to_draw(frames: int) -> int:
    """How often ``animation_cost`` ticks when it measures ``frames`` frames."""
    return 2 * (WARM_UP + frames) + TIMED_PICTURES


def _frame_ms(simulation: SimulationAhead, motion: Motion, draw: Callable[[Simulation], None], frames: int) -> float:
    """What a frame takes while the next one is worked out elsewhere [ms]."""
    if not simulation.wait_for_process():
        raise RuntimeError("the process of the simulation did not start")
    taken = []
    for _ in range(WARM_UP + frames):
        start = time.perf_counter()
        simulation.advance(motion, 1 / DISPLAY_RATE)
        draw(simulation)
        taken.append(1e3 * (time.perf_counter() - start))
    return median(taken[WARM_UP:])


def _picture_stages(picture: Callable[[], object], renderer: Renderer) -> dict[str, float]:
    renderer.timer.on = True
    stages = []
    for _ in range(TIMED_PICTURES):
        picture()
        stages.append({name.removeprefix("ms_"): spent for name, spent in renderer.timer.stages.items()})
    renderer.timer.on = False
    return {f"picture: {name}": spent for name, spent in _medians(stages).items()}


def _medians(rows: list[dict[str, float]]) -> dict[str, float]:
    names = list(dict.fromkeys(name for row in rows for name in row))
    return {name: median(row.get(name, 0.0) for row in rows) for name in names}
