"""What tells something and makes nothing: comparisons, heads, costs, parameters, versions."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import HeadOption, SetOption
from .words import DIFFERENT, command


@command()
def compare(
    one: Annotated[Path, typer.Argument(metavar="A.png")],
    other: Annotated[Path, typer.Argument(metavar="B.png")],
    difference: Annotated[Path | None, typer.Option(help="Write both and their magnified difference here.")] = None,
) -> None:
    """Tell whether two pictures are the same but for rounding. Status 0 if they are, 1 if not."""
    from ..commands.compare import compare

    if not compare(one, other, difference):
        raise typer.Exit(DIFFERENT)


@command()
def inspect(head: Annotated[str, typer.Argument(metavar="HEAD", help="makehuman, mannequin, or a mesh file.")]) -> None:
    """Say what a head holds: counts, holes, unit and axes, and what was repaired."""
    from ..commands.inspect import inspect

    inspect(head)


@command()
def bench(
    json: Annotated[Path | None, typer.Option("--json", help="Write all figures to this JSON file.")] = None,
    of: Annotated[
        str, typer.Option("--of", help="What is measured: animation, hairstyle, face; with commas between.")
    ] = "animation,hairstyle,face",
    counts: Annotated[str, typer.Option(help="Counts of particles, with commas between.")] = "500,2000,5000",
    strands: Annotated[str, typer.Option(help="Counts of strands, with commas between.")] = "10000,100000,200000",
    texels: Annotated[str, typer.Option(help="Sizes of fine wrinkle fields, with commas between.")] = "512,2048",
    frames: Annotated[int, typer.Option(min=1, max=1000, help="How many frames are measured for each.")] = 30,
    head: HeadOption = None,
    set_: SetOption = None,
) -> None:
    """Measure what each stage of animation, hairstyle and face costs here, beside the papers and a k-d tree."""
    from ..commands.bench import Amounts, bench, parse_subjects
    from ..commands.documents import head_source, open_document, parse_counts

    amounts = Amounts(parse_counts(counts), parse_counts(strands), parse_counts(texels), frames)
    bench(open_document(None, set_ or (), head_source=head_source(head)), parse_subjects(of), amounts, json)


@command()
def params(
    name: Annotated[str, typer.Argument(help="Only parameters with this in their name.")] = "",
    markdown: Annotated[bool, typer.Option("--markdown", help="Print the page of the documentation.")] = False,
) -> None:
    """List every parameter with its default, range, unit and help."""
    from ..commands import parameters

    if markdown:
        typer.echo(parameters.markdown(), nl=False)
    else:
        parameters.print_parameters(name)


@command()
def version() -> None:
    """Print the versions of headstudio and of what it computes and draws with."""
    from ..commands.versions import versions

    for name, number in versions().items():
        typer.echo(f"{name} {number}")
