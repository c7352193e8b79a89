"""Step 10: drawing requirements, each tolerance with the dB it costs."""

import math
from collections.abc import Iterator
from typing import Annotated

from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, microns, shown
from abu_calc.inputs.autobalancer import oil_name
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import ovality_residual
from abu_calc.sizing.case import Case
from abu_calc.sizing.manufacture.construction import Construction
from abu_calc.sizing.manufacture.cover import Fit, filling_gap_of, seat_name
from abu_calc.sizing.manufacture.eccentricity import EccentricitySplit
from abu_calc.sizing.manufacture.ring_seat import RaceQuality
from abu_calc.sizing.parts.demands import GROOVE_TOLERANCE, RACE_TOLERANCE
from abu_calc.sizing.track import Track
from abu_calc.standards.tolerance_classes import DeviationLimits

SOFT_ARM = 10e-6
"""Lever arm of rolling friction on a soft race (assumed; 10–50 µm)."""


@record
class DrawingLine(Record):
    """One requirement for the drawing."""

    feature: Annotated[str, Quantity("feature")]
    requirement: Annotated[str, Quantity("requirement")]
    cost_db: Annotated[float | None, Quantity("cost", "", 3, "what the level rises by when the tolerance is used up")]


def _line(feature: str, requirement: str, cost: float | None = None) -> DrawingLine:
    return DrawingLine(feature=feature, requirement=requirement, cost_db=cost)


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


def drawing(
    case: Case, candidate: Candidate, track: Track, split: EccentricitySplit, construction: Construction
) -> tuple[DrawingLine, ...]:
    """Advice for the drawing; requirements are engineering practice (assumed), costs are computed from the budget.

    What only changes the capacity, or what the balls themselves balance, costs nothing.
    """
    quality = construction.quality
    return (
        *_eccentricity(case, candidate, split),
        *_race(case, candidate, track, quality),
        *_seat_and_balls(candidate, split, quality, f"{case.autobalancer.bore_diameter_mm:g}"),
        *_construction(case, construction),
        *_running(case, candidate),
    )


def _eccentricity(case: Case, candidate: Candidate, split: EccentricitySplit) -> tuple[DrawingLine, ...]:
    """The total, and the run-outs of race and spindle that it is split into."""
    budget = candidate.budget
    others = math.hypot(budget.rolling_friction, budget.race_ovality, budget.plane_offset)
    fit = "the fit" if split.fit is None else split.fit.named
    whole = "worst case" if split.rule == "worst-case" else "root of the sum of squares"
    return (
        _line(
            "race to bore, total",
            f"eccentricity {microns(split.total)} µm at most, {whole} of race {microns(split.race)}, {fit} "
            f"{microns(split.clearance)}, spindle {microns(split.spindle)}, imbalance of the housing "
            f"{microns(split.housing)} µm",
            _cost(others, case.race_eccentricity),
        ),
        _line(
            "race run-out",
            f"{microns(2 * split.race)} µm TIR to the bore; {_how_round(split)}",
            _cost(others, split.race),
        ),
        _line(
            "spindle run-out", f"{microns(2 * split.spindle)} µm TIR at the seat, on its own bearings",
            _cost(others, split.spindle),
        ),
    )  # fmt: skip


def _how_round(split: EccentricitySplit) -> str:
    """How the run-out of the race is attained."""
    if not split.ring_class:
        return "grind bore and race in one set-up"
    return f"a ring of class {split.ring_class} (ISO 492) has {microns(split.ring_run_out)} µm of it, its seat the rest"


def _construction(case: Case, construction: Construction) -> Iterator[DrawingLine]:
    """Closure with the way of the balls, fastening, seat of the ring."""
    parts, seat, abu = construction.parts, construction.seat, case.autobalancer
    yield _line(
        "closure", f"cover {parts.closure}, {seat_name(parts, construction.cover)}, after balls and oil; it holds "
        f"{construction.cover.held:.3g} N, needed {construction.cover.needed:.3g} N",
    )  # fmt: skip
    yield _line(
        "filling", "balls go in one by one between hub and edge of the race on the cover's side; gap beside a ball "
        f"{shown(filling_gap_of(parts), 'mm')}",
    )  # fmt: skip
    force = "" if abu.clamp_force_N is None else f" by {abu.clamp_force_N:g} N"
    ways = {
        "clamped": f"clamped on the spindle by a nut{force}",
        "shrunk": "shrunk on the spindle, no nut",
        "flange": f"part of the wheel's flange, clamped by its nut{force}",
    }
    yield _line("fastening", ways[parts.fastening])
    if seat is not None:
        named = f"{seat.seat_class} " if seat.seat_class else ""
        limits = shown((seat.seat.upper, seat.seat.lower), "um", "+.3g", "/")
        low, high = abu.temperature_range_C
        yield _line(
            "seat of the ring",
            f"{named}{limits}, ring {seat.ring_class}; {microns(seat.left)} µm of interference left at least at "
            f"{low:g} … {high:g} °C; join with the body at {seat.joining:.0f} °C",
        )


