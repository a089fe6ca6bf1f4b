"""Work that takes a while and changes nothing on show, such as an export: a thread each, and a message at the end."""

from __future__ import annotations

import threading
from collections.abc import Callable
from queue import Empty, SimpleQueue

from .messages import Messages


class Chores:
    """Runs them. ``explain`` makes a line of an error."""

    def __init__(self, explain: Callable[[Exception], str]) -> None:
        self._explain = explain
        self._ended: SimpleQueue[tuple[str, str]] = SimpleQueue()
        self._running: list[threading.Thread] = []

    @property
    def busy(self) -> bool:
        """Whether one is under way."""
        return any(thread.is_alive() for thread in self._running)

    def run(self, work: Callable[[], str]) -> None:
        """Do ``work``, which returns what to say when it is done. The program does not end before it has."""
        thread = threading.Thread(target=self._work, args=(work,), name="chore")
        self._running = [other for other in self._running if other.is_alive()] + [thread]
        thread.start()

    def report(self, messages: Messages) -> None:
        """Say what has ended. Call once a frame."""
        while True:
            try:
                text, kind = self._ended.get_nowait()
            except Empty:
                return
            messages.say(text, kind)

    def _work(self, work: Callable[[], str]) -> None:
        try:
            self._ended.put((work(), "good"))
        except Exception as error:  # every failure is the user's to read and must not end the window
            self._ended.put((self._explain(error), "error"))
