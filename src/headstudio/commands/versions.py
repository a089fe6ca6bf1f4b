"""The versions that decide the numbers a run gives."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

from .. import __version__

COMPUTING = ("numpy", "scipy", "libigl", "trimesh", "moderngl", "anny")


def versions() -> dict[str, str]:
    """headstudio, Python, the system, and every package that computes or draws; "missing" for one that is not there."""
    return {
        "headstudio": __version__,
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        **{name: _version(name) for name in COMPUTING},
    }


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "missing"
