"""``headstudio demo``: what the program can do, as films, contact sheets and figures in one folder."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from ..io.contact_sheet import contact_sheet
from ..io.film import open_film
from ..params import assign
from ..scene.animation import Animation
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.motion import head_motion
from ..scene.stage import Stage
from .documents import animate, choose_view
from .pictures import Photographer, Pixels, save_picture
from .reporting import counting, say
from .simulate import Run, write_report

FPS = 30.0
_COLUMNS = 3
# The light stands this far to the left of the camera [rad], wherever the camera goes.
_LIGHT_ASIDE = math.radians(35)
_MARGIN = 0.05  # around the bust and its hair at rest [m]


@dataclass(frozen=True)
class Scale:
    """How much is made: particles, pixels a side of a film, and the part of the full length of the films."""

    particles: int
    size: int
    length: float

    @property
    def still(self) -> tuple[int, int]:
        """Width and height of a picture on a sheet of many."""
        return 3 * self.size // 4, 3 * self.size // 4


FULL = Scale(particles=2000, size=512, length=1.0)
QUICK = Scale(particles=600, size=192, length=0.3)


@dataclass(frozen=True)
class Scene:
    """A film of the demo: its name, which is also the motion's, the view, how long it lasts [s], and what else is set.

    moments: those that the sheet shows [s].
    """

    name: str
    view: str
    seconds: float
    moments: tuple[float, ...]
    settings: Mapping[str, float] = field(default_factory=dict)

    def shown(self, count: int) -> list[int]:
        """Numbers of the frames that the sheet shows, when the film has ``count`` of them."""
        return sorted({min(round(moment / self.seconds * count), count - 1) for moment in self.moments})


SCENES = (
    # One swing from right to left and back.
    Scene("shake", "three-quarter", 3.0, (0.0, 1.1, 1.2, 1.3, 1.4, 1.5)),
    Scene("nod", "side", 2.0, (0.0, 0.4, 0.8, 1.2, 1.6, 2.0), {"motion.angle": math.radians(25), "motion.rate": 1.0}),
    Scene("turn", "back", 3.0, (0.0, 0.5, 1.0, 2.0, 2.5, 3.0)),
    # Hands come at 0.3 s and let go at 1.8 s.
    Scene("split", "back", 4.0, (0.0, 0.4, 1.7, 1.87, 2.0, 4.0)),
    Scene("wind", "front", 4.0, (0.0, 0.2, 0.4, 1.0, 2.5, 4.0)),
)


def demo(document: Document, out: Path, quick: bool) -> None:
    """Fill the folder ``out``. Raises what building, drawing and writing raise."""
    scale = QUICK if quick else FULL
    document = assign(document, {"hair.particles": scale.particles})
    photographer = Photographer((scale.size, scale.size))
    builder = Builder()
    document = framed(document, animate(document, builder))
    out.mkdir(parents=True, exist_ok=True)
    at_rest = animate(document, builder).stage()
    save_picture(views(at_rest, document, photographer), out / "views.png")
    save_picture(shadows(at_rest, document, photographer), out / "shadows.png")
    for scene in SCENES:
        run = Run(animate(directed(scene, document), builder))
        save_picture(film(scene, run, photographer, scale, out / scene.name), out / f"{scene.name}.png")
    say(f"the demo's pictures, films and figures are in {out.resolve()}:")
    for path in sorted(out.iterdir()):
        say(f"  {path.name}")


def framed(document: Document, animation: Animation) -> Document:
    """The document with a camera that has all of the head and its hair at rest in view."""
    stage = animation.stage()
    heights: list[NDArray[Any]] = [stage.head.skin.bounds[:, 1]]
    if stage.hair is not None:
        heights.append(stage.hair.positions[:, 1])
    if stage.strands is not None:
        heights.append(stage.strands.points[:, 1])
    low, high = min(each.min() for each in heights) - _MARGIN, max(each.max() for each in heights) + _MARGIN
    distance = 0.5 * (high - low) / math.tan(0.5 * document.camera.field_of_view)
    return assign(document, {"camera.target_y": 0.5 * (low + high), "camera.distance": distance})


def seen_and_lit(document: Document, view: str) -> Document:
    """The document from a view by name, the light beside the camera: nobody looks at the dark side."""
    document = choose_view(document, view)
    azimuth = math.remainder(document.camera.azimuth - _LIGHT_ASIDE, math.tau)
    return assign(document, {"look.light_azimuth": azimuth})


def views(stage: Stage, document: Document, photographer: Photographer) -> Pixels:
    """The head from all sides."""
    names = ("front", "three-quarter", "left", "back")
    looks = [seen_and_lit(document, name) for name in names]
    return contact_sheet([photographer.still(stage, look, photographer.size) for look in looks], names)


def shadows(stage: Stage, document: Document, photographer: Photographer) -> Pixels:
    """The same head with and without shadows."""
    document = choose_view(document, "three-quarter")
    looks = [assign(document, {"look.shadows": on}) for on in (True, False)]
    pictures = [photographer.still(stage, look, photographer.size) for look in looks]
    return contact_sheet(pictures, ("shadows", "no shadows"))


def directed(scene: Scene, document: Document) -> Document:
    """The document as a scene wants it moved and seen."""
    return seen_and_lit(assign(document, {"motion.kind": scene.name, **scene.settings}), scene.view)


def film(scene: Scene, run: Run, photographer: Photographer, scale: Scale, path: Path) -> Pixels:
    """Write the scene as PATH.mp4 and its figures as PATH.json; returns a sheet of its moments."""
    count = max(1, round(scene.seconds * scale.length * FPS))
    chosen = scene.shown(count)
    moments: list[Pixels] = []
    captions: list[str] = []
    with (
        open_film(path.with_suffix(".mp4"), FPS, photographer.size) as reel,
        counting(path.name, count) as progress,
    ):
        for number, stage in enumerate(run.play(head_motion(run.animation.document.motion), count, FPS)):
            reel.add(photographer.picture(stage, run.animation.document))
            run.frames[-1] |= photographer.cost
            if number in chosen:
                moments.append(photographer.still(stage, run.animation.document, scale.still))
                captions.append(f"{path.name}, {(number + 1) / FPS:.2f} s")
            progress.advance(progress.task_ids[0])
    write_report(run.report(photographer.device), path.with_suffix(".json"))
    return contact_sheet(moments, captions, _COLUMNS)
