"""How simulated time follows the clock on the wall."""

from __future__ import annotations

from dataclasses import dataclass

# The longest piece of time that one frame makes up for: after a hiccup hair goes on, it does not leap.
LONGEST_FRAME = 1 / 15
STEP = 1 / 60
SMOOTHING = 0.5  # [s] over which the measured pace is averaged


@dataclass
class Playback:
    """Play, pause and step. ``pace`` is simulated seconds for a second of the wall clock, as measured."""

    playing: bool = True
    speed: float = 1.0
    pace: float = 0.0
    _steps: int = 0

    def toggle(self) -> None:
        """Play, or pause."""
        self.playing = not self.playing

    def step(self) -> None:
        """Pause, and go on by one display step."""
        self.playing = False
        self._steps += 1

    def take(self, wall: float, fixed: float | None = None) -> float:
        """How long to simulate in a frame that follows ``wall`` seconds after the last one [s].

        ``fixed``: the length of a frame while a film is recorded, which goes on evenly however long a frame takes.
        """
        steps, self._steps = self._steps, 0
        if not self.playing:
            return steps * STEP
        seconds = fixed if fixed is not None else min(wall, LONGEST_FRAME) * self.speed
        if wall > 0:
            weight = min(wall / SMOOTHING, 1.0)
            self.pace += weight * (seconds / wall - self.pace)
        return seconds
