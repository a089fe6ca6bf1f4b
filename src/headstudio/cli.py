"""The command line: one function per command, each a thin face over what is in ``headstudio.commands``."""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

app = typer.Typer(
    name="headstudio",
    help="Hair that is shaken live, on a head. Alone it opens the window.",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)

Project = Annotated[Path | None, typer.Argument(help="A project, NAME.headstudio; without one, the default head.")]
HeadOption = Annotated[
    str | None, typer.Option("--head", help="makehuman, mannequin, or a mesh: OBJ, PLY, STL, OFF, GLB.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="Set a parameter; headstudio params lists them. May be repeated."),
]
SeedOption = Annotated[int | None, typer.Option("--seed", help="Start of the random numbers.")]
ParticlesOption = Annotated[int | None, typer.Option("--particles", help="How many particles carry the hair.")]

CANCELLED = 130
FAILED = 2


def command(function: Callable[..., None]) -> Callable[..., None]:
    """Register a command. A foreseen error is one line and status 2; Ctrl-C is a word and status 130."""

    @functools.wraps(function)
    def run(*args: Any, **kwargs: Any) -> None:
        from .commands.reporting import as_line, complain, foreseen

        try:
            function(*args, **kwargs)
        except KeyboardInterrupt:
            complain("cancelled")
            raise typer.Exit(CANCELLED) from None
        except BrokenPipeError:
            raise  # typer ends quietly when the reader of a pipe has seen enough
        except Exception as error:
            if not foreseen(error):
                raise
            complain(as_line(error))
            raise typer.Exit(FAILED) from None

    app.command()(run)
    return run


@command
def inspect(head: Annotated[str, typer.Argument(metavar="HEAD", help="makehuman, mannequin, or a mesh file.")]) -> None:
    """Say what a head holds: counts, holes, unit and axes, and what was repaired."""
    from .commands.inspect import inspect

    inspect(head)


@command
def params(
    name: Annotated[str, typer.Argument(help="Only parameters with this in their name.")] = "",
    markdown: Annotated[bool, typer.Option("--markdown", help="Print the page of the documentation.")] = False,
) -> None:
    """List every parameter with its default, range, unit and help."""
    from .commands import parameters

    if markdown:
        typer.echo(parameters.markdown(), nl=False)
    else:
        parameters.print_parameters(name)


@command
def version() -> None:
    """Print the versions of headstudio and of what it computes and draws with."""
    from .commands.versions import versions

    for name, number in versions().items():
        typer.echo(f"{name} {number}")


def main() -> None:
    """What the word ``headstudio`` runs."""
    try:
        app()
    except KeyboardInterrupt:
        sys.exit(CANCELLED)
