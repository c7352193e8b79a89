"""Step 6: the race (called track in JSON) and its load."""

import math

from abu_calc.formulas.slow_motion import ball_stiffness, decay_rate, optimum_drag, slow_stiffness
from abu_calc.foundation.checks import Action, Check, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.moved import Moved
from abu_calc.foundation.units import GRAVITY, from_si
from abu_calc.sizing import trials
from abu_calc.sizing.actions import followed, pins, set_action, speeds_from
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import ovality_residual, permitted_displacement
from abu_calc.sizing.case import Case
from abu_calc.sizing.manufacture.bearing_ring import race_groove
from abu_calc.sizing.trials import TriedRequirement

LEAST_HARDNESS_HRC, GROUND_HARDNESS_HRC = 58.0, 60.0
"""Least hardness of a race, and the usual one of a ground race."""
OVER = 1.05
"""Factor over the speed that carries balls over, as advised."""


@dataclass(frozen=True)
class Track:
    """Groove, slow motion of the balls [SI]; null where there is none.

    `decay_rates`: drag and slowest rate [1/s] at the drag rate at work, in hot and in cold oil.
    """

    groove_radius: float | None
    carry_over: float
    ball_stiffness: float
    optimum_drag: float | None
    decay_rates: tuple[tuple[float, float], ...]


@formula(
    "Lowest speed that carries the balls round a horizontal axis",
    "√(g/R_p)",
    "rad/s",
    where="Below this speed the balls rattle at the bottom of the race.",
    assumed="horizontal spindle",
    source="derived",
)
def carry_over_speed(pitch_radius: float) -> float:
    """
    >>> round(from_si(carry_over_speed(23e-3), "rpm"))
    197
    """
    return math.sqrt(GRAVITY / pitch_radius)


def track(case: Case, candidate: Candidate, frequencies: tuple[float, float]) -> Track:
    """Track of one candidate at the rated speed."""
    kappa = ball_stiffness(candidate.ball_mass, candidate.requirement.effective_mass, case.speed, frequencies)
    slowest, _ = slow_stiffness((kappa,) * candidate.ball_count, candidate.budget.resting_angles)
    rolls = case.autobalancer.corrector == "roller"
    return Track(
        groove_radius=None if rolls else race_groove(case, candidate.race_radius, candidate.ball_diameter / 2),
        carry_over=carry_over_speed(candidate.pitch_radius),
        ball_stiffness=kappa,
        optimum_drag=optimum_drag(slowest, case.inertia_factor) if slowest > 0 else None,
        decay_rates=tuple(
            (drag, _rate(case, candidate, kappa, drag)) for drag in (share * case.drag for share in case.drag_shares)
        ),
    )


def _rate(case: Case, candidate: Candidate, kappa: float, drag: float) -> float:
    return decay_rate((kappa,) * candidate.ball_count, candidate.budget.resting_angles, drag, case.inertia_factor)


def track_checks(case: Case, candidate: Candidate, race: Track) -> tuple[Check, ...]:
    """Pressure, hardness, hoop stress and roundness at the highest speed.

    On a horizontal spindle also whether the lowest speed carries the balls over.
    """
    top = f"{from_si(case.speed_range[1], 'rpm'):.6g} rpm"
    checks = (_pressure(case, candidate, top), _hardness(case, candidate), _hoop(case, candidate, top),
              _roundness(case, candidate, top))  # fmt: skip
    if case.table.machine.spindle_axis != "horizontal":
        return checks
    return (*checks, _carried_over(case, candidate, race))


def _pressure(case: Case, candidate: Candidate, top: str) -> Check:
    """Check of the Hertz pressure against the pressure that leaves no dent."""
    pressure, permitted = _pressures(case, candidate)
    required = TriedRequirement("the Hertz pressure", "MPa", lambda *given: _pressures(*given)[0],
                           lambda *given: _pressures(*given)[1], lambda *given: _not_above(*_pressures(*given)),
                           "the permitted Hertz pressure")  # fmt: skip
    passed = pressure <= permitted
    return coded(
        "ABU301", verdict(passed), f"At {top}, a ball presses its race. Up to 5.2·HV no dent is left (assumed rule)",
        pressure, permitted, "MPa",
        None if passed else trials.remedy(case, candidate, trials.harder(case), required),
    )  # fmt: skip


def _pressures(_: Case, candidate: Candidate) -> tuple[float, float]:
    """Hertz pressure and the permitted one [MPa]."""
    stress = candidate.strength
    return from_si(stress.contact_pressure, "MPa"), from_si(stress.permitted_pressure, "MPa")


