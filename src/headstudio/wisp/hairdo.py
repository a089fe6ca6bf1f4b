"""A hairstyle from its settings: the seven steps of Choe, Ko 2005, section 6, in one function."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

import numpy as np

from ..head.mesh import Floats
from ..head.scalp import Scalp
from .accessories import Band
from .adornment import Adornment, adorn
from .colour import strand_colours
from .cutting import Blade
from .deform import Deformer, DeformReport
from .elastics import Elastic, elastics_of
from .field import force_field
from .follicles import Regions, spread_wisps
from .growth import Sown, member_strands
from .headbands import Headband
from .maps import density_map
from .markov import Singles
from .masters import master_controls, synthesise_details
from .members import Masters
from .outlines import Outlines
from .parting import Parting
from .rest import rest_outlines
from .settings import HairColourSettings, WispSettings
from .strands import Strands
from .styling_settings import StylingSettings
from .surroundings import Surroundings

MadeT = TypeVar("MadeT")


@dataclass(frozen=True, eq=False)
class Hairdo:
    """A finished hairstyle.

    strands: what is drawn and exported. outlines: of the wisps, as they lie. controls: control points of the master
    strands [m], (W, n, 3). report: what the deformation solver met. adornments: what is worn in the hair.
    """

    strands: Strands
    outlines: Outlines
    controls: Singles
    report: DeformReport
    adornments: tuple[Adornment, ...]


@dataclass(frozen=True, eq=False)
class _Spread:
    """Wisps on the scalp. rest: their outlines before they are bent. lengths: of the masters [m], (W,)."""

    regions: Regions
    rest: Outlines
    lengths: Floats


@dataclass(frozen=True, eq=False)
class _Laid:
    """Wisps as they lie. outlines: after they were bent. uv: their roots on the scalp square, (W, 2)."""

    spread: _Spread
    outlines: Outlines
    report: DeformReport
    uv: Floats
    elastics: tuple[Elastic, ...]


@dataclass(frozen=True, eq=False)
class _Grown:
    """Strands that have no colour yet, and the control points of the masters."""

    strands: Strands
    controls: Singles


# What does not change how wisps lie: the first of these shape the curls around their outlines, the others the strands.
_CURLS = (
    "prototype", "prototype_curve", "curl_size", "curl_length", "curl_variety", "straight_roots", "temperature", "window",
    "alignment",
)  # fmt: skip
_STRANDS = ("points", "length_distribution", "length_curve", "fuzziness", "shaft_root", "shaft_tip")
_OUTLINES = tuple(field.name for field in fields(WispSettings) if field.name not in (*_CURLS, *_STRANDS))


class Stylist:
    """Styles one head of hair again and again, and makes again only what a change concerns: other curls grow on wisps that
    lie as they lay, and other colours on the same strands. Not for several threads at once.
    """

    def __init__(self) -> None:
        # The last result of every step, with what it was made from.
        self._made: dict[str, tuple[Any, Any]] = {}
        self._deformer = Deformer()

    def style(
        self,
        scalp: Scalp,
        surroundings: Surroundings,
        wisp: WispSettings,
        colour: HairColourSettings,
        styling: StylingSettings,
        strands: int | None = None,
        announce: Callable[[str], None] = lambda step: None,
    ) -> Hairdo:
        """Style hair on ``scalp``.

        strands: make only the first so many of the strands; they are a thinned picture of the whole. ``announce`` is told
        what is being done. Raises ParameterError for curves that cannot be used.
        """

        def step(name: str, wanted: Any, make: Callable[[], MadeT]) -> MadeT:
            if name not in self._made or self._made[name][0] != wanted:
                self._made[name] = (wanted, make())
            made: MadeT = self._made[name][1]
            return made

        spread = step(
            "wisps",
            (scalp, [getattr(wisp, name) for name in _OUTLINES]),
            lambda: _spread(scalp, wisp, announce),
        )
        bare = replace(styling, cuts=(), accessories=())
        count = wisp.strands if strands is None else min(strands, wisp.strands)

        def sow() -> tuple[Sown, Singles]:
            sown = step(
                "sown",
                (spread, count, wisp.hairline),
                lambda: Sown.on(scalp, spread.regions, count, wisp),
            )
            colours = step(
                "colours",
                (sown, colour, wisp.points),
                lambda: strand_colours(colour, sown.owner, spread.regions.count, wisp.points).reshape(-1, 3),
            )
            return sown, colours

        # Where strands are rooted and what colour they have is found out while the wisps are laid.
        with ThreadPoolExecutor(1) as aside:
            sowing = aside.submit(sow)
            laid = step(
                "laid",
                (spread, surroundings, bare),
                lambda: self._lay(spread, scalp, surroundings, bare, announce),
            )
            announce("colour")
            sown, colours = sowing.result()
        grown = step(
            "grown",
            (laid, sown, wisp, styling.cuts, _bands(styling)),
            lambda: _grow(laid, sown, surroundings, wisp, styling, announce),
        )
        worn = step(
            "worn",
            (laid, surroundings, styling.accessories),
            lambda: adorn(styling.accessories, laid.elastics, surroundings),
        )
        coloured = replace(grown.strands, colour=colours)
        return Hairdo(coloured, laid.outlines, grown.controls, laid.report, worn)

    def _lay(
        self,
        spread: _Spread,
        scalp: Scalp,
        surroundings: Surroundings,
        styling: StylingSettings,
        announce: Callable[[str], None],
    ) -> _Laid:
        """Let the wisps lie."""
        announce("flow")
        outlines, report = self._deformer.deform(spread.rest, surroundings, styling, scalp)
        uv = scalp.locate(spread.rest.roots)
        force = force_field(replace(styling, operations=(), accessories=()), surroundings)
        return _Laid(spread, outlines, report, uv, elastics_of(styling.operations, outlines, surroundings, force, uv))


def _bands(styling: StylingSettings) -> tuple[Band, ...]:
    return tuple(worn for worn in styling.accessories if isinstance(worn, Band))


def _spread(scalp: Scalp, wisp: WispSettings, announce: Callable[[str], None]) -> _Spread:
    """Spread the wisps over the scalp."""
    announce("wisps")
    parting = Parting.of(scalp, wisp)
    regions = spread_wisps(scalp, density_map(wisp), wisp.wisps, parting, wisp.seed, wisp.hairline)
    return _Spread(regions, *rest_outlines(scalp, regions, parting, wisp))


def _grow(
    laid: _Laid,
    sown: Sown,
    surroundings: Surroundings,
    wisp: WispSettings,
    styling: StylingSettings,
    announce: Callable[[str], None],
) -> _Grown:
    """Grow the strands that are sown around the masters of wisps that lie."""
    announce("strands")
    outlines = laid.outlines
    details = synthesise_details(laid.spread.rest, wisp, outlines)
    controls = master_controls(outlines, details)
    masters = Masters(
        controls, details.per_segment, outlines.radii.astype(np.float32), laid.spread.lengths / outlines.segment
    )
    blades = [Blade.of(cut, surroundings.proportions, laid.uv) for cut in styling.cuts]
    holds: list[Elastic | Headband] = [*laid.elastics]
    holds += [Headband.of(band, surroundings) for band in _bands(styling)]
    points = member_strands(masters, sown, wisp, surroundings, blades, holds)
    shaft = np.linspace(wisp.shaft_root, wisp.shaft_tip, wisp.points, dtype=np.float32)
    made = Strands.of_equal_count(points, sown.fineness[:, None] * shaft, None, sown.owner.astype(np.int32))
    return _Grown(replace(made, stands_for=wisp.strands / max(len(sown.owner), 1)), controls)
