"""Two pieces of work on two cores: long arrays are worked on without Python's lock."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

First = TypeVar("First")
Second = TypeVar("Second")

# Work given away gives none away itself, so that whoever waits never waits for its own place.
_HELPERS: ThreadPoolExecutor | None = ThreadPoolExecutor(2, thread_name_prefix="skin")


def work_alone() -> None:
    """Do one thing after the other from now on: in a process beside another that needs the other cores."""
    global _HELPERS
    _HELPERS = None


def at_once(mine: Callable[[], First], other: Callable[[], Second]) -> tuple[First, Second]:
    """What both return, ``other`` worked out in another thread meanwhile."""
    if _HELPERS is None:
        return mine(), other()
    helper = _HELPERS.submit(other)
    return mine(), helper.result()
