"""Fine wrinkles of a body part: two height fields, pores, and how the fields rise and fall as the skin moves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..head import length_maps
from ..head.mesh import Floats, Ints
from . import pores
from .carving import CarvedField, carve
from .direction_field import DirectionField, interpolate
from .fine_growth import FineGrowth
from .fine_guides import FIELDS, FineGuides
from .fine_settings import FineSettings
from .laws import LAWS
from .metric import perpendicular, vertex_metrics
from .seams import SharedSkin
from .shrinkage import shrinkage_gauge
from .texels import TexelMap, texel_map
from .texture_map import TextureMap

# Below this part of the full depth nothing is carved: palms and soles.
_BARE = 1e-3
# How much finer or coarser than the mean a map may be somewhere.
_LOCAL = 0.25, 4.0


@dataclass(frozen=True, eq=False)
class FineWrinkles:
    """What is drawn as bumps on the skin: Bando's thesis, section 2.6.

    The height of the skin is the sum of amplitude times height over both fields, and the pores. Images have row 0 at
    v = 0. fields: directions and magnitudes. carved: furrows. heights: of the fields at full amplitude, (2, size, size)
    [m]. pores: (size, size) [m]. initial_amplitude: r of eq. 2.4.
    """

    texels: TexelMap
    fields: tuple[DirectionField, ...]
    carved: tuple[CarvedField, ...]
    heights: NDArray[np.float32]
    pores: NDArray[np.float32]
    initial_amplitude: float

    @cached_property
    def growth(self) -> FineGrowth:
        """What measures how far they are out."""
        texture_map = self.texels.map
        everywhere, metrics = np.arange(len(texture_map.uv)), vertex_metrics(texture_map)
        across = (perpendicular(field.directions, metrics) for field in self.fields)
        return FineGrowth(
            tuple(shrinkage_gauge(texture_map, everywhere, each) for each in across), self.initial_amplitude
        )


def grow_fine_wrinkles(
    texture_map: TextureMap,
    settings: FineSettings,
    guides: FineGuides,
    beside: tuple[FineWrinkles, SharedSkin] | None = None,
) -> FineWrinkles:
    """Carve both fields of a body part. The same settings give the same furrows.

    guides: of its shape, see ``face_guides`` and ``limb_guides``. beside: wrinkles of a neighbouring part and the skin
    that both share, whose directions, furrows and pores are taken over as they are; furrows of the neighbour grow on.
    """
    texels = texel_map(texture_map, settings.texture_size)
    strength = _strength(texels, settings, guides)
    strip = beside[1].strip(texels) if beside else np.zeros_like(texels.mapped)
    open_texels = texels.without((strength < _BARE) | strip)
    vectors = direction_vectors(texture_map, settings, guides, beside)
    texel = local_texel(texels)
    units = np.maximum(settings.unit / texel, 1.0)
    fields = tuple(DirectionField(open_texels, field, units) for field in vectors)
    seeds = np.random.SeedSequence(settings.seed).spawn(FIELDS + 1)
    carved = tuple(
        carve(
            field,
            LAWS[settings.laws],
            depth=settings.depth,
            roundness=settings.roundness,
            seed=seeds[k],
            onward=beside[1].onward(beside[0].carved[k], open_texels) if beside else None,
        )
        for k, field in enumerate(fields)
    )
    heights = np.stack([field.height * strength for field in carved]).astype(np.float32)
    dimples = pores.dimples(
        open_texels,
        settings.pores * guides.pores,
        diameter=settings.pore_size / texel,
        depth=settings.pore_depth,
        rng=np.random.default_rng(seeds[FIELDS]),
    )
    if beside:
        neighbour, shared = beside
        for mine, theirs in zip((*heights, dimples), (*neighbour.heights, neighbour.pores)):
            mine[strip] = shared.copied(theirs, neighbour.texels, texels)
    return FineWrinkles(texels, fields, carved, heights, dimples, settings.initial_amplitude)


def direction_vectors(
    texture_map: TextureMap,
    settings: FineSettings,
    guides: FineGuides,
    beside: tuple[FineWrinkles, SharedSkin] | None = None,
) -> Floats:
    """The direction vectors of both fields at every vertex, in texture space, (2, n, 2); see ``grow_fine_wrinkles``.

    A field for which the artist has set vectors follows these, the other one the guides.
    """
    placed = guides.vectors(texture_map, settings.crossing)
    fields = []
    for k in range(FIELDS):
        own = np.array([vector[1:] for vector in settings.vectors if vector.field == k])
        vertices, vectors = guides.vertices, placed[k]
        if len(own):
            vertices, vectors = nearest_vertices(texture_map, own[:, :2]), own[:, 2:]
        vectors = settings.strength * vectors
        if beside:
            shared_vertices, shared_vectors = beside[1].vectors(
                beside[0].fields[k].vectors, beside[0].texels.map, texture_map
            )
            outside = ~np.isin(vertices, shared_vertices)
            vertices = np.concatenate([vertices[outside], shared_vertices])
            vectors = np.concatenate([vectors[outside], shared_vectors])
        fields.append(interpolate(texture_map, vertices, vectors))
    return np.stack(fields)


def local_texel(texels: TexelMap) -> Floats:
    """Edge of a texel on the skin at every vertex [m], (n,): furrows are of one size on the skin, however it is mapped.

    The mean of the longest and the shortest way across; within bounds, since a needle at the border has no size.
    """
    squared = np.sqrt(np.linalg.det(vertex_metrics(texels.map)))
    return np.sqrt(squared).clip(*(bound * texels.map.metres for bound in _LOCAL)) / texels.size


def nearest_vertices(texture_map: TextureMap, uv: Floats) -> Ints:
    """The vertex nearest to each point of texture space, (k, 2), around the seam too: (k,)."""
    used = np.unique(texture_map.mesh.faces)
    places = texture_map.uv[used]
    turns = (-1, 0, 1) if texture_map.wrapped else (0,)
    copies = np.concatenate([places + np.array([turn, 0]) for turn in turns])
    found = cKDTree(copies).query(uv)[1]
    nearest: Ints = used[found % len(used)]
    return nearest


def _strength(texels: TexelMap, settings: FineSettings, guides: FineGuides) -> Floats:
    """Part of the depth of furrows that each texel gets, (size, size); off the mesh, where they run out, all of it."""
    strength = np.where(texels.mapped, texels.spread(guides.furrowed), 1.0)
    if settings.painted_strength is not None:
        everywhere = texels.centres(np.arange(texels.size**2)) / texels.size
        strength *= length_maps.sample(settings.painted_strength, everywhere).reshape(strength.shape)
    return strength
