"""Accessories, as an artist writes them down and as meshes (Choe, Ko 2005, section 6.2). Only bands press on hair."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ..head.mesh import Floats, TriangleMesh
from ..head.rows import row_unit
from ..head.smooth import smoothstep
from ..params import colour, number
from .operations import Place
from .paths import STEP, along_skin, at_height, off_skin, outward, sideways
from .surroundings import Surroundings
from .sweep import closed_tube, joined, ribbon_strip, tube

_BAND_BOW = 0.015  # over which a band is smooth [m]
_NARROW, _TAPER = 0.35, 0.08  # a band's width at its ends, as a part of that on top, and how far up it tapers [m]


@dataclass(frozen=True)
class Band:
    """A band over the head from ear to ear. lean: where on top it lies, 0 over the ears, 1 at the forehead."""

    lean: float = number(0.35, "Lean", "", -0.6, 0.8, "Where the band crosses the top: 0 over the ears, 0.8 in front.")
    width: float = number(0.014, "Width", "m", 0.002, 0.06, "Width of the band.", shown="mm")
    lift: float = number(0.010, "Lift", "m", 0.0, 0.06, "How far above the skin it lies, on the hair.", shown="mm")
    colour: tuple[float, float, float] = colour("#8c2f39", "Colour", "Colour of the band.")


@dataclass(frozen=True)
class Pin:
    """A hairpin at a place, pointing along a direction in proportions of the head."""

    place: Place = (0.9, 0.45, 0.3)
    direction: Place = (0.0, 0.3, -1.0)
    length: float = number(0.05, "Length", "m", 0.01, 0.15, "Length of the pin.", shown="mm")
    lift: float = number(0.010, "Lift", "m", 0.0, 0.06, "How far above the skin it lies, on the hair.", shown="mm")
    colour: tuple[float, float, float] = colour("#2b2b2e", "Colour", "Colour of the pin.")


@dataclass(frozen=True)
class Ribbon:
    """A ribbon tied to a bow at a place."""

    place: Place = (0.0, 0.45, -1.3)
    width: float = number(0.11, "Width", "m", 0.02, 0.4, "Width of the bow.", shown="mm")
    lift: float = number(0.012, "Lift", "m", 0.0, 0.1, "How far above the skin it sits, on the hair.", shown="mm")
    colour: tuple[float, float, float] = colour("#a63d57", "Colour", "Colour of the ribbon.")


@dataclass(frozen=True)
class HairTie:
    """A ring around tied hair at a place, square to a direction in proportions of the head; without any, to the skin."""

    place: Place = (0.0, 0.45, -1.15)
    direction: Place = (0.0, 0.0, 0.0)
    radius: float = number(0.014, "Radius", "m", 0.003, 0.08, "Radius of what it holds.", shown="mm")
    thickness: float = number(0.004, "Thickness", "m", 0.001, 0.02, "Thickness of the ring.", shown="mm")
    colour: tuple[float, float, float] = colour("#33272a", "Colour", "Colour of the ring.")


Accessory = Band | Pin | Ribbon | HairTie


@singledispatch
def accessory_mesh(accessory: object, surroundings: Surroundings) -> TriangleMesh:
    """The closed mesh of ``accessory`` on the head of ``surroundings`` [m], in the head frame."""
    raise TypeError(f"{accessory!r} is no accessory")


def band_path(band: Band, surroundings: Surroundings) -> Floats:
    """The middle of a band [m], (n, 3), from behind one ear to behind the other."""
    angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 9)
    # A half circle around the skull that leans forward as it rises, and passes behind the ears where it ends.
    rise = np.cos(angle)
    places = np.stack(
        [1.05 * np.sin(angle), 1.1 * rise - 0.7 * (1 - rise), band.lean * rise - 0.45 * (1 - rise)], axis=1
    )
    path = at_height(surroundings, along_skin(surroundings, places, band.lift), band.lift)
    # A band is stiff: it goes in one bow over what lies under it.
    return gaussian_filter1d(path, _BAND_BOW / STEP, axis=0, mode="nearest")


@accessory_mesh.register
def _band(band: Band, surroundings: Surroundings) -> TriangleMesh:
    path = band_path(band, surroundings)
    _, away = sideways(surroundings, off_skin(surroundings, path, 0.8 * band.lift))
    to_end = STEP * np.minimum(np.arange(len(path)), np.arange(len(path))[::-1])
    width = band.width * (_NARROW + (1.0 - _NARROW) * smoothstep(to_end, 0.0, _TAPER))
    return ribbon_strip(path, away, width, 0.0025)


@accessory_mesh.register
def _pin(pin: Pin, surroundings: Surroundings) -> TriangleMesh:
    middle, away = _on_hair(surroundings, pin.place, pin.lift)
    along = _along_skin(np.array(pin.direction) * surroundings.proportions.extent, away)
    side = np.cross(away, along)
    run = np.linspace(-0.5, 0.5, 24)[:, None] * pin.length
    # Two prongs that lie side by side, and bend as the head does.
    prongs = [middle + run * along + gap * side for gap in (-0.0018, 0.0018)]
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 9)[1:-1, None]
    bow = middle + 0.5 * pin.length * along + 0.0018 * (np.sin(turn) * side + np.cos(turn) * along)
    path = off_skin(surroundings, np.concatenate([prongs[0], bow, prongs[1][::-1]]), pin.lift)
    return tube(path, np.full(len(path), 0.0009))


@accessory_mesh.register
def _ribbon(ribbon: Ribbon, surroundings: Surroundings) -> TriangleMesh:
    middle, away = _on_hair(surroundings, ribbon.place, ribbon.lift)
    up = _along_skin(np.array([0.0, 1.0, 0.0]), away)
    side = np.cross(up, away)
    size = 0.5 * ribbon.width
    pieces = []
    for sign in (-1.0, 1.0):
        turn = np.linspace(0.0, 2 * np.pi, 33)
        # A loop seen from the edge is a drop lying on its side; its cloth is wide outside and gathered in the knot.
        across = sign * size * 0.5 * (1 - np.cos(turn))
        high = 0.3 * size * np.sin(turn)
        droop = -0.18 * size * 0.5 * (1 - np.cos(turn))
        loop = middle + across[:, None] * side + high[:, None] * away + droop[:, None] * up
        normal = np.cos(turn)[:, None] * away - sign * np.sin(turn)[:, None] * side
        pieces.append(ribbon_strip(loop, normal, size * (0.22 + 0.5 * np.sin(0.5 * turn) ** 2), 0.0008))
        fall = np.linspace(0.0, 1.0, 20)
        tail = middle + (sign * 0.45 * size * fall)[:, None] * side - (1.1 * size * fall**1.2)[:, None] * up
        tail = off_skin(
            surroundings, tail + (0.05 * size * np.sin(2 * np.pi * fall))[:, None] * away, 0.3 * ribbon.lift
        )
        pieces.append(ribbon_strip(tail, np.broadcast_to(away, tail.shape), size * (0.2 + 0.25 * fall), 0.0008))
    knot = middle + np.linspace(-0.14, 0.14, 9)[:, None] * size * up
    pieces.append(tube(knot, 0.13 * size * np.sqrt(1.02 - np.linspace(-1, 1, 9) ** 2)))
    return joined(pieces)


@accessory_mesh.register
def _hair_tie(tie: HairTie, surroundings: Surroundings) -> TriangleMesh:
    middle, away = _on_hair(surroundings, tie.place, tie.radius)
    axis = row_unit((np.array(tie.direction) * surroundings.proportions.extent)[None], otherwise=away[None])[0]
    return ring(middle, axis, tie.radius, tie.thickness)


def ring(middle: Floats, axis: Floats, radius: float, thickness: float) -> TriangleMesh:
    """A ring of ``thickness`` around ``middle``, (3,), square to ``axis``, (3,), with ``radius``, all [m]."""
    least = np.eye(3)[np.abs(axis).argmin()]
    side = row_unit(np.cross(axis, least)[None], otherwise=least[None])[0]
    turn = np.linspace(0.0, 2 * np.pi, 49)[:-1, None]
    return closed_tube(middle + radius * (np.cos(turn) * side + np.sin(turn) * np.cross(axis, side)), 0.5 * thickness)


def _on_hair(surroundings: Surroundings, place: Place, lift: float) -> tuple[Floats, Floats]:
    """A place at least ``lift`` [m] off the skin [m], (3,), and the direction away from the skin there, (3,)."""
    point = off_skin(surroundings, surroundings.proportions.place(np.array(place))[None], lift)
    return point[0], outward(surroundings, point)[0]


def _along_skin(direction: Floats, away: Floats) -> Floats:
    """The unit direction along the skin that is nearest to ``direction``, (3,)."""
    along = direction - (direction @ away) * away
    return row_unit(along[None], otherwise=np.cross(away, np.eye(3)[np.abs(away).argmin()])[None])[0]
