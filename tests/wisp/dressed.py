"""Hair at rest on the mannequin, made without the rest of the styler."""

from functools import lru_cache

import numpy as np

from headstudio.head.head import Head
from headstudio.head.load import load_head
from headstudio.head.rows import row_unit
from headstudio.head.scalp import Scalp, grow_scalp
from headstudio.head.scalp_settings import ScalpSettings
from headstudio.wisp.deform import deform
from headstudio.wisp.field import force_field
from headstudio.wisp.force import ForceField
from headstudio.wisp.outlines import Outlines
from headstudio.wisp.styling_settings import StylingSettings
from headstudio.wisp.surroundings import Surroundings


@lru_cache(maxsize=2)
def body(name: str = "mannequin") -> tuple[Head, Scalp, Surroundings]:
    """A head, its scalp and the space around it."""
    head = load_head(name)
    return head, grow_scalp(head, ScalpSettings()), Surroundings.around(head)


def hair(scalp: Scalp, wisps: int = 300, length: float = 0.3, segment: float = 0.01, seed: int = 3) -> Outlines:
    """Straight outlines of equal length on random roots, leaning away from the whorl; 100,000 strands in all."""
    uv = scalp.random_points(wisps, np.random.default_rng(seed))
    along = scalp.root_directions(uv, 1.0, 1.0)
    across = row_unit(np.cross(along, np.eye(3)[np.abs(along).argmin(axis=1)]), otherwise=along)
    frame = np.stack([across, np.cross(along, across), along], axis=2)
    joints = round(length / segment)
    return Outlines(
        roots=scalp.points(uv),
        segment=segment,
        counts=np.full(wisps, joints),
        frames=np.repeat(frame[:, None], joints, axis=1),
        radii=np.full((wisps, joints + 1), 0.006),
        strands=np.full(wisps, 100_000 // wisps),
    )


def styled(outlines: Outlines, name: str = "mannequin", **settings: object):
    """``outlines`` deformed under gravity and ``settings`` alone: outlines and report."""
    _, scalp, surroundings = body(name)
    return deform(outlines, surroundings, plain_styling(**settings), scalp)


def plain_styling(**settings: object) -> StylingSettings:
    """``settings`` over gravity alone: hair that nobody has parted or taken off the face."""
    return StylingSettings(
        **{"parted": 0.0, "parting": 0.0, "off_face": 0.0, "close": 0.0, "off_shoulders": 0.0, **settings}
    )


def weight(name: str = "mannequin") -> ForceField:
    """The force on hair around a head where nothing but gravity pulls."""
    return force_field(plain_styling(), body(name)[2])
