"""The pictures of docs/styles.md: every hairstyle that ships, from before, beside and behind.

python docs/pictures/styles.py [--head HEAD] [--into FOLDER] [SHEET ...]
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from headstudio.commands.demo import seen_and_lit
from headstudio.commands.pictures import Photographer
from headstudio.io.contact_sheet import contact_sheet
from headstudio.params import assign
from headstudio.scene.animation import Animation
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.stage import Stage
from headstudio.scene.styles import load_style, style_names

SIZE = (160, 200)
STRANDS = 20_000
VIEWS = ("three-quarter", "left", "back")
COLOURS = 256
NEAREST, MARGIN = 0.93, 1.12  # the camera's distance [m], unless hair needs more
LOOKED_AT, CHIN = -0.015, -0.05  # heights [m]
MEN = ("mens-short", "beard", "figure-8a")  # shown on a man where the head knows the difference

SHEETS = {
    "long": ("straight-long", "fringe", "bob", "side-part", "wavy-lob", "hairband"),
    "short": ("mens-short", "beard", "swept-back", "spiky", "mohawk", "tight-curls", "afro"),
    "tied": ("ponytail", "half-up", "pigtails", "bun", "three-strand-braid", "crown-braid"),
    "wisps": ("figure-7b", "figure-7c", "figure-7d", "figure-7e", "figure-8a", "figure-8b"),
    "flow": ("figure-9a", "figure-9b", "figure-9c", "figure-11a", "figure-11b"),
    "colour": ("figure-12a", "figure-12b", "figure-12c", "figure-12d"),
    "looks": tuple(f"figure-13{letter}" for letter in "abcdef"),
    "photographs": ("figure-14b", "figure-14d", "figure-15a", "figure-15b", "figure-15c", "figure-15d"),
}


def main(head: str, folder: Path, sheets: list[str]) -> None:
    """Write styles-SHEET.png, a row of views for each style, two styles side by side."""
    missing = set(style_names()) - {name for names in SHEETS.values() for name in names}
    if missing:
        raise SystemExit(f"on no sheet: {', '.join(sorted(missing))}")
    builder, photographer = Builder(), Photographer(SIZE)
    for sheet in sheets or SHEETS:
        rows = [_views(name, head, builder, photographer) for name in SHEETS[sheet]]
        pixels = contact_sheet(rows, list(SHEETS[sheet]), columns=2)
        # Hair is noise to PNG: a palette of its own for every sheet makes a third of the size.
        picture = Image.fromarray(pixels).quantize(COLOURS, Image.Quantize.MEDIANCUT, kmeans=2)
        picture.save(folder / f"styles-{sheet}.png", optimize=True)


def _views(name: str, head: str, builder: Builder, photographer: Photographer) -> np.ndarray:
    shown = {"head.source": head, "head.masculine": float(name in MEN), "look.hair_as": "strands"}
    document = load_style(name).on(assign(Document(), shown))
    stage = Animation(builder, document, STRANDS).stage()
    document = replace(
        document, camera=replace(document.camera, distance=_distance(stage, document), target_y=LOOKED_AT)
    )
    return np.concatenate([photographer.still(stage, seen_and_lit(document, view), SIZE) for view in VIEWS], axis=1)


def _distance(stage: Stage, document: Document) -> float:
    """How far off the camera has all hair above the chin in view, up and to the sides [m]."""
    points = stage.strands.points[stage.strands.points[:, 1] > CHIN]
    slope = np.tan(0.5 * document.camera.field_of_view)
    up = np.percentile(points[:, 1], 99.9) - LOOKED_AT
    aside = np.percentile(np.abs(points[:, [0, 2]]).max(axis=1), 99.9)
    return max(NEAREST, MARGIN * max(up, aside * SIZE[1] / SIZE[0]) / slope)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--head", default="makehuman")
    parser.add_argument("--into", type=Path, default=Path(__file__).parent)
    parser.add_argument("sheets", nargs="*", choices=[[], *SHEETS], metavar="SHEET")
    chosen = parser.parse_args()
    main(chosen.head, chosen.into, chosen.sheets)
