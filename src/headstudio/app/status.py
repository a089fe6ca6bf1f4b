"""The line at the foot of the window: what is being built, and what there is."""

from __future__ import annotations

from imgui_bundle import imgui

from . import theme
from .studio import Studio
from .ui import Rect, Ui

NOTES = {
    "": "Waiting for the last build to end",
    "head": "Reading the head",
    "scalp": "Mapping the scalp",
    "body": "Measuring the body for contact",
    "hair": "Growing the hair",
    "surroundings": "Measuring the space around the head",
    "hairdo": "Styling the hair",
    "placement": "Placing the strands on the head",
    "groom": "Laying the strands on the head",
    "wisps": "Spreading the wisps",
    "flow": "Letting the hair flow",
    "strands": "Growing the strands",
    "colour": "Colouring the hair",
    "face": "Placing the muscles of the face",
    "furrows": "Refining the skin around its furrows",
    "creases": "Balancing furrows and bulges",
    "fine wrinkles": "Carving fine wrinkles",
    "amplitude": "Carving fine wrinkles",
    "surface": "Joining the skin",
    "skin": "Joining the skin",
}


def draw(ui: Ui, studio: Studio, rect: Rect) -> None:
    """Draw the line in the current ImGui window, which lies at ``rect``."""
    imgui.set_cursor_screen_pos((rect.x + ui.px(12), rect.y + (rect.height - imgui.get_text_line_height()) / 2))
    ui.muted(_what_there_is(studio))
    rate = imgui.get_io().framerate
    text = f"{rate:.0f} frames/s"
    imgui.same_line(rect.width - imgui.calc_text_size(text).x - ui.px(12))
    ui.muted(text)


def progress(ui: Ui, studio: Studio, view: Rect) -> None:
    """A note over the viewport while hair is being built, with a way out."""
    if not studio.building or studio.work.in_gesture or studio.builds.seconds < 0.25:
        return
    note = f"{NOTES.get(studio.builds.part, studio.builds.part)}   {studio.builds.seconds:.1f} s"
    width, height = ui.px(400), ui.px(44)
    x, y = view.x + (view.width - width) / 2, view.y + ui.px(50)
    canvas = imgui.get_window_draw_list()
    canvas.add_rect_filled((x, y), (x + width, y + height), theme.packed(theme.PANEL, 0.95), ui.px(6))
    canvas.add_rect((x, y), (x + width, y + height), theme.packed(theme.LINE), ui.px(6))
    # How long it will take is not known: a bar that runs says that something is being done.
    run = (studio.builds.seconds * 0.6) % 1.3 - 0.3
    canvas.push_clip_rect((x + ui.px(6), y), (x + width - ui.px(6), y + height), True)
    canvas.add_rect_filled(
        (x + run * width, y + height - ui.px(3)),
        (x + (run + 0.3) * width, y + height),
        theme.packed(theme.ACCENT),
        ui.px(1.5),
    )
    canvas.pop_clip_rect()
    canvas.add_text((x + ui.px(14), y + (height - imgui.get_font_size()) / 2), theme.packed(theme.INK), note)
    imgui.set_cursor_screen_pos((x + width - ui.px(92), y + (height - imgui.get_frame_height()) / 2))
    if ui.button("Cancel", "Keep the hair as it is.", width=ui.px(80)):
        studio.cancel_build()


def _what_there_is(studio: Studio) -> str:
    if studio.grown is None:
        return "No hair yet"
    animation = studio.grown.animation
    if animation.simulation is not None:
        hair = animation.simulation.built.hair
        return f"{animation.head.name}     {hair.count:,} particles     {len(hair.links):,} links"
    if animation.hairdo is None:
        return animation.head.name
    groom = studio.grown.document.groom.hair
    if groom is not None:
        return f"{animation.head.name}     {groom.strands.count:,} strands of {groom.name}"
    wisps, strands = len(animation.hairdo.outlines.roots), studio.grown.document.wisp.strands
    return f"{animation.head.name}     {strands:,} strands in {wisps:,} wisps"
