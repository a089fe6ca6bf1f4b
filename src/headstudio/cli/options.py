"""Options that several commands have: declared once, so that they are called the same everywhere."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Project = Annotated[Path | None, typer.Argument(help="A project, NAME.headstudio; without one, the default head.")]
HeadOption = Annotated[
    str | None, typer.Option("--head", help="makehuman, mannequin, or a mesh: OBJ, PLY, STL, OFF, GLB.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="Set a parameter; headstudio params lists them. May be repeated."),
]
MotionOption = Annotated[
    str | None,
    typer.Option(
        "--motion", help="rest, shake, nod, turn, tilt, split, wind, or a table FILE.csv of a recorded motion."
    ),
]
SizeOption = Annotated[str, typer.Option("--size", help="Pixels: 512 or 640x480.")]
ViewOption = Annotated[str | None, typer.Option("--view", help="front, three-quarter, side, left, right, back or top.")]
SkinOption = Annotated[
    str | None, typer.Option("--skin", metavar="NAME", help="Skin by its age: child, young, grown, aged or weathered.")
]
SeedOption = Annotated[int | None, typer.Option("--seed", help="Start of the random numbers.")]
ParticlesOption = Annotated[int | None, typer.Option("--particles", help="How many particles carry the hair.")]

PresetOption = Annotated[
    str | None, typer.Option("--preset", metavar="NAME", help="A hairstyle that ships; headstudio styles lists them.")
]
ExpressionOption = Annotated[
    list[str] | None,
    typer.Option("--expression", metavar="NAME=0.8", help="smile, angry, squint_left ... May be repeated."),
]
PointsOption = Annotated[
    int | None, typer.Option("--points", min=2, max=1000, help="Points of every strand that is written.")
]
PerStrandOption = Annotated[
    int | None,
    typer.Option("--points-per-strand", min=2, help="How many points make a strand, for files of bare points."),
]
