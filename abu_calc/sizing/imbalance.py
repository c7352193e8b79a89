"""Step 2: the wheel's imbalance, from any of its sources."""

import math

from abu_calc.formulas.rigid_body import Vector
from abu_calc.formulas.suspension import resonance_factor
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import level_from_velocity, velocity_from_level
from abu_calc.inputs.wheel import Shown
from abu_calc.sizing.case import Case
from abu_calc.sizing.instruments import in_words, velocity_shown
from abu_calc.standards.vibration import permissible_imbalance

NODE_SHARE = 0.05
"""A handle that moves by less than this share of a point mass's motion says nothing of the imbalance."""


@dataclass(frozen=True)
class Imbalance:
    """m₀e [kg m] of the wheel with its source in words."""

    value: float
    source: str


@formula(
    "Imbalance that causes a given vibration velocity at a place",
    "m₀e = √2·v/(Ω·I_a·k_Ω)",
    "kg m",
    signs="M D_x",
    where="I_a is the inertance from wheel to place, 1/M for a point mass; k_Ω = MΩ²/|D_x|.",
    assumed="one harmonic at Ω, above the natural frequencies of the suspension",
    source="Kladiev 1996, for a point mass √2·v·M/Ω·|1−(ω₀/Ω)²|; the rigid body is derived here",
)
def imbalance_from_level(velocity_rms: float, speed: float, inertance: float, resonance: float = 1.0) -> float:
    """
    >>> v = velocity_from_level(109)
    >>> round(1e6 * imbalance_from_level(v, 5800 * math.pi / 30, 1 / 5.6), 2)
    183.75
    """
    return math.sqrt(2) * velocity_rms / (speed * abs(inertance) * resonance)


def find_imbalance(case: Case) -> Imbalance:
    """The imbalance from the one source that the file gives."""
    wheel = case.table.wheel
    if wheel.imbalance_g_mm is not None:
        return Imbalance(wheel.imbalance, "given")
    if wheel.balance_grade is not None:
        value = permissible_imbalance(wheel.balance_grade, wheel.mass_kg, case.speed)
        return Imbalance(value, f"{wheel.balance_grade} of ISO 21940-11 for the wheel at the rated speed")
    return _measured(case)


def _measured(case: Case) -> Imbalance:
    shown = case.table.wheel.shown
    if shown is None:  # the table would not have been read
        raise InputError("no imbalance is known", place=Place(key="wheel.imbalance_g_mm"))
    velocity = measured_velocity(shown, case.speed, "wheel")
    background = case.background_level
    if background is not None:
        velocity = _without_background(velocity, background)
    place = next((handle.place for handle in case.handles if handle.name == shown.at), case.body.wheel)
    inertance = motion_shown(case, place, shown)
    if inertance < NODE_SHARE / case.body.mass:
        raise InputError(
            "the handle is near a node: it hardly moves, whatever the imbalance",
            place=Place(key="wheel.measured_at"),
            remedy="Measure at another handle, or near the wheel.",
        )
    resonance = resonance_factor(case.suspension, case.speed, case.body.effective_mass())
    value = imbalance_from_level(velocity, case.speed, inertance, resonance)
    return Imbalance(value, f"measured {in_words(shown)} idle, without autobalancer")


def motion_shown(case: Case, place: Vector, shown: Shown) -> float:
    """Motion of the axis that an instrument shows per imbalance at the wheel [1/kg].

    Three axes: the vector total over √2, as `velocity_shown` has it; else the loudest axis.
    """
    if shown.axes == 3 and case.body.in_space:
        return math.hypot(*case.body.axes(place)) / math.sqrt(2)
    return case.body.loudest_axis(place)


def measured_velocity(shown: Shown, speed: float, table: str) -> float:
    """Rms velocity of one axis [m/s] from a table's measured value; refused, by its key, where W_h is not defined."""
    try:
        return velocity_shown(shown, speed)
    except InputError as error:
        raise error.at(Place(key=f"{table}.measured_weighting")) from None


def _without_background(velocity: float, background_level: float) -> float:
    background = velocity_from_level(background_level)
    if background >= velocity:
        raise InputError(
            "the background is not below the measured level, so nothing is left for the imbalance",
            place=Place(key="machine.background_level_db"),
            found=f"{background_level:g} dB",
            allowed=f"below {level_from_velocity(velocity):.1f} dB",
            remedy="Give the level with a balanced wheel, or leave the key out.",
        )
    return math.sqrt(velocity**2 - background**2)
