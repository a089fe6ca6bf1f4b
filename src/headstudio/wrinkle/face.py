"""A head whose face moves: muscles or expression units, then jaw, lids and tissue (Bando's thesis, section 2.5.2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from ..head.head import Head, Landmarks, Part
from ..head.mesh import Floats, Ints
from ..head.smooth import smoothstep
from .expressions import BLINK, EXPRESSIONS, JAW_OPEN, Expression
from .face_settings import FaceSettings
from .jaw import find_jaw
from .lids import find_lids, usual_eye
from .muscle_set import SIDES, place_muscles
from .part_motion import BrowMotion, EyeMotion, JawPartMotion, LashMotion
from .tissue import TissueLift

# Displacements below this [m] per unit of contraction are left out.
_NEGLIGIBLE = 1e-6
# On each side of the middle, muscles of both sides share the skin, within this part of the height of the head.
_SHARED = 0.045
# How much of the turn of an eye its lids follow.
_UPPER_FOLLOWS, _LOWER_FOLLOWS = 0.7, 0.35
WIDEST_JAW = float(np.radians(26.0))
"""How far the jaw opens at most [rad]."""
_Motion = EyeMotion | JawPartMotion | LashMotion | BrowMotion
_SHOWN = {**EXPRESSIONS, "blink": BLINK}


@dataclass(frozen=True, eq=False)
class FacePose:
    """A face at one instant. positions: of every vertex of the skin [m], (n, 3). parts: those of the head, moved; a part
    that rests is the head's own object. jaw: how far it is open [rad]."""

    positions: Floats
    parts: tuple[Part, ...]
    jaw: float


@dataclass(frozen=True)
class _Drive:
    """What one pose asks of jaw, lids and eyes; by side."""

    jaw: float
    upper: Mapping[str, float]
    lower: Mapping[str, float]
    gaze: Mapping[str, float]


