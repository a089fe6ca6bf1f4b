"""Paint a map on the face: how thick the tissue is, how strong fine wrinkles are."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from ...head.length_maps import sample
from ...head.locate import SurfacePoints
from ...head.mesh import Floats, TriangleMesh
from ...head.scalp_settings import GrayImage
from ...scene.document import Document
from ...scene.stage import Stage
from ...wisp.proportions import Proportions
from ...wrinkle.tissue_thickness import MAX_THICKNESS, as_image, thickness_of
from ..brush import BrushStroke, Sheet
from ..brush_rim import draw_rim, rim_points
from ..map_colours import map_colours
from ..parameter_widgets import edit_item
from ..studio import Studio
from ..ui import Ui
from .face_places import FacePlaces, places_of
from .skin_canvas import SkinCanvas, Touch, as_points
from .skin_tool import SkinTool

SIZE = 256  # texels along an edge of a new map
_LIFT = 0.0015  # of the coloured map off the skin [m]
_OPACITY = 0.6


@dataclass(frozen=True)
class PaintedSkin:
    """A map over the texture square of the face: what it is called, and how it is read, replaced and taken away."""

    label: str
    icon: str
    help: str
    read: Callable[[Document, FacePlaces], GrayImage]
    write: Callable[[Document, GrayImage | None], Document]


def _tissue(document: Document, faces: FacePlaces) -> GrayImage:
    return document.face.painted_tissue or _named_tissue(faces, document.face.tissue)


@lru_cache(maxsize=4)
def _named_tissue(faces: FacePlaces, preset: str) -> GrayImage:
    thickness = thickness_of(faces.head, preset)[faces.layout.part.vertices]
    return as_image(thickness, faces.layout.texture_map, SIZE)


@lru_cache(maxsize=1)
def _full_strength() -> GrayImage:
    return GrayImage(np.ones((SIZE, SIZE), dtype=np.float32))


TISSUE = PaintedSkin(
    "Tissue",
    icons.ICON_FA_LAYER_GROUP,
    f"Paint how thick the tissue under the skin is, up to {1e3 * MAX_THICKNESS:.0f} mm: it bulges where skin is pressed.",
    _tissue,
    lambda document, image: replace(document, face=replace(document.face, painted_tissue=image)),
)
STRENGTH = PaintedSkin(
    "Fine strength",
    icons.ICON_FA_FINGERPRINT,
    "Paint how deep fine wrinkles are; where it is dark the skin is smooth.",
    lambda document, faces: document.fine.painted_strength or _full_strength(),
    lambda document, image: replace(document, fine=replace(document.fine, painted_strength=image)),
)


def skin_painter(painted: PaintedSkin) -> Callable[[Studio], PaintSkin]:
    """What makes the tool that paints this map."""
    return lambda studio: PaintSkin(studio, painted)


class PaintSkin(SkinTool):
    """The brush on the face. Beside the mapped part a press is for the camera."""

    takes_shift = True

    def __init__(self, studio: Studio, painted: PaintedSkin) -> None:
        super().__init__(studio)
        self.painted = painted
        self.label, self.icon = painted.label, painted.icon
        self.help = f"{painted.help} Ctrl takes away, Shift smooths."
        self._stroke: BrushStroke | None = None
        self._sheet: tuple[object, Sheet] | None = None
        self._dressed: tuple[object, Stage] | None = None

    def press_on(self, canvas: SkinCanvas, touch: Touch) -> bool:
        """Begin a stroke."""
        if canvas.under(touch.x, touch.y) is None:
            return False
        action = "smooth" if touch.shift else "lower" if touch.ctrl else "raise"
        before = self.painted.read(self.studio.document, canvas.faces).pixels.astype(np.float64)
        self._stroke = BrushStroke(self.studio.brush, self._sheet_for(canvas.faces, before.shape), before, action)
        self.studio.work.begin_gesture(self._name)
        self.drag_on(canvas, touch)
        return True

    def drag_on(self, canvas: SkinCanvas, touch: Touch) -> None:
        """Paint on to where the mouse is."""
        place = canvas.under(touch.x, touch.y)
        if self._stroke is None or place is None:
            return
        self._stroke.move(canvas.faces.at_rest(place)[0])
        self._write(GrayImage(self._stroke.result.astype(np.float32)), self._name)

    def release(self) -> None:
        """The stroke is done."""
        self._stroke = None
        self.studio.work.end_gesture()

    def options(self, ui: Ui) -> None:
        """The brush, and filling or forgetting the whole map."""
        self.studio.brush, _ = edit_item(ui, self.studio.brush)
        gap = imgui.get_style().item_spacing.x / 2
        width = (imgui.get_content_region_avail().x - 2 * gap) / 3
        for label, value in (("Fill", 1.0), ("Clear", 0.0)):
            if ui.button(label, f"Make the whole map {'white' if value else 'black'}.", width=width):
                image = GrayImage(np.full((SIZE, SIZE), value, dtype=np.float32))
                self._write(image, f"{label} {self._name.lower()}")
            imgui.same_line(0, gap)
        if ui.button("Reset", "Forget what was painted.", width=width):
            self._write(None, f"Reset {self._name.lower()}")

    def painted_image(self, faces: FacePlaces) -> GrayImage | None:
        """The map as it is now."""
        return self.painted.read(self.studio.document, faces)

    def dress(self, stage: Stage) -> Stage:
        """The map in colours on the face."""
        faces = places_of(self.studio)
        if faces is None or stage.skin is None:
            return stage
        image = self.painted.read(self.studio.document, faces)
        if self._dressed is None or self._dressed[0] != (stage, image):
            part = faces.layout.part
            mesh = TriangleMesh(stage.skin.posed[part.vertices], part.mesh.faces)
            raised = stage.frame.to_world(mesh.vertices + _LIFT * mesh.vertex_normals)
            values = sample(image, faces.layout.texture_map.uv)
            colours = np.column_stack([map_colours(values), np.full(len(values), _OPACITY)])
            overlays = replace(stage.overlays, triangles=raised[mesh.faces], triangle_colours=colours[mesh.faces])
            self._dressed = (stage, image), replace(stage, overlays=overlays)
        return self._dressed[1]

    def draw_on(self, canvas: SkinCanvas, drawing: imgui.ImDrawList, touch: Touch | None) -> None:
        """The rim of the brush on the skin, and that of its mirror image."""
        place = canvas.under(touch.x, touch.y) if touch is not None else None
        if place is None:
            return
        self._draw_rim(canvas, drawing, place, 1.0)
        if self.studio.brush.mirror:
            across = canvas.faces.at_rest(place)
            across[:, 0] = 2 * _middle(canvas.faces) - across[:, 0]
            self._draw_rim(canvas, drawing, canvas.faces.of_skin(across), 0.35)

    def _draw_rim(self, canvas: SkinCanvas, drawing: imgui.ImDrawList, place: SurfacePoints, strength: float) -> None:
        faces = canvas.faces
        rim = rim_points(faces.at_rest(place)[0], faces.normals(place)[0], self.studio.brush.radius)
        draw_rim(drawing, as_points(canvas.on_screen(faces.of_skin(rim))), strength, canvas.scale)

    def _write(self, image: GrayImage | None, label: str) -> None:
        self.studio.work.change(self.painted.write(self.studio.document, image), label)

    @property
    def _name(self) -> str:
        return f"{self.painted.label} map"

    def _sheet_for(self, faces: FacePlaces, shape: tuple[int, ...]) -> Sheet:
        """Where the texels lie on the skin; beside the map, the nearest skin, so that paint reaches its border."""
        if self._sheet is None or self._sheet[0] != (faces, shape):
            v, u = ((np.arange(count) + 0.5) / count for count in shape)
            uv = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
            places: Floats = faces.at_rest(faces.of_uv(uv)[0]).reshape(*shape, 3)
            self._sheet = (faces, shape), Sheet(places, _middle(faces))
        return self._sheet[1]


def _middle(faces: FacePlaces) -> float:
    """The x of the plane between both halves of the face [m]."""
    return float(Proportions.of(faces.head.landmarks).centre[0])
