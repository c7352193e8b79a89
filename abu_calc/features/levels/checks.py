"""Checks of levels against limits, and loads on each hand of a machine that is held still in the air.

Limits: octaves, the weighted overall level (GOST 17770-86) and the daily exposure (Directive 2002/44/EC).
"""

import math
from collections.abc import Sequence
from typing import Final

from abu_calc.features.levels.levels import Band, PlaceLevels, largest, level
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.units import GRAVITY
from abu_calc.sizing.design import Design
from abu_calc.standards.vibration import (
    Octave,
    corrected_limit,
    daily_exposure,
    exposure_action_value,
    exposure_limit_value,
    largest_total_of_one_axis,
)

SAY_UNIT: Final = "Say the unit: --scale 9.80665 for numbers in g, --scale 1 for SI."
LONGER: Final = "Record for longer, or sample faster."


def level_checks(places: Sequence[PlaceLevels], minutes: float | None, assumed: str = "") -> tuple[Check, ...]:
    """Checks of the loudest place: each octave, the weighted overall level, and the daily exposure.

    The daily exposure is checked if its minutes are given; `assumed`: a unit that nothing in the file tells.
    """
    octaves = (_octave(places, index) for index in range(len(places[0].loudest)))
    exposure = [] if minutes is None else [_exposure(places, minutes)]
    unit = [coded("ABU414", "warn", assumed.partition(";")[0], remedy=SAY_UNIT)] if assumed else []
    return (*octaves, _corrected(places), *exposure, *unit)


def _octave(places: Sequence[PlaceLevels], index: int) -> Check:
    place, band = max(((point, point.loudest[index]) for point in places), key=lambda pair: pair[1].velocity or -1.0)
    name, limit = f"{band.octave.nominal:g} Hz", band.octave.limit.level
    if band.velocity is None:
        return coded("ABU411", "not-done", band.reason or "not known", None, limit, LONGER, of=name)
    actual = level(band.velocity)
    kept = actual is None or actual <= limit
    return coded("ABU411", verdict(kept), f"rms velocity, {_axis_of(place, band, index)}", actual, limit, of=name)


def _axis_of(place: PlaceLevels, band: Band[Octave], index: int) -> str:
    axis = next(candidate for candidate in place.axes if candidate.bands[index] is band)
    return axis.name if place.name == axis.name or len(place.axes) == 1 else f"{place.name}, {axis.name}"


def _corrected(places: Sequence[PlaceLevels]) -> Check:
    """A total that lacks octaves is at least so high: it can fail, not pass."""
    limit, total_level = corrected_limit().level, level(largest(place.corrected for place in places))
    if total_level is not None and total_level > limit:
        return coded("ABU412", "fail", "all octaves together, 8 Hz at half its velocity", total_level, limit)
    if not all(place.complete for place in places):
        return coded("ABU412", "not-done", "octaves are missing", total_level, limit, LONGER)
    return coded("ABU412", "pass", "all octaves together, 8 Hz at half its velocity", total_level, limit)


def _exposure(places: Sequence[PlaceLevels], minutes: float) -> Check:
    """Against the limit; a warning above the action value, or where axes that were not measured leave it open."""
    limit, action = exposure_limit_value(), exposure_action_value()
    totals = [place.total for place in places]
    largest_total = largest(totals)
    if largest_total is None or None in totals:
        reason = next(axis.reason for place in places for axis in place.axes if axis.weighted_acceleration is None)
        return coded("ABU413", "not-done", reason or "not known", None, limit, LONGER)
    exposure = daily_exposure(largest_total, 60 * minutes)
    highest = daily_exposure(max(map(_highest_total, places)), 60 * minutes)
    message = f"A(8) of {minutes:g} minutes a day; the action value is {action:g} m/s²"
    if highest > exposure * (1 + 1e-9):
        message += f"; axes that were not measured may raise it to {highest:.3g} m/s²"
    passed, safe = exposure <= limit, highest <= action
    reach = min(minutes * (action / exposure) ** 2, 1440.0) if exposure > 0 else 1440.0
    remedy = None
    if exposure > action:
        remedy = f"Limit the use to {reach:.3g} minutes a day: A(8) falls from {exposure:.3g} to {action:g} m/s² "
        remedy += "(calculated)."
    return coded("ABU413", verdict(passed, safe), message, exposure, limit, remedy)


def _highest_total(place: PlaceLevels) -> float:
    """The most that three axes can come to where fewer were measured, none of the others above these."""
    parts = [axis.weighted_acceleration or 0.0 for axis in place.axes]
    if len(parts) == 1:
        return largest_total_of_one_axis() * parts[0]
    return math.hypot(*parts, max(parts)) if len(parts) == 2 else math.hypot(*parts)


def held_loads(design: Design) -> dict[str, tuple[float, float]]:
    """Static load [N] of the hand at each handle, without and with the autobalancer, upward; negative: it must press
    down. Empty if the lever of two handles does not give it.

    The machine's centre of mass may lie between or outside the handles. Equilibrium of a horizontal
    spindle: F₁ + F₂ = (M + m)g, F₁p₁ + F₂p₂ = m·g·a_r, places from the centre of mass of machine and wheel,
    the autobalancer in the plane of its race. One handle carries all; three are statically indeterminate.
    """
    case, added = design.case, design.autobalancer.mass
    handles = case.handles
    if len(handles) == 1:
        return {handles[0].name: (case.body.mass * GRAVITY, (case.body.mass + added) * GRAVITY)}
    known = case.table.machine.spindle_axis == "horizontal" and case.body.is_rigid and not case.body.in_space
    if len(handles) != 2 or not known or handles[0].place[2] == handles[1].place[2]:
        return {}
    first, second = handles
    at, other = first.place[2], second.place[2]
    span = at - other

    def share(mass: float) -> tuple[float, float]:
        weight, moment = (case.body.mass + mass) * GRAVITY, mass * GRAVITY * case.race_place[2]
        at_first = (moment - weight * other) / span
        return at_first, weight - at_first

    loads = zip(share(0.0), share(added), strict=True)
    return {handle.name: load for handle, load in zip(handles, loads, strict=True)}
