"""A table of fits to strange scans: distances before and after, and how near anything could come.

    python -m tests.wrinkle.fit_table 1001 1002 1003 [--keep FOLDER] [--head FILE] [--files FILE FILE]

Scans are drawn from their number: heads, places, rims, crossings, close parallels. Those from 1 on were looked at while
the fit was made; those from 201 on were not before the table was made that has them. From 1001 on heads of any age and
sex are drawn, and places from the forehead to the neck; whether a line is followed by another is left to chance. From
3001 on places are foreheads and eye corners, and a third of the heads is drawn from those of ``--files``.

"noise" is how far the scan is from itself without noise, "base" how far the skin is from the scan without its grooves: a
scan rounds the triangles of a coarse head, which no furrow can make good.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from headstudio.commands.compare_scan import fitted, measure
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.settings import HeadSettings
from headstudio.wrinkle.comparison import compare

from .strange_scans import PLACES, Strange, strange_scan

HEADS = (
    HeadSettings(source="mannequin"),
    HeadSettings(source="makehuman", age=0.2),
    HeadSettings(source="makehuman", age=0.8, masculine=1.0),
)
RIMS = (0.0, 0.3, 0.5, 1.0)


# The first places are those of numbers below this.
_WIDER, _FEWER_PLACES = 1001, ("forehead", "cheek", "face", "chin", "temple")
# Numbers from here on are of the places that the thesis compares (figure 2.15).
_AS_THESIS = 3001


def drawn_as_thesis(number: int, files: Sequence[str]) -> tuple[HeadSettings, Strange]:
    """The head and the recipe of a scan of a forehead or an eye corner by its number."""
    rng = np.random.default_rng([number, _AS_THESIS])
    head, recipe = drawn_wider(number)
    place = "eye corner" if rng.random() < 0.5 else "forehead"
    if files and rng.random() < 1 / 3:
        head = HeadSettings(source=files[int(rng.integers(len(files)))])
    return head, replace(recipe, place=place, through=True)


def drawn_wider(number: int, file: str | None = None) -> tuple[HeadSettings, Strange]:
    """The head and the recipe of a scan by its number, of all heads and places there are, or of the head of a file."""
    rng = np.random.default_rng(number)
    made = HeadSettings(source="makehuman", age=float(rng.uniform(0.1, 0.9)), masculine=float(rng.integers(2)))
    head = HeadSettings(source="mannequin") if rng.random() < 0.25 else made
    place = str(rng.choice(list(PLACES)))
    recipe = Strange(
        number,
        place=place,
        radius=rng.uniform(0.03, 0.05),
        lines=int(rng.integers(1, 7)),
        spread=rng.uniform(1.0, 1.8),
        rims=rng.uniform(0.0, 1.0),
        rim_at=rng.uniform(2.0, 3.0),
        rim_width=rng.uniform(0.6, 1.4),
        wander=rng.uniform(0.5e-3, 3.5e-3),
        crossing=bool(rng.random() < 0.3),
        smooth=bool(rng.random() < 0.5),
        added=bool(rng.random() < 0.5),
        varying=rng.uniform(0.0, 0.5),
        spacing=rng.uniform(0.8e-3, 1.6e-3),
    )
    return (HeadSettings(source=file) if file else head), recipe


def drawn(number: int) -> tuple[HeadSettings, Strange]:
    """The head and the recipe of a scan by its number."""
    rng = np.random.default_rng(number)
    rims, head = RIMS[number % 4], HEADS[number % 3]
    kind = ("one above the other", "crossing", "close")[number // 4 % 3]
    place = str(rng.choice(_FEWER_PLACES))
    radius = {"forehead": 0.045, "face": 0.065}.get(place, 0.035) * rng.uniform(0.85, 1.15)
    lines = int(rng.integers(1, 9 if radius < 0.05 else 13))
    spread = 1.5
    if kind == "close":
        # Some 5 to 9 mm apart.
        lines = max(lines, 2)
        spread = rng.uniform(5e-3, 9e-3) * lines / (radius - 0.012)
    recipe = Strange(
        number,
        place=place,
        radius=radius,
        lines=lines,
        spread=spread,
        rims=rims,
        rim_at=rng.uniform(2.0, 3.0),
        rim_width=rng.uniform(0.6, 1.4),
        wander=rng.uniform(0.5e-3, 3.5e-3),
        crossing=kind == "crossing",
        smooth=bool(rng.random() < 0.5),
        added=bool(rng.random() < 0.5),
        varying=rng.uniform(0.0, 0.5),
        spacing=rng.uniform(0.8e-3, 1.6e-3),
    )
    return head, recipe


def row(
    number: int,
    keep: Path | None,
    show: Callable[[str], object],
    file: str | None = None,
    files: Sequence[str] = (),
) -> None:
    """Fit the scan of this number and show its row. file: the head that is taken, files: those that it is drawn from."""
    if number >= _AS_THESIS and file is None:
        head_settings, recipe = drawn_as_thesis(number, files)
    else:
        head_settings, recipe = drawn_wider(number, file) if number >= _WIDER else drawn(number)
    document = replace(Document(), head=head_settings)
    builder = Builder()
    head = builder.head(document.head)
    scan = strange_scan(head, recipe)
    clean = strange_scan(head, replace(recipe, noise=0.0))
    floor = compare(clean, scan).distances().mean
    bare = strange_scan(head, replace(recipe, lines=0))
    base = measure(document, bare, builder).rows["the whole overlap"][0].mean
    start = time.process_time()
    changed, laid, note = fitted(document, scan, builder)
    seconds = time.process_time() - start
    report = measure(changed, scan, builder, laid)
    figures = []
    for where in ("the whole overlap", "around its wrinkles"):
        if where not in report.rows:
            figures.append("nowhere")
            continue
        without, with_ = report.rows[where]
        figures.append(f"{1e3 * without.mean:.3f} {1e3 * with_.mean:.3f} {1 - with_.mean / without.mean:4.0%}")
    best = 1 - floor / report.rows["the whole overlap"][0].mean
    kind = (
        "crossing"
        if recipe.crossing
        else f"{recipe.spread * (recipe.radius - 0.012) / recipe.lines * 1e3:.0f} mm apart"
    )
    show(
        f"{number:4d} {_named(head_settings):18s} {recipe.place:10s} "
        f"{recipe.lines:2d} lines {kind:11s} rims {recipe.rims:.1f} | "
        f"{figures[0]} (noise {1e3 * floor:.3f} {best:.0%}, base {1e3 * base:.3f}) | around {figures[1]} | "
        f"{note.split()[0]} furrows | {seconds:.0f} s\n"
    )
    if keep is not None:
        keep.mkdir(parents=True, exist_ok=True)
        np.savez(keep / f"{number}.npz", scan=scan.vertices, faces=scan.faces, laid=laid)
        from headstudio.wrinkle.furrow import encode_furrows

        (keep / f"{number}.json").write_bytes(encode_furrows(changed.wrinkle.furrows))


def _named(head: HeadSettings) -> str:
    if head.source != "makehuman":
        return Path(head.source).stem
    return f"{'man' if head.masculine > 0.5 else 'woman'} {head.age:.2f}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("numbers", type=int, nargs="+")
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--head", help="the head of this file, for numbers from 1001 on")
    parser.add_argument(
        "--files", nargs="+", default=[], help="heads to draw from beside the built-in ones, from 3001 on"
    )
    chosen = parser.parse_args()
    for each in chosen.numbers:
        row(each, chosen.keep, sys.stdout.write, chosen.head, chosen.files)
        sys.stdout.flush()
