"""Pictures against their references: ``--regenerate-screenshots`` in tests/conftest.py writes these anew."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.head.mannequin import mannequin
from headstudio.head.scalp import grow_scalp
from headstudio.head.scalp_settings import ScalpSettings
from headstudio.lcp.body import Body
from headstudio.lcp.grow import grow_hair
from headstudio.lcp.settings import HairSettings
from headstudio.render.renderer import Renderer
from headstudio.scene.settings import Camera, Look
from headstudio.scene.stage import HairOnStage, Overlays, Stage

CheckPicture = Callable[[str, NDArray[np.uint8]], None]
SIZE = (288, 288)


@pytest.fixture(scope="module")
def stage() -> Stage:
    """The mannequin with a thousand particles of hair, its head turned a little.

    Nothing moves the hair, so it is short enough to turn with the head and not into the shoulders.
    """
    head = mannequin()
    hair = grow_hair(grow_scalp(head, ScalpSettings()), Body.around(head), HairSettings(particles=1000, length=0.17))
    frame = HeadFrame(Rotation.from_rotvec([0.1, 0.35, 0.0]))
    return Stage(head, frame, HairOnStage(hair, hair.rest_positions, hair.rest_directions))


def with_overlays(stage: Stage) -> Stage:
    """The particles in orange, their directions in blue."""
    assert stage.hair is not None
    at = stage.frame.to_world(stage.hair.positions)
    ends = stage.frame.to_world(stage.hair.positions + 0.01 * stage.hair.directions)
    overlays = Overlays(
        segments=np.stack([at, ends], axis=1),
        segment_colours=np.tile([0.3, 0.6, 1.0], (len(at), 1)),
        points=at,
        point_colours=np.tile([1.0, 0.5, 0.1], (len(at), 1)),
    )
    return dataclasses.replace(stage, overlays=overlays)


@pytest.mark.parametrize(
    ("name", "look", "camera"),
    [
        ("three_quarters", {}, {"azimuth": 0.5, "distance": 0.8}),
        ("back_without_shadows", {"shadows": False, "hair_colour": (0.75, 0.6, 0.4)}, {"azimuth": 3.0}),
        ("face", {"show_hair": False, "skin_colour": (0.4, 0.26, 0.19)}, {"azimuth": -0.3, "distance": 0.5}),
        ("particles", {"show_hair": False}, {"azimuth": 1.4}),
    ],
)
def test_picture(
    gl: moderngl.Context,
    check_picture: CheckPicture,
    stage: Stage,
    name: str,
    look: dict[str, Any],
    camera: dict[str, float],
) -> None:
    renderer = Renderer(gl)
    drawn = with_overlays(stage) if name == "particles" else stage
    renderer.render(drawn, Look(**look), Camera(**camera), SIZE)
    check_picture(name, renderer.read_pixels())
