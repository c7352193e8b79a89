"""Checks of the chosen autobalancer, and warnings that no check gives.

Requirements of the search for balls, by name: which of them a design misses. The search reads no check.
"""

import math
from collections.abc import Iterator
from typing import Final

from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.units import shown
from abu_calc.sizing.actions import two_digits
from abu_calc.sizing.balls import Candidate, enough, light, shortfalls
from abu_calc.sizing.budget import steady_contact
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.handles import BodyBands, band_end, body_advice, estimate_keys
from abu_calc.sizing.places import HANDS
from abu_calc.sizing.track import LEAST_HARDNESS_HRC, Track, carries_over
from abu_calc.sizing.vibration import LevelsUnderLoad, measurably_lower
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


LEVEL, ACCELERATION = "level", "acceleration at the handles"
EXPECTED: Final = frozenset({LEVEL, ACCELERATION})
"""Limits of vibration, as expected."""
INERTIA: Final = " by the band of the estimated inertia"
DOUBTFUL: Final = frozenset(limit + INERTIA for limit in EXPECTED)
"""The same limits at the end of the band that an estimated inertia leaves."""


def missed(design: Design) -> frozenset[str]:
    """Names of the requirements that a design misses. What depends on the file alone is alike for all candidates."""
    return frozenset(name for name, met in _requirements(design) if not met)


def loudness(design: Design) -> tuple[int, int]:
    """How many limits of vibration are exceeded as expected, and how many in doubtful cases."""
    names = missed(design)
    return len(names & EXPECTED), len(names & DOUBTFUL)


def missed_by_race(case: Case, candidate: Candidate, race: Track) -> frozenset[str]:
    """Names of the requirements on balls and race alone that they miss."""
    hard = case.autobalancer.race_hardness_HRC >= LEAST_HARDNESS_HRC
    own = ("hardness of the race", hard), ("speed that carries the balls over", carries_over(case, race))
    return frozenset((*shortfalls(case, candidate), *(name for name, met in own if not met)))


def _requirements(design: Design) -> Iterator[tuple[str, bool]]:
    case, chosen, arm = design.case, design.autobalancer, design.swing_arm
    yield from ((name, False) for name in missed_by_race(case, chosen, design.track))
    yield "speeds at which balls balance", design.frequency.balancing_possible
    off = chosen.budget.plane_offset if case.race_offset and case.body.is_rigid else 0.0
    yield "race near the wheel", off <= chosen.budget.permitted
    yield "fit of the bore", design.eccentricity.holds
    yield from design.construction.requirements
    yield "lower level than without", measurably_lower(design.idle)
    yield from _vibration(design)
    if arm is not None:
        damping, bunched = arm.arm.joint_damping, arm.damping_limit_bunched
        softest = min(arm.contact_stiffness_limit, arm.contact_stiffness_limit_exact)
        yield "supercritical arm", arm.arm.contact_stiffness < softest
        yield "damping of the pivot", damping > arm.damping_limit
        yield "damping of the pivot, balls together", bunched is not None and damping > bunched


def _vibration(design: Design) -> Iterator[tuple[str, bool]]:
    levels, total, bands, limit = design.speed_levels, design.highest_total, design.bands, design.case.level_limit
    if levels is not None:
        yield LEVEL, levels.highest.level_after_db <= limit
        yield LEVEL + INERTIA, bands is None or bands.level is None or bands.level[1] <= limit
    permitted = design.case.table.limits.a_hv_m_per_s2
    if permitted is not None and total is not None:
        end = band_end(total, bands, design.case)
        yield ACCELERATION, total.total <= permitted
        yield ACCELERATION + INERTIA, end is None or end <= permitted
