"""Checks of the chosen autobalancer, and warnings that no check gives."""

import math

from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.units import shown
from abu_calc.sizing.actions import two_digits
from abu_calc.sizing.balls import Candidate, enough, light
from abu_calc.sizing.capacity import steady_contact
from abu_calc.sizing.case import Case
from abu_calc.sizing.handles import BodyBands, body_advice, estimate_keys
from abu_calc.sizing.places import HANDS
from abu_calc.sizing.vibration import LevelsUnderLoad
from abu_calc.standards.balls import stock_diameter


def candidate_checks(case: Case, chosen: Candidate) -> tuple[Check, ...]:
    """Checks of the chosen autobalancer: capacity, residual displacement, mass, and a race near the wheel."""
    return _capacity(case, chosen), residual_check(chosen), _mass(case, chosen), *_plane(case, chosen)


def _capacity(case: Case, candidate: Candidate) -> Check:
    margin = case.autobalancer.capacity_margin
    return coded("ABU201", verdict(enough(case, candidate)), f"{candidate.ball_count} balls side by side must carry "
        f"the required capacity times the margin {margin:g}", candidate.capacity, _with_margin(case, candidate),
    )  # fmt: skip


def _with_margin(case: Case, candidate: Candidate) -> float:
    return candidate.requirement.required * case.autobalancer.capacity_margin


def residual_check(candidate: Candidate) -> Check:
    """Check of the residual displacement against the permitted one."""
    budget = candidate.budget
    speed = shown(budget.speed, "rpm", ".6g")
    return coded("ABU202", verdict(budget.within), f"At {speed}, race eccentricity, dry friction and two-lobe ovality "
        "leave this displacement, as expected", budget.residual, budget.permitted,
    )  # fmt: skip


def _mass(case: Case, candidate: Candidate) -> Check:
    return coded("ABU203", verdict(light(case, candidate)), "The autobalancer with its balls takes this share of the "
        "machine's mass", candidate.mass_fraction, case.autobalancer.max_mass_fraction,
    )  # fmt: skip


def _plane(case: Case, candidate: Candidate) -> tuple[Check, ...]:
    """Check of the displacement at the wheel if the race is off the wheel's plane and the body is known."""
    if case.race_offset == 0:
        return ()
    if not case.body.is_rigid:
        return (
            coded("ABU205", "not-done", "The race is off the wheel's plane, and the rigid body is not known",
                  remedy=f"Specify {estimate_keys(case)} for an estimate, or machine.transverse_inertia_kg_m2 and "
                  "machine.center_of_mass_to_wheel_mm."),
        )  # fmt: skip
    rest, permitted = candidate.budget.plane_offset, candidate.budget.permitted
    near = rest <= permitted
    message = (
        f"The race is off the wheel's plane. The balls carry {candidate.requirement.plane_ratio:.3f} times the "
        "imbalance, and the loudest place keeps a motion as by this displacement of the race"
    )
    return (coded("ABU205", verdict(near), message, rest, permitted),)


def power_checks(case: Case) -> tuple[Check, ...]:
    """Check that the motor has the power that cutting takes; no check if either is not given."""
    power, contact = case.table.machine.power_W, case.contact
    if power is None or contact is None:
        return ()
    rim = case.speed * case.wheel_radius
    cutting = contact.cutting_coefficient * contact.press_force * rim
    message = "Cutting takes the power f·N·v at the rated speed, and the motor must give it"
    action = None if cutting <= power else f"The motor has the power for a normal force of {most_force(case):g} N."
    return (coded("ABU403", verdict(cutting <= power), message, cutting, power, action),)


def most_force(case: Case) -> float:
    """The largest normal force of two digits [N] for which the motor has the power; none without both."""
    power, contact = case.table.machine.power_W, case.contact
    if power is None or contact is None:
        return math.inf
    return two_digits(power / (contact.cutting_coefficient * case.speed * case.wheel_radius), math.floor)


def design_warnings(
    case: Case, candidate: Candidate, loaded: LevelsUnderLoad | None, bands: BodyBands | None
) -> tuple[str, ...]:
    """Warnings that a reader must know and that no check gives."""
    return (
        *_body_warnings(case, bands, candidate.mass),
        *_sheet_warnings(case),
        *_contact_warnings(case, candidate),
        *_choice_warnings(case, candidate),
        *_loaded_warnings(loaded),
    )


