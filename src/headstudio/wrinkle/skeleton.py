"""Moving skin by the joints under it: forward kinematics and linear blend skinning (thesis, section 2.5.2)."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from ..head.mesh import Floats
from ..head.rig import Rig


def joint_motions(rig: Rig, turns: Floats) -> Floats:
    """Where every joint takes what hangs on it: matrices (j, 3, 4) from rest to the pose.

    turns: rotation vector of every joint about where it rests, in the axes of the rest pose [rad], (j, 3); what hangs
    on a joint turns with it.
    """
    rotations = Rotation.from_rotvec(turns).as_matrix()
    motions = np.empty((len(rig.names), 3, 4))
    for joint, parent in enumerate(rig.parents):
        at = rig.positions[joint]
        own = np.column_stack([rotations[joint], at - rotations[joint] @ at])
        motions[joint] = own if parent < 0 else _after(motions[parent], own)
    return motions


def skinned(rig: Rig, vertices: Floats, motions: Floats) -> Floats:
    """Vertices at rest [m], (n, 3), moved by the mean of their joints' motions, (j, 3, 4), by weight: (n, 3)."""
    blended = (rig.weights @ motions.reshape(-1, 12)).reshape(-1, 3, 4)
    moved: Floats = np.einsum("nij,nj->ni", blended[:, :, :3], vertices) + blended[:, :, 3]
    return moved


def _after(outer: Floats, inner: Floats) -> Floats:
    """The motion ``inner`` and then ``outer``, (3, 4) each."""
    return np.column_stack([outer[:, :3] @ inner[:, :3], outer[:, :3] @ inner[:, 3] + outer[:, 3]])
