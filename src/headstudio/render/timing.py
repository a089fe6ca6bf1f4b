"""Milliseconds for each stage of a frame."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

import moderngl


class StageTimer:
    """Measures the stages of a frame, when asked to.

    OpenGL works behind the caller's back, so a stage only ends when the driver has finished: measuring costs a little
    overlap, and is off until ``on`` is set. ``stages`` holds the last frame's figures [ms] by name, "ms_light" and so
    on.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self.on = False
        self.stages: dict[str, float] = {}
        self._context = context

    def start(self) -> None:
        """Begin a frame: what the last one did and this one does not is no longer in ``stages``."""
        self.stages = {}

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time what is done inside as ``ms_NAME``."""
        if not self.on:
            yield
            return
        start = time.perf_counter()
        yield
        self._context.finish()
        self.stages[f"ms_{name}"] = 1e3 * (time.perf_counter() - start)
