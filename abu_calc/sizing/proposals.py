"""Changes of the file that are worth a trial for a check of sizing, and those with which sizing finds checks better.

A change of a file in words: what changes, from what to what, without what stays.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, Final, NamedTuple

from abu_calc.foundation.checks import RANK, Check
from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.units import SYMBOLS, from_si, quantity_and_unit
from abu_calc.inputs.autobalancer import Autobalancer, oil_name
from abu_calc.inputs.reading.overrides import parse_override, value_at
from abu_calc.sizing import size
from abu_calc.sizing.actions import PINS, followed, overrides, pins, plain, speeds_from, two_digits, with_entries
from abu_calc.sizing.advice import most_force
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.manufacture.fastening import slip_torque
from abu_calc.sizing.track import GROUND_HARDNESS_HRC
from abu_calc.sizing.type_test import chosen_wheel, declared_estimate, more_easily
from abu_calc.sizing.vibration import feasible_mm, truer_races

Entries = dict[str, object]
"""Values by key path."""

ROOM: Final = (1.1, 1.25, 1.5)
"""Factors on the envelope."""
MARGINS: Final = (1.25, 1.6)
"""Factors on the capacity margin."""
WALLS: Final = (1.5, 2.0, 3.0)
"""Factors on the least wall."""
HARDEST: Final = 63.0
"""Hardness of a ground race, at most [HRC]."""
NEARER: Final = (0.75, 0.5, 0.25, 0.0)
"""Shares of the race's distance from the wheel's plane."""
FASTER: Final = (1.05, 1.2, 1.5, 2.0, 3.0)
"""Factors over the natural frequency for the lowest speed."""
OVER: Final = 1.05
"""Factor over the speed that carries balls over."""
WIDER: Final = 4
"""Race eccentricities of two digits above the least that standard fits hold."""
ARM: Final = "swing_arm."
"""Start of the keys of the swing arm, on which the choice of balls and race does not rest."""


def more_room(design: Design) -> Iterator[Entries]:
    """The search free of what is pinned, then less margin, then a larger envelope with it free."""
    own = design.case.autobalancer
    yield from free(design.case)
    yield from _less_margin(design.case)
    for more in ROOM:
        yield from free(design.case, _envelope(own, more))


def _envelope(own: Autobalancer, factor: float) -> Entries:
    keys = ("max_outer_diameter_mm", "max_width_mm")
    return {f"autobalancer.{key}": round(factor * getattr(own, key), 1) for key in keys}


def carrying_more(design: Design) -> Iterator[Entries]:
    """Balls and races that carry more than required, in the envelope and in larger ones."""
    own, known = design.case.autobalancer, {overrides(pins(design.autobalancer))}
    for room in (1.0, *ROOM):
        entries = {} if room == 1 else _envelope(own, room)
        for margin in MARGINS:
            larger = followed(
                _unpinned(design.case), {**entries, "autobalancer.capacity_margin": margin * own.capacity_margin}
            )
            if larger and (chosen := overrides(pins(larger.candidate))) not in known:
                known.add(chosen)
                yield {**entries, **pins(larger.candidate)}


def lighter(design: Design) -> Iterator[Entries]:
    """The search free of what is pinned, the light design, less margin."""
    yield from free(design.case)
    if design.case.autobalancer.design != "light":
        yield {"autobalancer.design": "light"}
    yield from _less_margin(design.case)


def _less_margin(case: Case) -> Iterator[Entries]:
    if case.autobalancer.capacity_margin > 1:
        yield {"autobalancer.capacity_margin": 1.0}


def rounder(design: Design) -> Iterator[Entries]:
    """A thicker wall, another body, the search free of what is pinned."""
    for more in WALLS:
        yield {"autobalancer.min_wall_mm": round(more * design.case.autobalancer.min_wall_mm, 2)}
    yield from stronger(design)


def harder(design: Design) -> Iterator[Entries]:
    """A harder race, the search free of what is pinned."""
    if design.case.autobalancer.race_hardness_HRC < HARDEST:
        yield {"autobalancer.race_hardness_HRC": HARDEST}
    yield from free(design.case)


def stronger(design: Design) -> Iterator[Entries]:
    """A body of steel, the search free of what is pinned."""
    if design.case.autobalancer.design == "light":
        yield {"autobalancer.design": "one-piece"}
    yield from free(design.case)


def free(case: Case, entries: Mapping[str, object] | None = None) -> Iterator[Entries]:
    """Entries with the balls and the race that the search finds if the file's pins are removed.

    Nothing if no race fits, or if there is nothing to change.
    """
    entries = dict(entries or {})
    if all(getattr(case.autobalancer, pin) is None for pin in PINS):
        yield from [entries] if entries else []
    elif free := followed(_unpinned(case), entries):
        yield {**entries, **pins(free.candidate)}


def _unpinned(case: Case) -> Case:
    own = case.autobalancer.model_copy(update=dict.fromkeys(PINS))
    own = type(own).model_validate(own.model_dump(exclude_unset=True, exclude=set(PINS)))
    return replace(case, autobalancer=own, table=case.table.model_copy(update={"autobalancer": own}))


def truer(design: Design) -> Iterator[Entries]:
    """A truer or a cleaner race; nothing can be done about a background that is too loud alone."""
    background = design.case.background_level
    if background is None or background < design.case.level_limit:
        yield from truer_races(design.case, design.eccentricity.least)


def faster(design: Design) -> Iterator[Entries]:
    """Lowest speeds above the natural frequencies."""
    least = max(design.frequency.natural_frequencies)
    for factor in FASTER:
        yield from speeds_from(design.case, factor * least)


def carrying_over(design: Design) -> Iterator[Entries]:
    """A lowest speed that carries the balls round a horizontal spindle."""
    yield from speeds_from(design.case, OVER * design.track.carry_over)


def with_idle_speed(design: Design) -> Iterator[Entries]:
    """A range of working speeds that holds the motor's idle speed."""
    (low, high), idle = design.case.table.machine.speeds_rpm, from_si(design.case.idle_speed or 0.0, "rpm")
    yield {"machine.speed_range_rpm": [float(math.floor(min(low, idle))), float(math.ceil(max(high, idle)))]}


