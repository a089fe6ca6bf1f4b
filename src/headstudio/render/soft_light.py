"""Soft light at a place, by direction: a mean, a slope and a bend for each colour (harmonics up to the second degree).

Light that comes through hair comes by the shortest ways, from both sides of a curtain: its mean is less than what
comes straight on, and it has no slope. Strands pass light straight on, and so they show the difference.

A light is nine numbers: mean, slope along x, y and z, and xx, yy, xy, xz and yz of the bend Q, a symmetric matrix without
trace: radiance from the unit direction d is mean + slope . d + d . Q d. With them goes how much hair there is in each
direction, a mean and a slope, for hair sends light back, too (common/soft_light.glsl).
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats

NUMBERS = 8
"""How many times four numbers a light is: of red, green and blue the mean and slope, three times four of the bend, the fifth
of all three, and the hair."""


def terms(directions: Floats) -> Floats:
    """What each of the nine numbers adds to the radiance from unit directions, (..., 3): (..., 9)."""
    x, y, z = np.moveaxis(directions, -1, 0)
    bend = [x * x - z * z, y * y - z * z, 2 * x * y, 2 * x * z, 2 * y * z]
    return np.stack([np.ones_like(x), x, y, z, *bend], axis=-1)


def weights(directions: Floats) -> Floats:
    """How much radiance from each of some directions, (n, 3), of which every other is opposite to the one before, counts in
    the nine numbers: (n, 9).

    Least squares. Fewer than six pairs do not say what the bend is: then it is the smallest that fits, and even light is
    even in any case.
    """
    basis = terms(directions)
    slope = np.linalg.pinv(basis[:, 1:4]).T
    even = basis[:, 4:]
    bend = np.linalg.pinv(even - even.mean(axis=0)).T
    mean = 1 / len(directions) - bend @ even.mean(axis=0)
    return np.column_stack([mean, slope, bend])


def irradiance(light: Floats, normals: Floats) -> Floats:
    """What falls on surfaces with these unit normals, (n, 3), in light as SkyLight.gather says, (n, 8, 4): linear RGB, (n, 3).

    The harmonics of a clamped cosine: Ramamoorthi, Hanrahan 2001.
    """
    falls = np.pi * np.repeat([1.0, 2 / 3, 1 / 4], [1, 3, 5]) * terms(normals)
    first, bend, last = light[:, :3], light[:, 3:6], light[:, 6, :3]
    sum_ = (
        np.einsum("nci,ni->nc", first, falls[:, :4])
        + np.einsum("nci,ni->nc", bend, falls[:, 4:8])
        + last * falls[:, 8:]
    )
    return np.maximum(sum_, 0.0)
