"""Hairstyles: made, listed, written for other programs and read from them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import (
    HeadOption,
    PerStrandOption,
    PointsOption,
    PresetOption,
    Project,
    SeedOption,
    SetOption,
    SizeOption,
    ViewOption,
)
from .words import command


@command()
def style(
    project: Project = None,
    preset: PresetOption = None,
    strands: Annotated[int | None, typer.Option("--strands", help="How many strands (N_s).")] = None,
    wisps: Annotated[int | None, typer.Option("--wisps", help="How many wisps (N_w).")] = None,
    out: Annotated[
        Path, typer.Option(help="A picture (.png), a project (.headstudio), or strands: .npy, .usda, .hair ...")
    ] = Path("style.png"),
    size: SizeOption = "512",
    view: ViewOption = None,
    points: PointsOption = None,
    operation: Annotated[
        list[str] | None,
        typer.Option(
            "--operation",
            metavar='"KIND WHERE"',
            help='tie, braid, bun, updo or cut, and for which hair: "braid back and u > 0.5". May be repeated.',
        ),
    ] = None,
    operations: Annotated[
        Path | None, typer.Option("--operations", help="A JSON file of operations and cuts, as in a project.")
    ] = None,
    prototype: Annotated[
        Path | None,
        typer.Option("--prototype", help="A hair file, whose strand of middle length all strands resemble."),
    ] = None,
    head: HeadOption = None,
    seed: SeedOption = None,
    set_: SetOption = None,
) -> None:
    """Style hair from wisps: a picture, a project or the strands themselves."""
    from ..commands.documents import choose_view, head_source, open_document
    from ..commands.hair_sources import with_prototype
    from ..commands.operations import with_operations
    from ..commands.pictures import parse_size
    from ..commands.style import style

    document = open_document(
        project,
        set_ or (),
        preset,
        head_source=head_source(head),
        wisp_strands=strands,
        wisp_wisps=wisps,
        wisp_seed=seed,
    )
    document = with_operations(document, operation or (), operations)
    if prototype is not None:
        document = with_prototype(document, prototype)
    style(choose_view(document, view), out, parse_size(size), points)


@command()
def styles() -> None:
    """List the hairstyles that ship, one a line, its name first."""
    from ..commands.style import styles

    styles()


@command()
def export(
    source: Annotated[str, typer.Argument(metavar="SOURCE", help="A project, a style by its name, or any hair file.")],
    out: Annotated[
        Path, typer.Argument(metavar="OUT", help="The ending chooses: .hair .data .npy .obj .ply .usda ...")
    ],
    points: PointsOption = None,
    points_per_strand: PerStrandOption = None,
    strands: Annotated[int | None, typer.Option("--strands", help="How many strands of a style (N_s).")] = None,
    head: HeadOption = None,
    set_: SetOption = None,
) -> None:
    """Write strands in another program's format."""
    from ..commands.documents import head_source
    from ..commands.export_hair import export_hair
    from ..commands.hair_sources import hair_document, is_hair_file
    from ..params import assign, parse_assignments

    if is_hair_file(source):
        export_hair(Path(source), out, points, points_per_strand)
        return
    chosen = {"head.source": head_source(head), "wisp.strands": strands}
    given = {path: value for path, value in chosen.items() if value is not None}
    document = assign(hair_document(source), given | parse_assignments(set_ or []))
    export_hair(document, out, points, points_per_strand)


@command("import")
def import_(
    hair: Annotated[Path, typer.Argument(metavar="HAIR", help=".hair .data .npy .obj .ply .usd .rib .tfx")],
    out: Annotated[
        Path | None,
        typer.Option(help="Where to write the strands as they lie on the head, or a project with them."),
    ] = None,
    points_per_strand: PerStrandOption = None,
    head: HeadOption = None,
) -> None:
    """Look at the strands of another program, and place them on a head."""
    from ..commands.documents import head_source, open_document
    from ..commands.import_hair import import_hair

    import_hair(hair, open_document(None, (), head_source=head_source(head)), points_per_strand, out)