def nearer(design: Design) -> Iterator[Entries]:
    """Places of the race nearer to the wheel's plane."""
    for share in NEARER:
        yield {"autobalancer.plane_offset_mm": round(share * design.case.autobalancer.plane_offset_mm, 2)}


def wider(design: Design) -> Iterator[Entries]:
    """The least race eccentricities of two digits that standard fits and careful work may hold."""
    least = feasible_mm(design.eccentricity.least)
    digits = max(0, 1 - math.floor(math.log10(least)))
    for more in range(WIDER):
        permitted = round((math.ceil(least * 10**digits) + more) / 10**digits, digits)
        yield {"autobalancer.race_eccentricity_mm": permitted}


def hard(_: Design) -> Iterator[Entries]:
    """The usual hardness of a ground race."""
    yield {"autobalancer.race_hardness_HRC": GROUND_HARDNESS_HRC}


def other_closure(design: Design) -> Iterator[Entries]:
    """A cover of the other kind."""
    screwed = design.case.autobalancer.closure == "screwed"
    yield {"autobalancer.closure": "pressed" if screwed else "screwed"}


def more_clamping(design: Design) -> Iterator[Entries]:
    """The clamp force of two digits that carries the slip torque."""
    force = design.case.autobalancer.clamp_force_N
    torque = slip_torque(design.case, design.construction.parts, design.eccentricity.fit)
    if force is not None and torque is not None and design.case.autobalancer.fastening != "shrunk":
        yield {"autobalancer.clamp_force_N": two_digits(force * torque.needed / torque.held, math.ceil)}


def less_force(design: Design) -> Iterator[Entries]:
    """The normal force for which the motor has the power."""
    yield {"grinding.press_force_N": most_force(design.case)}