class Face:
    """The face of one head; what depends on the head alone is made once. ``pose`` then takes some milliseconds."""

    def __init__(self, head: Head) -> None:
        self.head = head
        self._rest = head.skin.vertices
        self._columns, self._fields = _fields(head)
        self._jaw = find_jaw(head)
        self._jawed: Ints = np.nonzero(self._jaw.weight > 1e-4)[0]
        eyes = {_side_of(part): part for part in head.parts if part.kind == "eye" and part.axis is not None}
        found = {
            side: find_lids(head.skin, head.landmarks, eyes.get(side) or usual_eye(head.landmarks, side))
            for side in SIDES
        }
        self._lids = {side: lids for side, lids in found.items() if lids is not None}
        self._tissue = TissueLift(head.skin, self._faces_that_move())
        self._motions = self._part_motions()

    @property
    def has_units(self) -> bool:
        """Whether the head brings MakeHuman's expression units."""
        return bool(self.head.expressions)

    def why_lids_stay(self, settings: FaceSettings) -> str | None:
        """Why lids do not do what ``settings`` ask of them, a line for the user; None where they do, or need not."""
        asked = {
            side
            for side in SIDES
            for name, expression in _SHOWN.items()
            if settings.strength(name, side) > 0
            and (expression.upper_lid or expression.lower_lid or expression.gaze_down)
        }
        still = sorted(asked - set(self._lids))
        if not still:
            return None
        which = "both eyes" if len(still) == 2 else f"the {still[0]} eye"
        return f"lids of {which} do not move: the skin leaves no opening before an eyeball"

    def pose(self, settings: FaceSettings, thickness: Floats | None = None) -> FacePose:
        """The face as ``settings`` sets its sliders; a performance is not looked at, see ``FaceSettings.at``.

        thickness: of the tissue under every vertex of the skin at rest [m], (n,); None leaves the skin unlifted.
        """
        positions, jaw = self.skin_at(settings, thickness)
        return FacePose(positions, self.parts_on(positions, settings), jaw)

    def skin_at(self, settings: FaceSettings, thickness: Floats | None = None) -> tuple[Floats, float]:
        """What ``pose`` does to the skin alone: its positions [m], (n, 3), and how far the jaw is open [rad]."""
        strengths = _strengths(settings)
        if not strengths and settings.jaw_open == 0:
            return self._rest, 0.0
        drive = self._drive(strengths, settings.jaw_open)
        positions = self._rest + (
            self._fields @ self._activity(strengths, self._share_of_units(settings.driver))
        ).reshape(-1, 3)
        if drive.jaw:
            jawed = self._jawed
            positions[jawed] = self._jaw.opened(jawed, positions[jawed], drive.jaw)
        for side, lids in self._lids.items():
            turn = lids.turns(drive.upper[side], drive.lower[side])
            positions[lids.vertices] = lids.turned(positions[lids.vertices], turn)
        if thickness is not None and settings.tissue_lift > 0:
            # The sculptors of the units have put the tissue in already.
            lift = settings.tissue_lift * (1.0 - self._share_of_units(settings.driver))
            positions = self._tissue.lifted(positions, lift * thickness)
        for lids in self._lids.values():
            positions[lids.vertices] = lids.cleared(positions[lids.vertices])
        return positions, drive.jaw

    def parts_on(self, positions: Floats, settings: FaceSettings) -> tuple[Part, ...]:
        """The parts of the head on a skin that ``settings`` have brought to ``positions`` [m], (n, 3)."""
        strengths = _strengths(settings)
        if not strengths and settings.jaw_open == 0:
            return self.head.parts
        drive = self._drive(strengths, settings.jaw_open)
        return tuple(self._posed_part(k, positions, drive) for k in range(len(self.head.parts)))

    def posed_head(self, pose: FacePose) -> Head:
        """The head with the skin and parts of a pose."""
        return replace(self.head, skin=self.head.skin.moved(pose.positions), parts=pose.parts)

    def _share_of_units(self, driver: str) -> float:
        """How much of an expression is left to units, 0 to 1."""
        return {"muscles": 0.0, "units": 1.0, "both": 0.5}[driver] if self.has_units else 0.0

    def expansion(self, positions: Floats) -> Floats:
        """How much larger than at rest the skin is around each vertex, (n,), at ``positions`` [m], (n, 3)."""
        expansion = np.ones(len(self._rest))
        expansion[self._tissue.vertices] = self._tissue.expansion(positions)
        return expansion

    def _activity(self, strengths: Mapping[tuple[str, str], float], by_units: float) -> Floats:
        """How strongly every field acts, (columns,)."""
        activity: dict[tuple[str, str, str], float] = {}
        for (name, side), strength in strengths.items():
            for muscle, amount in _SHOWN[name].contractions.items():
                key = ("muscle", side, muscle)
                activity[key] = activity.get(key, 0.0) + (1.0 - by_units) * strength * amount
            for unit, amount in _SHOWN[name].units.items():
                key = ("unit", side, unit.replace("SIDE", side))
                activity[key] = activity.get(key, 0.0) + by_units * strength * amount
        values = np.zeros(len(self._columns))
        for key, amount in activity.items():
            if key in self._columns:
                values[self._columns[key]] = amount
        return values

    def _drive(self, strengths: Mapping[tuple[str, str], float], jaw_open: float) -> _Drive:
        """Jaw, lids and eyes: the jaw opens as far as both sides ask for, lids and eyes each on their own side."""
        shown: list[tuple[Expression, dict[str, float]]] = [
            (expression, {side: strengths.get((name, side), 0.0) for side in SIDES})
            for name, expression in _SHOWN.items()
        ]
        jaw = jaw_open * JAW_OPEN.jaw + sum(min(by_side.values()) * each.jaw for each, by_side in shown)
        upper, lower, gaze = {}, {}, {}
        for side in SIDES:
            gaze[side] = sum(by_side[side] * each.gaze_down for each, by_side in shown)
            upper[side] = sum(by_side[side] * each.upper_lid for each, by_side in shown)
            lower[side] = sum(by_side[side] * each.lower_lid for each, by_side in shown)
            if side in self._lids:
                upper[side] += _UPPER_FOLLOWS * gaze[side] / self._lids[side].largest_fall
                lower[side] -= _LOWER_FOLLOWS * gaze[side] / self._lids[side].largest_rise
        return _Drive(min(jaw, WIDEST_JAW), upper, lower, gaze)

    def _posed_part(self, index: int, positions: Floats, drive: _Drive) -> Part:
        motion = self._motions[index]
        if isinstance(motion, EyeMotion):
            return motion.posed(drive.gaze[_side_of(self.head.parts[index])])
        if isinstance(motion, JawPartMotion):
            return motion.posed(drive.jaw)
        if isinstance(motion, LashMotion):
            side = next(side for side, lids in self._lids.items() if lids is motion.lids)
            return motion.posed(positions, drive.upper[side], drive.lower[side])
        if isinstance(motion, BrowMotion):
            return motion.posed(positions)
        return self.head.parts[index]

    def _part_motions(self) -> list[_Motion | None]:
        teeth = [part.mesh.vertices[:, 1] for part in self.head.parts if part.kind == "teeth"]
        level = 0.5 * (min(each.min() for each in teeth) + max(each.max() for each in teeth)) if teeth else 0.0
        left = self.head.landmarks.left_eye - self.head.landmarks.right_eye
        left = left / np.linalg.norm(left)
        motions: list[_Motion | None] = []
        for part in self.head.parts:
            if part.kind == "eye" and part.axis is not None:
                motions.append(EyeMotion(part, left))
            elif part.kind in ("teeth", "tongue"):
                motions.append(JawPartMotion(part, self._jaw, level))
            elif part.kind == "lashes" and self._lids:
                middle = part.mesh.vertices.mean(axis=0)
                nearest = min(self._lids.values(), key=lambda lids: float(np.linalg.norm(lids.centre - middle)))
                motions.append(LashMotion(part, self.head, nearest))
            elif part.kind in ("lashes", "brows"):
                motions.append(BrowMotion(part, self.head))
            else:
                motions.append(None)
        return motions

    def _faces_that_move(self) -> Ints:
        moved = np.diff(self._fields.indptr).reshape(-1, 3).sum(axis=1) > 0
        moved[self._jawed] = True
        for lids in self._lids.values():
            moved[lids.vertices] = True
        faces = self.head.skin.faces
        # What lines an open mouth says nothing of the skin beside it.
        found: Ints = faces[moved[faces].any(axis=1) & ~self._jaw.lining[faces].any(axis=1)]
        return found


