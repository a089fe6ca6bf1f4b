"""What an artist decides about statistical wisps and the colour of hair: Choe, Ko 2005, sections 2, 5 and 6."""

from __future__ import annotations

from dataclasses import dataclass

from ..head.scalp_settings import GrayImage
from ..params import choice, colour, integer, number

# Control points (x, y) of an editable curve over 0 to 1, and points in space.
CurvePoints = tuple[tuple[float, float], ...]
Path3D = tuple[tuple[float, float, float], ...]

PROTOTYPES = ("straight", "wavy", "loose curl", "tight curl", "coil", "kinky", "zigzag")
LENGTH_DISTRIBUTIONS = ("blunt", "trimmed", "layered", "feathered", "frayed")
DEVIATION_RADII = ("constant", "tapering", "bell", "pinched", "flaring")
DENSITY_MAPS = ("even", "thinning", "receding", "bald crown", "undercut", "mohawk", "monk")
LENGTH_MAPS = (
    "even",
    "fringe",
    "bob",
    "round",
    "layered",
    "long back",
    "short back and sides",
    "top knot",
    "undercut",
    "mohawk",
    "mullet",
    "crop",
)
PROTRUSION_MAPS = ("flat", "natural", "lifted front", "full crown", "standing")
PARTINGS = ("none", "centre", "left", "right", "zigzag", "to nape")
FACIAL_HAIR = ("none", "stubble", "moustache", "goatee", "beard", "full beard")
PIGMENTS = (
    "black",
    "dark brown",
    "brown",
    "light brown",
    "auburn",
    "red",
    "strawberry blonde",
    "dark blonde",
    "blonde",
    "platinum",
    "white",
    "melanin",
    "dyed",
)
SPREADS = ("uniform", "gaussian")


@dataclass(frozen=True)
class WispSettings:
    """The shape of hair before it is styled: global parameters, prototype strand and wisp parameters.

    length_curve: the density l(u) of relative lengths as control points, in place of the named distribution.
    radius_curve: the deviation radius r(s), relative to the root, in place of the named one. prototype_curve: a drawn or
    imported prototype strand, root first [m], in place of the named one; two points or more. parting_line: a drawn
    parting, (u, v) on the scalp square, in place of the named one; two points or more. painted_density, painted_lengths,
    painted_protrusion: painted maps in place of the named ones.
    """

    wisps: int = integer(1500, "Wisps", 1, 10_000, "How many wisps there are, N_w.", log=True)
    strands: int = integer(100_000, "Strands", 1, 500_000, "How many strands there are in all, N_s.", log=True)
    points: int = integer(32, "Points", 2, 256, "How many points a finished strand has.", log=True)
    segments: int = integer(24, "Segments", 2, 100, "How many segments the outline of the longest hair has.")
    length: float = number(
        0.27, "Length", "m", 0.001, 1.5, "The longest hair; the gray length map scales it.", shown="cm", log=True
    )
    density_map: str = choice("even", "Density map", DENSITY_MAPS, "Where on the scalp hair grows densely.")
    length_map: str = choice("layered", "Length map", LENGTH_MAPS, "How hair length varies over the scalp.")
    protrusion_map: str = choice(
        "natural", "Protrusion map", PROTRUSION_MAPS, "Where hair lies along the scalp and where it stands up."
    )
    protrusion: float = number(
        1.0, "Protrusion", "", 0.0, 3.0, "How far hair stands up, as a multiple of the protrusion map."
    )
    parting: str = choice("left", "Parting", PARTINGS, "Where hair is parted: left and right are the person's own.")
    parting_reach: float = number(
        0.07, "Parting reach", "m", 0.005, 0.2, "How far from the parting hair still leans away from it.", shown="cm"
    )
    prototype: str = choice("straight", "Prototype", PROTOTYPES, "The strand that all strands resemble.")
    curl_size: float = number(
        1.0, "Curl size", "", 0.0, 4.0, "How far curls reach sideways, as a multiple of the prototype."
    )
    curl_length: float = number(
        1.0,
        "Curl length",
        "",
        0.25,
        4.0,
        "How long curls are along the hair, as a multiple of the prototype.",
        log=True,
    )
    curl_variety: float = number(
        0.0,
        "Curl variety",
        "",
        0.0,
        1.0,
        "How far curls differ in size from lock to lock: 0.3 makes those of one a third larger than another's.",
    )
    straight_roots: float = number(
        0.02, "Straight roots", "m", 0.0, 0.3, "How far from the scalp curls have reached their size.", shown="cm"
    )
    temperature: float = number(
        0.02,
        "Temperature",
        "",
        0.0,
        0.3,
        "Temperature T of the Gibbs choice (eq. 4), as a part of the prototype's amplitude: 0 copies the prototype, "
        "0.12 hardly resembles it.",
    )
    window: float = number(
        0.5, "Window", "", 0.1, 3.0, "Length of the compared window (eq. 2), in periods of the prototype."
    )
    alignment: float = number(
        0.0, "Alignment", "", 0.0, 1.0, "0: every wisp starts its waves where it likes; 1: all wave together."
    )
    length_distribution: str = choice(
        "trimmed", "Length distribution", LENGTH_DISTRIBUTIONS, "How long the strands of a wisp are, l(u)."
    )
    deviation_radius: str = choice(
        "tapering", "Deviation radius", DEVIATION_RADII, "How far strands stray from the master strand, r(s)."
    )
    radius: float = number(
        1.0, "Wisp radius", "", 0.0, 5.0, "Radius of wisps, as a multiple of that of their roots on the scalp."
    )
    fuzziness: float = number(
        0.1, "Fuzziness", "", 0.0, 1.0, "Variation sigma of the strands in a wisp: 0.1 is smooth, 1 is wild (eq. 1)."
    )
    shaft_root: float = number(
        35e-6,
        "Shaft at the root",
        "m",
        5e-6,
        500e-6,
        "Half the thickness of a strand at its root.",
        shown="mm",
        log=True,
    )
    shaft_tip: float = number(
        15e-6, "Shaft at the tip", "m", 1e-6, 500e-6, "Half the thickness of a strand at its tip.", shown="mm", log=True
    )
    hairline: float = number(
        0.010,
        "Soft hairline",
        "m",
        0.0,
        0.05,
        "How far from the border of the scalp hair is still finer and sparser; at the nape it is twice as far.",
        shown="mm",
    )
    seed: int = integer(1, "Seed", 0, 2**31 - 1, "Start of the random numbers: the same seed gives the same hair.")
    length_curve: CurvePoints = ()
    radius_curve: CurvePoints = ()
    prototype_curve: Path3D = ()
    parting_line: CurvePoints = ()
    painted_density: GrayImage | None = None
    painted_lengths: GrayImage | None = None
    painted_protrusion: GrayImage | None = None


