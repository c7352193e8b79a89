"""Fastening of the housing on the spindle: the torque that it carries before it slips, and the one it needs."""

import math
from typing import Final, NamedTuple

from abu_calc.formulas.press_fit import (
    ASSEMBLY_TEMPERATURE,
    FRICTION,
    MATERIALS,
    STEEL_RING,
    Ring,
    contact_pressure,
    fit_torque,
    interference_left,
    outer_hoop,
    spin_growth,
)
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import shown
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import RULES, HousingDimensions
from abu_calc.sizing.manufacture.cover import OVERSPEED, PROOF_SHARE, Fit
from abu_calc.sizing.parts.housing_parts import HousingParts

SLIP_FACTOR: Final = 2.0
"""Least slip torque over the torque that is needed (assumed)."""
RUN_UP: Final = 1.0
"""Time to full speed if the file has no [run_up] [s], its default."""


def bore_growth(case: Case, size: HousingDimensions) -> float:
    """What the bore outgrows the spindle by in diameter [m]: at the highest temperature and overspeed, at least 0."""
    body = MATERIALS[RULES[case.autobalancer.design].body_density]
    warmer = case.autobalancer.temperature_range_C[1] - ASSEMBLY_TEMPERATURE
    thermal = (body.expansion - STEEL_RING.expansion) * 2 * size.bore_radius * warmer
    disc = Ring(size.bore_radius, size.outer_radius, body)
    return max(0.0, thermal) + 2 * spin_growth(disc, case.speed_range[1], False)


@formula(
    "Torque that the fastening must carry",
    "T_n = J_a·Ω/t_u; flanges also J_w·Ω/t_u + P_m/Ω",
    "N m",
    signs="J_a J_w t_u P_m Ω",
    where=(
        "J_a is the polar inertia of housing and balls, J_w that of the wheel as a disc. The run-up takes t_u. P_m is "
        "the power of the motor at the rated speed."
    ),
    assumed="a steady run-up; jamming of the wheel is not covered but by the factor of 2",
    source="derived",
)
def needed_torque(case: Case, inertia: float) -> float:
    run_up = case.table.run_up.time_s if case.table.run_up is not None else RUN_UP
    torque = inertia * case.speed_range[1] / run_up
    if case.autobalancer.fastening == "flange":
        wheel = case.table.wheel.mass_kg * case.wheel_radius**2 / 2
        torque += wheel * case.speed_range[1] / run_up + (case.table.machine.power_W or 0.0) / case.speed
    return torque


@formula(
    "Slip torque of a housing that a nut clamps",
    "2·μ_f·F_n·r_e, r_e = (2/3)·(R_h³ − R_b³)/(R_h² − R_b²)",
    "N m",
    signs="F_n r_e R_h R_b",
    where="Both faces of the hub drive; R_b and R_h are the radii of bore and hub.",
    assumed="even pressure on the hub's faces, friction 0.12",
    source="textbook (plate clutch)",
)
def clamped_torque(clamp_force: float, bore_radius: float, hub_radius: float) -> float:
    """
    >>> round(clamped_torque(8000.0, 10e-3, 12.5e-3), 2)
    21.69
    """
    mean = 2 / 3 * (hub_radius**3 - bore_radius**3) / (hub_radius**2 - bore_radius**2)
    return 2 * FRICTION * clamp_force * mean


def shrunk_torque(case: Case, size: HousingDimensions, fit: Fit) -> float:
    """Least slip torque [N m] of a fit, over the temperatures, at rest and at overspeed; the hub alone holds."""
    hub, spindle = _hub(case, size), Ring(0.0, size.bore_radius, STEEL_RING)
    disc = Ring(size.bore_radius, size.outer_radius, hub.material)
    left = min(
        interference_left(fit.loosest, spindle, disc, temperature, speed)
        for temperature in case.autobalancer.temperature_range_C
        for speed in (0.0, OVERSPEED * case.speed_range[1])
    )
    return fit_torque(contact_pressure(left, spindle, hub), size.bore_radius, size.width)


