"""Hair in motion on one built head: what there is to see of it, and what there is to measure."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from ..head.depth import SkinDepth
from ..head.frame import HeadFrame
from .builder import Built
from .document import Document
from .measures import contact_figures, hair_figures, head_figures, parting_figures
from .moving_hair import STEP_RATE, MovingHair
from .overlays import overlays_of
from .stage import HairOnStage, Stage


class Simulation(MovingHair):
    """The hair of one built document, in motion. What stage() shows lies between the last two internal steps."""

    def __init__(self, built: Built, document: Document, reference: bool = False) -> None:
        """``reference``: by the leapfrog solver."""
        self.built = built
        super().__init__(built.hair, built.body, document, reference=reference)

    def stage(self) -> Stage:
        """What there is to see now: hair between the last two internal steps, and the head where it is."""
        share = min(max(self._owed * STEP_RATE, 0.0), 1.0)
        positions = (1.0 - share) * self.before.positions + share * self.state.positions
        directions = (1.0 - share) * self.before.directions + share * self.state.directions
        length = np.linalg.norm(directions, axis=1, keepdims=True)
        hair = HairOnStage(self.model, positions, directions / np.maximum(length, 1e-9))
        frame = self._frame_between(share)
        marks = overlays_of(self.document.look, hair, self.built.body, frame, self.air)
        return Stage(self.built.head, frame, hair, marks)

    def _frame_between(self, share: float) -> HeadFrame:
        first, second = self.frame_before, self.frame
        turn = (second.rotation * first.rotation.inv()).as_rotvec()
        rotation = type(first.rotation).from_rotvec(share * turn) * first.rotation
        return replace(
            second, rotation=rotation, translation=(1.0 - share) * first.translation + share * second.translation
        )

    def measure(self) -> dict[str, float]:
        """The figures of the present state: those of scene.measures, and the momentum that air and hair exchanged."""
        model, state = self.model, self.state
        return {
            **hair_figures(model, state),
            **contact_figures(model, state, self._skin_depth, self.frame),
            **parting_figures(model, self.parting or self.last_parting, state),
            **head_figures(self.frame),
            **self._wind_figures(),
        }

    @cached_property
    def _skin_depth(self) -> SkinDepth:
        return SkinDepth(self.built.head)

    def _wind_figures(self) -> dict[str, float]:
        if len(self.air.positions) == 0:
            return {}
        given = float(np.linalg.norm(self.air_to_hair))
        lost = float(np.linalg.norm(self.air_to_hair + self.hair_to_air))
        return {"air_particles": float(len(self.air.positions)), "air_impulse": given, "air_imbalance": lost}
