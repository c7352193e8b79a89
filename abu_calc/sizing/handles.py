"""What an estimated inertia leaves open, and the weighted acceleration at the handles against its limit."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from abu_calc.formulas.rigid_body import usual_lengths
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.moved import Moved
from abu_calc.foundation.units import from_si, shown
from abu_calc.sizing.actions import set_options, with_entries, words
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import judged_speeds
from abu_calc.sizing.case import WHEEL_PLANE, Case, read_case
from abu_calc.sizing.imbalance import find_imbalance
from abu_calc.sizing.places import LevelPlace, PlaceBand, in_space, place_bands, place_numbers, settled_levels
from abu_calc.sizing.vibration import idle_vibration, speed_levels

Band = tuple[float, float]
SAME = 1e-3
"""Relative change of an imbalance that is not told."""

SHOWN: Final = 1.005
"""Ratio of two accelerations that shows."""


@dataclass(frozen=True)
class BodyBands:
    """95 % bands that an estimated inertia leaves [low, high]; `level` [dB]: of the highest over the speed range.

    `effective_mass` [kg] at the wheel, with the autobalancer; `imbalance` [kg m]; `places`: of each place of the idle
    machine, in its order.
    """

    effective_mass: Band
    imbalance: Band
    level: Band | None
    places: tuple[PlaceBand, ...]


def body_bands(case: Case, candidate: Candidate, possible: bool) -> BodyBands | None:
    """Bands of an estimated body, the autobalancer as it is; None if nothing is estimated."""
    estimate = case.body.estimate
    if estimate is None:
        return None

    def numbers(other: Case) -> list[float]:
        try:
            imbalance = find_imbalance(other).value
        except AbuError:  # near a node of this body, a measured level says nothing
            return [math.nan] * (3 + 4 * len(case.places))
        levels = speed_levels(other, imbalance, candidate, (), possible)
        places = idle_vibration(other, imbalance, candidate, possible).places
        highest = math.nan if levels is None else levels.highest.level_after_db
        mass = other.body.effective_mass(candidate.mass)
        return [mass, imbalance, highest, *place_numbers(places, case.speed)]

    mass, imbalance, level, *places = estimate.bands(lambda placed: numbers(case.with_body(placed)))
    return BodyBands(mass, imbalance, None if any(map(math.isnan, level)) else level, place_bands(tuple(places)))


@dataclass(frozen=True)
class HighestTotal:
    """The highest vector total a_hv [m/s²] over places and speeds: where, and at which speed [rad/s]."""

    name: str
    speed: float
    total: float


def highest_total(case: Case, imbalance: float, candidate: Candidate) -> HighestTotal | None:
    """The highest a_hv with the autobalancer, as expected, at the judged speeds; None if W_h is not defined at one."""
    totals = list[HighestTotal | None]()
    for speed in judged_speeds(case):
        there = replace(case, speed=speed)
        totals += _totals(there, idle_vibration(there, imbalance, candidate, possible=True).places)
    known = [total for total in totals if total is not None]
    return max(known, key=lambda total: total.total) if known and len(known) == len(totals) else None


def total_of(case: Case, imbalance: float, candidate: Candidate, at_race: float) -> float:
    """The highest a_hv [m/s²] of a machine whose race keeps a displacement [m]; 0 where W_h is not defined."""
    totals = _totals(case, _places(case, imbalance, candidate, at_race))
    return max((0.0 if total is None else total.total for total in totals), default=0.0)


def _places(case: Case, imbalance: float, candidate: Candidate, at_race: float) -> tuple[LevelPlace, ...]:
    """Places of the machine whose race keeps a displacement [m], all parts of it in line."""
    if case.body.in_space and case.handles:
        return in_space(case, imbalance, candidate, at_race)
    return settled_levels(case, None, at_race, imbalance, candidate.mass, in_line=True).places


def _totals(case: Case, places: tuple[LevelPlace, ...]) -> Iterator[HighestTotal | None]:
    for place in places:
        total = place.total(case.speed, after=True)
        yield None if total is None else HighestTotal(place.name, case.speed, total)


UNCERTAIN: Final = 3.0
"""Factor by which the acceleration at a handle is uncertain where body or handles are not known."""


def handle_checks(case: Case, expected: HighestTotal | None, bands: BodyBands | None) -> tuple[Check, ...]:
    """Check of the weighted acceleration at the highest handle; none without a limit in the file.

    `expected`: None if the balls cannot balance, or W_h is not defined.
    """
    limit = case.table.limits.a_hv_m_per_s2
    if limit is None:
        return ()
    if expected is None:
        reason = "Not known: the balls cannot balance, or W_h is not defined at one of the speeds (5.62 … 1413 Hz)"
        return (coded("ABU404", "not-done", reason, None, limit),)
    high = band_end(expected, bands, case)
    notes = [f"{_place(expected)}: expected {_said(expected.total)} (limit {limit:g} m/s²)"]
    if high is not None:
        notes.append(f"The estimated inertia leaves up to {_said(high)} as expected")
    if not case.body.is_rigid:
        notes.append("The machine is a point mass: the value is uncertain by a factor of 2 to 3")
    elif not case.handles:
        notes.append("The file names no handle: the value is that of the wheel plane")
    kept = expected.total <= limit
    sure = (case.body.is_rigid and bool(case.handles)) or UNCERTAIN * expected.total <= limit
    safe = sure and (high is None or high <= limit)
    action = missing_body(case) if kept and not safe else None
    return (coded("ABU404", verdict(kept, safe), ". ".join(notes), expected.total, limit, action),)


def band_end(expected: HighestTotal, bands: BodyBands | None, case: Case) -> float | None:
    """Upper end of the band of the highest a_hv [m/s²], in proportion to the speed; None if nothing is estimated."""
    if bands is None:
        return None
    ends = [
        (band.a_hv_after_band[1], held.name) for band, held in zip(bands.places, case.places, strict=True)
        if band.a_hv_after_band is not None
    ]  # fmt: skip
    share = expected.speed / case.speed
    return max((end * share for end, _ in ends), default=None)


def missing_body(case: Case) -> str:
    """Keys to specify for levels at handles: those of a body that is missing, of handles, or measured inertias."""
    if not case.body.is_rigid:
        return body_advice(case)
    if not case.handles:
        return "Add a [[machine.handle]] for each handle."
    return "Measure the inertia by a pendulum: specify machine.inertia_kg_m2 and machine.center_of_mass_from_wheel_mm."


def body_advice(case: Case) -> str:
    """How a point mass becomes a rigid body: usual lengths of such a machine, tried, and what they change."""
    top, keys = case.table.machine, estimate_keys(case)
    entries: dict[str, object] = dict(usual_lengths(top.layout, top.mass_kg))
    unknown = f"Specify {keys} for an estimate of the inertia, or the inertia itself."
    if not entries:
        return unknown
    try:
        other = read_case(with_entries(case.table, entries))
        imbalances = find_imbalance(case).value, find_imbalance(other).value
    except (AbuError, ValueError):
        return unknown
    masses = case.body.effective_mass(), other.body.effective_mass()
    moved = [Moved("the effective mass without an autobalancer", masses[0], masses[1], "kg").text]
    if abs(imbalances[1] - imbalances[0]) > SAME * imbalances[0]:
        moved.append(_moved_imbalance(*imbalances))
    else:
        louder = 20 * math.log10(masses[0] / masses[1])
        moved.append(f"the level without one {'rises' if louder > 0 else 'falls'} by {abs(louder):.1f} dB")
    given = words(entries)
    return (
        f"Measure {keys}. With {given}, usual for this mass, {' and '.join(moved)} (calculated): {set_options(entries)}"
    )


def _moved_imbalance(before: float, after: float) -> str:
    return Moved("the imbalance", from_si(before, "g_mm"), from_si(after, "g_mm"), "g·mm").text


def estimate_keys(case: Case) -> str:
    """Keys from which the inertia of this layout is estimated, in words."""
    keys = {"straight": ("length_mm",), "face": ("height_mm",)}.get(
        case.table.machine.layout, ("length_mm", "height_mm")
    )
    return " and ".join(f"machine.{key}" for key in keys)


def _place(total: HighestTotal) -> str:
    place = "Wheel plane" if total.name == WHEEL_PLANE else f'Handle "{total.name}"'
    return f"{place}, {shown(total.speed, 'rpm', '.6g')}"


def _said(total: float) -> str:
    return f"a_hv = {total:.3g} m/s²"
