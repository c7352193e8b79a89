"""Shaking that frees balls from dry rolling friction in a race: it moves them faster than they creep."""

import math

from abu_calc.formula import formula


@formula(
    "Amplitude of a shaking beyond which balls roll in spite of dry friction",
    "a_s > k_r·R_p/r",
    "m",
    shown="um",
    where=(
        "Across the race, of the axial runout by which a face wheel moves the machine, or along it, of the backward "
        "whirl |X − iY|/2 that runout causes at work, against the friction force m(k_r/r)Ω²R_p."
    ),
    assumed="the groove may be shaken at any frequency; at Ω, 5(R−r) = 7(R_g−r), across it at resonance",
    source="derived; simulated of every machine by abu grinding",
    printed=(
        "Kladiev 1996 has axial runout alone shake friction out; the whirl by runout in the plane does, too, but slowly"
    ),
)
def shaking_threshold(arm: float, pitch_radius: float, ball_radius: float) -> float:
    """
    >>> round(1e6 * shaking_threshold(2e-6, 24e-3, 8e-3), 3)
    6.0
    """
    return arm * pitch_radius / ball_radius


@formula(
    "Drag that dry friction amounts to while a backward whirl shakes the balls along the race",
    "4J(k_r·R_p/r)Ω/(π·a_s)",
    "1/s",
    where="The mean of friction over a swing at 2Ω.",
    assumed="a_s well above k_r·R_p/r",
    source="derived by averaging",
)
def shaken_drag(threshold: float, whirl: float, speed: float, inertia_factor: float) -> float:
    """
    >>> round(shaken_drag(5.81e-6, 20e-6, 607.37, 1.4))
    315
    """
    return 4 * inertia_factor * threshold * speed / (math.pi * whirl)
