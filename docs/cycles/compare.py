"""Draws scenes with this program and lays them beside Cycles': compare.py OUT [NAME ...] (see README.md)."""

from __future__ import annotations

import json
import math
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from unittest.mock import patch

import flip_evaluator
import moderngl
import numpy as np
from PIL import Image

from headstudio.commands.render_strands import plain_mesh, read_view, scene_of
from headstudio.head.mesh import Floats
from headstudio.render import strand_picture
from headstudio.render.context import headless_context
from headstudio.render.strand_hair import StrandHair
from headstudio.render.view import View, perspective_view
from headstudio.wisp.colour import decode_srgb
from headstudio.wisp.strands import Strands

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def compare(path: Path) -> str:
    """A row of the table for the scene in a JSON file, its pictures lying beside it."""
    context = headless_context()
    stated, more = read_view(path), json.loads(path.read_text(encoding="utf-8"))
    arrays = np.load(more["strands"])
    strands = Strands(arrays["points"], np.concatenate([[0], np.cumsum(arrays["counts"])]))
    scene = scene_of(strands, [plain_mesh(head) for head in more["head"]], stated)
    view = perspective_view(np.array(stated.eye), np.array(stated.target), math.radians(stated.fov_degrees), 1.0)
    drawn = strand_picture.strand_picture(context, scene, view, stated.size)
    assert drawn is not None
    ours = strand_picture.shown(drawn)
    Image.fromarray(ours).save(path.with_name(f"{path.stem}-ours.png"))
    theirs = eight_bits(path.with_suffix(".png"))[..., :3]
    mask = eight_bits(path.with_name(f"{path.stem}-mask.png"))[..., 3] > 127
    our_mask = coverage(context, scene, view, stated.size) > 0.5
    flip = flip_evaluator.evaluate(np.float32(theirs / 255), np.float32(ours / 255), "LDR")[1]
    ours_linear, theirs_linear = (decode_srgb(picture / 255)[mask] for picture in (ours, theirs))
    brightness = (ours_linear @ LUMINANCE).mean() / (theirs_linear @ LUMINANCE).mean()
    overlap = (mask & our_mask).sum() / (mask | our_mask).sum()
    colours = " ".join(f"{part:.2f}" for part in ours_linear.mean(axis=0) / theirs_linear.mean(axis=0))
    return f"{path.stem:16s} FLIP {flip:.3f}  brightness {brightness:.2f} ({colours})  overlap {overlap:.3f}"


def eight_bits(path: Path) -> Floats:
    """A picture in 0 to 255."""
    with Image.open(path) as image:
        return np.asarray(image).astype(float)


def coverage(context: moderngl.Context, scene: strand_picture.StrandScene, view: View, size: int) -> Floats:
    """The part of every pixel that hair covers: what black hair takes from a picture in which all else is white."""
    white = replace(scene, sun=np.zeros(3), sky=np.ones(3), diffuse=np.ones(3))
    far_off = Strands(np.float32([[9.0, 9.0, 9.0], [9.0, 9.1, 9.0]]), np.array([0, 2]), np.full(2, 1e-5, np.float32))

    def black(hair: StrandHair, material: object) -> None:
        hair._shade_target.clear(0.0, 0.0, 0.0, 1.0)

    with (
        patch.object(StrandHair, "shade", black),
        patch.object(strand_picture, "irradiance", lambda light, normals: np.full(normals.shape, np.pi)),
    ):
        with_hair, bare = (
            strand_picture.strand_picture(context, each, view, size)
            for each in (white, replace(white, strands=far_off))
        )
    assert with_hair is not None
    assert bare is not None
    return 1.0 - with_hair[..., 1] / np.maximum(bare[..., 1], 0.1)


if __name__ == "__main__":
    scene_files = [
        path for path in sorted(Path(sys.argv[1]).glob("*.json")) if len(sys.argv) == 2 or path.stem in sys.argv[2:]
    ]
    # A process for each: one that draws scene after scene keeps some 200 MB of each.
    with ProcessPoolExecutor(1, get_context("spawn"), max_tasks_per_child=1) as processes:
        for row in processes.map(compare, scene_files):
            sys.stdout.write(row + "\n")
            sys.stdout.flush()
