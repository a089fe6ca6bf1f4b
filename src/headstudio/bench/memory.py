"""How much memory a hairstyle takes, from a preset to arrays, in a process that does nothing else.

python -m headstudio.bench.memory PROJECT prints the most it ever had [bytes], before hair and with it.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.project import load_project, save_project


def peak_memory(document: Document) -> tuple[int, int] | None:
    """The most memory [bytes] that a process had which built head and scalp of ``document``, and then with all strands.

    None where the system does not tell.
    """
    if sys.platform == "win32":
        return None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "hair.headstudio"
        save_project(document, path)
        asked = subprocess.run([sys.executable, "-m", __name__, str(path)], capture_output=True, text=True, check=True)
    before, after = (int(word) for word in asked.stdout.split())
    return before, after


def _most() -> int:
    if sys.platform == "linux":
        # What getrusage tells begins with the memory of the process that started this one.
        status = Path("/proc/self/status").read_text()
        return 1024 * int(status.partition("VmHWM:")[2].split()[0])
    import resource  # not on every system

    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return used if sys.platform == "darwin" else 1024 * used


def _measure(path: Path) -> None:
    document, builder = load_project(path).document, Builder()
    builder.surroundings(document)
    builder.scalp(document)
    before = _most()
    builder.hairdo(document)
    sys.stdout.write(f"{before} {_most()}\n")


if __name__ == "__main__":
    _measure(Path(sys.argv[1]))
