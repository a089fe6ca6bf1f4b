"""Master strands at rest: where they start, how long they are, and which way they leave the skin."""

from __future__ import annotations

import math

import numpy as np

from ..head.length_maps import sample
from ..head.mesh import Floats
from ..head.scalp import Scalp
from .curves import deviation_radius
from .follicles import Regions
from .maps import length_map, protrusion_map
from .outlines import Outlines
from .parting import Parting, unit
from .settings import WispSettings
from .stray import Stray

# No master strand is shorter [m]: stubble.
SHORTEST = 0.0005


def rest_outlines(
    scalp: Scalp, regions: Regions, parting: Parting | None, settings: WispSettings
) -> tuple[Outlines, Floats]:
    """Straight outlines with a joint angle of zero everywhere, and the length of every master strand [m], (W,).

    All segments have one length, so that the last of a wisp may reach past its end; the strands are cut there. The
    protrusion map says how far hair is raised from the skin, between lying along its flow (away from the whorl and from
    the parting) and standing up. Lengths are at least half a millimetre.
    """
    segment = settings.length / settings.segments
    length = np.maximum(settings.length * sample(length_map(settings), regions.uv), SHORTEST)
    counts = np.maximum(np.ceil(length / segment - 1e-9), 1).astype(np.int64)
    frames = root_frames(scalp, regions, parting, settings)
    joints = int(counts.max(initial=1))
    parameter = np.minimum(np.arange(joints + 1) * segment / np.maximum(length, segment * 1e-3)[:, None], 1.0)
    radii = regions.reach[:, None] * deviation_radius(settings, parameter)
    radii[:, 0] = regions.reach
    outlines = Outlines(
        roots=regions.roots,
        segment=segment,
        counts=counts,
        frames=np.repeat(frames[:, None], joints, axis=1),
        radii=radii,
        strands=np.rint(settings.strands * regions.share).astype(np.int64),
        aside=None if parting is None else parting.aside(regions.roots),
        stray=Stray.over(regions.roots, settings.seed),
    )
    return outlines, length


def root_frames(scalp: Scalp, regions: Regions, parting: Parting | None, settings: WispSettings) -> Floats:
    """Frames of the first segments, (W, 3, 3): columns along the skin across the hair, the third direction, the hair."""
    normals = scalp.normals(regions.uv)
    flow = scalp.root_directions(regions.uv, 1.0, 0.0)
    if parting is not None:
        flow = parting.lean(regions.roots, normals, flow)
    raised = np.clip(settings.protrusion * sample(protrusion_map(settings), regions.uv), 0.0, 1.0) * (math.pi / 2)
    direction = unit(np.cos(raised)[:, None] * flow + np.sin(raised)[:, None] * normals)
    # At the whorl itself hair has no flow: it stands up.
    direction = np.where(np.linalg.norm(direction, axis=1, keepdims=True) > 0, direction, normals)
    across = np.cross(normals, direction)
    standing = np.linalg.norm(across, axis=1) < 1e-6
    across[standing] = _some_tangent(normals[standing])
    across = unit(across)
    return np.stack([across, np.cross(direction, across), direction], axis=-1)


def _some_tangent(normals: Floats) -> Floats:
    """For each unit normal, (k, 3), a vector across it."""
    axis = np.eye(3)[np.abs(normals).argmin(axis=1)]
    return np.cross(normals, axis)
