"""Checks of the chosen autobalancer, and warnings that no check gives."""

from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.units import from_si
from abu_calc.sizing import trials
from abu_calc.sizing.balls import Candidate, enough, light
from abu_calc.sizing.capacity import steady_contact
from abu_calc.sizing.case import Case
from abu_calc.sizing.vibration import LevelsUnderLoad
from abu_calc.standards.balls import stock_diameter


def candidate_checks(case: Case, imbalance: float, chosen: Candidate) -> tuple[Check, ...]:
    """Checks of the chosen autobalancer: capacity, residual displacement, mass, and a race near the wheel."""
    return _capacity(case, imbalance, chosen), _budget(chosen), _mass(case, imbalance, chosen), *_plane(case, chosen)


def _capacity(case: Case, imbalance: float, candidate: Candidate) -> Check:
    margin = case.autobalancer.capacity_margin
    need = from_si(candidate.requirement.required * margin, "g_mm")
    passed = enough(case, candidate)
    return coded("ABU201", verdict(passed), f"{candidate.ball_count} balls side by side against {margin:g} × the need",
        from_si(candidate.capacity, "g_mm"), need, "g·mm",
        None if passed else trials.remedy(case, imbalance, trials.more_room(case), enough), "least",
    )  # fmt: skip


def _budget(candidate: Candidate) -> Check:
    budget = candidate.budget
    speed = f"{from_si(budget.speed, 'rpm'):.6g} rpm"
    return coded("ABU202", verdict(budget.within), "race eccentricity, dry friction and an oval race, expected, "
        f"against what the limit permits at {speed}", from_si(budget.residual, "um"), from_si(budget.permitted, "um"),
        "µm",
        None if budget.within else "What was tried for the level, see ABU401.",
    )  # fmt: skip


def _mass(case: Case, imbalance: float, candidate: Candidate) -> Check:
    limit, passed = case.autobalancer.max_mass_fraction, light(case, candidate)
    return coded("ABU203", verdict(passed), "share of the machine's mass, balls included",
        100 * candidate.mass_fraction, 100 * limit, "%",
        None if passed else trials.remedy(case, imbalance, trials.lighter(case), light),
    )  # fmt: skip


def _plane(case: Case, candidate: Candidate) -> tuple[Check, ...]:
    """The race off the wheel's plane: what rests at the wheel, if the body is known."""
    if case.race_offset == 0:
        return ()
    if not case.body.is_rigid:
        return (
            coded("ABU205", "not-done",
                "the race is off the wheel's plane, and the rigid body is not known",
                remedy="Give machine.transverse_inertia_kg_m2 and machine.center_of_mass_to_wheel_mm.",
            ),
        )  # fmt: skip
    rest, permitted = from_si(candidate.budget.plane_offset, "um"), from_si(candidate.budget.permitted, "um")
    near = rest <= permitted
    return (
        coded("ABU205", verdict(near), f"the balls need {candidate.requirement.plane_ratio:.3f} × the imbalance, "
            "and this stays at the wheel", rest, permitted, "µm",
            None if near else "Bring the race nearer to the wheel.",
        ),
    )  # fmt: skip


def power_checks(case: Case) -> tuple[Check, ...]:
    """Check that the motor has the power that cutting takes; no check if either is not given."""
    power, contact = case.table.machine.power_W, case.contact
    if power is None or contact is None:
        return ()
    rim = case.speed * case.wheel_radius
    cutting = contact.cutting_coefficient * contact.press_force * rim
    enough = cutting <= power
    return (
        coded("ABU403", verdict(enough), "f·N·v at the rated speed against the motor's power", cutting,
            power, "W", None if enough else "A smaller press force or cutting coefficient: these do not go together.",
        ),
    )  # fmt: skip


def design_warnings(case: Case, candidate: Candidate, loaded: LevelsUnderLoad | None) -> tuple[str, ...]:
    """Warnings that a reader must know and that no check gives."""
    return (
        *_body_warnings(case),
        *_sheet_warnings(case),
        *_contact_warnings(case, candidate),
        *_choice_warnings(case, candidate),
        *_loaded_warnings(loaded),
    )


def _loaded_warnings(loaded: LevelsUnderLoad | None) -> list[str]:
    if loaded is None or loaded.steady.after is not None:
        return []
    return [
        "No level under load is given with the autobalancer: the balls cannot balance at these speeds, or this contact "
        "asks for more than they carry."
    ]


def _body_warnings(case: Case) -> list[str]:
    if case.body.is_rigid:
        return []
    clause = " and the imbalance found from it" if case.table.wheel.shown else ""
    handles = "; every handle moves alike" if case.handles else ""
    return [
        f"The machine is taken as a point mass: a level at a handle{clause} is uncertain by a factor of two to three"
        f"{handles}. Give machine.transverse_inertia_kg_m2 and machine.center_of_mass_to_wheel_mm to do better."
    ]


def _sheet_warnings(case: Case) -> list[str]:
    """Explanation of a weighted acceleration, if an imbalance was found from it."""
    shown = case.table.wheel.shown
    if shown is None or shown.weighting != "Wh":
        return []
    return [
        "The imbalance is found from a weighted acceleration. If that is a data sheet's, it was measured with a test "
        "wheel of defined imbalance (ISO 28927-1), not with the wheel in use."
    ]


def _contact_warnings(case: Case, candidate: Candidate) -> list[str]:
    contact, warnings = case.contact, []
    if contact is None:
        return ["No [grinding]: the capacity is for idling; the need under load, compliant or rigid, was not computed."]
    if contact.kind != "compliant":
        return [f"The contact is {contact.kind}: a compliant need was not computed."]
    steady = steady_contact(case, candidate.mass, damped=False)
    if steady is not None and steady.balls_increase_imbalance:
        warnings.append(
            "At this contact stiffness balls under load would increase the imbalance (it lies between MΩ² and 2MΩ²)."
        )
    return warnings


def _choice_warnings(case: Case, candidate: Candidate) -> list[str]:
    warnings = []
    if stock_diameter(candidate.ball_diameter) is None:
        warnings.append(f"Balls of {from_si(candidate.ball_diameter, 'mm'):g} mm are not a stock size.")
    if case.autobalancer.corrector == "roller":
        warnings.append("Rollers: as long as their diameter, cylindrical race; no toroidal groove shakes out friction.")
    return warnings