def _not_above(value: float, limit: float) -> bool:
    return value <= limit


def _hardness(case: Case, candidate: Candidate) -> Check:
    hardness = case.autobalancer.race_hardness_HRC
    passed = hardness >= LEAST_HARDNESS_HRC
    action = None
    if not passed:
        moved = Moved("the hardness of the race", hardness, GROUND_HARDNESS_HRC, "HRC", LEAST_HARDNESS_HRC)
        action = set_action({"autobalancer.race_hardness_HRC": GROUND_HARDNESS_HRC}, candidate, moved,
                            more="Harden the race to 60–63 HRC and grind it.")  # fmt: skip
    return coded(
        "ABU302", verdict(passed), "A soft race dents, and dents hold the balls. Machines with soft races gained "
        "nothing", hardness, LEAST_HARDNESS_HRC, "HRC", action, "least",
    )  # fmt: skip


def _hoop(case: Case, candidate: Candidate, top: str) -> Check:
    hoop, limit = _hoops(case, candidate)
    required = TriedRequirement("the hoop stress", "MPa", lambda *given: _hoops(*given)[0],
                           lambda *given: _hoops(*given)[1], lambda *given: _not_above(*_hoops(*given)),
                           "the permitted hoop stress")  # fmt: skip
    passed = hoop <= limit
    return coded(
        "ABU303", verdict(passed), f"The rim spins at {top} (the limit is assumed)", hoop, limit, "MPa",
        None if passed else trials.remedy(case, candidate, trials.stronger(case), required),
    )  # fmt: skip


def _hoops(_: Case, candidate: Candidate) -> tuple[float, float]:
    """Hoop stress and the permitted one [MPa]."""
    return from_si(candidate.strength.hoop_stress, "MPa"), from_si(candidate.strength.permitted_hoop, "MPa")


def carries_over(case: Case, race: Track) -> bool:
    """True if the lowest speed carries the balls round; a vertical spindle has no top to pass."""
    return case.table.machine.spindle_axis != "horizontal" or case.speed_range[0] > race.carry_over


def _carried_over(case: Case, candidate: Candidate, race: Track) -> Check:
    lowest, needed = from_si(case.speed_range[0], "rpm"), from_si(race.carry_over, "rpm")
    passed = carries_over(case, race)
    return coded(
        "ABU102", verdict(passed), "The lowest speed must carry the balls round the horizontal spindle", lowest, needed,
        "rpm", None if passed else _faster(case, candidate, lowest, needed), "least",
    )  # fmt: skip


def _faster(case: Case, candidate: Candidate, lowest: float, needed: float) -> Action:
    """A lowest speed that carries the balls over; the motor's idle speed, if that is the lowest, is not in the file."""
    raised = math.ceil(OVER * needed)
    for entries in speeds_from(case, raised):
        after = followed(case, {**entries, **pins(candidate)})
        if after is not None and from_si(after.case.speed_range[0], "rpm") >= raised:
            return set_action(entries, candidate, Moved("the lowest speed", lowest, raised, "rpm", needed))
    return Action("Raise the lowest speed, or enlarge the race.")


def _left(case: Case, candidate: Candidate) -> tuple[float, float]:
    """Displacement that two-lobe ovality leaves with one web alone, and the permitted one [µm]."""
    permitted = permitted_displacement(case, candidate.mass, case.speed_range[1])
    return from_si(ovality_residual(candidate.roundness.unaided), "um"), from_si(permitted, "um")


def _roundness(case: Case, candidate: Candidate, top: str) -> Check:
    """Check of the displacement that an oval race leaves if one web alone holds it.

    The value is compared with all that the level's limit permits.
    """
    left, permitted = _left(case, candidate)
    drawn = f"{from_si(ovality_residual(candidate.roundness.lobes), 'um'):.3g} µm"
    required = TriedRequirement("the displacement by two-lobe ovality", "µm", lambda *given: _left(*given)[0],
                           lambda *given: _left(*given)[1], lambda _, other: other.stays_round,
                           "the permitted displacement")  # fmt: skip
    return coded(
        "ABU304", verdict(candidate.stays_round), f"At {top}, two opposite balls make the race oval. One web alone "
        f"leaves this displacement; web and cover together leave {drawn}", left, permitted, "µm",
        None if candidate.stays_round else trials.remedy(case, candidate, trials.rounder(case), required),
    )  # fmt: skip
