"""The application without its window: the work, what was built from it, and what is in motion."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..head.head import HeadError
from ..head.mesh import Floats
from ..io.film import FilmError
from ..io.hair import HairFileError
from ..params import ParameterError
from ..render.context import RenderError
from ..scene.animation import Animation, groundwork
from ..scene.builder import Builder
from ..scene.document import Document
from ..scene.drafts import drafted, next_to_build, same_hair
from ..scene.project import ProjectError
from ..scene.stage import Stage
from ..wisp.adopt import AdoptError
from ..wisp.selection import StylingError
from .brush import Brush
from .builds import Builds
from .chores import Chores
from .messages import Messages
from .performance import Performance
from .playback import Playback
from .styling_items import Chosen
from .work import Work

# What the program foresaw and says in its own words; anything else is named with its type.
FORESEEN = (
    HeadError,
    ParameterError,
    StylingError,
    ProjectError,
    AdoptError,
    RenderError,
    FilmError,
    HairFileError,
    OSError,
)

SETTLE = 1.0  # seconds until furrows that were built in a hurry are built again


@dataclass(frozen=True, eq=False)
class Grown:
    """A head of hair, ready to move, and the document it was grown from."""

    document: Document
    animation: Animation


class Studio:
    """Everything the faces of the window show and change."""

    def __init__(self, live: bool = False) -> None:
        """live: loose hair and faces are worked out one frame ahead, in other processes."""
        self.work = Work()
        self.messages = Messages()
        self.playback = Playback()
        self.performance = Performance(self.document.motion)
        self.brush = Brush()
        self.chores = Chores(explain)
        self.chosen: Chosen | None = None
        self.grown: Grown | None = None
        self.stage: Stage | None = None
        builder = Builder(lambda part: self.builds.announce(part))
        self.builds: Builds[Grown] = Builds(
            lambda document: _grow(builder, document, live, settled=document is self._settling)
        )
        self._settling: Document | None = None
        self._unsettled_for = 0.0
        self._tuned: Document | None = None
        self._refused: Document | None = None

    # -- the work ----------------------------------------------------------------------------------------------------

    @property
    def document(self) -> Document:
        """The document as it is now."""
        return self.work.document

    def set(self, path: str, value: Any, label: str) -> None:
        """Set one parameter; what it cannot take becomes a message."""
        with self.reporting():
            self.work.set(path, value, label)

    def undo(self) -> None:
        """Take back the last change."""
        label = self.work.history.undo_label
        if self.work.history.undo():
            self.messages.say(f"Undone: {label}")

    def redo(self) -> None:
        """Do again what was taken back."""
        label = self.work.history.redo_label
        if self.work.history.redo():
            self.messages.say(f"Redone: {label}")

    def new(self) -> None:
        """Start an empty project."""
        for warning in self.work.start_over():
            self.messages.say(warning, "warning")
        self.reset()

    def open(self, path: Path) -> bool:
        """Open a project; False, with a message, when it cannot be opened."""
        with self.reporting() as outcome:
            for warning in self.work.open(path):
                self.messages.say(warning, "warning")
            self.messages.say(f"Opened {path.name}", "good")
            self.reset()
        return outcome.good

    def save(self, path: Path) -> bool:
        """Save the project; False, with a message, when it cannot be written."""
        with self.reporting() as outcome:
            self.messages.say(f"Saved {self.work.save(path)}", "good")
        return outcome.good

    def reporting(self) -> Reporting:
        """A block whose errors become messages, and never lose the document."""
        return Reporting(self.messages)

    # -- time --------------------------------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.grown.animation.time if self.grown else 0.0

    @property
    def face_time(self) -> float:
        """Where the performance of the face is [s]."""
        return self.grown.animation.face_time if self.grown else 0.0

    def seek_face(self, time: float) -> None:
        """Put the performance of the face at ``time`` [s], not before 0."""
        if self.grown is not None:
            self.grown.animation.seek_face(max(time, 0.0))
            self.stage = None

    def tick(self, wall: float, fixed: float | None = None) -> None:
        """Go on by one frame that comes ``wall`` seconds after the last one.

        ``fixed``: the length of a frame [s] while a film is recorded.
        """
        self.messages.pass_time(wall)
        self.chores.report(self.messages)
        self._follow_document()
        self._take_build()
        self._settle(wall)
        if self.grown is None:
            return
        with self.reporting() as outcome:
            self._animate(self.grown.animation, self.playback.take(wall, fixed))
        if not outcome.good:
            self.playback.playing = False

    def aim_head(self, turn: Floats, place: Floats) -> None:
        """The user's hand wants the head turned by pitch, yaw, roll [rad] and the bust moved [m], each (3,)."""
        self.performance.hand.aim(self.time, turn, place)

    def reset(self) -> None:
        """Everything back to rest, at time 0; a motion starts anew."""
        self.performance = Performance(self.document.motion)
        if self.grown is not None:
            self.grown.animation.reset()
            self.stage = None

    def _animate(self, animation: Animation, seconds: float) -> None:
        document = self.work.history.document  # the view is no matter of the simulation
        if document != self._tuned:
            animation.retune(document)
            self._tuned = document
        elif seconds <= 0 and self.stage is not None and animation.exact:
            return
        if seconds > 0:
            self.performance.follow(document.motion, animation.time)
            animation.advance(self.performance, seconds)
            for note in animation.take_notes():
                self.messages.say(f"{note[:1].upper()}{note[1:]}.", "warning")
        stage = animation.stage()
        # Time may pass and nothing move: then nothing is drawn again.
        if self.stage is None or not stage.shows_what(self.stage):
            self.stage = stage

    @property
    def building(self) -> bool:
        """Whether hair is being built that the user waits for, or only its draft is there."""
        if self.builds.wanted is not None:
            return self.builds.wanted is not self._settling
        return self.grown is not None and not self.work.in_gesture and _is_draft(self.grown.document, self.document)

    def cancel_build(self) -> None:
        """Keep the hair as it is, and take back the change that asked for another."""
        self.builds.cancel()
        self.messages.say("Cancelled: the hair stays as it was.")
        if self.grown is not None and _is_draft(self.grown.document, self.document):
            # A draft is there, and without what it shows there is nothing to be built in full: the last hair comes back.
            self.work.history.undo()
            return
        self._return_to_grown()

    def _follow_document(self) -> None:
        """Ask for a build when the document has moved away from what was built.

        What takes long waits for the end of a drag. Strands and the depth of furrows follow it: one build after the other,
        each to its end, since one that gave way to every next position of the mouse would never be seen. Strands come as
        a draft first, and the rest of them once it is on the screen and the mouse was let go.
        """
        shown = self.grown.document if self.grown else None
        document = next_to_build(self.document, shown, dragging=self.work.history.in_gesture)
        known = self.builds.wanted or shown or self._refused
        waits = self.builds.wanted is not None and self.builds.wanted is not self._settling
        if self.work.in_gesture and (waits or known is None or groundwork(document) != groundwork(known)):
            return
        if known is not None and (same_hair(document, known) or same_hair(self.document, known)):
            return
        if self.grown is not None and same_hair(document, self.grown.document):
            self.builds.cancel()
        else:
            self.builds.request(document)

    def _settle(self, wall: float) -> None:
        """When nobody does anything for a while, build again what was built in a hurry; nobody sees a difference."""
        idle = self.grown is not None and not self.grown.animation.settled and not self.work.in_gesture
        self._unsettled_for = self._unsettled_for + wall if idle and self.builds.wanted is None else 0.0
        if self._unsettled_for > SETTLE and self.grown is not None:
            self._settling = replace(self.grown.document)
            self.builds.request(self._settling)

    def _take_build(self) -> None:
        finished = self.builds.poll()
        if finished is None:
            return
        if finished.result is not None:
            goes_on = self.grown is not None and finished.result.animation.go_on_from(self.grown.animation)
            if not goes_on:
                self.performance = Performance(self.document.motion)
            self.grown = finished.result
            self._tuned = None
            self.stage = None
        elif finished.error is not None:
            self.messages.say(explain(finished.error), "error")
            self._return_to_grown()

    def _return_to_grown(self) -> None:
        """Make the document one that there is hair for: the last such, or else one that can be built."""
        if self.grown is not None:
            grown = self.grown.document
            self.work.hair_as, self.work.skin_as = grown.look.hair_as, grown.look.skin_as
            if self.work.go_back(lambda document: same_hair(drafted(document), drafted(grown))):
                return
        self._stand_in()

    def _stand_in(self) -> None:
        """A project that cannot be built keeps what it can: first the head gives way, then everything that grows."""
        document = self.document
        head = replace(document.head, source="mannequin")
        stand_in = replace(document, head=head, scalp=replace(document.scalp, curves=()))
        if same_hair(stand_in, document):
            plain = Document()
            stand_in = replace(plain, head=head, motion=document.motion, look=document.look, camera=document.camera)
        if same_hair(stand_in, document):
            self._refused = document
            return
        self.work.change(stand_in, "Use the mannequin")
        self.messages.say("The mannequin stands in.", "warning")


class Reporting:
    """A block whose errors become messages; ``good`` tells whether there was none."""

    def __init__(self, messages: Messages) -> None:
        self.good = True
        self._messages = messages

    def __enter__(self) -> Reporting:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: object) -> bool:
        if not isinstance(error, Exception):
            return False
        self.good = False
        self._messages.say(explain(error), "error")
        return True


def explain(error: Exception) -> str:
    """An error as one line."""
    text = " ".join(str(error).split()) or "no further reason"
    return text if isinstance(error, FORESEEN) else f"{type(error).__name__}: {text}"


def _grow(builder: Builder, document: Document, live: bool, *, settled: bool) -> Grown:
    shown = document.look.strands_shown
    return Grown(document, Animation(builder, document, shown, settled=settled, live=live))


def _is_draft(shown: Document, wanted: Document) -> bool:
    return same_hair(shown, drafted(wanted)) and not same_hair(shown, wanted)
