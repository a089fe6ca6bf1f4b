"""The command line: one function per command, each a thin face over what is in ``headstudio.commands``."""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from .memory import keep_freed_memory

app = typer.Typer(
    name="headstudio",
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
            from .commands.outputs import check_can_be_written
            from .commands.reporting import as_line, complain, foreseen

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


@app.callback(invoke_without_command=True)
def alone(context: typer.Context) -> None:
    """Hair that is shaken live, on a head. Without a command, the window opens."""
    if context.invoked_subcommand is None:
        open_window()


@command("open")
def open_window(project: Project = None, head: HeadOption = None, set_: SetOption = None) -> None:
    """Open the window, on a project if one is named."""
    from .app import WindowError, main
    from .commands.documents import head_source
    from .commands.reporting import complain
    from .params import parse_assignments

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
    from .commands.demo import demo
    from .commands.documents import head_source, open_document

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
    from .commands.documents import choose_motion, choose_view, head_source, open_document
    from .commands.pictures import parse_size
    from .commands.simulate import Shot, simulate

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
    from .commands.documents import choose_motion, choose_view, head_source, open_document
    from .commands.hair_sources import is_hair_file
    from .commands.pictures import parse_size, render
    from .commands.render_strands import render_stated

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
    from .commands.documents import choose_view, head_source, open_document
    from .commands.hair_sources import with_prototype
    from .commands.operations import with_operations
    from .commands.pictures import parse_size
    from .commands.style import style

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
    from .commands.style import styles

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
    from .commands.documents import head_source
    from .commands.export_hair import export_hair
    from .commands.hair_sources import hair_document, is_hair_file
    from .params import assign, parse_assignments

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
    from .commands.documents import head_source, open_document
    from .commands.import_hair import import_hair

    import_hair(hair, open_document(None, (), head_source=head_source(head)), points_per_strand, out)


@command()
def wrinkle(
    project: Project = None,
    preset: Annotated[
        str | None,
        typer.Option(
            "--preset", help="thinking, smiling, troubled, angry, surprised, squinting, looking-down, neutral."
        ),
    ] = None,
    expression: ExpressionOption = None,
    wrinkles: Annotated[bool, typer.Option("--wrinkles/--no-wrinkles", help="With its wrinkles, or smooth.")] = True,
    compare: Annotated[
        Path | None, typer.Option(metavar="SCAN", help="Tell how far the face is from a scan of the same head.")
    ] = None,
    fit: Annotated[bool, typer.Option("--fit", help="With --compare: move and size furrows to the scan.")] = False,
    infer: Annotated[bool, typer.Option("--infer", help="Propose furrows from how the skin shrinks.")] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            help="A picture (.png, face.png if not said) or the posed mesh (.obj, .ply, .glb);"
            " with --fit a project (.headstudio) or furrows (.json); with --infer any of these, or a picture."
        ),
    ] = None,
    size: SizeOption = "512",
    view: ViewOption = None,
    skin: SkinOption = None,
    head: HeadOption = None,
    set_: SetOption = None,
) -> None:
    """Show a face with an expression and the wrinkles it makes."""
    from .commands.documents import choose_view, head_source, open_document
    from .commands.pictures import parse_size
    from .commands.wrinkle import with_face, wrinkle

    document = open_document(project, set_ or (), skin=skin, head_source=head_source(head))
    document = with_face(document, preset, expression or (), wrinkles)
    if compare is not None or fit:
        from .commands.compare_scan import compare_scan

        if compare is None:
            raise typer.BadParameter("--fit needs a scan: --compare SCAN")
        compare_scan(document, compare, fit, out)
        return
    if infer:
        from .commands.infer_furrows import infer_furrows

        infer_furrows(choose_view(document, view), out or Path("proposals.png"), parse_size(size))
        return
    wrinkle(choose_view(document, view), out or Path("face.png"), parse_size(size), framed=project is None)


@command()
def limb(
    which: Annotated[str, typer.Argument(metavar="LIMB", help="hand, arm, foot, or what FILE.glb holds.")] = "hand",
    pose: Annotated[str, typer.Option(help="rest, relaxed, open, fist, point or pinch.")] = "relaxed",
    age: Annotated[
        float, typer.Option(min=0, max=1, help="0 young, 1 old: shape, and depth of the joints' lines.")
    ] = 0.5,
    wrinkles: Annotated[bool, typer.Option("--wrinkles/--no-wrinkles", help="With its wrinkles, or smooth.")] = True,
    near: Annotated[str | None, typer.Option(metavar="JOINT", help="From close by, such as 'middle proximal'.")] = None,
    out: Annotated[Path, typer.Option(help="The picture, a PNG.")] = Path("limb.png"),
    size: SizeOption = "512",
    view: ViewOption = None,
    skin: SkinOption = None,
    set_: SetOption = None,
) -> None:
    """Show a hand, an arm or a foot with its wrinkles."""
    from .commands.documents import choose_view, open_document
    from .commands.limb import limb
    from .commands.pictures import parse_size
    from .params import assign
    from .wrinkle.hand_settings import HandSettings

    document = choose_view(open_document(None, set_ or (), skin=skin, head_age=age), view)
    limb(document, which, assign(HandSettings(), {"pose": pose}), wrinkles, parse_size(size), out, near)


@command()
def bake(
    project: Project = None,
    maps: Annotated[str, typer.Option(help="height, normal, ao, weights: with commas between.")] = "height,normal,ao",
    size: Annotated[int, typer.Option(min=128, max=4096, help="Width and height of the maps.")] = 2048,
    out: Annotated[Path, typer.Option(help="The folder to fill.")] = Path("maps"),
    expression: ExpressionOption = None,
    head: HeadOption = None,
    set_: SetOption = None,
) -> None:
    """Write the wrinkles of a face as maps: heights in 16 bits, normals, occlusion, and what each expression adds."""
    from .commands.bake import bake, parse_maps
    from .commands.documents import head_source, open_document
    from .commands.wrinkle import with_face

    document = open_document(project, set_ or (), head_source=head_source(head))
    bake(with_face(document, None, expression or (), True), parse_maps(maps), size, out)


@command()
def compare(
    one: Annotated[Path, typer.Argument(metavar="A.png")],
    other: Annotated[Path, typer.Argument(metavar="B.png")],
    difference: Annotated[Path | None, typer.Option(help="Write both and their magnified difference here.")] = None,
) -> None:
    """Tell whether two pictures are the same but for rounding. Status 0 if they are, 1 if not."""
    from .commands.compare import compare

    if not compare(one, other, difference):
        raise typer.Exit(DIFFERENT)


@command()
def inspect(head: Annotated[str, typer.Argument(metavar="HEAD", help="makehuman, mannequin, or a mesh file.")]) -> None:
    """Say what a head holds: counts, holes, unit and axes, and what was repaired."""
    from .commands.inspect import inspect

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
    from .commands.bench import Amounts, bench, parse_subjects
    from .commands.documents import head_source, open_document, parse_counts

    amounts = Amounts(parse_counts(counts), parse_counts(strands), parse_counts(texels), frames)
    bench(open_document(None, set_ or (), head_source=head_source(head)), parse_subjects(of), amounts, json)


@command()
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


@command()
def version() -> None:
    """Print the versions of headstudio and of what it computes and draws with."""
    from .commands.versions import versions

    for name, number in versions().items():
        typer.echo(f"{name} {number}")


def main() -> None:
    """What the word ``headstudio`` runs."""
    keep_freed_memory()
    try:
        app()
    except KeyboardInterrupt:
        sys.exit(CANCELLED)
