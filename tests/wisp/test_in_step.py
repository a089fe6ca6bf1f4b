"""Waves in step: locks begin to wave where hair that passes over their roots has come to."""

import numpy as np

from headstudio.wisp.in_step import InStep
from headstudio.wisp.masters import synthesise_details
from headstudio.wisp.outlines import Outlines
from headstudio.wisp.settings import WispSettings

SEGMENT, JOINTS = 0.006, 40


def curtain():
    """Locks rooted all over a plane, which hang straight down it from as high as 0 m."""
    across, down = np.meshgrid(np.linspace(-0.1, 0.1, 24), np.linspace(0.0, 0.1, 13))
    roots = np.stack([across.ravel(), -down.ravel(), 0 * down.ravel()], axis=1)
    frame = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]).T
    count = len(roots)
    return Outlines(
        roots=roots,
        segment=SEGMENT,
        counts=np.full(count, JOINTS),
        frames=np.broadcast_to(frame, (count, JOINTS, 3, 3)),
        radii=np.zeros((count, JOINTS + 1)),
        strands=np.ones(count, dtype=np.int64),
    )


def test_hair_has_come_from_the_highest_root_above():
    outlines = curtain()
    come, down = InStep.along(outlines).come, -outlines.roots[:, 1]
    below = down > 0.03
    beyond = (come - down)[below]
    assert np.ptp(beyond) < 2 * SEGMENT
    assert abs(beyond.mean()) < 0.02


def test_locks_side_by_side_wave_together_wherever_they_are_rooted():
    outlines = curtain()
    settings = WispSettings(prototype="wavy", alignment=1.0, temperature=0.0, straight_roots=0.001, curl_length=2.0)
    details = synthesise_details(outlines, settings, outlines)
    sideways = details.offsets[..., 0] * np.where(outlines.roots[:, :1] < 0, -1.0, 1.0)
    heights = outlines.roots[:, 1:2] - SEGMENT / details.per_segment * np.arange(sideways.shape[1])
    at = np.linspace(-0.22, -0.12, 40)
    curves = np.array([np.interp(at, h[::-1], s[::-1]) for h, s in zip(heights, sideways, strict=True)])
    curves = curves[-outlines.roots[:, 1] > 0.03]
    assert np.corrcoef(curves).min() > 0.8


def test_the_halves_of_a_head_mirror_each_other():
    outlines = curtain()
    side = InStep.along(outlines).side
    assert (side == np.sign(outlines.roots[:, 0])).all()
