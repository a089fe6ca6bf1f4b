"""Standard measurements of a head, and what adults measure.

Sources:
ANSUR II. Gordon et al. 2014, "2012 Anthropometric Survey of U.S. Army Personnel: Methods and Summary Statistics",
Natick/TR-15/007; 4082 men, 1986 women.
NIOSH. Zhuang and Bradtmiller 2005, "Head-and-face anthropometric survey of U.S. respirator users", Journal of
Occupational and Environmental Hygiene 2(11), 567-576; 2543 men, 1454 women.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..head import Head
from ..mesh import Floats


class Norm(NamedTuple):
    """Mean and standard deviation of men and women apart [m], and the survey."""

    male: tuple[float, float]
    female: tuple[float, float]
    source: str

    @property
    def mean(self) -> float:
        """Of both sexes in equal parts [m]."""
        return (self.male[0] + self.female[0]) / 2.0

    @property
    def deviation(self) -> float:
        """Pooled within the sexes [m], so the difference between them does not widen it."""
        return float(np.hypot(self.male[1], self.female[1]) / np.sqrt(2.0))


def _norm(male: tuple[float, float], female: tuple[float, float], source: str) -> Norm:
    return Norm((male[0] / 1e3, male[1] / 1e3), (female[0] / 1e3, female[1] / 1e3), source)


ADULTS = {
    "head_length": _norm((199.5, 7.0), (189.8, 7.4), "ANSUR II"),
    "head_breadth": _norm((154.3, 5.5), (147.8, 5.2), "ANSUR II"),
    "tragion_to_top": _norm((131.1, 6.2), (126.5, 6.5), "ANSUR II"),
    "bizygomatic_breadth": _norm((143.5, 6.9), (135.1, 6.5), "NIOSH"),
    "menton_sellion": _norm((122.7, 7.0), (113.4, 6.1), "NIOSH"),
    "interpupillary": _norm((64.5, 3.6), (61.9, 3.5), "NIOSH"),
    "nose_breadth": _norm((36.6, 4.1), (33.2, 3.9), "NIOSH"),
    "nose_protrusion": _norm((21.1, 2.7), (19.8, 2.7), "NIOSH"),
    "subnasale_sellion": _norm((52.0, 4.1), (48.2, 3.8), "NIOSH"),
    "lip_length": _norm((51.1, 4.2), (48.0, 4.0), "NIOSH"),
}


def measured(head: Head) -> dict[str, float]:
    """The measurements of ``ADULTS`` on a head in the head frame [m], from its landmarks and its skin."""
    at, skin = head.landmarks, head.skin.vertices
    tragion, tip = at.left_tragus, at.nose_tip
    height, depth = skin[:, 1], skin[:, 2]
    middle = skin[np.abs(skin[:, 0]) < 1e-4]
    below_nose = middle[(middle[:, 1] < tip[1]) & (middle[:, 1] > tip[1] - 0.018) & (middle[:, 2] > tragion[2] + 0.06)]
    subnasale = below_nose[np.argmin(below_nose[:, 2])]
    above_ears = height > tragion[1] + 0.045
    cheeks = (np.abs(height - tragion[1]) < 0.025) & (depth > tragion[2] + 0.02)
    wings = (np.abs(height - tip[1]) < 0.012) & (depth > subnasale[2] - 0.004)
    return {
        "head_length": _distance(at.glabella, at.occiput),
        "head_breadth": _breadth(skin[above_ears]),
        "tragion_to_top": float(at.crown[1] - tragion[1]),
        "bizygomatic_breadth": _breadth(skin[cheeks]),
        "menton_sellion": _distance(at.chin, at.nasion),
        "interpupillary": _distance(at.left_eye, at.right_eye),
        "nose_breadth": _breadth(skin[wings]),
        "nose_protrusion": _distance(tip, subnasale),
        "subnasale_sellion": _distance(subnasale, at.nasion),
        "lip_length": _distance(at.mouth_left, at.mouth_right),
    }


def _distance(a: Floats, b: Floats) -> float:
    return float(np.linalg.norm(a - b))


def _breadth(points: Floats) -> float:
    return float(np.ptp(points[:, 0]))