@dataclass(frozen=True)
class HairColourSettings:
    """The colour of hair: Choe, Ko 2005, section 5. Each channel of HSV has its own distribution over strands and wisps."""

    pigment: str = choice(
        "brown", "Pigment", PIGMENTS, "A natural colour; melanin and dyed take the values that stand below."
    )
    eumelanin: float = number(0.5, "Eumelanin", "", 0.0, 8.0, "Concentration of brown-black pigment, for melanin.")
    pheomelanin: float = number(0.2, "Pheomelanin", "", 0.0, 8.0, "Concentration of red-yellow pigment, for melanin.")
    dye: tuple[float, float, float] = colour("#7a2f5d", "Dye", "The mean colour of dyed hair.")
    hue_distribution: str = choice("gaussian", "Hue distribution", SPREADS, "How hue is distributed.")
    saturation_distribution: str = choice(
        "gaussian", "Saturation distribution", SPREADS, "How saturation is distributed."
    )
    value_distribution: str = choice("gaussian", "Value distribution", SPREADS, "How brightness is distributed.")
    hue_spread: float = number(
        0.01,
        "Hue spread",
        "",
        0.0,
        0.5,
        "Over strands: standard deviation, or half the width if uniform; 1 is the circle.",
    )
    saturation_spread: float = number(
        0.05, "Saturation spread", "", 0.0, 1.0, "Over strands: standard deviation, or half the width if uniform."
    )
    value_spread: float = number(
        0.06, "Value spread", "", 0.0, 1.0, "Over strands: standard deviation, or half the width if uniform."
    )
    wisp_hue_spread: float = number(0.0, "Hue spread of wisps", "", 0.0, 0.5, "The same, from wisp to wisp.")
    wisp_saturation_spread: float = number(
        0.02, "Saturation spread of wisps", "", 0.0, 1.0, "The same, from wisp to wisp."
    )
    wisp_value_spread: float = number(0.03, "Value spread of wisps", "", 0.0, 1.0, "The same, from wisp to wisp.")
    gray: float = number(0.0, "Gray", "", 0.0, 1.0, "Part of the strands that have lost their pigment.")
    tip_colour: tuple[float, float, float] = colour("#c79a5e", "Tip colour", "What colour hair turns to at the tip.")
    tip_amount: float = number(0.0, "Tip amount", "", 0.0, 1.0, "How far it turns to the colour of the tip.")
    tip_start: float = number(0.3, "Tip start", "", 0.0, 1.0, "Where along the strand it starts to turn.")
    streak_colour: tuple[float, float, float] = colour("#d8b070", "Streak colour", "The colour of streaks.")
    streaks: float = number(0.0, "Streaks", "", 0.0, 1.0, "Part of the wisps that are streaks.")
    seed: int = integer(1, "Seed", 0, 2**31 - 1, "Start of the random numbers: the same seed gives the same colours.")


@dataclass(frozen=True)
class FacialHairSettings:
    """Hair of the face: the same wisps on patches of their own. Its colour is that of the hair."""

    style: str = choice("none", "Facial hair", FACIAL_HAIR, "Which hair of the face grows.")
    length: float = number(
        0.02,
        "Length",
        "m",
        0.0005,
        0.5,
        "The longest hair of a beard; a moustache is a little shorter.",
        shown="mm",
        log=True,
    )
    strands: int = integer(20_000, "Strands", 1, 200_000, "How many strands there are in all.", log=True)
    prototype: str = choice("wavy", "Prototype", PROTOTYPES, "The strand that all strands resemble.")
    curl_size: float = number(
        0.3, "Curl size", "", 0.0, 4.0, "How far curls reach sideways, as a multiple of the prototype."
    )
    curl_length: float = number(
        0.4,
        "Curl length",
        "",
        0.25,
        4.0,
        "How long curls are along the hair, as a multiple of the prototype.",
        log=True,
    )
    protrusion: float = number(0.4, "Protrusion", "", 0.0, 1.0, "How far hair stands up from the skin.")
    fuzziness: float = number(0.4, "Fuzziness", "", 0.0, 1.0, "Variation sigma of the strands in a wisp (eq. 1).")
    stiffness: float = number(
        2.5, "Bending stiffness", "", 0.0, 50.0, "Weight kappa of the hair's own shape against gravity (eq. 5)."
    )
    shaft: float = number(
        45e-6, "Shaft", "m", 5e-6, 500e-6, "Half the thickness of a strand at its root.", shown="mm", log=True
    )
    seed: int = integer(1, "Seed", 0, 2**31 - 1, "Start of the random numbers: the same seed gives the same hair.")
