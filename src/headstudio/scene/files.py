"""Writing a file so that a crash, a full disk or a pulled plug leaves either the old file or the new one."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path


def write_atomically(path: Path, content: bytes) -> None:
    """Write ``content`` to ``path`` by way of a neighbour that takes its name at the end. Raises OSError.

    A symbolic link keeps being one: what it points to is replaced.
    """
    path = Path(os.path.realpath(path))
    neighbour = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with neighbour.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        neighbour.replace(path)
    except BaseException as error:
        with contextlib.suppress(OSError):
            neighbour.unlink()
        if isinstance(error, OSError):
            # The name of the neighbour would tell the user nothing.
            raise OSError(error.errno, error.strerror, str(path)) from None
        raise
