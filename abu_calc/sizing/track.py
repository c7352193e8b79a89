"""Step 6: the race (called track in JSON) and its load."""

import math

from abu_calc.formulas.slow_motion import ball_stiffness, decay_rate, optimum_drag, slow_stiffness
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY, shown
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import ovality_residual, permitted_displacement
from abu_calc.sizing.case import Case
from abu_calc.sizing.manufacture.bearing_ring import race_groove

LEAST_HARDNESS_HRC, GROUND_HARDNESS_HRC = 58.0, 60.0
"""Least hardness of a race, and the usual one of a ground race."""


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
    >>> round(carry_over_speed(23e-3) * 30 / math.pi)
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
    top = shown(case.speed_range[1], "rpm", ".6g")
    checks = (_pressure(candidate, top), _hardness(case), _hoop(candidate, top), _roundness(case, candidate, top))
    if case.table.machine.spindle_axis != "horizontal":
        return checks
    return (*checks, _carried_over(case, race))


def _pressure(candidate: Candidate, top: str) -> Check:
    """Check of the Hertz pressure against the pressure that leaves no dent."""
    pressure, permitted = candidate.strength.contact_pressure, candidate.strength.permitted_pressure
    return coded("ABU301", verdict(pressure <= permitted),
        f"At {top}, a ball presses its race. Up to 5.2·HV no dent is left (assumed rule)", pressure, permitted,
    )  # fmt: skip


def _hardness(case: Case) -> Check:
    hardness = case.autobalancer.race_hardness_HRC
    return coded("ABU302", verdict(hardness >= LEAST_HARDNESS_HRC),
        "A soft race dents, and dents hold the balls. Machines with soft races gained nothing",
        hardness, LEAST_HARDNESS_HRC,
    )  # fmt: skip


def _hoop(candidate: Candidate, top: str) -> Check:
    hoop, limit = candidate.strength.hoop_stress, candidate.strength.permitted_hoop
    return coded("ABU303", verdict(hoop <= limit), f"The rim spins at {top} (the limit is assumed)", hoop, limit)


def carries_over(case: Case, race: Track) -> bool:
    """True if the lowest speed carries the balls round; a vertical spindle has no top to pass."""
    return case.table.machine.spindle_axis != "horizontal" or case.speed_range[0] > race.carry_over


def _carried_over(case: Case, race: Track) -> Check:
    message = "The lowest speed must carry the balls round the horizontal spindle"
    return coded("ABU102", verdict(carries_over(case, race)), message, case.speed_range[0], race.carry_over)


def _roundness(case: Case, candidate: Candidate, top: str) -> Check:
    """Check of the displacement that an oval race leaves if one web alone holds it.

    The value is compared with all that the level's limit permits.
    """
    drawn = shown(ovality_residual(candidate.roundness.lobes), "um")
    return coded("ABU304", verdict(candidate.stays_round), f"At {top}, two opposite balls make the race oval. One web "
        f"alone leaves this displacement; web and cover together leave {drawn}",
        ovality_residual(candidate.roundness.unaided),
        permitted_displacement(case, candidate.mass, case.speed_range[1]),
    )  # fmt: skip
