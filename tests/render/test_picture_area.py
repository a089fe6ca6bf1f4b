from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.head.mesh import Floats
from headstudio.render.picture_area import Area, Outline, around
from headstudio.render.view import camera_view
from headstudio.scene.settings import Camera

SIZE = (300, 200)


def blob(seed: int) -> Floats:
    points = np.random.default_rng(seed).normal(size=(2000, 3)) * [0.04, 0.06, 0.03]
    return points[np.linalg.norm(points / [0.1, 0.15, 0.08], axis=1) < 1] + [0, 0.05, 0.05]


def holds(area: Area, at: Floats) -> np.ndarray:
    x, y, width, height = area
    return (at[:, 0] >= x) & (at[:, 0] <= x + width) & (at[:, 1] >= y) & (at[:, 1] <= y + height)


@pytest.mark.parametrize("seed", range(6))
def test_an_area_holds_its_part_of_the_skin_and_little_more(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points, turning = blob(seed), np.ones(len(blob(seed)))
    inside = points[:, 1] > 0.05
    outline = Outline(points, turning, inside)
    posed = points + rng.normal(size=3) * 0.01
    outline.pose(posed)
    frame = HeadFrame(Rotation.from_rotvec(rng.normal(size=3) * 0.4), rng.normal(size=3) * 0.02)
    view = camera_view(Camera(azimuth=rng.uniform(0, 6), elevation=rng.uniform(-1, 1), distance=0.9), SIZE[0] / SIZE[1])
    world = frame.skinned(posed[inside], turning[inside])
    clip = np.column_stack([world, np.ones(len(world))]) @ view.clip_from_world.T
    at = (0.5 * clip[:, :2] / clip[:, 3:] + 0.5) * SIZE
    x, y, width, height = outline.area(view, frame, SIZE)
    assert holds((x, y, width, height), at[((at >= 0) & (at <= SIZE)).all(axis=1)]).all()
    low, high = np.clip(at.min(axis=0), 0, SIZE), np.clip(at.max(axis=0), 0, SIZE)
    assert width * height < 1.5 * np.prod(high - low) + 100


def test_an_eye_within_the_skin_sees_it_everywhere_and_no_skin_is_nowhere() -> None:
    points = blob(1)
    everywhere, view = np.ones(len(points), dtype=bool), camera_view(Camera(distance=0.05), 1.0)
    turning = np.ones(len(points))
    assert Outline(points, turning, everywhere).area(view, HeadFrame(), SIZE) == (0, 0, *SIZE)
    assert Outline(points, turning, ~everywhere).area(view, HeadFrame(), SIZE) == (0, 0, 0, 0)


@pytest.mark.parametrize("area", [(0, 0, 0, 0), (0, 0, 30, 20), (5, 6, 7, 8), (0, 6, 30, 14), (25, 0, 5, 20)])
def test_area_and_what_is_around_it_are_the_picture(area: Area) -> None:
    drawn = np.zeros((20, 30), dtype=int)
    for x, y, width, height in [area, *around(area, (30, 20))]:
        drawn[y : y + height, x : x + width] += 1
    assert (drawn == 1).all()
