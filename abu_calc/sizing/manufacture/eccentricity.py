"""One budget for the eccentricity: what the file permits in all, split into what a drawing can ask for.

The simulation uses the total. Run-out of the race, fit, run-out of the spindle and imbalance of the housing share it.
"""

import math
from collections.abc import Sequence
from typing import Final

from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, microns, to_si
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.manufacture.bearing_ring import ring_of
from abu_calc.sizing.manufacture.cover import Fit, standard_fits
from abu_calc.sizing.manufacture.fastening import SLIP_FACTOR, bore_growth, needed_torque, shrunk_torque, whole_inertia
from abu_calc.sizing.parts.housing_parts import candidate_dimensions, housing_parts
from abu_calc.standards.self_aligning import RUNOUT_CLASSES, outer_run_out
from abu_calc.standards.tolerance_classes import grade_tolerance
from abu_calc.standards.vibration import permissible_imbalance

GRADES: Final = (8, 7, 6, 5, 4, 3, 2)
"""Tolerance grades IT of run-outs, coarsest first; the last is the least that careful grinding attains (assumed)."""
BALANCE_GRADES: Final = ("G40", "G16", "G6.3", "G2.5", "G1")
LARGE_RING_GRADE: Final = 7
"""Grade that stands for the run-out of rings beyond the table of ISO 492 (assumed)."""
IMBALANCE_SHARE: Final = 0.05
"""Share of the total that the housing's imbalance may take, where a grade attains it (assumed)."""


@formula(
    "Eccentricity in all by its four parts",
    "worst case: Δ_r + Δ_f + Δ_s + Δ_h; rss: √(Δ_r² + Δ_f² + Δ_s² + Δ_h²)",
    "m",
    shown="um",
    where=(
        "Half the run-out of the race to the bore is Δ_r. Half the largest clearance of bore and spindle is Δ_f. Half "
        "the run-out of the spindle's seat is Δ_s. The imbalance of the housing without balls per effective mass is "
        "Δ_h. The rule is autobalancer.eccentricity_sum."
    ),
    assumed="worst case: all parts at their limit in one direction; rss: independent parts in random directions",
    source="derived",
)
def eccentricity_sum(parts: Sequence[float], rule: str) -> float:
    """
    >>> round(1e6 * eccentricity_sum((3e-6, 0.0, 4e-6, 0.0), "rss"), 3)
    5.0
    """
    return math.hypot(*parts) if rule == "rss" else math.fsum(parts)


@formula(
    "Eccentricity that stands for the residual imbalance of the housing without balls",
    "Δ_h = G_e·m_h/(Ω·m_F)",
    "m",
    shown="um",
    where=(
        "The balls balance the static part of this imbalance. Its couple part remains, and is taken as if all of it "
        "remained, at the highest speed, for which the grade is specified."
    ),
    assumed="the couple moves the wheel at most as much as the whole imbalance in its plane",
    source="ISO 21940-11 (grade); derived",
)
def housing_eccentricity(grade: str, housing_mass: float, speed: float, effective_mass: float) -> float:
    """
    >>> round(1e6 * housing_eccentricity("G6.3", 0.17, 607.0, 6.4), 3)
    0.276
    """
    return permissible_imbalance(grade, housing_mass, speed) / effective_mass


@dataclass(frozen=True)
class EccentricitySplit:
    """Parts of the eccentricity [m] that the drawing permits; `fit` None: no standard row holds this bore.

    `ring_class`, `ring_run_out`: tolerance class by ISO 492 of a bearing's ring and its run-out [m], of which half is a
    part of `race`; empty and 0 for a race that is ground in one set-up with the bore.
    `total`: what the file permits and the simulation uses; `least`: the least sum that standard fits and careful
    grinding attain.
    """

    total: float
    rule: str
    race: float
    clearance: float
    spindle: float
    housing: float
    fit: Fit | None
    balance_grade: str
    least: float
    ring_class: str = ""
    ring_run_out: float = 0.0

    @property
    def parts(self) -> tuple[float, float, float, float]:
        """Race, clearance, spindle, housing [m]."""
        return self.race, self.clearance, self.spindle, self.housing

    @property
    def sum(self) -> float:
        """Sum of the parts by the rule [m]."""
        return eccentricity_sum(self.parts, self.rule)

    @property
    def holds(self) -> bool:
        """True if the parts stay within the total."""
        return self.fit is not None and self.sum <= self.total * (1 + 1e-9)


def split_eccentricity(case: Case, candidate: Candidate) -> EccentricitySplit:
    """The split of the total: the coarsest run-outs and the loosest standard fit that hold it.

    Run-outs of race and spindle get what the fit and the housing leave, in proportion to their tolerance grades.
    """
    total, rule = case.race_eccentricity, case.autobalancer.eccentricity_sum
    bore, fits = case.autobalancer.bore_diameter, _fits(case, candidate)
    grade, housing = _housing(case, candidate, total)
    least = _least(case, candidate, fits, bore)

    def split(fit: Fit | None, run_outs: tuple[float, float], ring: tuple[str, float]) -> EccentricitySplit:
        clearance = 0.0 if fit is None else fit.eccentricity
        return EccentricitySplit(total, rule, run_outs[0], clearance, run_outs[1], housing, fit, grade, least, *ring)

    for number in GRADES:
        for ring in _ring_run_outs(case, candidate):
            needed = _race(candidate, number) + ring[1] / 2, grade_tolerance(number, bore) / 2
            for fit in fits:
                if split(fit, needed, ring).holds:
                    stretched = _stretched(needed, (fit.eccentricity, housing), total, rule)
                    return split(fit, _rounded(stretched, needed), ring)
    ring = _ring_run_outs(case, candidate)[-1]
    needed = _race(candidate, GRADES[-1]) + ring[1] / 2, grade_tolerance(GRADES[-1], bore) / 2
    return split(min(fits, key=lambda fit: fit.eccentricity, default=None), needed, ring)