def easier(design: Design) -> Iterator[Entries]:
    """A race that runs truer or rolls more easily with the test wheel."""
    wheel = chosen_wheel(design.case.table)
    if wheel is not None:
        estimate = declared_estimate(design.case, design.autobalancer, wheel.imbalance)
        yield from more_easily(design.case, estimate, design.eccentricity.least)


def on_arm(key: str, design: Design) -> Iterator[Entries]:
    """Entries of the swing arm that meet the bound of a check."""
    if design.swing_arm is not None:
        from abu_calc.sizing.swing_arm import changes  # its formulas are for machines on an arm alone

        for values in changes(design.swing_arm, design.case, key):
            yield {f"{ARM}{name}": value for name, value in values.items()}


class Proposed(NamedTuple):
    """Changes that are worth a trial; `same`: with the balls and the race as they are."""

    changes: Callable[[Design], Iterator[Entries]]
    same: bool = False


ON_ARM: Final = frozenset({"arm_stiffness", "arm_damping", "arm_pressed", "arm_stands"})
"""Keys of the checks of the bounds of a swing arm."""

PROPOSED: Final[Mapping[str, Proposed]] = {
    "frequency_region": Proposed(faster, same=True), "carry_over": Proposed(carrying_over, same=True),
    "motor_idle_speed": Proposed(with_idle_speed, same=True),
    "capacity": Proposed(more_room), "residual_budget": Proposed(truer, same=True), "mass": Proposed(lighter),
    "race_plane": Proposed(nearer, same=True), "eccentricity_budget": Proposed(wider, same=True),
    "contact_pressure": Proposed(harder), "race_hardness": Proposed(hard, same=True),
    "hoop_stress": Proposed(stronger), "race_roundness": Proposed(rounder), "filling": Proposed(more_room),
    "overspeed_stress": Proposed(stronger), "cover": Proposed(other_closure, same=True),
    "slip_torque": Proposed(more_clamping, same=True), "burst_speed": Proposed(stronger),
    "idle_level": Proposed(truer, same=True), "level_lowered": Proposed(truer, same=True),
    "cutting_power": Proposed(less_force, same=True), "handles": Proposed(truer, same=True),
    "declared_value": Proposed(easier),
    **{key: Proposed(partial(on_arm, key)) for key in sorted(ON_ARM)},
}  # fmt: skip
"""What is proposed for checks of sizing, by their keys, in the order in which it is tried."""


def mended(design: Design) -> list[Entries]:
    """Changes by which sizing finds more and more checks better, all together first, with balls and race pinned.

    Each check in turn, the worst first, gets the first change that mends it and makes no other check worse, else the
    first that mends it: what gets worse comes next.
    """
    now, steps, seen = design, [Entries()], set[str]()
    while bad := [check for check in now.checks if check.requested and check.status != "pass"
                  and check.key in PROPOSED and check.code not in seen]:  # fmt: skip
        check = min(bad, key=_rank)
        seen.add(check.code)
        if step := _first(now, check):
            change, now = step
            pinned = {} if all(key.startswith(ARM) for key in change) else pins(now.autobalancer)
            steps.append({**steps[-1], **change, **pinned})
    return steps[:0:-1]


def _rank(check: Check) -> int:
    return RANK.index(check.status)


def _first(design: Design, check: Check) -> tuple[Entries, Design] | None:
    """The first change that mends a check of sizing, and the machine with it, as sized."""
    before, partly = {each.code: _rank(each) for each in design.checks}, None
    proposed = PROPOSED[check.key]
    for change in proposed.changes(design):
        entries = {**change, **pins(design.autobalancer)} if proposed.same else change
        try:
            after = size(with_entries(design.case.table, entries))
        except (AbuError, ValueError):  # the file refuses it, or no race fits
            continue
        ranks = {each.code: _rank(each) for each in after.checks}
        if ranks.get(check.code, 0) <= before[check.code]:
            continue
        if all(rank >= before.get(code, RANK.index("pass")) for code, rank in ranks.items()):
            return entries, after
        partly = partly or (entries, after)
    return partly


