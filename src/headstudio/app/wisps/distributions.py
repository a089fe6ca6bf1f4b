"""Step 4: the strands of a wisp: how long they are, how far they stray, and how they vary (Choe, Ko 2005, section 2)."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator

from ...wisp.curves import LengthDistribution, radius_points
from ..curve_plot import HELP, CurvePlot
from ..parameter_rows import ParameterRows
from ..ui import Ui
from .named import Named

_VARIATION = ("fuzziness", "temperature", "window", "alignment", "shaft_root", "shaft_tip", "hairline")


class WispStep:
    """l(u) and r(s) as curves, sigma, T and h."""

    def __init__(self, rows: ParameterRows) -> None:
        self.rows = rows
        self._lengths = Named(rows, "length_distribution", "length_curve", "own curve")
        self._radii = Named(rows, "deviation_radius", "radius_curve", "own curve")
        self._length_plot = CurvePlot(
            "Length curve", lambda points: lambda u: np.interp(u, *points.T), 1.2, "length u", "share of strands l(u)"
        )
        self._radius_plot = CurvePlot(
            "Radius curve", lambda points: PchipInterpolator(*points.T), 2.5, "root to tip s", "radius r(s)"
        )

    def draw(self, ui: Ui) -> None:
        """Both curves, each below the choice of those that ship, and the numbers."""
        wisp = self.rows.studio.document.wisp
        self._lengths.row(ui)
        shape = LengthDistribution.of(wisp).points
        curve = self._length_plot.draw(ui, tuple((float(u), float(density)) for u, density in shape))
        if curve is not None:
            self._lengths.put(curve)
        ui.muted(HELP)
        self._radii.row(ui)
        curve = self._radius_plot.draw(ui, radius_points(wisp))
        if curve is not None:
            self._radii.put(curve)
        self.rows.rows(ui, "wisp", ("radius", *_VARIATION))
