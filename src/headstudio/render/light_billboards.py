"""Particles as the light sees them: flat billboards on the texels of the light map, nearest to the light first."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..lcp.model import HairModel
from ..scene.settings import Look
from .strand_texture import STRIP_WIDTH
from .strands import HairCurves
from .view import View

BILLBOARD_DTYPE = np.dtype(
    [
        ("centre", "f4", 2),
        ("axis", "f4", 2),
        ("half_width", "f4"),
        ("half_length", "f4"),
        ("opacity", "f4"),
        ("window", "f4"),
        ("depth", "f4"),
        ("particle", "f4"),
        ("window_width", "f4"),
        ("_unused", "f4"),
    ]
)
"""Three RGBA texels. centre, half_width and half_length in texels of the light map; axis: unit, along the hair as
projected; opacity in the middle; where in the strand texture its window is, and how wide; depth 0 to 1 in the light's
box; particle: index."""

LEAST_SINE = 0.3
"""Seen end-on a billboard would be infinitely thin and opaque: sin(theta) is bounded from below."""


def opacity_scale(cosine: NDArray[np.float64], opacity: float) -> NDArray[np.float64]:
    """Opacity of billboards whose hair makes an angle of this cosine with the direction of projection.

    Bando et al. 2006, section 4: scaled by 1/sin(theta); sin(theta) >= LEAST_SINE, and never above 1.
    """
    sine = np.sqrt(np.clip(1 - cosine**2, LEAST_SINE**2, 1.0))
    return np.minimum(opacity / sine, 1.0)


def light_billboards(
    curves: HairCurves, model: HairModel, windows: NDArray[np.float64], light: View, look: Look, size: int
) -> NDArray[np.void]:
    """The billboards of all particles in ascending depth from the light (thesis 3.4, line 7), of BILLBOARD_DTYPE, (n,).

    ``windows``: place of each particle in the strand texture, 0 to 1, (n,). ``size``: texels a side of the light map.
    """
    depth = light.depth(curves.position)
    order = np.argsort(depth, kind="stable")
    position, direction = curves.position[order], curves.direction[order]
    texels = size / light.far
    half_width = 0.5 * look.billboard_width * model.spacing * texels

    axis = np.stack([direction @ light.right, direction @ light.up], axis=1)
    sine = np.sqrt(np.einsum("ni,ni->n", axis, axis))
    axis = np.where(sine[:, None] > 1e-6, axis / np.maximum(sine, 1e-6)[:, None], [0.0, 1.0])

    out = np.zeros(len(order), BILLBOARD_DTYPE)
    centre = np.stack([(position - light.eye) @ light.right, (position - light.eye) @ light.up], axis=1)
    out["centre"] = centre * texels + 0.5 * size
    out["axis"] = axis
    out["half_width"] = half_width
    out["half_length"] = half_width * look.billboard_stretch * np.maximum(sine, LEAST_SINE)
    # Of the light that meets strands some goes on through them; hair that is not drawn casts no shadow.
    stopped = look.hair_opacity * (1.0 - look.forward_scatter)
    out["opacity"] = opacity_scale(direction @ light.forward, stopped) * curves.grown[order, -1]
    out["window"] = windows[order]
    out["window_width"] = look.billboard_width * model.spacing / STRIP_WIDTH
    out["depth"] = depth[order] / light.far
    out["particle"] = order
    return out
