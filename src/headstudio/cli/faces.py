"""Faces and limbs with their wrinkles, and the maps of these."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import ExpressionOption, HeadOption, Project, SetOption, SizeOption, SkinOption, ViewOption
from .words import command


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
    from ..commands.documents import choose_view, head_source, open_document
    from ..commands.pictures import parse_size
    from ..commands.wrinkle import with_face, wrinkle

    document = open_document(project, set_ or (), skin=skin, head_source=head_source(head))
    document = with_face(document, preset, expression or (), wrinkles)
    if compare is not None or fit:
        from ..commands.compare_scan import compare_scan

        if compare is None:
            raise typer.BadParameter("--fit needs a scan: --compare SCAN")
        compare_scan(document, compare, fit, out)
        return
    if infer:
        from ..commands.infer_furrows import infer_furrows

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
    from ..commands.documents import choose_view, open_document
    from ..commands.limb import limb
    from ..commands.pictures import parse_size
    from ..params import assign
    from ..wrinkle.hand_settings import HandSettings

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
    from ..commands.bake import bake, parse_maps
    from ..commands.documents import head_source, open_document
    from ..commands.wrinkle import with_face

    document = open_document(project, set_ or (), head_source=head_source(head))
    bake(with_face(document, None, expression or (), True), parse_maps(maps), size, out)