def _race(case: Case, candidate: Candidate, track: Track, quality: RaceQuality) -> tuple[DrawingLine, ...]:
    budget, abu = candidate.budget, case.autobalancer
    smooth = math.hypot(budget.race_eccentricity, budget.race_ovality, budget.plane_offset)
    arm = case.friction_arm or SOFT_ARM
    race = f"R {shown((candidate.race_radius, RACE_TOLERANCE), 'mm', '.2f', ' ± ')}"
    return (
        _line("race", f"{race} at the bottom (affects the capacity only)", 0.0),
        _line("groove", f"{_across(track.groove_radius)} (helps to shake out friction; no effect on the level)", 0.0),
        _line(
            "race circularity",
            f"{microns(quality.circularity)} µm; two lobes of {microns(quality.circularity / 2)} µm leave "
            f"{microns(quality.circularity)} µm",
            _cost(budget.residual, quality.circularity),
        ),
        _line(
            "race waviness",
            f"n_k lobes of amplitude a_k leave n_k·a_k: {microns(quality.waviness)} µm at most, such as 5 × "
            f"{microns(quality.waviness / 5)} µm",
            _cost(budget.residual, quality.waviness),
        ),
        _line(
            "race surface",
            f"Ra ≤ {microns(quality.roughness)} µm, no dents: a dent {microns(quality.dent)} µm deep holds a ball",
            _cost(budget.residual, quality.dent * candidate.pitch_radius / _dent_half_width(candidate, quality.dent)),
        ),
        _line(
            "race hardness",
            f"{hardness_text(quality)}, through-hardened (given: {abu.race_hardness_HRC:g}); a soft race has a lever "
            f"arm of {microns(SOFT_ARM)} µm",
            _cost(smooth, max(1.0, SOFT_ARM / arm) * budget.rolling_friction),
        ),
        _line(
            "rolling friction",
            f"lever arm ≤ {1e3 * abu.rolling_friction_mm:g} µm: hard, ground, clean, oiled",
            _cost(smooth, budget.rolling_friction),
        ),
    )


def _across(groove: float | None) -> str:
    if groove is None:
        return "straight ± 2 µm"
    return f"R {from_si(groove, 'mm'):.2f} ± {shown(GROOVE_TOLERANCE, 'mm')} across"


def hardness_text(quality: RaceQuality) -> str:
    """Hardness of the race as a drawing writes it."""
    low, high = quality.hardness
    return f"{low:g}–{high:g} HRC"


def _seat_and_balls(
    candidate: Candidate, split: EccentricitySplit, quality: RaceQuality, bore: str
) -> tuple[DrawingLine, ...]:
    rest = math.hypot(candidate.budget.rolling_friction, candidate.budget.race_ovality, candidate.budget.plane_offset)
    fit = split.fit
    named = "no standard fit" if fit is None else (
        f"bore Ø{bore} {fit.bore_class} ({_limits(fit.bore)}), spindle Ø{bore} {fit.spindle_class} "
        f"({_limits(fit.spindle)} mm); {_clearance(fit)}; the largest clearance gives "
        f"{microns(split.clearance)} µm of the eccentricity"
    )  # fmt: skip
    return (
        _line("bore and spindle", named, None if fit is None else _cost(rest, split.clearance)),
        _line(
            "balls", f"of one lot, grade {quality.ball_grade} (ISO 3290-1); the balls balance the differences of their "
            "diameters", 0.0,
        ),
        _line(
            "housing without balls",
            f"balanced to {split.balance_grade} (ISO 21940-11); the balls balance the static rest, the couple counts "
            f"as {microns(split.housing)} µm of the eccentricity",
            0.0,
        ),
    )  # fmt: skip


def _limits(limits: DeviationLimits) -> str:
    """Upper and lower deviation in mm."""
    return " / ".join(f"{from_si(limit, 'mm'):+.4g}" if limit else "0" for limit in (limits.upper, limits.lower))


def _clearance(fit: Fit) -> str:
    """Clearance or interference of a fit in words."""
    if fit.tightest <= 0:
        return f"clearance {shown((-fit.tightest, -fit.loosest), 'um')}"
    if fit.loosest >= 0:
        return f"interference {shown((fit.loosest, fit.tightest), 'um')}"
    return f"clearance {microns(-fit.loosest)} to interference {microns(fit.tightest)} µm"


def _running(case: Case, candidate: Candidate) -> tuple[DrawingLine, ...]:
    oval, overspeed = candidate.roundness, shown(1.2 * case.speed_range[1], "rpm", ".0f")
    return (
        _line(
            "oil",
            f"one that gives a viscous drag rate of {case.drag:g} 1/s, which the design assumes. Specify "
            "grade and volume under [oil], or identify the rate from recorded starts"
            if case.table.oil is None
            else f"{case.table.oil.fill_ml:g} ml of {oil_name(case.table.oil)}, for a viscous drag rate of about "
            f"{case.drag:.3g} 1/s at {case.table.oil.temperature_C:g} °C",
        ),
        _line(
            "web and cover",
            "both must carry the wall, the cover without clearance: two-lobe ovality then leaves "
            f"{microns(ovality_residual(oval.lobes))} µm, with one web alone "
            f"{microns(ovality_residual(oval.unaided))} µm; the diameter of a free ring would grow by "
            f"{microns(oval.free_ring)} µm",
        ),
        _line("proof", f"cover and seal; overspeed test at {overspeed}, 1.2 × the highest speed"),
    )


def _cost(rest: float, part: float) -> float | None:
    cost = extra_level(rest, part)
    return cost if math.isfinite(cost) else None


def _dent_half_width(candidate: Candidate, dent: float) -> float:
    """Half chord [m] of the ball in a dent of that depth [m]."""
    return math.sqrt(candidate.ball_diameter * dent)
