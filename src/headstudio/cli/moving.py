"""Hair that moves: the window, the demo, simulations and pictures of them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from .options import HeadOption, MotionOption, ParticlesOption, Project, SeedOption, SetOption, SizeOption, ViewOption
from .words import FAILED, app, command


@app.callback(invoke_without_command=True)
def alone(context: typer.Context) -> None:
    """Hair that is shaken live, on a head. Without a command, the window opens."""
    if context.invoked_subcommand is None:
        open_window()


@command("open")
def open_window(project: Project = None, head: HeadOption = None, set_: SetOption = None) -> None:
    """Open the window, on a project if one is named."""
    from ..app import WindowError, main
    from ..commands.documents import head_source
    from ..commands.reporting import complain
    from ..params import parse_assignments

    changes: dict[str, Any] = {} if head is None else {"head.source": head_source(head)}
    try:
        main(str(project) if project else None, changes | parse_assignments(set_ or []))
    except WindowError as error:
        complain(str(error))
        raise typer.Exit(FAILED) from None


@command()
def demo(
    out: Annotated[Path, typer.Option(help="The folder to fill.")] = Path("headstudio-demo"),
    quick: Annotated[bool, typer.Option("--quick", help="Small and short: a few seconds of work.")] = False,
    head: HeadOption = None,
    seed: SeedOption = None,
    set_: SetOption = None,
) -> None:
    """Make films, contact sheets and figures of what the program can do."""
    from ..commands.demo import demo
    from ..commands.documents import head_source, open_document

    demo(open_document(None, set_ or (), head_source=head_source(head), hair_seed=seed), out, quick)


@command()
def simulate(
    project: Project = None,
    motion: MotionOption = None,
    seconds: Annotated[float, typer.Option(min=0.01, max=600, help="How long [s].")] = 4.0,
    fps: Annotated[float, typer.Option(min=4, max=240, help="Frames a second.")] = 30.0,
    particles: ParticlesOption = None,
    out: Annotated[Path | None, typer.Option(help="A film (.mp4, .mov, .mkv), or a folder for pictures.")] = None,
    stats: Annotated[Path | None, typer.Option(help="A JSON file for the figures of every frame.")] = None,
    size: SizeOption = "512",
    view: ViewOption = None,
    head: HeadOption = None,
    seed: SeedOption = None,
    set_: SetOption = None,
) -> None:
    """Set hair in motion; write a film, figures, or both."""
    from ..commands.documents import choose_motion, choose_view, head_source, open_document
    from ..commands.pictures import parse_size
    from ..commands.simulate import Shot, simulate

    document = open_document(
        project, set_ or (), head_source=head_source(head), hair_particles=particles, hair_seed=seed
    )
    document, movement = choose_motion(document, motion)
    simulate(choose_view(document, view), movement, Shot(seconds, fps, parse_size(size), out, stats))


@command()
def render(
    project: Annotated[
        Path | None,
        typer.Argument(help="A project, NAME.headstudio, or strands of any format; without one, the default head."),
    ] = None,
    out: Annotated[Path, typer.Option(help="The picture, a PNG.")] = Path("picture.png"),
    size: SizeOption = "512",
    view: Annotated[
        str | None,
        typer.Option(
            help="front, three-quarter, side, left, right, back or top; for strands a JSON file, see the guide."
        ),
    ] = None,
    motion: MotionOption = None,
    seconds: Annotated[float, typer.Option(min=0, max=600, help="How long after the start of the motion [s].")] = 0.0,
    particles: ParticlesOption = None,
    head: Annotated[
        list[str] | None,
        typer.Option("--head", help="makehuman, mannequin, or a mesh; below strands, as many meshes as there are."),
    ] = None,
    seed: SeedOption = None,
    set_: SetOption = None,
) -> None:
    """Draw one picture: of a project, or of strands with a stated camera and light."""
    from ..commands.documents import choose_motion, choose_view, head_source, open_document
    from ..commands.hair_sources import is_hair_file
    from ..commands.pictures import parse_size, render
    from ..commands.render_strands import render_stated

    if project is not None and is_hair_file(str(project)):
        render_stated(project, head or [], view, out)
        return
    document = open_document(
        project,
        set_ or (),
        head_source=head_source(head[-1] if head else None),
        hair_particles=particles,
        hair_seed=seed,
    )
    document, movement = choose_motion(document, motion)
    render(choose_view(document, view), movement, seconds, parse_size(size), out)
    typer.echo(out)
