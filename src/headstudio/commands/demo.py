"""``headstudio demo``: what the program can do, as films, contact sheets and figures in one folder."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..io.contact_sheet import contact_sheet
from ..io.film import open_film
from ..params import assign
from ..scene.document import Document
from ..scene.motion import head_motion
from ..scene.simulation import Simulation
from ..scene.stage import Stage
from .documents import build, choose_view
from .pictures import Photographer, Pixels, save_picture
from .reporting import counting, say
from .simulate import Run, write_report

FPS = 30.0
PICTURES_ON_A_SHEET = 8


@dataclass(frozen=True)
class Scale:
    """How much is made: particles, pixels a side, and the part of the full length of the films."""

    particles: int
    size: int
    length: float


FULL = Scale(particles=2000, size=512, length=1.0)
QUICK = Scale(particles=600, size=192, length=0.3)


@dataclass(frozen=True)
class Scene:
    """A film of the demo: its name, which is also the motion's, the view, how long it lasts [s], and what else is set."""

    name: str
    view: str
    seconds: float
    settings: Mapping[str, float] = field(default_factory=dict)


SCENES = (
    Scene("shake", "three-quarter", 3.0),
    Scene("nod", "side", 2.0, {"motion.angle": math.radians(25), "motion.rate": 1.0}),
    Scene("turn", "back", 3.0),
    Scene("split", "back", 4.0),
    Scene("wind", "front", 4.0),
)


def demo(document: Document, out: Path, quick: bool) -> None:
    """Fill the folder ``out``. Raises what building, drawing and writing raise."""
    scale = QUICK if quick else FULL
    document = assign(document, {"hair.particles": scale.particles})
    photographer = Photographer((scale.size, scale.size))
    built = build(document)
    out.mkdir(parents=True, exist_ok=True)
    at_rest = Simulation(built, document).stage()
    save_picture(views(at_rest, document, photographer), out / "views.png")
    save_picture(shadows(at_rest, document, photographer), out / "shadows.png")
    for scene in SCENES:
        run = Run(directed(scene, document), built)
        save_picture(
            film(run, photographer, round(scene.seconds * scale.length * FPS), out / scene.name),
            out / f"{scene.name}.png",
        )
    say(f"the demo's pictures, films and figures are in {out.resolve()}:")
    for path in sorted(out.iterdir()):
        say(f"  {path.name}")


def views(stage: Stage, document: Document, photographer: Photographer) -> Pixels:
    """The head from all sides."""
    names = ("front", "three-quarter", "left", "back")
    looks = [choose_view(document, name) for name in names]
    return contact_sheet([photographer.picture(stage, look) for look in looks], names)


def shadows(stage: Stage, document: Document, photographer: Photographer) -> Pixels:
    """The same head with and without shadows."""
    document = choose_view(document, "three-quarter")
    looks = [assign(document, {"look.shadows": on}) for on in (True, False)]
    return contact_sheet([photographer.picture(stage, look) for look in looks], ("shadows", "no shadows"))


def directed(scene: Scene, document: Document) -> Document:
    """The document as a scene wants it moved and seen."""
    return choose_view(assign(document, {"motion.kind": scene.name, **scene.settings}), scene.view)


def film(run: Run, photographer: Photographer, count: int, path: Path) -> Pixels:
    """Write ``count`` frames as PATH.mp4 and their figures as PATH.json; returns a sheet of moments."""
    chosen = set(np.linspace(0, count - 1, PICTURES_ON_A_SHEET).round().astype(int))
    moments: list[Pixels] = []
    captions: list[str] = []
    with (
        open_film(path.with_suffix(".mp4"), FPS, photographer.size) as reel,
        counting(path.name, count) as progress,
    ):
        for number, stage in enumerate(run.play(head_motion(run.document.motion), count, FPS)):
            picture = photographer.picture(stage, run.document)
            reel.add(picture)
            run.frames[-1] |= photographer.cost
            if number in chosen:
                moments.append(picture)
                captions.append(f"{path.name}, {(number + 1) / FPS:.2f} s")
            progress.advance(progress.task_ids[0])
    write_report(run.report(photographer.device), path.with_suffix(".json"))
    return contact_sheet(moments, captions)
