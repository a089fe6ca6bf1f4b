"""``headstudio simulate``: a document in motion, as a film, as numbers, or both."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..io.film import FILM_SUFFIXES, Film, open_film
from ..params import ParameterError
from ..scene.animation import Animation
from ..scene.document import Document
from ..scene.files import write_atomically
from ..scene.motion import Motion
from ..scene.stage import Stage
from .documents import animate
from .pictures import Photographer, Size
from .reporting import counting, say, warn
from .versions import versions

Figures = dict[str, float | None]


@dataclass(frozen=True)
class Shot:
    """What to film: how long [s], how many frames a second, how large, and where film and figures go (None: nowhere)."""

    seconds: float
    fps: float
    size: Size
    film: Path | None
    stats: Path | None

    @property
    def frames(self) -> int:
        """How many frames that makes, one at least."""
        return max(1, round(self.seconds * self.fps))


@dataclass
class Run:
    """A document in motion, frame by frame, with the figures of every frame."""

    animation: Animation
    frames: list[Figures] = field(default_factory=list)

    def play(self, motion: Motion, count: int, fps: float) -> Iterator[Stage]:
        """Go on by ``count`` frames of 1/fps [s]; yields each when its figures are taken. Tells what was repaired."""
        for _ in range(count):
            start = time.perf_counter()
            self.animation.advance(motion, 1 / fps)
            elapsed = time.perf_counter() - start
            for note in self.animation.take_notes():
                warn(note)
            self.frames.append(self._figures(elapsed))
            yield self.animation.stage()

    def _figures(self, elapsed: float) -> Figures:
        measured = self.animation.measure()
        stages = {f"ms_{stage}": spent for stage, spent in self.animation.timings.items()}
        figures = {"time": self.animation.time, **measured, **stages, "ms_simulation": 1000 * elapsed}
        # JSON knows no infinity: a figure that has no value (the distance of pairs, where there are none) is null.
        return {name: float(value) if math.isfinite(value) else None for name, value in figures.items()}

    def report(self, renderer: str | None) -> dict[str, Any]:
        """The content of the stats file, SI throughout. ``renderer``: what drew the frames, if anything did."""
        document, simulation, hairdo = self.animation.document, self.animation.simulation, self.animation.hairdo
        hair: dict[str, Any] = {}
        if simulation is not None:
            model = simulation.built.hair
            hair = {"particles": model.count, "links": len(model.links), "solver": simulation.solver_name}
        elif hairdo is not None:
            hair = {"strands": hairdo.strands.count, "wisps": len(hairdo.outlines.roots)}
        seed = document.hair.seed if simulation else document.wisp.seed
        return {"versions": versions(), "renderer": renderer, "seed": seed, **hair, "frames": self.frames}


def simulate(document: Document, motion: Motion, shot: Shot) -> None:
    """Film a document in motion and write its figures. Raises what building, drawing and writing raise."""
    if shot.film is not None:
        check_is_film(shot.film)
    photographer = Photographer(shot.size) if shot.film else None
    run = Run(animate(document))
    with ExitStack() as stack:
        film: Film | None = stack.enter_context(open_film(shot.film, shot.fps, shot.size)) if shot.film else None
        progress = stack.enter_context(counting("simulating", shot.frames))
        for stage in run.play(motion, shot.frames, shot.fps):
            if film is not None and photographer is not None:
                film.add(photographer.picture(stage, document))
                run.frames[-1] |= photographer.cost
            progress.advance(progress.task_ids[0])
    if shot.stats is not None:
        write_report(run.report(photographer.device if photographer else None), shot.stats)
    for line in summary(run, shot):
        say(line)


def check_is_film(path: Path) -> None:
    """Raise ParameterError for a name that looks like a film and would become a folder."""
    suffix = path.suffix.lower()
    if suffix and suffix not in FILM_SUFFIXES and not path.is_dir():
        raise ParameterError(
            f"a film ends in {', '.join(FILM_SUFFIXES)}, a folder of pictures in nothing; got {path.name!r}"
        )


def write_report(report: dict[str, Any], path: Path) -> None:
    """Write a report as JSON. Raises OSError."""
    write_atomically(path, json.dumps(report, indent=1, allow_nan=False).encode() + b"\n")


def summary(run: Run, shot: Shot) -> list[str]:
    """What happened, in lines for a person."""
    simulated = run.frames[-1]["time"] or 0.0
    cost = sum(frame["ms_simulation"] or 0.0 for frame in run.frames) / 1000
    frames = f"{len(run.frames)} frames, {simulated:.2f} s in {cost:.2f} s ({simulated / cost:.2f} times real time)"
    if run.animation.simulation is not None:
        hair = run.animation.simulation.built.hair
        lines = [
            f"{hair.count} particles, {len(hair.links)} links, {frames}",
            f"largest reach {_largest(run, 'reach_max'):.3f}, "
            f"largest rms stretch {100 * _largest(run, 'stretch_rms'):.2f} %, "
            f"deepest penetration {1000 * _largest(run, 'penetration_max'):.1f} mm",
        ]
    else:
        lines = [frames]
    if shot.film is not None:
        lines.append(f"film: {shot.film}")
    if shot.stats is not None:
        lines.append(f"figures: {shot.stats}")
    return lines


def _largest(run: Run, name: str) -> float:
    return max((frame.get(name) or 0.0 for frame in run.frames), default=0.0)
