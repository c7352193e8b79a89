"""Step 10: what the drawing must say, each tolerance with the dB it costs."""

import math
from dataclasses import dataclass

from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.track import Track
from abu_calc.units import from_si, to_si

OVALITY = to_si(3, "um")
DENT = to_si(1, "um")


@dataclass(frozen=True)
class Advice:
    """One line of the drawing: feature, requirement, and the cost in dB when the tolerance is used up (or none)."""

    feature: str
    requirement: str
    cost_db: float | None = None


def extra_level(residual: float, part: float) -> float:
    """What one more displacement costs [dB]: 20·lg(√(w² + d²)/w), w what stays without it, d the part [m].

    Range: independent parts. Source: root of the sum of squares.

    >>> round(extra_level(10e-6, 10e-6), 2)
    3.01
    """
    return 20 * math.log10(math.hypot(residual, part) / residual) if residual > 0 else math.inf


def drawing(case: Case, one: Candidate, track: Track) -> tuple[Advice, ...]:
    """Advice for the drawing; the values are engineering practice (assumed), the costs are computed from the budget."""
    budget, abu = one.budget, case.autobalancer
    rest = math.hypot(budget.rolling_friction, budget.plane_offset)
    eccentricity = from_si(case.race_eccentricity, "um")
    groove = (
        f"R {from_si(track.groove_radius, 'mm'):.2f} ± 0.2 mm across the race"
        if track.groove_radius is not None
        else "cylindrical, straight within 2 µm"
    )
    dent = DENT * one.pitch_radius / _dent_half_width(one)
    return (
        Advice("race", f"R {from_si(one.race_radius, 'mm'):.2f} ± 0.05 mm at the bottom"),
        Advice("groove", groove),
        Advice(
            "race to bore, all in", f"eccentricity {eccentricity:.0f} µm (TIR {2 * eccentricity:.0f} µm) with bore "
            "clearance and spindle; grind bore and race in one set-up", _cost(rest, case.race_eccentricity),
        ),
        Advice("race circularity", "3 µm; two lobes of 1.5 µm leave 3 µm", _cost(budget.residual, OVALITY)),
        Advice("race surface", "Ra ≤ 0.16 µm, no dents: one of 1 µm depth holds a ball", _cost(budget.residual, dent)),
        Advice("race hardness", f"60–63 HRC, case ≥ 0.5 mm after grinding (given: {abu.race_hardness_HRC:g} HRC)"),
        Advice("rolling friction", f"lever arm ≤ {1e3 * abu.rolling_friction_mm:g} µm: hard, ground, clean, oiled",
               _cost(math.hypot(budget.race_eccentricity, budget.plane_offset), budget.rolling_friction)),
        Advice("bore and spindle", "bore H6, spindle js6"),
        Advice("balls", "of one lot, grade 20 (ISO 3290)"),
        Advice("housing without balls", "balanced to G6.3 (ISO 21940-11)"),
        Advice("oil", f"so that the drag is about {abu.rolling_drag_per_s:g} 1/s{_optimum(track)}; VG 46 "
               "gives 3 to 50 by slip, more when cold; state grade and volume"),
        Advice("web or cover", "must carry the wall: a free ring would go oval by "
               f"{from_si(track.free_ring_ovality, 'um'):.1f} µm under two opposite balls"),
        Advice("proof", "cover, seal, and overspeed test at 1.2 × the highest speed"),
    )  # fmt: skip


def _cost(rest: float, part: float) -> float | None:
    cost = extra_level(rest, part)
    return cost if math.isfinite(cost) else None


def _optimum(track: Track) -> str:
    return "" if track.optimum_drag is None else f" (optimum {track.optimum_drag:.0f})"


def _dent_half_width(one: Candidate) -> float:
    """Half chord [m] of the ball in a dent of that depth."""
    return math.sqrt(one.ball_diameter * DENT)