def shrunk_stress(case: Case, size: HousingDimensions, fit: Fit) -> float:
    """Largest hoop stress [Pa] of the hub by the largest interference, over the temperatures, at rest."""
    hub, spindle = _hub(case, size), Ring(0.0, size.bore_radius, STEEL_RING)
    most = max(
        interference_left(fit.tightest, spindle, hub, temperature, 0.0)
        for temperature in (*case.autobalancer.temperature_range_C, ASSEMBLY_TEMPERATURE)
    )
    return outer_hoop(contact_pressure(most, spindle, hub), hub)


def _hub(case: Case, size: HousingDimensions) -> Ring:
    return Ring(size.bore_radius, size.hub_radius, MATERIALS[RULES[case.autobalancer.design].body_density])


def whole_inertia(parts: HousingParts) -> float:
    """Polar inertia of housing and balls [kg m²]."""
    balls = parts.balls
    return sum(part.inertia for part in parts.turned) + balls.count * balls.mass * balls.pitch_radius**2


class SlipTorque(NamedTuple):
    """Torque that the fastening holds and the one it needs [N m]; stress of the hub and the permitted one [Pa]."""

    held: float
    needed: float
    stress: float
    permitted: float

    @property
    def holds(self) -> bool:
        """True if the torque is held and the hub bears it."""
        return self.held >= self.needed and self.stress <= self.permitted


def slip_torque(case: Case, parts: HousingParts, fit: Fit | None) -> SlipTorque | None:
    """Slip torque of the fastening.

    None without the force of the nut, without the power that a flange must carry, or without a fit that is shrunk.
    """
    size, own, force = parts.dimensions, case.autobalancer, case.autobalancer.clamp_force_N
    needed = SLIP_FACTOR * needed_torque(case, whole_inertia(parts))
    if own.fastening == "shrunk" and fit is not None:
        held, stress = shrunk_torque(case, size, fit), shrunk_stress(case, size, fit)
    elif own.fastening == "shrunk" or force is None or (own.fastening, case.table.machine.power_W) == ("flange", None):
        return None
    else:
        held = clamped_torque(force, size.bore_radius, size.hub_radius)
        stress = force / (math.pi * (size.hub_radius**2 - size.bore_radius**2))
    return SlipTorque(held, needed, stress, PROOF_SHARE * _hub(case, size).material.strength)


def torque_check(case: Case, parts: HousingParts, fit: Fit | None, torque: SlipTorque | None) -> tuple[Check, ...]:
    """Check of the slip torque; none without the force of the nut, or without the power that a flange must carry."""
    fastening, force = case.autobalancer.fastening, case.autobalancer.clamp_force_N
    if fastening == "shrunk":
        return (_shrunk_check(fit, torque, SLIP_FACTOR * needed_torque(case, whole_inertia(parts))),)
    if torque is None or force is None:
        return ()
    what = "flange" if fastening == "flange" else "housing"
    message = f"Slip torque of the clamped {what}, against twice the torque of the run-up"
    if torque.stress > torque.permitted:
        permitted = shown(torque.permitted, "MPa")
        message += f". The nut crushes the hub: {shown(torque.stress, 'MPa')}, permitted {permitted}"
    return (coded("ABU308", verdict(torque.holds), message, torque.held, torque.needed),)


def _shrunk_check(fit: Fit | None, torque: SlipTorque | None, needed: float) -> Check:
    if fit is None or torque is None:
        return coded("ABU308", "not-done", "No interference fit of ISO 286 is tabulated for this bore", None, needed,
            'Specify autobalancer.fastening = "clamped".',
        )  # fmt: skip
    message = (
        f"Slip torque of the shrunk housing ({fit.named}), least over the temperatures at 1.2 × the highest speed, "
        f"against twice the torque of the run-up. Hub: {shown(torque.stress, 'MPa')}, "
        f"permitted {shown(torque.permitted, 'MPa')}"
    )
    return coded("ABU308", verdict(torque.holds), message, torque.held, needed,
        None if torque.holds else 'Specify autobalancer.fastening = "clamped".',
    )  # fmt: skip
