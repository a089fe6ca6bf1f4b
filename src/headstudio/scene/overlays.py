"""What is drawn on top of the picture for whoever tunes the simulation: springs, particles, contact planes and air."""

from __future__ import annotations

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..lcp.body import Body
from ..lcp.wind import AirState
from .settings import Look
from .stage import NO_OVERLAYS, HairOnStage, Overlays

# Linear colours. A spring is gray at its rest length, red when stretched and blue when compressed by _FULL_STRAIN.
_SLACK, _STRETCHED, _COMPRESSED = np.array([0.35, 0.35, 0.35]), np.array([1.0, 0.08, 0.03]), np.array([0.05, 0.25, 1.0])
_FULL_STRAIN = 0.1
_PARTICLE, _DIRECTION = np.array([1.0, 0.75, 0.2]), np.array([0.8, 0.35, 0.1])
_PLANE = np.array([0.1, 0.8, 0.45])
_AIR = np.array([0.35, 0.7, 1.0])

_DIRECTION_LENGTH = 0.5  # of the mean distance of particles
_PLANE_SIZE = 0.4  # of it, from the middle of a plane to its edge
_AIR_TIME = 0.01  # [s]: a particle of air trails as far as it flies in this time

# Segments (k, 2, 3) with colours (k, 3), or points (p, 3) with colours (p, 3).
_Marks = tuple[Floats, Floats]


def overlays_of(look: Look, hair: HairOnStage, body: Body, frame: HeadFrame, air: AirState) -> Overlays:
    """The marks that ``look`` asks for, in the world [m]."""
    segments: list[_Marks] = []
    points: list[_Marks] = []
    if look.show_links:
        segments.append(_springs(hair, frame))
    if look.show_particles:
        points.append(_coloured(frame.to_world(hair.positions), _PARTICLE))
        segments.append(_directions(hair, frame))
    if look.show_contact:
        segments.append(_planes(hair, body, frame))
    if look.show_wind and len(air.positions):
        points.append(_coloured(air.positions, _AIR))
        trails = np.stack([air.positions, air.positions - _AIR_TIME * air.velocities], axis=1)
        segments.append(_coloured(trails, 0.5 * _AIR))
    if not segments and not points:
        return NO_OVERLAYS
    lines, line_colours = _joined(segments, (0, 2, 3))
    places, place_colours = _joined(points, (0, 3))
    return Overlays(lines, line_colours, places, place_colours)


def _springs(hair: HairOnStage, frame: HeadFrame) -> _Marks:
    world = frame.to_world(hair.positions)
    ends = world[hair.model.links]
    strain = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) / hair.model.rest_length - 1.0
    pull = np.clip(strain / _FULL_STRAIN, -1.0, 1.0)[:, None]
    colours = _SLACK + np.maximum(pull, 0) * (_STRETCHED - _SLACK) + np.maximum(-pull, 0) * (_COMPRESSED - _SLACK)
    return ends, colours


def _directions(hair: HairOnStage, frame: HeadFrame) -> _Marks:
    tips = hair.positions + _DIRECTION_LENGTH * hair.model.spacing * hair.directions
    return _coloured(np.stack([frame.to_world(hair.positions), frame.to_world(tips)], axis=1), _DIRECTION)


def _planes(hair: HairOnStage, body: Body, frame: HeadFrame) -> _Marks:
    """A square on the plane (thesis, eq. 3.19) below every particle that touches it or nearly does."""
    planes = body.planes(hair.positions, frame)
    near = np.abs(planes.distance) < hair.model.spacing
    normal = planes.normals[near]
    foot = hair.positions[near] - planes.distance[near, None] * normal
    # Any direction along the plane: across the axis that the normal is farthest from.
    along = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal), axis=1)])
    along *= _PLANE_SIZE * hair.model.spacing / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    across = np.cross(normal, along)
    corners = foot[:, None] + np.stack([along + across, along - across, -along - across, across - along], axis=1)
    edges = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 3)
    return _coloured(frame.to_world(edges).reshape(-1, 2, 3), _PLANE)


def _coloured(marks: Floats, colour: Floats) -> _Marks:
    return marks, np.broadcast_to(colour, (len(marks), 3))


def _joined(marks: list[_Marks], empty: tuple[int, ...]) -> _Marks:
    places = np.concatenate([places for places, _ in marks] or [np.zeros(empty)])
    return places, np.concatenate([colours for _, colours in marks] or [np.zeros((0, 3))])
