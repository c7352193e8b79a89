"""Step 6: the race (called track in JSON) and its load."""

import math

from abu_calc.formulas.slow_motion import ball_stiffness, decay_rate, optimum_drag, slow_stiffness
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY, from_si
from abu_calc.sizing import trials
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import oval_rest, permitted_displacement
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import groove_radius

LEAST_HARDNESS_HRC = 58.0


@dataclass(frozen=True)
class Track:
    """Groove, slow motion of the balls [SI]; null where there is none.

    `decay_rates`: drag and slowest rate [1/s] at the drag of the file, a third of it and three times it.
    """

    groove_radius: float | None
    carry_over: float
    ball_stiffness: float
    optimum_drag: float | None
    decay_rates: tuple[tuple[float, float], ...]


@formula(
    "Least speed that carries balls round a horizontal axis",
    "√(g/R_p)",
    "rad/s",
    where="Below it balls rattle in the bottom of the race.",
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
        groove_radius=None if rolls else groove_radius(candidate.race_radius, candidate.ball_diameter / 2),
        carry_over=carry_over_speed(candidate.pitch_radius),
        ball_stiffness=kappa,
        optimum_drag=optimum_drag(slowest, case.inertia_factor) if slowest > 0 else None,
        decay_rates=tuple(
            (drag, _rate(case, candidate, kappa, drag)) for drag in (case.drag, case.drag / 3, 3 * case.drag)
        ),
    )


def _rate(case: Case, candidate: Candidate, kappa: float, drag: float) -> float:
    return decay_rate((kappa,) * candidate.ball_count, candidate.budget.resting_angles, drag, case.inertia_factor)


def track_checks(case: Case, imbalance: float, candidate: Candidate, race: Track) -> tuple[Check, ...]:
    """Pressure, hardness, hoop stress, roundness at the highest speed; on a horizontal spindle that the balls are
    carried over at the lowest.
    """
    hardness, stress = case.autobalancer.race_hardness_HRC, candidate.strength
    pressure, permitted = from_si(stress.contact_pressure, "MPa"), from_si(stress.permitted_pressure, "MPa")
    hoop, limit = from_si(stress.hoop_stress, "MPa"), from_si(stress.permitted_hoop, "MPa")
    top = f"{from_si(case.speed_range[1], 'rpm'):.6g} rpm"
    checks = [
        coded(
            "ABU301",
            verdict(pressure <= permitted),
            f"Hertz pressure of a ball at {top}, against 5.2·HV, which leaves no dent (assumed rule)",
            pressure,
            permitted,
            "MPa",
            None if pressure <= permitted else trials.remedy(case, imbalance, trials.harder(case), _bears),
        ),
        coded(
            "ABU302",
            verdict(hardness >= LEAST_HARDNESS_HRC),
            "a soft race dents, and dents hold the balls: machines with soft races gained nothing",
            hardness,
            LEAST_HARDNESS_HRC,
            "HRC",
            None if hardness >= LEAST_HARDNESS_HRC else "Harden the race to 60–63 HRC and grind it.",
            "least",
        ),
        coded(
            "ABU303",
            verdict(hoop <= limit),
            f"spinning rim at {top} (limit assumed)",
            hoop,
            limit,
            "MPa",
            None if hoop <= limit else trials.remedy(case, imbalance, trials.stronger(case), _bears),
        ),
        _roundness(case, imbalance, candidate, top),
    ]
    if case.table.machine.spindle_axis == "horizontal":
        lowest, needed = from_si(case.speed_range[0], "rpm"), from_si(race.carry_over, "rpm")
        checks.append(
            coded(
                "ABU102",
                verdict(lowest > needed),
                "the lowest speed carries the balls round the horizontal spindle",
                lowest,
                needed,
                "rpm",
                None if lowest > needed else "Raise the lowest speed, or enlarge the race.",
                "least",
            )
        )
    return tuple(checks)


def _bears(_: Case, candidate: Candidate) -> bool:
    return candidate.strength.enough


def _roundness(case: Case, imbalance: float, candidate: Candidate, top: str) -> Check:
    """Check of the residual that an oval race leaves if one web alone holds it.

    The value is compared with all that the level's limit permits.
    """
    left, permitted = (
        oval_rest(candidate.roundness.unaided),
        permitted_displacement(case, candidate.mass, case.speed_range[1]),
    )
    drawn = f"{from_si(oval_rest(candidate.roundness.lobes), 'um'):.3g} µm"
    return coded(
        "ABU304",
        verdict(candidate.stays_round),
        "what the two lobes leave of a race that two opposite balls make "
        f"oval, held by one web alone, at {top}; {drawn} as drawn, the cover carrying the wall",
        from_si(left, "um"),
        from_si(permitted, "um"),
        "µm",
        None
        if candidate.stays_round
        else trials.remedy(case, imbalance, trials.rounder(case), lambda _, other: other.stays_round),
    )
