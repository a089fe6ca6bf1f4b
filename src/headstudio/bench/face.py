"""A face that moves and wrinkles, frame by frame, and the carving of its fine wrinkles (Bando's thesis, section 2.7:
5.0 frames a second at 512 x 512 on a Xeon of 2 GHz, a fine field of 512 x 512 in about 10 s)."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from statistics import median

import numpy as np

from ..head.head import Head
from ..params import assign
from ..render.renderer import Renderer
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.face_ahead import FaceAhead
from ..scene.stage import Stage
from ..wrinkle.face import Face
from ..wrinkle.face_creases import face_creases
from ..wrinkle.face_settings import FaceSettings
from ..wrinkle.fine_guides import face_guides
from ..wrinkle.fine_wrinkles import grow_fine_wrinkles
from ..wrinkle.living_skin import Skin
from ..wrinkle.performance import keyframe
from ..wrinkle.tissue_thickness import thickness_of
from .light_head import light_head

SIZE = (512, 512)
WARM_UP = 3
PAPER_FPS = 5.0
PAPER_CARVING_S = 10.0


@dataclass(frozen=True)
class FaceCost:
    """A face that goes from rest to a smile. triangles: of the head's skin. refined: with those that carry furrows.

    Milliseconds are medians: muscles_ms: muscles, jaw, lids and tissue; furrows_ms: shrinkage, displacement and normals;
    fine_ms: amplitudes of the fine fields; skin_ms: all of these, some at once; picture_ms: drawing it at 512 x 512 with
    shadows; frame_ms: of a performance, the skin of the next frame being worked out in another process meanwhile.
    light_refined, light_ms: triangles of a light head with furrows, and what muscles, tissue and furrows cost on it.
    """

    triangles: int
    refined: int
    muscles_ms: float
    furrows_ms: float
    fine_ms: float
    skin_ms: float
    picture_ms: float
    frame_ms: float
    light_refined: int
    light_ms: float

    @property
    def fps(self) -> float:
        """Frames a second of the animated face."""
        return 1e3 / self.frame_ms


@dataclass(frozen=True)
class CarvingCost:
    """Both fine fields of a face and its pores on images of ``texels`` along an edge [ms], and how many segments of furrows."""

    texels: int
    carving_ms: float
    segments: int


def face_cost(
    document: Document, frames: int, builder: Builder, renderer: Renderer, tick: Callable[[], None] = lambda: None
) -> FaceCost:
    """Let a face smile for ``frames`` frames; ``tick`` is called after each."""
    document = assign(document, {"look.skin_as": "living", "look.hair_as": "none"})
    skin = builder.skin(document)
    face, creases, fine = skin.face, skin.creases, skin.surface.fine
    part = skin.surface.bed.layout.part.vertices
    tissue = thickness_of(face.head, "average")
    rows = []
    for k in range(-WARM_UP, frames):
        settings = _smiling(k)
        times = [time.perf_counter()]
        pose = face.pose(settings, tissue)
        times.append(time.perf_counter())
        creases.displaced(pose.positions)
        times.append(time.perf_counter())
        if fine is not None:
            fine.growth.amplitudes(pose.positions[part])
        times.append(time.perf_counter())
        living = skin.at(settings)
        times.append(time.perf_counter())
        renderer.render(Stage(face.head, skin=living), document.look, document.camera, SIZE, skin=document.skin)
        renderer.context.finish()
        times.append(time.perf_counter())
        if k >= 0:
            rows.append(1e3 * np.diff(times))
        tick()
    light_refined, light_ms = _light_cost(document, face.head, frames)
    muscles, furrows, fine_ms, whole, picture = (float(value) for value in np.median(rows, axis=0))
    return FaceCost(
        triangles=len(face.head.skin.faces),
        refined=len(creases.faces),
        muscles_ms=muscles,
        furrows_ms=furrows,
        fine_ms=fine_ms,
        skin_ms=whole,
        picture_ms=picture,
        frame_ms=_frame_ms(skin, document, renderer, frames, tick),
        light_refined=light_refined,
        light_ms=light_ms,
    )


def _frame_ms(skin: Skin, document: Document, renderer: Renderer, frames: int, tick: Callable[[], None]) -> float:
    """What a frame of a performance takes while skin moves one frame ahead [ms]."""
    face = FaceAhead(skin)
    if not face.wait_for_process():
        raise RuntimeError("the process of the skin did not start")
    rate = 30.0
    smiles = (keyframe(k / rate, {"smile": _smiling(k).smile}) for k in range(WARM_UP + frames + 1))
    performance = FaceSettings(performance=tuple(smiles))
    taken = []
    for k in range(WARM_UP + frames):
        start = time.perf_counter()
        face.advance(performance, k / rate, 1 / rate)
        living = face.at(performance, k / rate)
        renderer.render(Stage(skin.face.head, skin=living), document.look, document.camera, SIZE, skin=document.skin)
        renderer.context.finish()
        taken.append(1e3 * (time.perf_counter() - start))
        tick()
    return median(taken[WARM_UP:])


def _smiling(frame: int) -> FaceSettings:
    """Up to a smile and back within a second of 30 frames."""
    return FaceSettings(smile=0.5 - 0.5 * float(np.cos(2 * np.pi * (frame + 0.5) / 30)))


def _light_cost(document: Document, whole: Head, frames: int) -> tuple[int, float]:
    """How many triangles a light head has with coarse furrows, and a pose of it [ms]."""
    head = light_head(whole)
    face, tissue = Face(head), thickness_of(head, "average")
    creases = face_creases(head, replace(document.wrinkle, fineness=1.0))
    taken = []
    for k in range(-WARM_UP, frames):
        start = time.perf_counter()
        creases.displaced(face.pose(_smiling(k), tissue).positions)
        taken.append(1e3 * (time.perf_counter() - start))
    return len(creases.faces), median(taken[WARM_UP:])


def carving_cost(document: Document, texels: int, builder: Builder) -> CarvingCost:
    """Carve the fine wrinkles of the document's face on images of ``texels``."""
    settings = assign(document, {"fine.texture_size": texels}).fine
    layout = builder.skin(assign(document, {"fine.on": False})).surface.bed.layout
    guides = face_guides(layout.texture_map, builder.head(document.head).landmarks)
    start = time.perf_counter()
    fine = grow_fine_wrinkles(layout.texture_map, settings, guides)
    spent = 1e3 * (time.perf_counter() - start)
    return CarvingCost(texels, spent, sum(len(field.segments.furrows) for field in fine.carved))
