"""Finds shaders and assets, in a checkout and in an installed wheel.

In the wheel they lie inside the package (``headstudio/_data``); in a checkout they stand at the top of the tree.
"""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


class ResourceError(FileNotFoundError):
    """A file that ships with headstudio is not there: the installation is damaged."""


def _find(folder: str, name: str) -> Path:
    for base in (_PACKAGE / "_data", _PACKAGE.parents[1]):
        path = base / folder / name
        if path.exists():
            return path
    raise ResourceError(f"{folder}/{name} is missing from this installation of headstudio; install it again")


def shader(name: str) -> Path:
    """The path of a shader, for example ``shader("hair/splat.vert")``. Raises ResourceError if it is not there."""
    return _find("shaders", name)


def asset(name: str) -> Path:
    """The path of an asset, for example ``asset("textures/strands.png")``. Raises ResourceError if it is not there."""
    return _find("assets", name)
