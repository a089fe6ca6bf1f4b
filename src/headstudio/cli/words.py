"""What all commands share: how one is registered, and how it ends when something is wrong."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import typer

app = typer.Typer(
    name="headstudio",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)

# Options that name what a command writes, whatever it is: "out" may be a folder.
OUTPUTS = {"out", "stats", "json"}

DIFFERENT = 1
CANCELLED = 130
FAILED = 2


def command(name: str | None = None) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Register a command. A foreseen error is one line and status 2; Ctrl-C is a word and status 130."""

    def register(function: Callable[..., None]) -> Callable[..., None]:
        @functools.wraps(function)
        def run(*args: Any, **kwargs: Any) -> None:
            from ..commands.outputs import check_can_be_written
            from ..commands.reporting import as_line, complain, foreseen

            try:
                for name in OUTPUTS & kwargs.keys():
                    if kwargs[name] is not None:
                        check_can_be_written(kwargs[name], as_file=name != "out")
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

        app.command(name)(run)
        return run

    return register