PINNED: Final = tuple(f"autobalancer.{key}" for key in PINS)
"""Keys that pin the choice of balls and race."""
PLAIN: Final = ("autobalancer", "machine", "suspension", "swing_arm")
"""Tables whose keys say by themselves what they are of."""


def in_words(entries: Sequence[str], table: Any = None, made: Sequence[str] = ()) -> str:
    """Entries as a sentence lists them, with the values of a file's `table` that they replace.

    `made`: the entries that pin the present balls and race, which are not told if they stay.

    >>> in_words(("oil.grade=VG 100", "oil.viscosity_index=120", "oil.fill_ml=1", "autobalancer.ball_count=4"))
    'oil VG 100 (viscosity index 120, 1 ml)'
    >>> in_words(("autobalancer.0.max_width_mm=40", "autobalancer.1.max_width_mm=40"))
    'max width 40 mm in both races'
    """
    values, own = (dict(entry.split("=", 1) for entry in each) for each in (entries, made))
    file = {} if table is None else table.model_dump(mode="json")
    parts = [f"{_oil(values)}{_instead_of_oil(table)}"] if "oil.grade" in values else []
    parts += [_entry(entry, file) for entry in entries if not entry.startswith(("oil.", *PINNED))]
    balls = [_balls(each) for each in (values, own)]
    if balls[0] and (not parts or (made and balls[0] != balls[1])):
        parts.append(balls[0] if balls[1] in ("", balls[0]) else f"{balls[0]} instead of {balls[1]}")
    parts = parts or [_entry(entry, file) for entry in entries]
    texts = [f"{part}{' in both races' * (parts.count(part) > 1)}" for part in dict.fromkeys(parts)]
    *first, last = texts
    return f"{', '.join(first)} and {last}" if first else last


def _oil(values: Mapping[str, str]) -> str:
    """An oil by grade, viscosity index and fill."""
    given = {"viscosity index {}": "oil.viscosity_index", "{} ml": "oil.fill_ml"}
    more = ", ".join(text.format(values[key]) for text, key in given.items() if key in values)
    return f"oil {values['oil.grade']}" + (f" ({more})" if more else "")


def _instead_of_oil(table: Any) -> str:
    """Oil or drag rate of a file that another oil takes the place of."""
    if table is None:
        return ""
    if "rolling_drag_per_s" in table.autobalancer.model_fields_set:
        source = "a" if table.identified is None else "the measured"
        return f" instead of {source} drag rate of {table.autobalancer.rolling_drag_per_s:g} 1/s"
    old = table.oil
    return f" instead of {f'{oil_name(old)} (viscosity index {old.viscosity_index:g})' if old else 'the assumed one'}"


def _balls(values: Mapping[str, str]) -> str:
    """Balls and race that entries pin, in words; nothing if they pin less than all."""
    if not all(key in values for key in PINNED):
        return ""
    count, diameter, radius = (values[key] for key in PINNED)
    return f"{count} balls Ø{float(diameter):.5g} mm in a race R {float(radius):.4g} mm"


def _entry(entry: str, file: Mapping[str, object]) -> str:
    """One entry, and the value that it replaces."""
    *parents, key = path = parse_override(entry).path
    value, before = entry.split("=", 1)[1], value_at(file, path)
    name, unit = quantity_and_unit(str(key))
    of = [] if parents[0] in PLAIN else [f"{part + 1}" if isinstance(part, int) else part for part in parents]
    instead = "" if before is None or plain(before) == value else f" instead of {plain(before)}"
    words = f"{' '.join([*of, name])} {value}{instead} {SYMBOLS.get(unit, unit)}"
    words = words.replace("run_up", "run-up").replace("_", " ").replace(",", ", ").strip()
    return f"a harder, smoother race ({words}, to be measured)" if key == "rolling_friction_mm" else words
