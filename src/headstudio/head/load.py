"""One door to every head: by name or from a file."""

from __future__ import annotations

from .from_file import head_from_file
from .head import Head
from .makehuman import makehuman
from .mannequin import mannequin

BUILT_IN = ("makehuman", "mannequin")
"""The names of the heads that need no file."""


def load_head(source: str, *, eyes: str = "", age: float = 0.2, masculine: float = 0.0) -> Head:
    """The head named ``source``: "makehuman", "mannequin", or the path of a mesh (OBJ, PLY, STL, OFF, GLB).

    eyes: the path of another mesh in the same place, unit and axes, with what belongs to a head from a file; or "". age (0
    young adult to 1 old) and masculine (0 female to 1 male) shape MakeHuman's human and nothing else. Raises HeadError, one
    line for the user, when there is no usable head.
    """
    if source == "makehuman":
        return makehuman(age, masculine)
    if source == "mannequin":
        return mannequin()
    return head_from_file(source, eyes or None)
