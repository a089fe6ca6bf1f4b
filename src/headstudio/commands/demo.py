"""``headstudio demo``: what the program can do, as films, contact sheets and figures in one folder."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..io.contact_sheet import contact_sheet
from ..io.film import open_film
from ..params import assign
from ..scene.document import Document
from ..scene.motion import head_motion
from ..scene.simulation import Simulation
from ..scene.views import seen_from
from .documents import build
from .pictures import Photographer, Pixels, save_picture
from .reporting import counting, results
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
    """A film of the demo: its name, which is also the motion's, the view, and how long it lasts [s]."""

    name: str
    view: str
    seconds: float


SCENES = (
    Scene("shake", "three-quarter", 3.0),
    Scene("nod", "side", 2.0),
    Scene("turn", "back", 3.0),
    Scene("split", "back", 4.0),
    Scene("wind", "front", 4.0),
)


def demo(document: Document, out: Path, quick: bool) -> None:
    """Fill the folder ``out``. Raises what building, drawing and writing raise."""
    scale = QUICK if quick else FULL
    document = assign(document, {"hair.particles": scale.particles})
    photographer = Photographer((scale.size, scale.size))
    out.mkdir(parents=True, exist_ok=True)
    save_picture(views(document, photographer), out / "views.png")
    save_picture(shadows(document, photographer), out / "shadows.png")
    for scene in SCENES:
        save_picture(film(scene, document, photographer, scale.length, out), out / f"{scene.name}.png")
    results.out(f"the demo's pictures, films and figures are in {out.resolve()}:")
    for path in sorted(out.iterdir()):
        results.out(f"  {path.name}")


def views(document: Document, photographer: Photographer) -> Pixels:
    """The head from all sides, hair as it has grown."""
    stage = Simulation(build(document), document).stage()
    names = ("front", "three-quarter", "left", "back")
    looks = [replace(document, camera=seen_from(document.camera, name)) for name in names]
    return contact_sheet([photographer.picture(stage, look) for look in looks], names)


def shadows(document: Document, photographer: Photographer) -> Pixels:
    """The same head with and without shadows."""
    stage = Simulation(build(document), document).stage()
    document = replace(document, camera=seen_from(document.camera, "three-quarter"))
    looks = [assign(document, {"look.shadows": shadows}) for shadows in (True, False)]
    return contact_sheet([photographer.picture(stage, look) for look in looks], ("shadows", "no shadows"))


def film(scene: Scene, document: Document, photographer: Photographer, length: float, out: Path) -> Pixels:
    """Film a scene and write its figures; returns a sheet of its moments."""
    document = assign(document, {"motion.kind": scene.name})
    document = replace(document, camera=seen_from(document.camera, scene.view))
    run = Run(document, head_motion(document.motion), build(document), photographer)
    count = round(scene.seconds * length * FPS)
    chosen = set(np.linspace(0, count - 1, PICTURES_ON_A_SHEET).round().astype(int))
    moments: list[Pixels] = []
    captions: list[str] = []
    path = out / f"{scene.name}.mp4"
    with open_film(path, FPS, photographer.size) as reel, counting(scene.name, count) as progress:
        for number, stage in enumerate(run.play(count, FPS)):
            picture = photographer.picture(stage, document)
            reel.add(picture)
            if number in chosen:
                moments.append(picture)
                captions.append(f"{scene.name}, {(number + 1) / FPS:.2f} s")
            progress.advance(progress.task_ids[0])
    write_report(run.report(), out / f"{scene.name}.json")
    return contact_sheet(moments, captions)
