"""What is worn in a hairstyle: the accessories and the elastics of ties and braids, as meshes with their colours."""

from __future__ import annotations

from dataclasses import dataclass

from ..head.mesh import TriangleMesh
from .accessories import accessory_mesh, ring
from .hairdressing import elastic_of
from .styling_settings import StylingSettings
from .surroundings import Surroundings


@dataclass(frozen=True, eq=False)
class Adornment:
    """A closed mesh in the head frame [m] and its colour, sRGB."""

    mesh: TriangleMesh
    colour: tuple[float, float, float]


def adorn(styling: StylingSettings, surroundings: Surroundings, longest: float) -> tuple[Adornment, ...]:
    """Everything worn in hair of at most ``longest`` [m] that is styled by ``styling`` on the head of ``surroundings``."""
    worn = [Adornment(accessory_mesh(item, surroundings), item.colour) for item in styling.accessories]
    for operation in styling.operations:
        elastic = elastic_of(operation, surroundings, longest)
        if elastic is not None:
            mesh = ring(elastic.middle, elastic.axis, elastic.radius, 0.3 * elastic.radius)
            worn.append(Adornment(mesh, elastic.colour))
    return tuple(worn)
