"""Step 10: drawing requirements, each tolerance with the dB it costs."""

import math

from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs.oil import oil_name
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import ovality_residual
from abu_calc.sizing.case import Case
from abu_calc.sizing.track import Track
from abu_calc.standards.tolerance_classes import DeviationLimits, part_limits

SOFT_ARM = to_si(10, "um")
"""Lever arm of rolling friction on a soft race (assumed; 10–50 µm)."""
OVALITY = to_si(3, "um")
"""Circularity asked of the race."""
RACE_TOLERANCE = to_si(0.05, "mm")
GROOVE_TOLERANCE = to_si(0.2, "mm")
ROUGHNESS = to_si(0.16, "um")
"""Ra of the race, at most."""
HARDNESS = "60–63 HRC"
CASE_DEPTH = to_si(0.5, "mm")
"""Least depth of the hard case after grinding [m]."""
BORE, SPINDLE = "H6", "js6"
WAVINESS = to_si(2.5, "um")
DENT = to_si(1, "um")


@dataclass(frozen=True)
class DrawingRequirement:
    """One line of the drawing: feature, requirement, and the cost in dB when the tolerance is used up (or none)."""

    feature: str
    requirement: str
    cost_db: float | None = None


@formula(
    "Increase of the level by one more displacement",
    "20·lg(√(w² + w_d²)/w)",
    "dB",
    where="w is the displacement without it.",
    assumed="independent displacements",
    source="root of the sum of squares",
)
def extra_level(residual: float, part: float) -> float:
    """
    >>> round(extra_level(10e-6, 10e-6), 2)
    3.01
    """
    return 20 * math.log10(math.hypot(residual, part) / residual) if residual > 0 else math.inf


def drawing(case: Case, candidate: Candidate, track: Track) -> tuple[DrawingRequirement, ...]:
    """Advice for the drawing; requirements are engineering practice (assumed), costs are computed from the budget.

    What only changes the capacity, or what the balls themselves balance, costs nothing.
    """
    return (*_race(case, candidate, track), *_seat_and_balls(case, candidate), *_running(case, candidate, track))


def _race(case: Case, candidate: Candidate, track: Track) -> tuple[DrawingRequirement, ...]:
    budget, abu = candidate.budget, case.autobalancer
    eccentricity = from_si(case.race_eccentricity, "um")
    others = math.hypot(budget.rolling_friction, budget.race_ovality, budget.plane_offset)
    smooth = math.hypot(budget.race_eccentricity, budget.race_ovality, budget.plane_offset)
    arm = case.friction_arm or SOFT_ARM
    race = f"R {from_si(candidate.race_radius, 'mm'):.2f} ± {_mm(RACE_TOLERANCE)} mm"
    return (
        DrawingRequirement("race", f"{race} at the bottom (affects the capacity only)", 0.0),
        DrawingRequirement(
            "groove", f"{_across(track.groove_radius)} (helps to shake out friction; no effect on the level)", 0.0
        ),
        DrawingRequirement(
            "race to bore, total",
            f"eccentricity {eccentricity:.0f} µm (TIR {2 * eccentricity:.0f} µm), bore "
            "clearance and spindle included; grind bore and race in one set-up",
            _cost(others, case.race_eccentricity),
        ),
        DrawingRequirement(
            "race circularity",
            f"{_um(OVALITY)} µm; two lobes of {_um(OVALITY / 2)} µm leave {_um(OVALITY)} µm",
            _cost(budget.residual, OVALITY),
        ),
        DrawingRequirement(
            "race waviness", "n_k lobes of amplitude a_k leave n_k·a_k: 5 × 0.5 µm", _cost(budget.residual, WAVINESS)
        ),
        DrawingRequirement(
            "race surface",
            f"Ra ≤ {_um(ROUGHNESS)} µm, no dents: a dent {_um(DENT)} µm deep holds a ball",
            _cost(budget.residual, DENT * candidate.pitch_radius / _dent_half_width(candidate)),
        ),
        DrawingRequirement(
            "race hardness",
            f"{HARDNESS}, case ≥ {_mm(CASE_DEPTH)} mm after grinding (given: "
            f"{abu.race_hardness_HRC:g}); a soft race has a lever arm of {_um(SOFT_ARM)} µm",
            _cost(smooth, max(1.0, SOFT_ARM / arm) * budget.rolling_friction),
        ),
        DrawingRequirement(
            "rolling friction",
            f"lever arm ≤ {1e3 * abu.rolling_friction_mm:g} µm: hard, ground, clean, oiled",
            _cost(smooth, budget.rolling_friction),
        ),
    )


