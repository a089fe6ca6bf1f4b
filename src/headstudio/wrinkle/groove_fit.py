"""Moving and sizing grooves so that the skin they make comes as near to a scan as it can.

Heights over the skin are compared texel by texel. What is made small is the mean distance to the scan, not its square,
so that a few places that do not belong (a lip, a scar, hair) do not pull: Gauss-Newton steps, damped after Levenberg and
Marquardt, with weights found anew at each step (Holland and Welsch 1977). The scan may move a little with them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import ndimage, sparse
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from ..head.mesh import Floats, Ints
from .groove import Groove, GrooveBed, MetricField
from .scan_heights import ScanHeights
from .shape import REACH

# Distances below this count by their square [m]: the noise of a scan.
_NOISE = 1e-4
# Depths of strands that share a place are joined as in blending.py.
_POWER = 6.0
_DAMPING, _EASED, _STIFFER = 1e-2, 0.3, 5.0
# The scale of the unknowns in the damping: logarithms, places [m], turns [rad].
_LOG, _PLACE, _TURN = 0.3, 1e-3, 0.01
# Texels farther than this from a curve's samples, besides the reach of its strands, are not looked at [m].
_SLACK = 5e-3


@dataclass(frozen=True, eq=False)
class GrooveModel:
    """Heights that grooves make. height: of every texel [m], (k,). slopes: by all unknowns, (k, unknowns).

    raised, powers: for every groove what it adds above the skin [m] and to the joined depth beneath, at its rows.
    """

    beds: tuple[GrooveBed, ...]
    raised: tuple[Floats, ...]
    powers: tuple[Floats, ...]
    height: Floats
    slopes: sparse.csr_array


class GrooveFit:
    """One scan, and grooves that approach it."""

    def __init__(self, heights: ScanHeights, grooves: Sequence[Groove]) -> None:
        """heights: of the scan, with any smooth change of shape taken off."""
        self.heights = heights
        self.grooves = tuple(grooves)
        self.texels = heights.texels
        self._metrics = MetricField(self.texels)
        self._rows: Ints = np.flatnonzero(heights.covered)
        self._tree = cKDTree(self.texels.positions[self._rows])
        self._upright = uprightness(heights)[self._rows]
        self._area = self.texels.area[self._rows] / self.texels.area[self._rows].sum()
        self._damping = _DAMPING
        self.motion = np.eye(4)
        self.model = self._modelled(self.grooves)
        self.cost = self._cost(self.model.height)

    def step(self, rigid: bool = True) -> float:
        """One step that does not raise the mean distance; returns by which part it fell."""
        left = self._left(self.model.height)
        weight = self._area * self._upright**2 / np.sqrt((left * self._upright) ** 2 + _NOISE**2)
        columns = self.model.slopes[self._rows]
        scales = self._scales()
        if rigid:
            columns = sparse.hstack([columns, sparse.csr_array(self._rigid_slopes())]).tocsr()
            scales = np.concatenate([scales, np.full(3, _PLACE), np.full(3, _TURN)])
        columns = sparse.csr_array(columns * scales)
        weighted = sparse.csr_array(columns * weight[:, None])
        normal = (columns.T @ weighted).toarray()
        pull = weighted.T @ left
        size = np.trace(normal) / len(normal)
        before = self.cost
        for _ in range(6):
            # The steps are those of the scaled unknowns.
            damped = normal + self._damping * (np.diag(np.diag(normal)) + 0.02 * size * np.eye(len(normal)))
            change = scales * np.linalg.solve(damped, pull)
            if self._accept(change, rigid):
                self._damping *= _EASED
                return 1.0 - self.cost / before
            self._damping *= _STIFFER
        return 0.0

    def worth(self) -> Floats:
        """By which part the mean distance would rise without each groove, (grooves,)."""
        model = self.model
        raised, powers = np.zeros((2, len(model.height)))
        for bed, up, power in zip(model.beds, model.raised, model.powers):
            raised[bed.rows] += up
            powers[bed.rows] += power
        costs = []
        for bed, up, power in zip(model.beds, model.raised, model.powers):
            height = model.height.copy()
            depth = np.maximum(powers[bed.rows] - power, 0.0) ** (1 / _POWER)
            height[bed.rows] = raised[bed.rows] - up - depth
            costs.append(self._cost(height))
        return np.array(costs) / self.cost - 1.0

    def replaced(self, grooves: Sequence[Groove]) -> GrooveFit:
        """A fit of other grooves to the same scan where it is now."""
        fit = GrooveFit(self.heights, grooves)
        fit.motion = self.motion
        return fit

    @property
    def left(self) -> Floats:
        """What the grooves leave of the heights [m], (k,); nan where the scan is not."""
        return self.heights.height - self.model.height

    def _accept(self, change: Floats, rigid: bool) -> bool:
        count = len(change) - 6 if rigid else len(change)
        ends = np.cumsum([0, *(bed.unknowns for bed in self.model.beds)])
        moved = tuple(bed.moved(change[a:b]) for bed, a, b in zip(self.model.beds, ends, ends[1:]))
        heights = self.heights
        if rigid:
            shift = np.zeros(len(heights.height))
            shift[self._rows] = self._rigid_slopes() @ change[count:]
            heights = heights.without(shift)
        model = self._modelled(moved)
        cost = self._cost(model.height, heights)
        if cost >= self.cost:
            return False
        self.grooves, self.model, self.cost, self.heights = moved, model, cost, heights
        if rigid:
            self.motion = _motion(-change[count:]) @ self.motion
        return True

    def _modelled(self, grooves: Sequence[Groove]) -> GrooveModel:
        beds = tuple(GrooveBed(groove, self.texels, self._metrics, self._near(groove)) for groove in grooves)
        parts = [bed.heights() for bed in beds]
        raised = tuple(sum(np.maximum(height, 0.0) for height, _ in strands) for strands in parts)
        powers = tuple(sum(np.maximum(-height, 0.0) ** _POWER for height, _ in strands) for strands in parts)
        total, joined = np.zeros((2, len(self.heights.height)))
        for bed, up, power in zip(beds, raised, powers):
            total[bed.rows] += up
            joined[bed.rows] += power
        joined **= 1 / _POWER
        ends = np.cumsum([0, *(bed.unknowns for bed in beds)])
        blocks = []
        for bed, strands, start in zip(beds, parts, ends):
            slope = np.zeros((len(bed.rows), bed.unknowns))
            for height, derivative in strands:
                share = np.divide(-height, joined[bed.rows], out=np.ones_like(height), where=height < 0)
                slope += np.where(height < 0, share, 1.0)[:, None] ** (_POWER - 1) * derivative
            rows = np.repeat(bed.rows, bed.unknowns)
            columns = np.tile(np.arange(start, start + bed.unknowns), len(bed.rows))
            blocks.append((slope.ravel(), rows, columns))
        values, rows, columns = (np.concatenate([np.zeros(0), *part]) for part in zip(*blocks))
        shape = len(total), int(ends[-1])
        slopes = sparse.coo_array((values, (rows.astype(np.int64), columns.astype(np.int64))), shape=shape).tocsr()
        return GrooveModel(beds, raised, powers, total - joined, slopes)

    def _near(self, groove: Groove) -> Ints:
        """Covered texels that the groove may reach."""
        widest = max(strand.width for strand in groove.strands)
        farthest = max(abs(strand.offset) for strand in groove.strands)
        _, places = groove.chain.sampled(24)
        found, _ = self.texels.layout.locate(places)
        mesh = self.texels.layout.texture_map.mesh
        points = found.blend(mesh.vertices, mesh.faces)
        away, _ = cKDTree(points).query(
            self.texels.positions[self._rows], distance_upper_bound=REACH * widest + farthest + _SLACK
        )
        return self._rows[np.isfinite(away)]

    def _left(self, height: Floats, heights: ScanHeights | None = None) -> Floats:
        return (heights or self.heights).height[self._rows] - height[self._rows]

    def _cost(self, height: Floats, heights: ScanHeights | None = None) -> float:
        left = self._left(height, heights) * self._upright
        return float(self._area @ np.sqrt(left**2 + _NOISE**2))

    def _scales(self) -> Floats:
        scales = []
        for bed in self.model.beds:
            strands = len(bed.groove.strands)
            scales += [np.full(len(bed.free) + 2, _PLACE), [_LOG], np.tile([_LOG, _LOG, _PLACE], strands)]
        return np.concatenate([np.zeros(0), *scales])

    def _rigid_slopes(self) -> Floats:
        """How the heights of the scan fall by its motion: a shift [m] and a turn [rad] about the origin, (r, 6)."""
        points, normals = self.texels.positions[self._rows], self.texels.normals[self._rows]
        return -np.concatenate([normals, np.cross(points, normals)], axis=1)


def uprightness(heights: ScanHeights) -> Floats:
    """The cosine between the scan and the skin at every texel, (k,): a height differs by a distance over this."""
    texels = heights.texels
    rise = np.gradient(ndimage.gaussian_filter(heights.filled, 1.0), texels.metres)
    return texels.of_image(1.0 / np.sqrt(1.0 + rise[0] ** 2 + rise[1] ** 2))


def _motion(twist: Floats) -> Floats:
    """A small shift [m] and turn [rad], (6,), as a matrix."""
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_rotvec(twist[3:]).as_matrix()
    matrix[:3, 3] = twist[:3]
    return matrix
