"""Writes the scenes that are measured against Cycles: scenes.py SINTEL OUT (see README.md)."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

from headstudio.commands.hair_sources import file_strands
from headstudio.head.mesh import TriangleMesh
from headstudio.params import assign
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document
from headstudio.scene.styles import load_style
from headstudio.wisp.strands import Strands

Scene = dict[str, Any]

STRANDS = 15_000
STYLES = ("bob", "tight-curls", "wavy-lob", "figure-13c", "afro", "ponytail")
# Scenes with a head of their own: what hair it has, and what head.
DRESSED: dict[str, tuple[str, dict[str, Any]]] = {
    "long-gray-mannequin": ("straight-long", {"head.source": "mannequin"}),
    "braid-auburn-back": ("three-strand-braid", {}),
    "short-brown-man": ("mens-short", {"head.masculine": 1.0, "head.age": 0.6}),
    "pigtails-copper-mannequin": ("pigtails", {"head.source": "mannequin"}),
    "swept-silver-old": ("swept-back", {"head.age": 0.8}),
    "bun-blond-behind": ("bun", {}),
}

# The three views that others were given of this hair, in metres and watts.
SINTEL: Scene = {
    "target": [0.0, 1.47, 0.0], "fov_degrees": 30.0, "size": 512, "samples": 64,
    "hair_melanin": 0.75, "hair_redness": 0.5, "hair_roughness": 0.3,
    "hair_radius_root": 0.0003, "hair_radius_tip": 0.0001,
    "sun_strength": 2.5, "ambient": 0.25, "skin_rgb": [0.6, 0.38, 0.3],
}  # fmt: skip
VIEWS: dict[str, Scene] = {
    "front": {"eye": [0.22, 1.52, 0.85], "sun_direction": [0.5, 0.8, 0.6]},
    "side": {"eye": [-0.85, 1.5, 0.1], "sun_direction": [-0.6, 0.8, 0.4]},
    "back": {"eye": [0.25, 1.58, -0.85], "sun_direction": [0.5, 0.8, -0.5]},
}
WHITE: Scene = {"hair_melanin": 0.02, "hair_redness": 0.0}
HARD: Scene = {"ambient": 0.0, "sun_strength": 4.0}
SMALL: Scene = {"size": 256, "samples": 40}


def scenes(sintel: Path, out: Path) -> dict[str, Scene]:
    """All scenes by name."""
    head = [str(sintel / name) for name in ("sintel.obj", "sintel-eyes.obj")]
    given = {**SINTEL, "head": head, "strands": str(out / "sintel.npz")}
    views = {name: {**given, **view} for name, view in VIEWS.items()}
    front, side, back = ({**view, **SMALL} for view in views.values())
    ours = {
        **front, "head": [str(out / "head.obj")], "target": [0.0, 0.07, 0.0],
        "hair_radius_root": 0.00025, "hair_radius_tip": 0.0001,
    }  # fmt: skip
    bob, curls, lob, ringlets, afro, ponytail = ({**ours, "strands": str(out / f"{style}.npz")} for style in STYLES)
    curls |= {"target": [0.0, 0.03, 0.0], "fov_degrees": 36.0}
    ringlets |= {"target": [0.0, 0.0, 0.0], "fov_degrees": 36.0}
    long, braid, short, pigtails, swept, bun = (
        {
            **SINTEL, **SMALL, "head": [str(out / f"{name}.obj")], "strands": str(out / f"{name}.npz"),
            "hair_radius_root": 0.00025, "hair_radius_tip": 0.0001,
        }
        for name in DRESSED
    )  # fmt: skip
    behind = {"sun_direction": [0.2, 0.5, -0.9], "sun_strength": 4.0, "ambient": 0.1}
    return {
        **views,
        "white-hard-side": {**side, **WHITE, **HARD},
        "white-side": {**side, **WHITE},
        "blond-front": {**front, "hair_melanin": 0.3, "hair_redness": 0.3},
        "blond-behind": {**front, "hair_melanin": 0.3, "hair_redness": 0.3, **behind},
        "black-side": {**side, "hair_melanin": 0.98, "hair_redness": 0.2},
        "red-back": {**back, "hair_melanin": 0.55, "hair_redness": 1.0},
        "red-close": {**side, "hair_melanin": 0.5, "hair_redness": 1.0, "fov_degrees": 12.0, "target": [0, 1.52, -0.02]},
        "bob-brown": {**bob, "eye": [0.45, 0.12, 0.75]},
        "bob-white-hard": {**bob, **WHITE, **HARD, "eye": [-0.85, 0.1, 0.1]},
        "curls-black": {**curls, "eye": [0.2, 0.15, -1.0], "hair_melanin": 0.95, "hair_redness": 0.2},
        "curls-blond": {**curls, "eye": [0.7, 0.1, 0.75], "hair_melanin": 0.25, "hair_redness": 0.5},
        # Seen only after the light was as it is.
        "lob-auburn": {
            **lob, "eye": [-0.5, 0.2, 0.75], "target": [0.0, 0.02, 0.0], "fov_degrees": 34.0, "hair_melanin": 0.65,
            "hair_redness": 0.8, "sun_direction": [0.9, 0.3, 0.5], "sun_strength": 3.5, "ambient": 0.15,
        },
        "sintel-right": {
            **front, "eye": [0.7, 1.65, -0.45], "hair_melanin": 0.4, "hair_redness": 0.1,
            "sun_direction": [0.7, 0.2, 0.3], "sun_strength": 2.0, "ambient": 0.4,
        },
        # Other hair, other light: what showed that a pile sends back too little.
        "ringlets-gold-behind": {
            **ringlets, **behind, "eye": [0.35, 0.1, 0.85], "hair_melanin": 0.2, "hair_redness": 0.6,
        },
        "afro-white-above": {**afro, **WHITE, "eye": [0.3, 0.75, 0.6], "target": [0.0, 0.06, 0.0], "fov_degrees": 36.0},
        "bob-black-quarter": {
            **bob, "eye": [0.55, 0.02, 0.7], "hair_melanin": 0.97, "hair_redness": 0.1,
            "sun_direction": [-0.7, 0.6, 0.4], "sun_strength": 3.0,
        },
        "ponytail-red-close": {
            **ponytail, "eye": [-0.75, 0.05, 0.3], "target": [0.0, 0.03, 0.0], "fov_degrees": 16.0,
            "hair_melanin": 0.5, "hair_redness": 1.0, "sun_direction": [-0.8, 0.35, 0.6],
        },
        # Long hair, a plait, short hair.
        "long-gray-mannequin": {
            **long, "eye": [-0.5, 0.15, 0.85], "target": [0, -0.02, 0], "fov_degrees": 36.0, "hair_melanin": 0.12,
            "hair_redness": 0.0, "sun_direction": [0.6, 0.6, 0.5], "sun_strength": 2.5, "ambient": 0.3,
        },
        "braid-auburn-back": {
            **braid, "eye": [0.35, 0.2, -0.85], "target": [0, 0.0, -0.02], "fov_degrees": 32.0, "hair_melanin": 0.6,
            "hair_redness": 0.9, "sun_direction": [-0.5, 0.5, -0.6], "sun_strength": 3.0, "ambient": 0.2,
        },
        "short-brown-man": {
            **short, "eye": [0.6, 0.2, 0.55], "target": [0, 0.06, 0], "fov_degrees": 28.0, "hair_melanin": 0.85,
            "hair_redness": 0.3, "sun_direction": [-0.3, 0.7, 0.6], "sun_strength": 2.0, "ambient": 0.35,
        },
        # The unseen three of the table.
        "pigtails-copper-mannequin": {
            **pigtails, "eye": [-0.8, 0.1, 0.35], "target": [0, 0.0, 0.0], "fov_degrees": 34.0, "hair_melanin": 0.4,
            "hair_redness": 0.9, "sun_direction": [-0.4, 0.35, 0.8], "sun_strength": 3.5, "ambient": 0.1,
        },
        "swept-silver-old": {
            **swept, "eye": [0.75, 0.25, 0.3], "target": [0, 0.06, 0], "fov_degrees": 26.0, "hair_melanin": 0.06,
            "hair_redness": 0.2, "sun_direction": [-0.5, 0.8, 0.1], "sun_strength": 2.2, "ambient": 0.3,
        },
        "bun-blond-behind": {
            **bun, "eye": [-0.3, 0.3, -0.8], "target": [0, 0.05, 0], "fov_degrees": 28.0, "hair_melanin": 0.25,
            "hair_redness": 0.4, "sun_direction": [0.7, 0.4, -0.2], "sun_strength": 3.0, "ambient": 0.2,
        },
    }  # fmt: skip


def write_strands(strands: Strands, path: Path) -> None:
    """Points and counts, for a program that reads nothing else."""
    np.savez(path, points=strands.points, counts=strands.counts)


def write_skin(skin: TriangleMesh, path: Path) -> None:
    """Vertices and faces, as an OBJ."""
    lines = ["v {:.6f} {:.6f} {:.6f}".format(*vertex) for vertex in skin.vertices]
    lines += ["f {} {} {}".format(*(face + 1)) for face in skin.faces]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main(sintel: Path, out: Path) -> None:
    """Write everything into ``out``."""
    out.mkdir(parents=True, exist_ok=True)
    write_strands(file_strands(sintel / "SintelHairOriginal-sintel_hair.16points.tfx"), out / "sintel.npz")
    builder = Builder()
    for style in STYLES:
        document = assign(load_style(style).on(Document()), {"wisp.strands": STRANDS})
        write_strands(builder.hairdo(document).strands, out / f"{style}.npz")
    write_skin(builder.head(Document().head).skin, out / "head.obj")
    for name, (style, change) in DRESSED.items():
        document = assign(load_style(style).on(Document()), {"wisp.strands": STRANDS, **change})
        write_strands(builder.hairdo(document).strands, out / f"{name}.npz")
        write_skin(builder.head(document.head).skin, out / f"{name}.obj")
    for name, scene in scenes(sintel, out).items():
        (out / f"{name}.json").write_text(json.dumps(scene, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
