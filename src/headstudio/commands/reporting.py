"""How a command speaks: results on standard output, progress and complaints on standard error."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

results = Console(highlight=False, soft_wrap=True)
asides = Console(stderr=True, highlight=False, soft_wrap=True)


def say(line: str) -> None:
    """Print a line of the result as it is."""
    typer.echo(line)


def warn(message: str) -> None:
    """Say something the user should know while the command goes on."""
    asides.print(f"[yellow]warning:[/] {escape(message)}")


def complain(message: str) -> None:
    """Say in one line why the command ends here."""
    asides.print(f"[red]headstudio:[/] {escape(' '.join(message.split()))}")


@contextmanager
def working(what: str) -> Iterator[None]:
    """Show that something of unknown length is going on; nothing when nobody watches a terminal."""
    if not asides.is_terminal:
        yield
        return
    with asides.status(what):
        yield


@contextmanager
def counting(what: str, total: int) -> Iterator[Progress]:
    """A bar that fills up while ``progress.advance(0)`` is called ``total`` times."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=asides, transient=True, disable=not asides.is_terminal) as progress:
        progress.add_task(what, total=total)
        yield progress


def foreseen(error: BaseException) -> bool:
    """Whether an error is one whose message is a line for the user, rather than a fault of the program."""
    from ..head.head import HeadError
    from ..io.compare import PictureError
    from ..io.film import FilmError
    from ..io.hair import HairFileError
    from ..params import ParameterError
    from ..render.context import RenderError
    from ..scene.project import ProjectError
    from ..scene.take import TakeError
    from ..wisp.adopt import AdoptError
    from ..wrinkle.alignment import ScanError
    from ..wrinkle.projection import TextureMapError

    own = (
        HeadError
        | ParameterError
        | ProjectError
        | TakeError
        | PictureError
        | FilmError
        | HairFileError
        | AdoptError
        | TextureMapError
        | ScanError
        | RenderError
    )
    return isinstance(error, OSError | own)


def as_line(error: BaseException) -> str:
    """The message of a foreseen error. An error of the operating system names its file first."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return str(error)
