"""Master strands: an outline and, around it, details after the prototype (Choe, Ko 2005, figure 5 and section 2.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats
from ..head.smooth import smoothstep
from .catmull_rom import catmull_rom_matrix
from .in_step import InStep
from .markov import Singles, reached, synthesise, window_size, without_loose_end
from .outlines import Outlines
from .parting import unit
from .prototypes import prototype_of
from .settings import WispSettings

# So many control points a Catmull-Rom spline needs to go once around a curl.
CONTROLS_PER_PITCH = 7
# So many neighbouring locks curl the same way.
_IN_PATCH = 6
# Were roots straight for the same way on all wisps, curls would begin in a line across the head.
_SOONER_OR_LATER = (0.4, 1.6)
# No lock is farther from the mean size than so many standard deviations.
_FARTHEST = 2.0


@dataclass(frozen=True, eq=False)
class Details:
    """Details of W master strands [m], (W, n, 3), in the frames of their outlines: ``per_segment`` of them a segment,
    from the root on, so that n is per_segment J + 1. None where hair is straight.
    """

    offsets: Singles | None
    per_segment: int


def synthesise_details(outlines: Outlines, settings: WispSettings, laid: Outlines | None = None) -> Details:
    """Give every master strand details of its own after the prototype. laid: the outlines as they lie, where they do:
    locks that wave together are then in step with what lies beside them, and not with what is rooted beside them.

    Curls have their pitch in metres, on short hair and on long. Where it is short, details lie closer than joints; the
    outline between joints is interpolated. At the root there are none, and they reach their size along the straight
    roots, for a strand starts where it grows.
    """
    prototype = prototype_of(settings)
    if prototype is None:
        return Details(None, 1)
    wisps, joints = outlines.frames.shape[:2]
    per_segment = max(math.ceil(CONTROLS_PER_PITCH * outlines.segment / prototype.pitch), 1)
    spacing = outlines.segment / per_segment
    samples = prototype.sampled(spacing)
    window = window_size(samples, settings.window * prototype.pitch / spacing)
    samples = without_loose_end(samples, window)
    rng = np.random.default_rng([settings.seed, 2])
    loose = 1.0 - settings.alignment
    pitch = prototype.pitch / spacing
    # Out of step by a part of a turn, and by whole turns, which are not quite the same in a prototype that wanders.
    turns = np.rint(loose * rng.random(wisps) * (len(samples) - window) / pitch) + loose * rng.random(wisps)
    step = None if laid is None or loose == 1.0 or wisps == 0 else InStep.along(laid)
    come = turns * pitch + (0.0 if step is None else step.come / spacing)
    starts = reached(samples, window, np.rint(np.maximum(come, 0.0)).astype(np.int64))
    count = per_segment * joints + 1
    larger = _sizes(settings.curl_variety, wisps, np.random.default_rng([settings.seed, 7]))
    needed = math.ceil(count / min(larger.min(initial=1.0), 1.0)) + 1
    offsets = synthesise(samples, window, settings.temperature, starts, needed, rng)
    offsets = _enlarged(offsets, larger, count)
    spin = np.asarray(loose * rng.uniform(-math.pi, math.pi, wisps))
    # Curls turn left or right as it comes. One prototype turns one way, and half of the locks are its mirror images.
    offsets[..., 0] *= np.where(_patches(outlines.roots, rng) < 0.5 * loose, -1, 1).astype(np.float32)[:, None]
    offsets = _spun(offsets, spin)
    if step is not None:
        offsets[..., 0] *= step.side.astype(np.float32)[:, None]
    along: Floats = spacing * np.arange(offsets.shape[1], dtype=np.float64)
    sooner, later = _SOONER_OR_LATER
    straight = np.asarray(settings.straight_roots * rng.uniform(sooner, later, wisps))
    offsets *= _onset(along, straight)[..., None]
    return Details(offsets, per_segment)


def master_controls(outlines: Outlines, details: Details) -> Singles:
    """Control points p = c + delta of the master strands [m], (W, n, 3): the details in the frames of the outlines."""
    count = details.per_segment
    joints = outlines.frames.shape[1]
    at = np.arange(joints * count + 1) / count
    centres = outlines.joints
    if count > 1:
        centres = np.matmul(catmull_rom_matrix(joints + 1, at), centres)
    if details.offsets is None:
        return centres.astype(np.float32)
    frames = _frames_at(outlines.frames.astype(np.float32), at)
    turned: Singles = np.einsum("wnij,wnj->wni", frames, details.offsets)
    return (centres + turned).astype(np.float32)


def _frames_at(frames: Singles, at: Floats) -> Singles:
    """Frames along outlines at parameters counted in segments, (n,): (W, n, 3, 3). Each segment's is at its middle."""
    place = np.clip(at - 0.5, 0, frames.shape[1] - 1)
    before = np.minimum(place.astype(np.int64), max(frames.shape[1] - 2, 0))
    after = np.minimum(before + 1, frames.shape[1] - 1)
    part = (place - before).astype(np.float32)[:, None, None]
    blend = (1 - part) * frames[:, before] + part * frames[:, after]
    along = unit(blend[..., 2])
    across = blend[..., 0] - np.einsum("wni,wni->wn", blend[..., 0], along)[..., None] * along
    across = unit(across)
    return np.stack([across, np.cross(along, across), along], axis=-1)


def _spun(offsets: Singles, angle: Floats) -> Singles:
    """Details turned about the outline, each strand by its own angle [rad], (W,)."""
    cosine, sine = (f(angle).astype(np.float32)[:, None] for f in (np.cos, np.sin))
    x, y, z = np.moveaxis(offsets, -1, 0)
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1)


def _patches(roots: Floats, rng: np.random.Generator) -> Floats:
    """Even numbers from 0 to 1 that neighbours share, for wisps rooted at (W, 3) [m]: (W,). Each takes that of the nearest
    of so many among them as have a patch of some breadth each.
    """
    count = max(len(roots) // _IN_PATCH, 1)
    nearest = cKDTree(roots[rng.permutation(len(roots))[:count]]).query(roots)[1]
    return rng.random(count)[nearest]


def _sizes(variety: float, wisps: int, rng: np.random.Generator) -> Floats:
    """How many times larger the curls of each lock are than the prototype's, (W,): as often smaller as larger."""
    return np.exp(variety * np.clip(rng.standard_normal(wisps), -_FARTHEST, _FARTHEST))


def _enlarged(offsets: Singles, larger: Floats, count: int) -> Singles:
    """The first ``count`` of details, (W, n, 3), each strand's ``larger``, (W,), in all directions."""
    if (larger == 1.0).all():
        return offsets[:, :count]
    at = np.arange(count) / larger[:, None]
    before = at.astype(np.int64)
    part = (at - before).astype(np.float32)[..., None]
    strand = np.arange(len(offsets))[:, None]
    between = (1 - part) * offsets[strand, before] + part * offsets[strand, before + 1]
    return between * larger.astype(np.float32)[:, None, None]


def _onset(along: Floats, straight: Floats) -> Singles:
    """The part of their size that details have at distances from the root [m], (n,), on strands whose roots are straight
    for a way [m], (W,): (W, n).
    """
    return smoothstep(along / np.maximum(straight, 1e-9)[:, None]).astype(np.float32)
