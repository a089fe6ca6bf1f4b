"""What an artist decides about how living skin takes the light."""

from __future__ import annotations

from dataclasses import dataclass

from ..params import choice, number

MONK_TONES = (
    "#f6ede4",
    "#f3e7db",
    "#f7ead0",
    "#eadaba",
    "#d7bd96",
    "#a07e56",
    "#825c43",
    "#604134",
    "#3a312a",
    "#292420",
)
"""The ten tones of the Monk scale, sRGB, from light to dark."""

TONES = ("own", *(f"monk {k}" for k in range(1, len(MONK_TONES) + 1)), "measured")
PIGMENTS = ("spectra", "pictures")
MODELS = ("simple", "lafortune")
SCATTERING = ("curvature", "screen")


@dataclass(frozen=True)
class SkinSettings:
    """Pigments, reflection and scattering of living skin: Bando's thesis, section 2.7 and its future work."""

    tone: str = choice(
        "own",
        "Tone",
        TONES,
        "Base colour b of eq. 2.6: the look's own skin colour, a tone of the Monk scale, or that of the measured skin.",
        live=True,
    )
    melanin: float = number(
        0.0, "Melanin", "", -0.5, 2.5, "Melanin beyond the base colour, m of eq. 2.6: browns the skin.", live=True
    )
    haemoglobin: float = number(
        0.0, "Haemoglobin", "", -0.5, 1.5, "Blood beyond the base colour, h of eq. 2.6: reddens the skin.", live=True
    )
    pigments: str = choice(
        "spectra",
        "Pigments by",
        PIGMENTS,
        "What melanin absorbs, a_m of eq. 2.6: by its spectrum, or as found in pictures of faces, which is yellower.",
        live=True,
    )
    flush: float = number(
        1.0,
        "Flush",
        "",
        0.0,
        3.0,
        "How uneven blood lies under the skin: red nose, cheeks, chin and ears, and blotches everywhere.",
        live=True,
    )
    blood_flow: float = number(
        0.0,
        "Blood flow",
        "",
        0.0,
        2.0,
        "Skin pales where it is stretched and reddens where it is pressed together.",
        live=True,
    )
    model: str = choice(
        "simple",
        "Reflection",
        MODELS,
        "Two soft highlights over scattered light, or the Lafortune model with the coefficients of measured skin.",
        live=True,
    )
    gloss: float = number(1.0, "Gloss", "", 0.0, 3.0, "Strength of the highlights.", live=True)
    roughness: float = number(
        0.42, "Roughness", "", 0.15, 0.9, "How wide the highlights of the simple model are.", live=True
    )
    scattering: float = number(
        1.0, "Scattering", "", 0.0, 3.0, "How far light travels under the skin, relative to measured skin.", live=True
    )
    scattering_by: str = choice(
        "curvature",
        "Scattering by",
        SCATTERING,
        "Curvature: worked out beforehand for every bend of the skin. Screen: the light on the skin is spread in the picture.",
        live=True,
    )
    relief: float = number(
        1.0, "Relief", "", 0.0, 4.0, "Height of fine wrinkles and pores; above 1 they are exaggerated.", live=True
    )
    creases: float = number(
        1.0, "Shade in creases", "", 0.0, 2.0, "How much darker and warmer the floors of furrows are.", live=True
    )
