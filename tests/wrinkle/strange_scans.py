"""Synthetic scans of a wrinkled head whose grooves have a profile that is not the studio's.

Gaussian valleys with raised rims along lines that wander over the skin, and the noise of a scanner. Nothing here knows
the chart, the furrows or the shape (2.1): the scan is made of the head's triangles alone, in space.
"""

from __future__ import annotations

from dataclasses import dataclass

import igl
import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import cKDTree

from headstudio.head.head import Head
from headstudio.head.mesh import Floats, TriangleMesh

from .skins import cut

# Where a scan may look: two landmarks and how far from the first towards the second (and beyond) its middle lies.
PLACES = {
    "forehead": ("glabella", "hairline", 0.5),
    "cheek": ("left_eye", "mouth_left", 0.55),
    "face": ("nasion", "nose_tip", 0.3),
    "chin": ("nose_tip", "chin", 0.8),
    "temple": ("right_eye", "right_tragus", 0.4),
    "eye corner": ("nasion", "left_eye", 1.7),
    "neck": ("nose_tip", "chin", 1.8),
}


# What is rounded is drawn out in so many rounds, and looked at so many times finer.
_ROUNDS, _LEVELS = 8, 2


@dataclass(frozen=True)
class Strange:
    """What a scan is made of. Lengths in metres.

    rims: volume that the rims rise by over that of the valley. rim_at, rim_width: where they stand and how wide they are,
    in widths of the valley. wander: how far lines stray. spread: over how much of the patch's radius lines lie that do not
    cross. crossing: whether they have any direction. smooth: whether the
    scan rounds the head's triangles or has them flat. through: whether it keeps to the head's vertices where it rounds: else
    a coarse head has another shape in its scan. added: whether crossing grooves add up or the deeper one counts.
    varying: how much depth changes along a line, 0 to 1. steepest: no valley is narrower than this part of its depth.
    """

    seed: int
    place: str = "forehead"
    radius: float = 0.05
    lines: int = 4
    depth: tuple[float, float] = (1e-3, 5e-3)
    sigma: tuple[float, float] = (1.0e-3, 3.0e-3)
    length: tuple[float, float] = (0.03, 0.08)
    rims: float = 1.0
    rim_at: float = 2.5
    rim_width: float = 1.0
    wander: float = 2e-3
    spread: float = 1.5
    crossing: bool = False
    smooth: bool = True
    through: bool = False
    added: bool = True
    varying: float = 0.0
    steepest: float = 0.4
    spacing: float = 1.1e-3
    noise: float = 1e-4


def strange_scan(head: Head, recipe: Strange) -> TriangleMesh:
    """The scan [m], in the frame of the head. The same recipe gives the same scan."""
    return strange_scan_with_lines(head, recipe)[0]


def strange_scan_with_lines(head: Head, recipe: Strange) -> tuple[TriangleMesh, list[Floats]]:
    """The scan, and the lines of its grooves on the skin [m], (k, 3) each."""
    rng = np.random.default_rng(recipe.seed)
    centre, fine = _patch(head, recipe)
    if recipe.smooth and recipe.through:
        fine = _drawn_out(fine)
    while np.median(fine.face_areas) > 0.5 * recipe.spacing**2:
        fine = TriangleMesh(*(igl.loop if recipe.smooth else igl.upsample)(fine.vertices, fine.faces)[:2])
    normals = fine.vertex_normals
    normal = normals[cKDTree(fine.vertices).query(centre)[1]]
    right = np.cross([0.0, 1.0, 0.0], normal)
    right /= np.linalg.norm(right)
    frame = np.stack([right, np.cross(normal, right), normal])
    seen = normals @ normal > 0.2
    local = (fine.vertices - centre) @ frame.T
    lifted = LinearNDInterpolator(local[seen, :2], local[seen, 2])

    height, lines = np.zeros(len(fine.vertices)), []
    for number in range(recipe.lines):
        flat = _line(rng, recipe, number)
        depth, sigma = rng.uniform(*recipe.depth), rng.uniform(*recipe.sigma)
        sigma, phase = max(sigma, recipe.steepest * depth), rng.random()
        line = np.column_stack([flat, lifted(flat)])
        line = line[np.isfinite(line[:, 2])]
        if len(line) < 50:
            continue
        lines.append(line @ frame + centre)
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
        away, nearest = cKDTree(line).query(local)
        part = along[nearest] / along[-1]
        ends = np.clip(np.minimum(part, 1 - part) / 0.2, 0, 1)
        size = ends**2 * (3 - 2 * ends)
        size *= (1 + recipe.varying * np.sin(2 * np.pi * (1.2 * part + phase))) / (1 + recipe.varying)
        groove = depth * size * seen * profile(away / sigma, recipe)
        height = height + groove if recipe.added else np.where(np.abs(groove) > np.abs(height), groove, height)
    height += rng.normal(0.0, recipe.noise, len(height))
    return fine.moved(fine.vertices + height[:, None] * normals), lines


def profile(x: Floats, recipe: Strange) -> Floats:
    """The height of a groove 1 deep and 1 wide at distances x."""
    rim = recipe.rim_width
    tall = recipe.rims / (2 * rim)
    rims = np.exp(-0.5 * ((np.abs(x) - recipe.rim_at) / rim) ** 2)
    return np.asarray(-np.exp(-0.5 * x**2) + tall * rims)


def _drawn_out(mesh: TriangleMesh) -> TriangleMesh:
    """The mesh whose rounded surface goes through the vertices of this one."""
    wanted, vertices = mesh.vertices, mesh.vertices
    for _ in range(_ROUNDS):
        rounded = igl.loop(vertices, mesh.faces, _LEVELS)[0]
        vertices = vertices + wanted - rounded[: len(wanted)]
    return mesh.moved(vertices)


def _patch(head: Head, recipe: Strange) -> tuple[Floats, TriangleMesh]:
    start, end, part = PLACES[recipe.place]
    marks = head.landmarks
    centre = (1 - part) * getattr(marks, start) + part * getattr(marks, end)
    skin = head.skin
    centre = skin.vertices[np.linalg.norm(skin.vertices - centre, axis=1).argmin()]
    middles = skin.vertices[skin.faces].mean(axis=1)
    return centre, cut(skin, np.linalg.norm(middles - centre, axis=1) < recipe.radius)


def _line(rng: np.random.Generator, recipe: Strange, number: int) -> Floats:
    """A wandering line in the plane of the patch, (400, 2)."""
    length = min(rng.uniform(*recipe.length), 1.6 * recipe.radius)
    room = recipe.radius - 0.012
    angle = rng.uniform(0, np.pi) if recipe.crossing else rng.normal(0.0, 0.15)
    if recipe.crossing:
        middle = rng.uniform(-0.3, 0.3, 2) * room
    else:
        # One above the other.
        middle = np.array([rng.uniform(-0.2, 0.2), ((number + 0.5) / recipe.lines - 0.5) * recipe.spread]) * room
    part = np.linspace(-0.5, 0.5, 400)
    aside = (
        sum(rng.normal(0.0, 1.0) / k * np.sin(2 * np.pi * (k * 0.8 * part + rng.random())) for k in (1, 2, 3))
        * recipe.wander
    )
    way, left = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    return np.asarray(middle + length * part[:, None] * way + aside[:, None] * left)