def _across(groove: float | None) -> str:
    return "straight ± 2 µm" if groove is None else f"R {from_si(groove, 'mm'):.2f} ± {_mm(GROOVE_TOLERANCE)} mm across"


def _seat_and_balls(case: Case, candidate: Candidate) -> tuple[DrawingRequirement, ...]:
    clearance = _bore_clearance(to_si(case.autobalancer.bore_diameter_mm, "mm"))
    rest = math.hypot(candidate.budget.rolling_friction, candidate.budget.race_ovality, candidate.budget.plane_offset)
    play = "" if clearance is None else f"; {from_si(clearance / 2, 'um'):.0f} µm of the eccentricity above at most"
    cost = None if clearance is None else _cost(rest, clearance / 2)
    return (
        DrawingRequirement("bore and spindle", f"bore {BORE}, spindle {SPINDLE}{play}", cost),
        DrawingRequirement(
            "balls", "of one lot, grade 20 (ISO 3290); the balls balance the 0.5 µm of their diameters", 0.0
        ),
        DrawingRequirement("housing without balls", "balanced to G6.3 (ISO 21940-11); the balls balance the rest", 0.0),
    )


def _running(case: Case, candidate: Candidate, track: Track) -> tuple[DrawingRequirement, ...]:
    oval = candidate.roundness
    optimum = "" if track.optimum_drag is None else f" (optimum {track.optimum_drag:.0f})"
    return (
        DrawingRequirement(
            "oil",
            f"for a viscous drag rate of about {case.drag:g} 1/s{optimum}; VG 46 gives 3 "
            "to 50 1/s, depending on slip, more when cold; specify grade and volume"
            if case.table.oil is None
            else f"{case.table.oil.fill_ml:g} ml of {oil_name(case.table.oil)}, for a viscous drag rate of about "
            f"{case.drag:.3g} 1/s{optimum} at {case.table.oil.temperature_C:g} °C",
        ),
        DrawingRequirement(
            "web and cover",
            "both must carry the wall, the cover without clearance: two-lobe ovality then leaves "
            f"{_um(ovality_residual(oval.lobes))} µm, with one web alone {_um(ovality_residual(oval.unaided))} µm; "
            f"the diameter of a free ring would grow by {_um(oval.free_ring)} µm",
        ),
        DrawingRequirement("proof", "cover and seal; overspeed test at 1.2 × the highest speed"),
    )


def _um(length: float) -> str:
    return f"{from_si(length, 'um'):.3g}"


def _mm(length: float) -> str:
    return f"{from_si(length, 'mm'):.3g}"


def bore_limits(bore: float) -> DeviationLimits | None:
    """Limits of the bore [m], where they are tabulated."""
    try:
        return part_limits("housing", BORE, bore)
    except RangeError:
        return None


def _bore_clearance(bore: float) -> float | None:
    """Largest clearance of a bore H6 on a spindle js6 [m] (ISO 286-2), where both are tabulated."""
    hole = bore_limits(bore)
    return None if hole is None else hole.upper - part_limits("shaft", SPINDLE, bore).lower


def _cost(rest: float, part: float) -> float | None:
    cost = extra_level(rest, part)
    return cost if math.isfinite(cost) else None


def _dent_half_width(candidate: Candidate) -> float:
    """Half chord [m] of the ball in a dent of that depth."""
    return math.sqrt(candidate.ball_diameter * DENT)
