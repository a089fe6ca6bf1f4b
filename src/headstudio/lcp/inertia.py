"""What hair feels because its head moves: Bando et al. 2006, section 3.5.

Particles are followed in the frame of the head, so a moving head shows as forces and never as jumps of position.
"""

from __future__ import annotations

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..head.rows import cross_matrix, mapped


def apparent_acceleration(frame: HeadFrame, positions: Floats, velocities: Floats, gravity: float) -> Floats:
    """Gravity, and the translational, Euler, centrifugal and Coriolis accelerations [m/s^2], (n, 3).

    positions [m] and velocities [m/s] in the head frame, (n, 3). gravity: [m/s^2], downward in the world.
    """
    falling = (np.array([0.0, -gravity, 0.0]) - frame.acceleration) @ frame.axes
    spin = frame.angular_velocity @ frame.axes
    spin_change = frame.angular_acceleration @ frame.axes
    # One matrix for Euler and centrifugal, one for Coriolis: x -> a x is a cross product.
    turning = cross_matrix(spin)
    by_position = -cross_matrix(spin_change) - turning @ turning
    return falling + mapped(positions, by_position) + mapped(velocities, -2.0 * turning)