def _fits(case: Case, candidate: Candidate) -> tuple[Fit, ...]:
    """Standard fits of the bore; a shrunk housing takes those that carry its torque, or else the tightest."""
    size = candidate_dimensions(case, candidate)
    fits = standard_fits(2 * size.bore_radius, bore_growth(case, size))
    if case.autobalancer.fastening != "shrunk":
        return fits
    needed = SLIP_FACTOR * needed_torque(case, whole_inertia(housing_parts(case, candidate)))
    return tuple(fit for fit in fits if shrunk_torque(case, size, fit) >= needed) or fits[-1:]


def _race(candidate: Candidate, grade: int) -> float:
    """Eccentricity [m] of a race whose run-out has a tolerance grade."""
    return grade_tolerance(grade, 2 * candidate.race_radius) / 2


def _ring_run_outs(case: Case, candidate: Candidate) -> tuple[tuple[str, float], ...]:
    """Tolerance classes of a bearing's ring, whose race is not ground in its place, with its run-out [m].

    A race that is ground in one set-up with the bore has none of its own.
    """
    ring = ring_of(case, candidate.race_radius)
    if ring is None:
        return (("", 0.0),)
    known = tuple(
        (name, run_out)
        for name in RUNOUT_CLASSES
        if (run_out := outer_run_out(name, ring.outside_diameter)) is not None
    )
    return known or (("0", grade_tolerance(LARGE_RING_GRADE, ring.outside_diameter)),)


def _housing(case: Case, candidate: Candidate, total: float) -> tuple[str, float]:
    """The coarsest grade whose imbalance takes no more than its share, else the finest, and its eccentricity [m]."""
    effective = case.body.effective_mass(candidate.mass, case.race_place)
    for grade in BALANCE_GRADES:
        own = housing_eccentricity(grade, candidate.housing.mass, case.speed_range[1], effective)
        if own <= IMBALANCE_SHARE * total:
            break
    return grade, own


def _least(case: Case, candidate: Candidate, fits: Sequence[Fit], bore: float) -> float:
    """The least sum [m] by the finest grades and the fit that centres best."""
    finest, own = GRADES[-1], _ring_run_outs(case, candidate)[-1][1]
    housing = _housing(case, candidate, 0.0)[1]
    clearance = min((fit.eccentricity for fit in fits), default=0.0)
    parts = _race(candidate, finest) + own / 2, clearance, grade_tolerance(finest, bore) / 2, housing
    return eccentricity_sum(parts, case.autobalancer.eccentricity_sum)


def _stretched(needed: tuple[float, float], fixed: tuple[float, float], total: float, rule: str) -> tuple[float, float]:
    """Both run-outs enlarged by one factor so that all parts together use up the total."""
    if rule == "rss":
        factor = math.sqrt(max(total**2 - math.hypot(*fixed) ** 2, 0.0)) / math.hypot(*needed)
    else:
        factor = (total - math.fsum(fixed)) / math.fsum(needed)
    return needed[0] * factor, needed[1] * factor


def _rounded(values: tuple[float, float], least: tuple[float, float]) -> tuple[float, float]:
    """Eccentricities whose run-outs are rounded down as drawings write them, but not below what the grade asks for."""
    first, second = (max(run_out(2 * value) / 2, low) for value, low in zip(values, least, strict=True))
    return first, second


def run_out(value: float) -> float:
    """A run-out [m] rounded down as a drawing writes it: two digits, half micrometres below 10 µm.

    >>> [round(1e6 * run_out(value), 3) for value in (7.94e-6, 18.7e-6, 223.9e-6)]
    [7.5, 18.0, 220.0]
    """
    microns = from_si(value, "um") * (1 + 1e-12)
    step = 0.5 if microns < 10 else 10.0 ** (math.floor(math.log10(microns)) - 1)
    return to_si(math.floor(microns / step) * step, "um")


def eccentricity_check(case: Case, split: EccentricitySplit) -> Check:
    """Check that a standard fit and attainable run-outs hold the eccentricity that the file permits."""
    if split.fit is None:
        return coded("ABU206", "not-done", f"No fit of ISO 286 is tabulated for a bore of "
            f"{case.autobalancer.bore_diameter_mm:g} mm", None, split.total, "Specify a bore from 0.6 to 500 mm.",
        )  # fmt: skip
    if split.holds:
        race, clearance, spindle, housing = map(microns, split.parts)
        message = (
            f"{split.rule} sum of race {race}, clearance of {split.fit.named} {clearance}, spindle {spindle}, "
            f"imbalance of the housing ({split.balance_grade}) {housing} µm, against autobalancer.race_eccentricity_mm"
        )
        return coded("ABU206", verdict(True), message, split.sum, split.total)
    message = (
        f"No standard fit of the bore holds autobalancer.race_eccentricity_mm. The least attainable {split.rule} sum "
        f"is that of {split.fit.named} and run-outs of grade IT{GRADES[-1]}"
    )
    return coded("ABU206", verdict(False), message, split.least, split.total)
