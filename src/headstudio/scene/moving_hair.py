"""Hair that moves with a head: fixed internal steps, whatever the display asks for, and no way to lose the hair."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..lcp.body import Body
from ..lcp.dynamics import Circumstances, Dynamics
from ..lcp.implicit import ImplicitSolver
from ..lcp.leapfrog import LeapfrogSolver
from ..lcp.model import HairModel, HairState
from ..lcp.parting import Parting
from ..lcp.wind import AirState, Wind
from .document import Document
from .motion import Motion

STEP_RATE = 60.0
"""Internal steps of the real-time solver per second."""

SPLIT_HOLD = 0.3, 1.8
"""When the hands of the motion "split" hold the hair apart: from, until [s]."""

LONGEST_FRAME = 0.25
"""What a single frame may ask for [s]; a longer hiccup is not caught up with."""

_SNAPSHOT_EVERY = 0.5  # [s]
_TOP_SPEED = 60.0  # hair faster than this has exploded [m/s]
_JUMP = 0.05, math.radians(20)  # what the head may move beyond its velocity in a step before it counts as put elsewhere
# What changes while hair moves, and all that another process needs to go on from here.
_MOVING = (
    "state", "before", "air", "frame", "frame_before", "parting", "last_parting", "_closing", "_owed", "_saved",
    "air_to_hair", "hair_to_air", "timings",
)  # fmt: skip


@dataclass
class _Snapshot:
    state: HairState
    air: AirState


class MovingHair:
    """The hair of one model in motion over one body.

    advance() steps it, and notes collects what the user should be told. It is not bound to a frame rate: inside, time goes
    in steps of 1 / STEP_RATE. timings: milliseconds that each stage of the last advance() took.
    """

    def __init__(self, model: HairModel, body: Body, document: Document, *, reference: bool = False) -> None:
        """``document``: what the parameters of the simulation are taken from. reference: by the leapfrog solver."""
        self.model = model
        self.document = document
        self.reference = reference
        self.notes: list[str] = []
        self.dynamics = Dynamics(model, body)
        self.solver = (LeapfrogSolver if reference else ImplicitSolver)(self.dynamics)
        self.wind = Wind(model, body, document.hair.seed)
        self.timings: dict[str, float] = {}
        self.parting: Parting | None = None
        self._closing: Parting | None = None
        self.reset()

    @property
    def solver_name(self) -> str:
        """The solver in use, for reports."""
        return "leapfrog" if self.reference else "implicit"

    @property
    def parts(self) -> int:
        """How often the real-time solver integrates the equations of motion in an internal step; 0 for the reference."""
        return self.solver.parts(self.document.lcp) if isinstance(self.solver, ImplicitSolver) else 0

    def reset(self) -> None:
        """Back to the initial state at time 0, with the head at rest and no air."""
        self.state = HairState.at_rest(self.model)
        self.before = self.state
        self.air = self.wind.still_air()
        self.frame = self.frame_before = HeadFrame()
        self.parting = self.last_parting = self._closing = None
        self._owed = 0.0
        self._saved = _Snapshot(self.state, self.air)
        self.air_to_hair = self.hair_to_air = np.zeros(3)
        self.dynamics.forget()

    def moment(self) -> dict[str, Any]:
        """Everything that moves, as it is now: what take_up() goes on from, here or in another process."""
        return {name: getattr(self, name) for name in _MOVING}

    def take_up(self, moment: dict[str, Any]) -> None:
        """Go on from there."""
        vars(self).update(moment)

    def frame_times(self, seconds: float) -> tuple[float, int]:
        """When advance() will ask where the head is: from when on [s], and how often, a part of an internal step apart."""
        steps = int((self._owed + min(seconds, LONGEST_FRAME)) * STEP_RATE + 1e-6)
        return self.state.time, steps * self.parts + 1

    def retune(self, document: Document) -> None:
        """Take over the parameters that a running simulation can take. The hair itself stays as it was built."""
        self.document = document

    @property
    def time(self) -> float:
        """Time of the last internal step [s]."""
        return self.state.time

    @property
    def shown_time(self) -> float:
        """The instant that there is to see [s]: at most one internal step behind."""
        return self.state.time - (1.0 / STEP_RATE - self._owed) if self.state.time > 0 else 0.0

    def advance(self, motion: Motion, seconds: float) -> None:
        """Let ``seconds`` pass while the head moves by ``motion``, a function of the simulation's time.

        A frame of more than a quarter of a second is a hiccup: the rest of it is left out, and noted.
        """
        if seconds > LONGEST_FRAME:
            self.notes.append(f"left out {seconds - LONGEST_FRAME:.2f} s after a hiccup")
            seconds = LONGEST_FRAME
        self._owed += seconds
        dt = 1.0 / STEP_RATE
        while self._owed >= dt * (1.0 - 1e-9):
            self._owed -= dt
            self.step(motion, dt)
        self.timings = {name: 1e3 * spent for name, spent in self.dynamics.timer.take().items()}

    def step(self, motion: Motion, dt: float) -> None:
        """One internal step of dt [s]: air, hair, and a look at whether the result can be right."""
        frame = motion(self.state.time + dt)
        if not _is_finite(frame):
            self.notes.append("the motion gave no place for the head; it stays where it was")
            frame = HeadFrame(self.frame.rotation, self.frame.translation)
            motion = _staying(frame)
        self._follow_script()
        state = self._after_jump(self.state, frame, dt)
        air, outside = self._outside_forces(state, frame, dt)
        now = Circumstances(self.document.lcp, frame, outside, motion, self.parting or self._closing)
        if self._closing is not None:
            self._closing = self._closing.letting_go(dt)
        with np.errstate(all="ignore"):
            stepped = self.solver.step(state, now, dt)
        if _is_sound(stepped):
            self.before, self.state, self.air = state, stepped, air
            self.frame_before, self.frame = self.frame, frame
            if stepped.time - self._saved.state.time >= _SNAPSHOT_EVERY:
                self._saved = _Snapshot(self.before, self.air)
        else:
            self._restore(frame, stepped.time)

    def _follow_script(self) -> None:
        """The part of a motion that the head does not do: in "split" two hands part the hair for a while."""
        if self.document.motion.kind != "split":
            return
        holding = SPLIT_HOLD[0] <= self.state.time < SPLIT_HOLD[1]
        if holding and self.parting is None:
            self.hold_apart()
        elif self.parting is not None and not holding:
            self.release()

    def _outside_forces(self, state: HairState, frame: HeadFrame, dt: float) -> tuple[AirState, Floats | None]:
        """The air after the step, and the forces of the air on hair [N], (n, 3), head frame; None in still air."""
        if not (self.document.wind.on or self.document.motion.kind == "wind"):
            return self.wind.still_air(), None
        world = frame.to_world(state.positions)
        spin = np.cross(frame.angular_velocity, world - frame.translation)
        velocities = frame.rotation.apply(state.velocities) + frame.velocity + spin
        with self.dynamics.timer.stage("wind"):
            air, exchange = self.wind.step(self.air, self.document.wind, frame, world, velocities, state.time, dt)
        self.air_to_hair, self.hair_to_air = exchange.hair.sum(axis=0), exchange.air.sum(axis=0)
        return air, frame.rotation.inv().apply(exchange.hair) / dt

    def _after_jump(self, state: HairState, frame: HeadFrame, dt: float) -> HairState:
        """Hair goes along at rest when the head is put elsewhere, instead of being torn after it."""
        last = self.frame
        shift = float(
            np.linalg.norm(frame.translation - last.translation - 0.5 * dt * (frame.velocity + last.velocity))
        )
        turn = (frame.rotation * last.rotation.inv()).as_rotvec()
        turned = float(np.linalg.norm(turn - 0.5 * dt * (frame.angular_velocity + last.angular_velocity)))
        if shift <= _JUMP[0] and turned <= _JUMP[1]:
            return state
        self.notes.append("the head jumped: hair was taken along at rest")
        return replace(state, velocities=np.zeros_like(state.velocities), before=None)

    def _restore(self, frame: HeadFrame, time: float) -> None:
        """Put the last good state back, at rest: the hair is kept, the motion that broke it is not."""
        self.notes.append("the simulation became unstable; the last good state was restored")
        good = self._saved.state
        self.state = replace(good, velocities=np.zeros_like(good.velocities), time=time, before=None)
        self.before, self.air = self.state, self._saved.air
        self.frame_before, self.frame = self.frame, frame

    def hold_apart(self, width: float = 0.09) -> None:
        """Part the hair of the back and hold it ``width`` [m] apart, until release()."""
        self.parting, self._closing = Parting.take(self.model, self.state.positions, width), None

    def release(self) -> None:
        """Let go of the hair: the hands come together. The gap that is left is still measured."""
        self._closing = self.parting or self._closing
        self.parting, self.last_parting = None, self.parting or self.last_parting


def _is_finite(frame: HeadFrame) -> bool:
    """Whether a frame says where the head is and how it moves."""
    parts = (frame.translation, frame.velocity, frame.acceleration, frame.angular_velocity, frame.angular_acceleration)
    return bool(np.all(np.isfinite(np.concatenate([frame.rotation.as_quat(), *parts]))))


def _staying(frame: HeadFrame) -> Motion:
    """A head that keeps still at ``frame``."""
    return lambda time: frame


def _is_sound(state: HairState) -> bool:
    """Whether every number is finite and no hair is faster than hair can be."""
    fastest = np.max(np.abs(state.velocities), initial=0.0)
    return bool(np.isfinite(fastest) and fastest < _TOP_SPEED and np.all(np.isfinite(state.positions)))
