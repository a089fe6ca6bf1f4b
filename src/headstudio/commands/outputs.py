"""Whether what a command makes can be written, asked before the work rather than after it."""

from __future__ import annotations

import errno
import os
from pathlib import Path


def check_can_be_written(path: Path, *, as_file: bool) -> None:
    """Make the folder that ``path`` will lie in. Raises OSError where nothing can be written.

    as_file: a file; otherwise it may be a folder that is there already.
    """
    if path.is_dir():
        if as_file:
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        folder = path
    else:
        folder = path.parent
        folder.mkdir(parents=True, exist_ok=True)
    if not os.access(folder, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
