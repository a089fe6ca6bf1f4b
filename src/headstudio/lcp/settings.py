"""The parameters of loosely connected particles: what grows, how it moves, and the air around it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..params import integer, number, switch


@dataclass(frozen=True)
class HairSettings:
    """How hair grows: Bando et al. 2006, section 3.2."""

    particles: int = integer(2000, "Particles", 100, 100_000, "How many particles sample the hair volume.", log=True)
    length: float = number(
        0.30, "Length", "m", 0.02, 1.0, "Longest hair; the gray length map scales it between 0 and this.", shown="cm"
    )
    lie_down: float = number(
        1.0, "Lie down", "", 0.0, 3.0, "Weight w_t of the root direction along the scalp, away from the whorl (eq. 4)."
    )
    stand_up: float = number(
        0.6, "Stand up", "", 0.05, 3.0, "Weight w_n of the root direction along the scalp's normal (eq. 4)."
    )
    bending_length: float = number(
        0.04,
        "Bending length",
        "m",
        0.005,
        0.3,
        "How far hair reaches out before its weight bends it down: (B / w)^(1/3) of the cantilever beam.",
        shown="cm",
        log=True,
    )
    root_depth: float = number(
        0.012, "Root depth", "m", 0.004, 0.03, "Depth s_r of the root particles below the scalp.", shown="mm"
    )
    mass: float = number(
        0.15,
        "Mass",
        "kg",
        0.02,
        1.0,
        "Mass of all hair above the scalp: 100,000 strands of 30 cm weigh about 150 g.",
        shown="g",
        log=True,
    )
    seed: int = integer(1, "Seed", 0, 2**31 - 1, "Start of the random numbers: the same seed gives the same hair.")


@dataclass(frozen=True)
class DynamicsSettings:
    """How hair moves: Bando et al. 2006, sections 3.3 to 3.5."""

    elastic_modulus: float = number(
        3e5,
        "Elastic modulus",
        "Pa",
        1e5,
        1e7,
        "Tensile modulus E that every particle keeps (eq. 8).",
        shown="kPa",
        log=True,
        live=True,
    )
    bending_scale: float = number(
        0.1,
        "Bending scale",
        "",
        0.0,
        1.0,
        "Part of a spring's force that is left in compression (thesis 3.3.2): 0 is limp, 1 a rubber block.",
        live=True,
    )
    hold: float = number(
        1.0,
        "Hold",
        "",
        0.0,
        20.0,
        "How firmly hair keeps the shape it grew in, from the root outward: 0 is free, 1 its own stiffness, 20 hairspray.",
        live=True,
    )
    stiffness: float = number(
        1.0,
        "Bending stiffness",
        "",
        0.0,
        10.0,
        "How firmly hair keeps its curvature, as a multiple of the beam that gave it its shape: 0 folds like cloth.",
        live=True,
    )
    spring_damping: float = number(
        2.0, "Spring damping", "", 0.0, 5.0, "Damping of the springs as a fraction of critical.", live=True
    )
    inner_friction: float = number(
        60.0,
        "Inner friction",
        "1/s",
        0.0,
        200.0,
        "Rate at which linked hair takes up a common velocity: 0 whips like loose strings, 200 moves like dough.",
        live=True,
    )
    air_friction: float = number(
        2.5, "Air friction", "1/s", 0.0, 20.0, "Rate at which still air slows hair down.", live=True
    )
    gravity: float = number(9.81, "Gravity", "m/s^2", 0.0, 30.0, "Acceleration of free fall.", live=True)
    interactions: bool = switch(
        True, "Hair-hair interactions", "Attraction, repulsion, collision and friction.", live=True
    )
    pressure: float = number(
        0.06,
        "Attraction/repulsion",
        "m^2/s^2",
        0.0,
        0.5,
        "Pressure gain k_a that keeps the average density (eq. 16).",
        live=True,
    )
    rest_density: float = number(
        1.0,
        "Rest density",
        "",
        0.2,
        2.0,
        "Density that the pressure strives for, as a multiple of the initial one: small repels, large coheres.",
        live=True,
    )
    collision: float = number(
        1.0,
        "Collision damping",
        "",
        0.0,
        10.0,
        "Damping d_c of approaching hair (eq. 17), relative to its default.",
        live=True,
    )
    friction: float = number(
        3.0,
        "Friction",
        "",
        0.0,
        10.0,
        "Damping d_f of sliding hair (eq. 18), relative to the default collision.",
        live=True,
    )
    body_friction: float = number(
        0.3, "Body friction", "", 0.0, 1.0, "Coulomb's coefficient between hair and skin (thesis 3.23).", live=True
    )


@dataclass(frozen=True)
class WindSettings:
    """Wind as particles of air: Bando et al. 2006, section 3.5."""

    on: bool = switch(False, "Wind", "Blow air particles at the hair.", live=True)
    speed: float = number(4.0, "Speed", "m/s", 0.0, 15.0, "Speed of the wind far away.", live=True)
    heading: float = number(
        math.pi / 2,
        "Heading",
        "rad",
        -math.pi,
        math.pi,
        "Direction the wind blows to, about the vertical: 0 along the face, 90 degrees to the person's left.",
        shown="deg",
        live=True,
    )
    gusts: float = number(0.3, "Gusts", "", 0.0, 1.0, "How much the speed varies.", live=True)
    drag: float = number(1.0, "Drag", "", 0.0, 5.0, "Drag between air and hair, relative to the default.", live=True)
