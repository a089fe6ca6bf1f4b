"""What is worn in a hairstyle: the accessories and the elastics of ties and braids, as meshes with their colours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..head.mesh import TriangleMesh
from .accessories import Accessory, accessory_mesh, ring
from .elastics import Elastic
from .surroundings import Surroundings

_THICKNESS = 0.3  # of an elastic, in its radius


@dataclass(frozen=True, eq=False)
class Adornment:
    """A closed mesh in the head frame [m] and its colour, sRGB."""

    mesh: TriangleMesh
    colour: tuple[float, float, float]


def adorn(
    accessories: Sequence[Accessory], elastics: Sequence[Elastic], surroundings: Surroundings
) -> tuple[Adornment, ...]:
    """Everything worn on the head of ``surroundings``: ``accessories``, and those of ``elastics`` that are seen."""
    worn = [Adornment(accessory_mesh(item, surroundings), item.colour) for item in accessories]
    for elastic in elastics:
        if elastic.colour is not None:
            mesh = ring(elastic.middle, elastic.axis, elastic.radius, _THICKNESS * elastic.radius)
            worn.append(Adornment(mesh, elastic.colour))
    return tuple(worn)
