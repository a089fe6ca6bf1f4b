"""Building hair while the window goes on: one worker thread, and the latest wish wins."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from ..scene.document import Document

ResultT = TypeVar("ResultT")


@dataclass(frozen=True)
class Finished(Generic[ResultT]):
    """A build that ended: what it was for, and either the result or the error."""

    document: Document
    result: ResultT | None
    error: Exception | None


@dataclass(eq=False)
class _Job(Generic[ResultT]):
    document: Document
    started: float
    part: str = ""
    finished: Finished[ResultT] | None = None
    unwanted: bool = False


class Unwanted(Exception):
    """Nobody waits for this build any more."""


class Builds(Generic[ResultT]):
    """Runs ``build`` for one document after the other, never two at once, since a builder keeps what it can use again.

    ``build`` calls ``announce`` before each part of its work. A build that nobody waits for any more ends there; within
    a part it cannot be interrupted.
    """

    def __init__(self, build: Callable[[Document], ResultT]) -> None:
        self._build = build
        self._running: _Job[ResultT] | None = None
        self._next: Document | None = None
        self._thread: threading.Thread | None = None

    @property
    def wanted(self) -> Document | None:
        """The document that is being built, or None when nobody waits for one."""
        if self._next is not None:
            return self._next
        return self._running.document if self._running and not self._running.unwanted else None

    @property
    def seconds(self) -> float:
        """How long the running build has taken so far [s]."""
        return time.perf_counter() - self._running.started if self._running else 0.0

    @property
    def part(self) -> str:
        """What the running build is making: "head", "scalp", "body" or "hair"."""
        return self._running.part if self._running else ""

    def announce(self, part: str) -> None:
        """Called by the build, in its own thread, before it makes ``part``. Raises Unwanted to end it."""
        job = self._running
        if job is None or job.unwanted:
            raise Unwanted
        job.part = part

    def request(self, document: Document) -> None:
        """Build this one, instead of whatever was wanted before."""
        if self._running is not None:
            self._running.unwanted = True
        self._next = document
        self._start_next()

    def cancel(self) -> None:
        """Want nothing any more."""
        self._next = None
        if self._running is not None:
            self._running.unwanted = True

    def close(self, patience: float = 10.0) -> None:
        """Want nothing any more, and wait up to ``patience`` seconds for the running build to notice."""
        self.cancel()
        if self._thread is not None:
            self._thread.join(patience)

    def poll(self) -> Finished[ResultT] | None:
        """The build that has just ended, if it is still wanted. Call once a frame."""
        job = self._running
        if job is None or job.finished is None:
            return None
        self._running = None
        self._start_next()
        return None if job.unwanted else job.finished

    def _start_next(self) -> None:
        if self._running is not None or self._next is None:
            return
        job: _Job[ResultT] = _Job(self._next, time.perf_counter())
        self._running, self._next = job, None
        # A daemon: the program does not wait for ever for hair that nobody will see.
        self._thread = threading.Thread(target=self._work, args=(job,), name="build", daemon=True)
        self._thread.start()

    def _work(self, job: _Job[ResultT]) -> None:
        try:
            job.finished = Finished(job.document, self._build(job.document), None)
        except Exception as error:  # every failure is the user's to read and must not end the window
            job.finished = Finished(job.document, None, error)
