"""A scalp, a body and small heads of hair about which everything is known beforehand."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import trimesh

from headstudio.head.contact import ContactField
from headstudio.head.mesh import TriangleMesh
from headstudio.lcp.body import Body
from headstudio.lcp.model import HairModel

CENTRE = np.array([0.0, 0.08, 0.0])
RADIUS = 0.1


@dataclass(frozen=True)
class DomeScalp:
    """Part of a sphere, with the methods that hair needs of a Scalp.

    u runs along the axis from right to left and v around it from front to nape. By Archimedes, a sphere and its cylinder
    have the same area, so equal areas of the square are equal areas of skin.
    """

    half_width: float = 0.75
    front: float = math.radians(55)
    back: float = math.radians(-95)
    shortest: float = 1.0

    @property
    def area(self):
        return RADIUS**2 * 2 * self.half_width * (self.front - self.back)

    def normals(self, uv):
        x = self.half_width * (2 * uv[:, 0] - 1)
        turn = self.front + (self.back - self.front) * uv[:, 1]
        around = np.sqrt(1 - x * x)
        return np.stack([x, around * np.cos(turn), around * np.sin(turn)], axis=1)

    def points(self, uv):
        return CENTRE + RADIUS * self.normals(uv)

    def root_directions(self, uv, lie_down, stand_up):
        """Eq. 4 with a whorl at the top."""
        n = self.normals(uv)
        top = np.array([0.0, 1.0, 0.0])
        t = -lie_down * (top - (n @ top)[:, None] * n) + stand_up * n
        return t / np.linalg.norm(t, axis=1, keepdims=True)

    def lengths(self, uv):
        return self.shortest + (1 - self.shortest) * uv[:, 1]

    def random_points(self, count, rng):
        return rng.random((count, 2))


def ball_mesh(radius=RADIUS, centre=CENTRE, subdivisions=4):
    ball = trimesh.creation.icosphere(subdivisions=subdivisions, radius=radius)
    return TriangleMesh(np.asarray(ball.vertices) + centre, np.asarray(ball.faces))


def ball_body():
    """The sphere under the dome, as hair feels it."""
    return Body(ContactField.around(ball_mesh(), 0.014))


def no_body():
    """A body too far away to meet."""
    return Body(ContactField.around(ball_mesh(centre=np.full(3, 1000.0), subdivisions=2), 0.014))


def hair_of(positions, directions, pairs, *, fixed=(0,), smoothing_length_links=0.02, mass=1e-4, arc_length=None):
    """Hair made by hand: links as given, rootward first, with the rest state measured in the plainest way."""
    positions, directions = np.asarray(positions, float), np.asarray(directions, float)
    pairs = np.asarray(pairs, dtype=np.int64).reshape(-1, 2)
    count = len(positions)
    held = np.zeros(count, dtype=bool)
    held[list(fixed)] = True
    x = positions[pairs[:, 1]] - positions[pairs[:, 0]]
    length = np.linalg.norm(x, axis=1)
    unit = x / np.maximum(length, 1e-12)[:, None]
    cosines = np.column_stack(
        [np.sum(directions[pairs[:, 0]] * unit, axis=1), -np.sum(directions[pairs[:, 1]] * unit, axis=1)]
    )
    aligned = np.abs(cosines[:, 0] - cosines[:, 1]) / 2
    lifeline = np.full(count, -1)
    for k, (_, tipward) in enumerate(pairs):
        lifeline[tipward] = k
    if arc_length is None:
        arc_length = np.where(held, -0.005, 1.0)
    return HairModel(
        coordinates=np.column_stack([np.full((count, 2), 0.5), arc_length]),
        root_points=np.broadcast_to(positions[0], positions.shape).copy(),
        rest_positions=positions,
        rest_directions=directions,
        mass=np.full(count, mass),
        fixed=held,
        links=pairs,
        rest_length=length,
        alignment=aligned,
        strength=aligned * length,
        rest_cosine=cosines,
        lifeline=lifeline,
        smoothing_length_links=smoothing_length_links,
        smoothing_length=0.01,
        spacing=0.01,
        rest_density=np.full(count, mass / 0.01**3),
        rest_clearance=np.full(count, np.inf),
        bending_length=0.04,
    )


def hanging_chain(count=8, spacing=0.01, **options):
    """Particles one below the other, the first one fixed: what the paper's figure 1 (c) calls traditional."""
    positions = np.outer(np.arange(count), [0.0, -spacing, 0.0])
    directions = np.tile([0.0, -1.0, 0.0], (count, 1))
    pairs = np.column_stack([np.arange(count - 1), np.arange(1, count)])
    return hair_of(positions, directions, pairs, **options)


def bundle(strands=3, joints=6, spacing=0.01):
    """Parallel strands that hang down, each particle linked to all those one joint further along."""
    grid = np.array([[s, -j, 0] for j in range(joints) for s in range(strands)], dtype=float) * spacing
    pairs = [
        (j * strands + s, (j + 1) * strands + t)
        for j in range(joints - 1)
        for s in range(strands)
        for t in range(strands)
    ]
    directions = np.tile([0.0, -1.0, 0.0], (len(grid), 1))
    return hair_of(grid, directions, pairs, fixed=range(strands), smoothing_length_links=1.3 * spacing)