def _loaded_warnings(loaded: LevelsUnderLoad | None) -> list[str]:
    if loaded is None or loaded.steady.after is not None:
        return []
    return [
        "No level under load is given with the autobalancer. The balls cannot balance at these speeds, or this contact "
        "requires more capacity than they have."
    ]


HEAVY_ROTOR = 0.03
"""Share of J_x from which the polar inertia of what spins counts."""


def _body_warnings(case: Case, bands: BodyBands | None, added: float) -> list[str]:
    signs = _sign_warning(case)
    if bands is not None:
        low, high = bands.effective_mass
        mass = case.body.effective_mass(added)
        return [
            *signs,
            "The inertia is estimated from layout, mass and lengths, not measured. Effective mass at the wheel: "
            f"{mass:.3g} kg, 95 % within {low:.3g} … {high:.3g} kg. Levels at handles have bands.",
        ]
    if case.body.is_rigid:
        return [*signs, *_rotor_warning(case), *_hands_warning(case)]
    measured = " An imbalance that a measured level gives is as uncertain." if case.table.wheel.shown else ""
    handles = " All handles move alike." if case.handles else ""
    unused = {"face": "length_mm", "angle": "height_mm"}.get(case.table.machine.layout)
    if unused is not None and getattr(case.table.machine, unused) is not None:
        handles += f" Alone machine.{unused} gives no estimate for this layout."
    return [
        f"The machine is modelled as a point mass: levels at handles are uncertain by a factor of 2 to 3.{measured}"
        f"{handles} {body_advice(case)}"
    ]


def _sign_warning(case: Case) -> list[str]:
    """Note on a centre of mass that lies where no such machine has it: a sign was mistaken."""
    given = case.table.machine.center_of_mass_from_wheel_mm
    if given is None:
        return []
    beyond, before = given[2] > 0, case.table.machine.layout == "angle" and given[0] > 0
    if not (beyond or before):
        return []
    where = "beyond the wheel, seen from the machine (z > 0)" if beyond else "before the spindle (x > 0)"
    return [
        f"The centre of mass lies {where}. Check the signs of machine.center_of_mass_from_wheel_mm: it counts from the "
        "wheel's centre, and both are negative at an angle grinder."
    ]


def _rotor_warning(case: Case) -> list[str]:
    """Note on the gyroscopic moments of a wheel that the file leaves out of a body in space."""
    body = case.body.body
    wheel = case.table.wheel.mass_kg * case.wheel_radius**2 / 2
    if not case.body.in_space or body.rotor_polar_inertia or body.inertia is None:
        return []
    if wheel <= HEAVY_ROTOR * min(body.inertia.xx, body.inertia.yy):
        return []
    return [
        f"The wheel as a disk has a polar inertia of {wheel:.3g} kg·m², whose gyroscopic moments are left out. Specify "
        "machine.rotor_polar_inertia_kg_m2."
    ]


def _hands_warning(case: Case) -> list[str]:
    if not case.body.in_space or case.table.suspension.model != "hands" or len(case.handles) >= HANDS:
        return []
    return [
        "Two hands hold a body in space at its first two handles. The file names fewer: levels at handles are those of "
        "a free body."
    ]


def _sheet_warnings(case: Case) -> list[str]:
    """Explanation of a weighted acceleration, if an imbalance was found from it."""
    shown = case.table.wheel.shown
    if shown is None or shown.weighting != "Wh":
        return []
    return [
        "The imbalance follows from a weighted acceleration. A data sheet's value was measured with a test wheel of "
        "defined imbalance (ISO 28927-1), not with the wheel in use."
    ]


def _contact_warnings(case: Case, candidate: Candidate) -> list[str]:
    contact, warnings = case.contact, []
    if contact is None:
        return ["The file has no [grinding]: the required capacity is that of idling, without load."]
    if contact.contact != "compliant":
        return [f"The contact is {contact.contact}: no required capacity of a compliant contact is computed."]
    steady = steady_contact(case, candidate.mass, damped=False)
    if steady is not None and steady.balls_increase_imbalance:
        warnings.append(
            "Under load the balls would increase the imbalance: the contact stiffness lies between MΩ² and 2MΩ²."
        )
    return warnings


def _choice_warnings(case: Case, candidate: Candidate) -> list[str]:
    warnings = []
    if stock_diameter(candidate.ball_diameter) is None:
        warnings.append(f"Ø{shown(candidate.ball_diameter, 'mm', 'g')} is not a stock size of balls.")
    if case.autobalancer.corrector == "roller":
        warnings.append(
            "The rollers are as long as their diameter and run on a cylindrical race. No groove reduces their friction."
        )
    return warnings
