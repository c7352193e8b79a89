"""Viscous drag rate by the oil in the race: cold, at work and hot, with the factor by which it is uncertain."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Final

from abu_calc.formulas.oil import (
    GRADES,
    SLIPS,
    OilDrag,
    OilRace,
    OilState,
    oil_depth,
    oil_drag_rate,
    oil_viscosity,
    viscosity_at_100,
)
from abu_calc.foundation.errors import AbuError, InputError, Place
from abu_calc.foundation.units import shown
from abu_calc.inputs.autobalancer import Oil
from abu_calc.inputs.machine import identified_note
from abu_calc.sizing.actions import with_entries
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import GROOVE_CLEARANCE, RULES, groove_radius

FACTOR: Final = 3.0
"""Factor by which the drag rate is uncertain, up and down: the shares of a partly wetted ball are reasoned, and the
coefficients for a ball on a wall differ by 1.6 between sources."""
RATE_KEY: Final = "rolling_drag_per_s"
_depth = lru_cache(maxsize=64)(oil_depth)


def oil_drag(case: Case, candidate: Candidate) -> OilDrag | None:
    """The drag in the oil of the file; None without [oil]. Raises InputError for oil that the race cannot hold."""
    oil = case.table.oil
    if oil is None:
        return None
    if case.autobalancer.corrector != "ball":
        raise InputError(
            "no drag of rollers in oil is known", place=Place(key="oil"),
            remedy="Remove [oil] and give autobalancer.rolling_drag_per_s.",
        )  # fmt: skip
    rules, radius = RULES[case.autobalancer.design], candidate.ball_diameter / 2
    race = OilRace(
        candidate.race_radius,
        groove_radius(candidate.race_radius, radius),
        candidate.ball_diameter + 2 * GROOVE_CLEARANCE,
        case.autobalancer.bore_diameter / 2 + rules.hub_wall,
        candidate.ball_count,
        radius,
    )
    fill, most = oil.fill_ml * 1e-6, race.volume(race.most)
    if fill > most:
        raise InputError(
            "more oil than the race holds",
            place=Place(key="oil.fill_ml"),
            found=f"{oil.fill_ml:g} ml",
            allowed=f"at most {most * 1e6:.3g} ml",
        )
    depth = _depth(fill, race, case.speed_range[0])
    at_40 = oil.viscosity_at_40

    def state(temperature: float) -> OilState:
        viscosity = oil_viscosity(temperature, at_40, _at_100(oil, at_40))
        return OilState(
            temperature,
            viscosity,
            _rate(oil, candidate, depth, viscosity, oil.slip_m_per_s),
            tuple(_rate(oil, candidate, depth, viscosity, slip) for slip in SLIPS),
        )

    return OilDrag(
        depth,
        min(depth / candidate.ball_diameter, 1.0),
        state(oil.temperature_C),
        state(oil.cold_temperature_C),
        state(oil.hot_temperature_C),
        tuple(_by_fill(oil, case, candidate, race)),
        RATE_KEY in case.autobalancer.model_fields_set,
    )


def _at_100(oil: Oil, at_40: float) -> float:
    """Viscosity at 100 °C [mm²/s], of the data sheet or by the index."""
    return oil.viscosity_100C_mm2_per_s or viscosity_at_100(at_40, oil.viscosity_index)


def _rate(oil: Oil, candidate: Candidate, depth: float, viscosity: float, slip: float) -> float:
    density = 1e3 * oil.density_g_per_cm3
    return oil_drag_rate(slip, viscosity, density, depth, candidate.ball_diameter / 2, candidate.ball_mass)


FILLS: Final = (0.5, 1.0, 2.0, 4.0)
"""Fills that are listed, over that of the file."""


def _by_fill(oil: Oil, case: Case, candidate: Candidate, race: OilRace) -> Iterator[tuple[float, tuple[float, ...]]]:
    """Fills [m³] that the race holds, and the drag rates at work of oils with the index of the file."""
    viscosities = [
        oil_viscosity(oil.temperature_C, grade, viscosity_at_100(grade, oil.viscosity_index)) for grade in GRADES
    ]
    for fill in (share * oil.fill_ml * 1e-6 for share in FILLS):
        if fill <= race.volume(race.most):
            depth = _depth(fill, race, case.speed_range[0])
            yield fill, tuple(_rate(oil, candidate, depth, viscosity, oil.slip_m_per_s) for viscosity in viscosities)


def with_oil(case: Case, candidate: Candidate) -> Case:
    """The case with the drag rate of the oil in the race of this candidate, unless the file gives the rate."""
    oil = oil_drag(case, candidate)
    if oil is None:
        return case
    return replace(case, oil=oil, drag=case.drag if oil.overridden else oil.working.drag)


USUAL_GRADES: Final = ("VG 22", "VG 32", "VG 46", "VG 68", "VG 100", "VG 150", "VG 220", "VG 320", "VG 460")
FLAT: Final = (120.0, 160.0)
"""Grades that are sold everywhere, and viscosity indices of oils whose viscosity depends less on the temperature."""
LEAST_DRAG: Final = 0.1
"""Drag rate [1/s] that stands for none where oils are ordered."""
FILL: Final = 1.0
"""Fill [ml] of a race whose file names no oil; half as much or twice moves the drag rate by some 10 %."""


def usual_oils(case: Case, candidate: Candidate) -> list[tuple[dict[str, object], float]]:
    """Entries of oils in the race, each with its drag rate at work [1/s]; none for rollers.

    Those with the lower viscosity index come first, then those whose rate is nearest to that of the case.
    """
    if case.autobalancer.corrector != "ball":
        return []
    fill: dict[str, object] = {} if case.table.oil else {"oil.fill_ml": FILL}
    found = list[tuple[dict[str, object], float]]()
    for index in FLAT:
        own = list[tuple[dict[str, object], float]]()
        for grade in USUAL_GRADES:
            entries = {"oil.grade": grade, "oil.viscosity_index": index, **fill}
            try:
                oil = oil_drag(replace(case, table=with_entries(case.table, entries)), candidate)
            except (AbuError, ValueError):  # the file refuses it, or the race cannot hold it
                continue
            if oil is not None:
                own.append((entries, oil.working.drag))
        found += sorted(own, key=lambda each: abs(math.log(each[1] / max(case.drag, LEAST_DRAG))))
    return found


def drag_share(case: Case, candidate: Candidate, temperature: float) -> float:
    """Drag rate in the oil of the file at a temperature [°C], over that at work."""
    oil, drag = case.table.oil, case.oil
    if oil is None or drag is None:
        raise ValueError("the file has no [oil]")
    viscosity = oil_viscosity(temperature, oil.viscosity_at_40, _at_100(oil, oil.viscosity_at_40))
    return _rate(oil, candidate, drag.depth, viscosity, oil.slip_m_per_s) / drag.working.drag


def value_sources(case: Case) -> Iterator[str]:
    """Where drag, friction and eccentricity come from, if they are identified or follow from an oil."""
    yield from identified_note(case.table.identified, case.autobalancer)
    if case.oil is not None:
        yield drag_source(case)


def drag_source(case: Case) -> str:
    """Where the drag rate of a case with oil comes from, in sentences."""
    oil = case.oil
    if oil is None:
        raise ValueError("the file has no [oil]")
    rate = oil.working.drag
    by_oil = (
        f"a viscous drag rate of {rate:.3g} 1/s at {oil.working.temperature:g} °C, uncertain by a factor of "
        f"{FACTOR:g} ({float(f'{rate / FACTOR:.2g}'):g} … {float(f'{rate * FACTOR:.2g}'):g} 1/s)"
    )
    if oil.overridden:
        return f"rolling_drag_per_s = {case.drag:.3g} overrides the oil. The oil gives {by_oil}."
    return f"The oil gives {by_oil}. The ring of oil is {shown(oil.depth, 'mm', '.2g')} deep."
