"""What the studio says to the user: short lines that come, stay for a while and go."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

SECONDS = {"info": 5.0, "good": 5.0, "warning": 9.0, "error": 14.0}
KEPT = 200


@dataclass
class Message:
    """One line. ``kind`` is "info", "good", "warning" or "error"; ``age`` is how long it has been shown [s]."""

    text: str
    kind: str
    age: float = 0.0
    times: int = 1

    @property
    def strength(self) -> float:
        """1 while it is fresh, falling to 0 over its last second."""
        return min(max(SECONDS[self.kind] - self.age, 0.0), 1.0)


class Messages:
    """The lines on show, newest last, and the log of all of them."""

    def __init__(self) -> None:
        self.shown: list[Message] = []
        self.log: deque[Message] = deque(maxlen=KEPT)

    def say(self, text: str, kind: str = "info") -> None:
        """Show a line; one that stands there already is renewed."""
        for message in self.shown:
            if message.text == text:
                message.age, message.times = 0.0, message.times + 1
                return
        message = Message(text, kind)
        self.shown.append(message)
        self.log.append(message)

    def dismiss(self, message: Message) -> None:
        """Take a line away now."""
        self.shown.remove(message)

    def pass_time(self, seconds: float) -> None:
        """Let the lines age."""
        for message in self.shown:
            message.age += seconds
        self.shown = [message for message in self.shown if message.strength > 0]