def _strengths(settings: FaceSettings) -> dict[tuple[str, str], float]:
    """How strongly each side shows each expression, those that it shows at all."""
    return {
        (name, side): strength for name in _SHOWN for side in SIDES if (strength := settings.strength(name, side)) > 0
    }


def _fields(head: Head) -> tuple[dict[tuple[str, str, str], int], sparse.csr_array]:
    """Displacements per unit of every muscle and expression unit on each side: columns by name, matrix (3 n, columns).

    Near the middle both sides share the skin, with shares that add up to 1: so one side alone moves its own half, and
    both together do no more in the middle than beside it.
    """
    share = _shares(head.skin.vertices, head.landmarks)
    columns: dict[tuple[str, str, str], int] = {}
    blocks: list[Floats] = []
    for (side, name), muscle in place_muscles(head.landmarks).items():
        columns["muscle", side, name] = len(blocks)
        blocks.append(share[side][:, None] * muscle.field(head.skin.vertices))
    for name, unit in head.expressions.items():
        offsets = np.zeros_like(head.skin.vertices)
        offsets[unit.vertices] = unit.offsets
        for side in SIDES:
            columns["unit", side, name] = len(blocks)
            blocks.append(share[side][:, None] * offsets)
    stacked = [sparse.csr_array(np.where(np.abs(block) > _NEGLIGIBLE, block, 0.0).reshape(-1, 1)) for block in blocks]
    return columns, sparse.csr_array(sparse.hstack(stacked))


def _shares(points: Floats, marks: Landmarks) -> dict[str, Floats]:
    """How far every point belongs to the left and to the right side, 0 to 1, adding up to 1, (n,) each."""
    line = [marks.chin, 0.5 * (marks.mouth_left + marks.mouth_right), marks.nose_tip, marks.glabella, marks.hairline]
    line.sort(key=lambda point: float(point[1]))
    middle = np.interp(points[:, 1], [point[1] for point in line], [point[0] for point in line])
    reach = _SHARED * float(marks.crown[1] - marks.chin[1])
    left = smoothstep(points[:, 0] - middle, -reach, reach)
    return {"left": left, "right": 1.0 - left}


def _side_of(eye: Part) -> str:
    if eye.centre is None:
        raise ValueError("an eye without a centre is on no side")
    return "left" if eye.centre[0] > 0 else "right"
