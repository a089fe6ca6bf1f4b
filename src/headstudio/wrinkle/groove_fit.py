"""Moving and sizing grooves so that the skin they make comes as near to a scan as it can.

Heights over the skin are compared texel by texel. What is made small is the mean distance to the scan, not its square,
so that a few places that do not belong (a lip, a scar, hair) do not pull: Gauss-Newton steps, damped after Levenberg and
Marquardt, with weights found anew at each step (Holland and Welsch 1977). Grooves take their steps one after the other,
each with a damping of its own, so that one that is hard to fit does not hold up the rest.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from ..head.mesh import Floats, Ints
from .groove import SAMPLES, Groove, GrooveBed, MetricField
from .groove_stiffness import bends_of
from .scan_heights import ScanHeights

# Distances below this count by their square [m]: the noise of a scan.
_NOISE = 1e-4
_NOTHING = 1e-9
_DAMPING, _EASED, _STIFFER, _TRIES = 1e-2, 0.3, 6.0, 4
# The scale of the unknowns in the damping: logarithms, places [m], turns [rad].
_LOG, _PLACE, _TURN = 0.3, 1e-3, 0.01
# Texels farther than this from a curve's samples, besides its reach, are not looked at [m].
_SLACK = 5e-3
# A scan covers what lies this near to one of its texels [m].
_COVERED = 2e-3


class _Placed:
    """A groove on the skin. height: what it makes of it at its rows [m], (i,)."""

    def __init__(self, bed: GrooveBed) -> None:
        self.bed = bed
        self.height, derivative = bed.heights()
        # Far out everything is so small that arithmetic gets slow. By its unknowns, (i, unknowns).
        self.slopes = np.where(np.abs(derivative) < _NOTHING, 0.0, derivative)
        # What stiffness asks for: these, (s,), to be nothing; and their derivatives, (s, unknowns).
        self.bends, self.by_unknowns = bends_of(bed, _NOISE)

    @property
    def strain(self) -> float:
        """What winding about costs [m^3]."""
        return 0.5 * float(self.bends @ self.bends)


class GrooveFit:
    """One scan, and grooves that approach it. motion: how the scan was moved towards them, (4, 4)."""

    def __init__(self, heights: ScanHeights, grooves: Sequence[Groove], known: GrooveFit | None = None) -> None:
        """heights: of the scan, with any smooth change of shape taken off. known: another fit to the same scan; grooves that
        are in both are taken over as they lie there."""
        self.heights = heights
        self.texels = heights.texels
        self.motion = np.eye(4)
        self._metrics: MetricField = MetricField(self.texels) if known is None else known._metrics
        self._rows: Ints = np.flatnonzero(heights.covered)
        self._covered: cKDTree = cKDTree(self.texels.positions[self._rows]) if known is None else known._covered
        self._upright = uprightness(heights)
        self._area = np.where(heights.covered, self.texels.area, 0.0)
        self.area = self._area.sum()
        self._area /= self.area
        placed = {} if known is None else {placed.bed.groove: placed for placed in known._placed}
        self._placed: list[_Placed] = [placed.get(groove) or _Placed(self._bed(groove)) for groove in grooves]
        self._damping = np.full(len(self._placed), _DAMPING)
        self._height: Floats = np.zeros(len(heights.height))
        for each in self._placed:
            self._height[each.bed.rows] += each.height

    @property
    def beds(self) -> list[GrooveBed]:
        """The grooves on the skin."""
        return [placed.bed for placed in self._placed]

    @property
    def grooves(self) -> list[Groove]:
        """The grooves as they are now."""
        return [bed.groove for bed in self.beds]

    @property
    def height(self) -> Floats:
        """What the grooves make of the skin [m], (k,): their heights add up."""
        return self._height

    @property
    def left(self) -> Floats:
        """What they leave of the heights of the scan [m], (k,); nan where the scan is not."""
        return self.heights.height - self.height

    @property
    def cost(self) -> float:
        """Mean distance to the scan over what it covers, noise counted in [m]."""
        return self._cost(self._rows, self.height[self._rows])

    def sweep(self, among: Iterable[int] | None = None, steps: int = 2) -> Floats:
        """Let every groove, or those ``among`` them, take some steps; the mean distance does not rise.

        Returns by which part it fell by each groove, (grooves,).
        """
        fell, before = np.zeros(len(self._placed)), self.cost
        for k in range(len(self._placed)) if among is None else among:
            fell[k] = self._improve(k, steps) / before
        return fell

    def worth(self) -> Floats:
        """How much more room there would be between scan and skin without each groove [m^3], (grooves,)."""
        rises = []
        for placed in self._placed:
            rows = placed.bed.rows
            height = self._height[rows]
            rises.append(self._cost(rows, height - placed.height) - self._cost(rows, height))
        return self.area * np.array(rises)

    def beside(self, some: Ints) -> Ints:
        """The grooves that displace skin that ``some`` of them do, too."""
        shared = np.zeros(len(self._height), dtype=bool)
        for k in some:
            shared[self._placed[k].bed.rows] = True
        return np.array([k for k, placed in enumerate(self._placed) if shared[placed.bed.rows].any()], dtype=np.int64)

    def replaced(self, grooves: Sequence[Groove]) -> GrooveFit:
        """A fit of other grooves to the same scan where it is now."""
        fit = GrooveFit(self.heights, grooves, self)
        fit.motion = self.motion
        return fit

    def let_scan_move(self) -> None:
        """Lay the scan better on what the grooves make: one rigid step, if it brings both nearer."""
        left = self.left[self._rows]
        points, normals = self.texels.positions[self._rows], self.texels.normals[self._rows]
        scales = np.repeat([_PLACE, _TURN], 3)
        rises = np.concatenate([normals, np.cross(points, normals)], axis=1)
        normal, pull = _equations(rises * scales, -left, self._weights(self._rows, left))
        twist = scales * _step(normal, pull, _DAMPING)
        before, heights = self.cost, self.heights
        rise = np.zeros(len(heights.height))
        rise[self._rows] = rises @ twist
        self.heights = heights.without(-rise)
        if self.cost >= before:
            self.heights = heights
            return
        step = np.eye(4)
        step[:3, :3], step[:3, 3] = Rotation.from_rotvec(twist[3:]).as_matrix(), twist[:3]
        self.motion = step @ self.motion

    def _improve(self, k: int, steps: int) -> float:
        """Let a groove take some steps. Returns by how much the mean distance fell [m]."""
        placed = self._placed[k]
        self._height[placed.bed.rows] -= placed.height
        near = np.union1d(self._near(placed.bed.groove), placed.bed.rows)
        cost = before = self._cost_with(placed, near)
        for _ in range(steps):
            bed = placed.bed
            left = self.heights.height[bed.rows] - self._height[bed.rows] - placed.height
            scales = bed.scales(_LOG, _PLACE)
            normal, pull = _equations(placed.slopes * scales, left, self._weights(bed.rows, left))
            stiff = placed.by_unknowns * scales / np.sqrt(self.area)
            normal += stiff.T @ stiff
            pull -= stiff.T @ placed.bends / np.sqrt(self.area)
            for _ in range(_TRIES):
                moved = bed.moved(scales * _step(normal, pull, self._damping[k]))
                tried = _Placed(GrooveBed(moved, self.texels, self._metrics, near))
                new_cost = self._cost_with(tried, near)
                if new_cost < cost:
                    self._damping[k] = max(_EASED * self._damping[k], 1e-4)
                    break
                self._damping[k] = min(_STIFFER * self._damping[k], 1e3)
            else:
                break
            placed, cost = tried, new_cost
        self._height[placed.bed.rows] += placed.height
        self._placed[k] = placed
        return before - cost

    def _cost_with(self, placed: _Placed, near: Ints) -> float:
        height = self._height[near]
        # The texels of a groove are some of those near it, in the same order.
        own = np.searchsorted(near, placed.bed.rows)
        height[own] += placed.height
        return self._cost(near, height) + placed.strain / self.area

    def _cost(self, rows: Ints, height: Floats) -> float:
        left = (self.heights.height[rows] - height) * self._upright[rows]
        return float(self._area[rows] @ np.sqrt(left**2 + _NOISE**2))

    def _weights(self, rows: Ints, left: Floats) -> Floats:
        upright = self._upright[rows]
        return self._area[rows] * upright**2 / np.sqrt((left * upright) ** 2 + _NOISE**2)

    def _line(self, groove: Groove) -> Floats:
        """Points of a curve on the skin [m], (k, 3)."""
        _, places = groove.chain.sampled(SAMPLES)
        found, _ = self.texels.layout.locate(places)
        mesh = self.texels.layout.texture_map.mesh
        return found.blend(mesh.vertices, mesh.faces)

    def seen(self, groove: Groove) -> NDArray[np.bool_]:
        """Which samples of a groove's curve the scan covers, (k,)."""
        away, _ = self._covered.query(self._line(groove), distance_upper_bound=_COVERED)
        return np.isfinite(away)

    def _bed(self, groove: Groove) -> GrooveBed:
        return GrooveBed(groove, self.texels, self._metrics, self._near(groove))

    def _near(self, groove: Groove) -> Ints:
        """Covered texels that the groove may reach, now and after some steps."""
        reach = groove.reach + _SLACK
        away, _ = cKDTree(self._line(groove)).query(self.texels.positions[self._rows], distance_upper_bound=reach)
        return self._rows[np.isfinite(away)]


def uprightness(heights: ScanHeights) -> Floats:
    """The cosine between the scan and the skin at every texel, (k,): a height differs by a distance over this."""
    texels = heights.texels
    rise = np.gradient(ndimage.gaussian_filter(heights.filled, 1.0), texels.metres)
    return texels.of_image(1.0 / np.sqrt(1.0 + rise[0] ** 2 + rise[1] ** 2))


def _equations(columns: Floats, left: Floats, weights: Floats) -> tuple[Floats, Floats]:
    """The normal equations of scaled unknowns, (u, u) and (u,), for what is left, (i,)."""
    weighted = columns * weights[:, None]
    return weighted.T @ columns, weighted.T @ left


def _step(normal: Floats, pull: Floats, damping: float) -> Floats:
    """The damped least-squares step, (u,)."""
    size = np.trace(normal) / len(normal)
    damped = normal + damping * (np.diag(np.diag(normal)) + (0.02 * size + 1e-12) * np.eye(len(normal)))
    step: Floats = np.linalg.solve(damped, pull)
    return step
