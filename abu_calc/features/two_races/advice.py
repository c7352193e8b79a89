"""Changes of the file that may mend a machine with two races, alike for both of them."""

from collections.abc import Iterator
from typing import Final

from abu_calc.features.design.next_step import Entries, together
from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.features.two_races.judgement import TwoRaceJudgement
from abu_calc.foundation.units import from_si
from abu_calc.sizing.actions import overrides
from abu_calc.sizing.vibration import truer_races
from abu_calc.standards.balls import stock_diameters

LARGER: Final = (1.2, 1.45, 1.75)
"""Least factors on the diameter of the balls that are tried."""
ROOM: Final = ("max_outer_diameter_mm", "max_width_mm")
ROOMIER: Final = (1.25, 1.6)
"""Factors on the room of both autobalancers that are tried."""
HEAVIER: Final = (0.08, 0.15)
"""Shares of the machine's mass that are tried for each autobalancer."""


def proposals(before: TwoRaceJudgement) -> Iterator[Entries]:
    """Changes for what does not pass: races that are made, start cases that are too loud or too slow, and pairs."""
    bad = {check.code for check in before.checks if check.requested and check.status != "pass"}
    design, of_starts = before.facts.design, list[dict[str, object]]()
    if "ABU401" in bad:
        of_starts += _truer(design)
    if bad & {"ABU701", "ABU702", "ABU704"}:
        of_starts += _quicker(design)
    made = [*_sturdier(design)] if bad - {"ABU401", "ABU402", "ABU701", "ABU702", "ABU704"} else []
    yield from together([*map(_of_both, made)], [*map(_of_both, of_starts)])


def _of_both(entries: dict[str, object]) -> Entries:
    """Entries of each [[autobalancer]]."""
    return overrides({f"autobalancer.{race}.{key}": value for race in (0, 1) for key, value in entries.items()})


def _quicker(design: TwoRaceDesign) -> Iterator[dict[str, object]]:
    """Larger balls of the stock."""
    for larger in _larger(design):
        yield {"ball_diameter_mm": larger}


def _larger(design: TwoRaceDesign) -> Iterator[float]:
    """Diameters [mm] of larger balls in stock."""
    diameter = design.races[0].design.autobalancer.ball_diameter
    stock = stock_diameters(design.case.table.autobalancer[0].ball_sizes)
    for factor in LARGER:
        if larger := next((size for size in stock if size >= factor * diameter), None):
            yield round(from_si(larger, "mm"), 6)


def _truer(design: TwoRaceDesign) -> list[dict[str, object]]:
    """Less eccentric races, races with less friction, both, as far as standard fits and careful work go."""
    least = max(race.design.eccentricity.least for race in design.races)
    changes = truer_races(design.races[0].design.case, least)
    return [{key.removeprefix("autobalancer."): value for key, value in entries.items()} for entries in changes]


def _sturdier(design: TwoRaceDesign) -> Iterator[dict[str, object]]:
    """Truer and cleaner races, the next larger ball, more room, a larger share of the mass; then all of them."""
    tables = design.bare.table.autobalancer
    larger = next(_larger(design), None)
    races = [entries for entries in _truer(design) if len(entries) > 1]
    rooms: list[dict[str, object]] = [
        {key: _rounded(max(getattr(table, key) for table in tables) * factor) for key in ROOM} for factor in ROOMIER
    ]
    heavier: list[dict[str, object]] = [{"max_mass_fraction": share} for share in HEAVIER]
    balls: list[dict[str, object]] = [] if larger is None else [{"ball_diameter_mm": larger}]
    combined = [{**room, **heavier[-1]} for room in rooms] + [{**entries, **rooms[0]} for entries in races[:1]]
    yield from (*races, *balls, *rooms, *heavier, *combined)


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")
