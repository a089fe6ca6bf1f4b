"""The command line: one function per command, each a thin face over what is in ``headstudio.commands``.

Every file declares the commands of one subject; the order in which they are read is that of ``headstudio --help``.
"""

from __future__ import annotations

import sys

from ..memory import keep_freed_memory
from .words import CANCELLED, app

# isort: off
from . import moving  # noqa: F401
from . import styling  # noqa: F401
from . import faces  # noqa: F401
from . import looking  # noqa: F401
# isort: on

__all__ = ["app", "main"]


def main() -> None:
    """What the word ``headstudio`` runs."""
    keep_freed_memory()
    try:
        app()
    except KeyboardInterrupt:
        sys.exit(CANCELLED)
