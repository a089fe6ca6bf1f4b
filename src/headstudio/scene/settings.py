"""The parts of the document that are neither head, hair nor wrinkle: motion, look and camera."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..params import choice, colour, integer, number, switch, text

MOTIONS = ("rest", "shake", "nod", "turn", "tilt", "split", "wind")
HAIR_AS = ("particles", "strands", "none")
SKIN_AS = ("resting", "living")
STRAND_MODELS = ("fibre", "kajiya-kay")
SKIN_SHOWS = ("skin", "expansion", "shrinkage", "amplitude", "height")
TONE_MAPS = ("soft", "filmic", "none")
SAMPLES = ("auto", "1", "2", "4", "8")


@dataclass(frozen=True)
class HeadSettings:
    """Which head."""

    source: str = text("makehuman", "Head", "makehuman, mannequin, or the path of a mesh (OBJ, PLY, STL, OFF, GLB).")
    eyes: str = text("", "Eyes", "The path of a mesh with eyes, teeth or lashes for a head from a file that has none.")
    age: float = number(0.2, "Age", "", 0.0, 1.0, "MakeHuman's age: 0 young, 1 old.")
    masculine: float = number(0.0, "Masculine", "", 0.0, 1.0, "MakeHuman's sex: 0 female, 1 male.")


@dataclass(frozen=True)
class MotionSettings:
    """How the head moves by itself."""

    kind: str = choice("rest", "Motion", MOTIONS, "What the head does.", live=True)
    angle: float = number(
        math.radians(40),
        "Angle",
        "rad",
        0.0,
        math.radians(60),
        "How far the head turns to each side.",
        shown="deg",
        live=True,
    )
    rate: float = number(2.0, "Rate", "Hz", 0.1, 4.0, "How often it turns.", live=True)


@dataclass(frozen=True)
class Look:
    """How things look: colours, light and what is drawn."""

    hair_colour: tuple[float, float, float] = colour("#6b4a2f", "Hair", "Colour of the hair.")
    skin_colour: tuple[float, float, float] = colour("#c99a7d", "Skin", "Colour of the skin.")
    iris_colour: tuple[float, float, float] = colour("#5f7f8a", "Iris", "Colour of the eyes.")
    background: tuple[float, float, float] = colour("#3a3d42", "Background", "Colour behind the head.")
    light_azimuth: float = number(
        math.radians(35),
        "Light azimuth",
        "rad",
        -math.pi,
        math.pi,
        "Where the light comes from, about the vertical.",
        shown="deg",
        live=True,
    )
    light_height: float = number(
        math.radians(50),
        "Light height",
        "rad",
        math.radians(-20),
        math.radians(90),
        "How high the light stands.",
        shown="deg",
        live=True,
    )
    light_strength: float = number(3.0, "Light", "", 0.0, 10.0, "Irradiance of the light.", live=True)
    ambient: float = number(0.5, "Ambient", "", 0.0, 3.0, "Soft light from all around.", live=True)
    billboard_width: float = number(
        1.1, "Billboard width", "", 0.5, 4.0, "Width of a billboard, in mean particle distances.", live=True
    )
    billboard_stretch: float = number(
        5.0, "Billboard stretch", "", 1.0, 8.0, "Length of a billboard over its width.", live=True
    )
    ribbons: int = integer(
        2,
        "Ribbons",
        1,
        12,
        "How many narrow billboards share the place of one particle: more look finer, and cost.",
        live=True,
    )
    hair_opacity: float = number(0.95, "Opacity", "", 0.05, 1.0, "Opacity of a billboard in its middle.", live=True)
    forward_scatter: float = number(
        0.3,
        "Transmission",
        "",
        0.0,
        1.0,
        "Goldman's directionality: light sent through hair, against light sent back. It goes on to the hair behind.",
        live=True,
    )
    gloss: float = number(40.0, "Gloss", "", 2.0, 200.0, "Exponent of the highlight of hair.", log=True, live=True)
    hair_as: str = choice(
        "particles",
        "Hair as",
        HAIR_AS,
        "What hair is made of: loose particles that can be shaken, the strands of a hairstyle made of wisps, or none.",
    )
    skin_as: str = choice(
        "resting",
        "Skin",
        SKIN_AS,
        "Resting: the head as it is. Living: a face with expressions, wrinkles and pores.",
    )
    skin_shows: str = choice(
        "skin",
        "Skin shows",
        SKIN_SHOWS,
        "Living skin as it is, or in colours: how much larger it is than at rest, how far it shrinks across its furrows, how "
        "far these are grown, how high it is displaced.",
        live=True,
    )
    split: float = number(
        0.0, "Split", "", 0.0, 1.0, "Left of this part of the picture living skin has no wrinkles.", live=True
    )
    tone_map: str = choice(
        "soft",
        "Tone map",
        TONE_MAPS,
        "How bright light fits into a picture: a mild curve, the stronger one of film, or not at all.",
        live=True,
    )
    strand_model: str = choice(
        "fibre", "Strand shading", STRAND_MODELS, "Marschner's lobes of a hair fibre, or Kajiya and Kay's.", live=True
    )
    strand_roughness: float = number(
        0.3, "Strand roughness", "", 0.05, 1.0, "How far the highlights of a strand spread along it.", live=True
    )
    strands_shown: int = integer(
        20_000,
        "Strands shown",
        100,
        1_000_000,
        "Strands that are drawn while you work, wider by as much as the others would cover; a final picture has all.",
        log=True,
        live=True,
    )
    samples: str = choice(
        "auto",
        "Samples",
        SAMPLES,
        "Samples a pixel at edges (MSAA) while you work, as far as the driver has them; auto: 4 on a graphics card, 1 where "
        "the processor draws. Stills and final pictures are drawn finer instead.",
        live=True,
    )
    shadows: bool = switch(
        True, "Shadows", "Hair shadows itself and the head, the head shadows itself and the hair.", live=True
    )
    shadow_size: int = integer(
        512, "Shadow buffer", 64, 2048, "Width and height of the shadow and light maps.", log=True, live=True
    )
    show_hair: bool = switch(True, "Hair", "Draw the hair.", live=True)
    show_head: bool = switch(True, "Head", "Draw the head.", live=True)
    show_particles: bool = switch(False, "Particles", "Draw the particles with their directions.", live=True)
    show_links: bool = switch(False, "Springs", "Draw the links between particles, coloured by stretch.", live=True)
    show_contact: bool = switch(False, "Contact planes", "Draw the planes that hair collides with.", live=True)
    show_wind: bool = switch(False, "Air", "Draw the particles of air.", live=True)


@dataclass(frozen=True)
class Camera:
    """An orbiting camera."""

    azimuth: float = number(
        math.radians(25),
        "Azimuth",
        "rad",
        -math.pi,
        math.pi,
        "Where the camera stands: 0 in front, 90 on the person's left.",
        shown="deg",
        live=True,
    )
    elevation: float = number(
        math.radians(5),
        "Elevation",
        "rad",
        math.radians(-89),
        math.radians(89),
        "How high the camera stands.",
        shown="deg",
        live=True,
    )
    distance: float = number(
        1.0, "Distance", "m", 0.05, 10.0, "From the camera to what it looks at.", shown="cm", log=True, live=True
    )
    target_x: float = number(
        0.0, "Target x", "m", -2, 2, "What the camera looks at, to the person's left.", shown="cm", live=True
    )
    target_y: float = number(-0.03, "Target y", "m", -2, 2, "What the camera looks at, upward.", shown="cm", live=True)
    target_z: float = number(0.0, "Target z", "m", -2, 2, "What the camera looks at, forward.", shown="cm", live=True)
    field_of_view: float = number(
        math.radians(30),
        "Field of view",
        "rad",
        math.radians(5),
        math.radians(100),
        "Vertical angle of view.",
        shown="deg",
        live=True,
    )
