"""What may be chosen: keys of a file with their values, as asked or by default; keys that parts of a family share.

Cost of a candidate in relative units: 1 is about the housing of a hand grinder with its race.

The default costs are assumptions, each with its reason; [costs] of a file replaces them key by key. The cost of
accuracy rises with the reciprocal of the tolerance (Chase & Greenwood 1988, Manuf. Rev. 1(1), 49).
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Annotated, Any, Final, NamedTuple, get_args

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.autobalancer import Grade
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.text import shown_short
from abu_calc.inputs.reading.values_with_units import plain_number
from abu_calc.inputs.variation import NOT_OF_THE_MACHINE, Variation, path_of, ways_of
from abu_calc.sizing.balls import Candidate, candidates, sound
from abu_calc.sizing.case import read_case
from abu_calc.sizing.imbalance import find_imbalance
from abu_calc.standards.tables import millimetres

ABU: Final = "autobalancer."
COUNT, DIAMETER, RADIUS = f"{ABU}ball_count", f"{ABU}ball_diameter_mm", f"{ABU}race_radius_mm"
ECCENTRICITY, FRICTION, DRAG = f"{ABU}race_eccentricity_mm", f"{ABU}rolling_friction_mm", f"{ABU}rolling_drag_per_s"
DESIGN, HARDNESS, RUN_UP = f"{ABU}design", f"{ABU}race_hardness_HRC", "run_up.time_s"
GRADE = "oil.grade"

Values = Mapping[str, Any]


class DefaultCost(NamedTuple):
    """Default cost of one key: its formula in words and as a function of all values, and where it comes from."""

    formula: str
    cost: Callable[[Values], float]
    source: str


def _reciprocal(key: str, reference: float, cost: float) -> Callable[[Values], float]:
    """Cost that doubles when the permitted value is halved."""
    return lambda values: cost * reference / max(float(values[key]), 1e-6)


DEFAULTS: Final[dict[str, DefaultCost]] = {
    COUNT: DefaultCost(
        "0.01·N·(d/16 mm)³", lambda v: 0.01 * v[COUNT] * (v[DIAMETER] / 16.0) ** 3,
        "assumed: balls of grade 20 are sold by weight",
    ),
    RADIUS: DefaultCost(
        "0.5·(R/31 mm)²", lambda v: 0.5 * (v[RADIUS] / 31.0) ** 2, "assumed: steel and turning go with the disc's area",
    ),
    ECCENTRICITY: DefaultCost(
        "0.25·(0.010 mm/ε)", _reciprocal(ECCENTRICITY, 0.010, 0.25),
        "form: Chase and Greenwood 1988; factor assumed",
    ),
    FRICTION: DefaultCost(
        "0.15·(0.002 mm/k)", _reciprocal(FRICTION, 0.002, 0.15),
        "form: Chase and Greenwood 1988; factor assumed",
    ),
    DRAG: DefaultCost("0", lambda _: 0.0, "assumed: oils of all grades cost the same"),
    GRADE: DefaultCost("0", lambda _: 0.0, "assumed: oils of all grades cost the same"),
    DESIGN: DefaultCost(
        "one-piece 0, bearing-ring −0.1, light +0.2",
        lambda v: {"one-piece": 0.0, "bearing-ring": -0.1, "light": 0.2}.get(str(v[DESIGN]), 0.0),
        "assumed: a bearing's race is bought; two parts are pressed together",
    ),
    HARDNESS: DefaultCost(
        "0.02·(H − 58 HRC), at least 0", lambda v: 0.02 * max(v[HARDNESS] - 58.0, 0.0), "assumed: longer hardening",
    ),
    RUN_UP: DefaultCost("0", lambda _: 0.0, "assumed: set in the drive"),
}  # fmt: skip
"""Default costs by key; the diameter of the balls has its cost with their number."""


@record
class CostEntry(Record):
    """Cost of one key."""

    key: Annotated[str, Quantity("value")]
    formula: Annotated[str, Quantity("cost")]
    source: Annotated[str, Quantity("source")]


def cost_entries(keys: Sequence[str], given: Mapping[str, object]) -> tuple[CostEntry, ...]:
    """The costs in force for values that differ among candidates; a key without any costs nothing."""
    entries = []
    for key in keys:
        if key in given:
            entries.append(CostEntry(key=key, formula=_formula(given[key]), source="[costs] of the file"))
        elif key in DEFAULTS:
            entries.append(CostEntry(key=key, formula=DEFAULTS[key].formula, source=DEFAULTS[key].source))
        elif key != DIAMETER:
            entries.append(CostEntry(key=key, formula="0", source="no cost known: specify it in [costs]"))
    return tuple(entries)


def cost_of(keys: Sequence[str], values: Values, given: Mapping[str, object], place: Place) -> float:
    """Cost of a candidate with these values of all keys. Raises InputError for a value that [costs] does not list."""
    total = 0.0
    for key in keys:
        if key in given:
            total += _given(key, values[key], given[key], place)
        elif key in DEFAULTS:
            total += DEFAULTS[key].cost(values)
    return round(total, 9)


def _formula(cost: object) -> str:
    if isinstance(cost, list):
        return ", ".join(f"{shown_short(value)}: {each:g}" for value, each in cost)
    return f"{cost:g} for each unit"


def _given(key: str, value: object, cost: object, place: Place) -> float:
    number = plain_number(value)
    if not isinstance(cost, list):
        if number is None:
            raise _refused(key, value, "a list of [value, cost], since its values are no numbers", place)
        return float(cost) * number  # type: ignore[arg-type]
    for listed, each in cost:
        other = plain_number(listed)
        if listed == value if other is None or number is None else other == number:
            return float(each)
    points = sorted((float(n), float(c)) for v, c in cost if (n := plain_number(v)) is not None)
    for (left, cost_left), (right, cost_right) in pairwise(points):
        if number is not None and left <= number <= right:
            return cost_left + (cost_right - cost_left) * (number - left) / (right - left)
    raise _refused(key, value, ", ".join(shown_short(v) for v, _ in cost), place)


def _refused(key: str, value: object, allowed: str, place: Place) -> InputError:
    return InputError(
        f"[costs] gives no cost of {key} = {shown_short(value)}",
        place=place,
        found=shown_short(value),
        allowed=allowed,
        remedy=f'Add [{shown_short(value)}, COST] to "{key}" in [costs].',
    )


MOST_ASSIGNMENTS: Final = 5000
"""Combinations of values of one machine."""
PAIRS: Final = 4
"""Pairs of diameter and number of balls in the default list."""
SHARED: Final = {
    "balls": (DIAMETER,),
    "race": (RADIUS, ECCENTRICITY, FRICTION, HARDNESS),
    "housing": (DESIGN, RADIUS, DIAMETER),
    "oil": (DRAG, GRADE),
}
"""Keys that are equal in machines which share a part."""
SIZED: Final = (COUNT, DIAMETER, RADIUS)
"""Keys that `abu size` fills in where nobody chooses them."""

VISCOSITY_GRADES: Final[tuple[str, ...]] = get_args(Grade)

Assignment = Mapping[str, Any]


class Choice(NamedTuple):
    """One thing to choose: its name, and the values of its keys, of which one is taken."""

    name: str
    values: tuple[Assignment, ...]


def options_of(machine: Machine, choose: object, place: Place) -> tuple[Choice, ...]:
    """Options as asked (`KEY=choice(A, B)` each, or a table by key), or the default list."""
    if choose is None:
        return tuple(_usual(machine))
    listed = choose if isinstance(choose, (list, tuple, Mapping)) else [choose]
    options = tuple(_option(*each, place) for each in ways_of(listed, MachineFile, place, GRAMMAR).items())
    if not options:
        raise InputError("nothing to choose from", place=place, allowed=GRAMMAR)
    _refuse_many(options, place)
    for option in options:
        for assignment in option.values:
            _tried(machine, assignment, place)
    return options


GRAMMAR: Final = '"KEY=choice(A, B, …)"'


def _option(key: str, way: Variation, place: Place) -> Choice:
    here = Place(place.file, place.line, f"{place.key} {key}")
    if path_of(key)[0] in (*NOT_OF_THE_MACHINE, "start", "measured", "measured_after", "limits"):
        raise InputError("no value that a design can choose", place=here, allowed="a key of machine or autobalancer")
    if not way.values:
        raise InputError("a distribution is no list of values", place=here, found=way.text, allowed=GRAMMAR)
    if len(set(way.values)) < len(way.values):
        raise InputError("a value is listed twice", place=here, found=way.text)
    return Choice(key, tuple({key: value} for value in way.values))


def _tried(machine: Machine, assignment: Assignment, place: Place) -> None:
    """Raise InputError that names the option if the file does not bear a value."""
    try:
        machine.changed(assignment).whole("optimise")
    except InputError as error:
        key = next(iter(assignment))
        raise error.at(Place(place.file, place.line, f"{place.key} {key}")) from None


def _refuse_many(options: Sequence[Choice], place: Place) -> None:
    count = math.prod(len(option.values) for option in options)
    if count > MOST_ASSIGNMENTS:
        raise InputError(
            "too many combinations", place=place, found=f"{count}", allowed=f"at most {MOST_ASSIGNMENTS}",
            remedy="List fewer values.",
        )  # fmt: skip


def _usual(machine: Machine) -> Iterator[Choice]:
    """Balls that fit, and for the values of the file also finer and coarser ones."""
    there = _sound(machine)
    ranked = sorted(there, key=_cost)
    strongest = max(there, key=lambda each: each.capacity_ratio)
    picked = [*ranked[: PAIRS - 1], strongest] if strongest not in ranked[: PAIRS - 1] else ranked[:PAIRS]
    yield Choice("balls", tuple(map(_pair_of, picked)))
    yield from _usual_scatter(machine, GRADES)


def usual_of_family(machines: Sequence[Machine]) -> list[tuple[Choice, ...]]:
    """Default list of several machines with the same balls: diameters that fit all of them."""
    all_sound = [_sound(machine) for machine in machines]
    cheapest = [{d: min(_cost(each) for each in its if _diameter(each) == d) for d in map(_diameter, its)}
                for its in all_sound]  # fmt: skip
    common = set.intersection(*(set(its) for its in cheapest))
    chosen = sorted(common, key=lambda d: (sum(its[d] for its in cheapest), d))[: PAIRS - 1]
    return [
        (Choice("balls", tuple(_pair_of(each) for d in chosen for each in _of_diameter(its, d))),
         *_usual_scatter(machine, GRADES[1:]))
        for machine, its in zip(machines, all_sound, strict=True)
    ] if chosen else [tuple(_usual(machine)) for machine in machines]  # fmt: skip


GRADES: Final = (32 / 46, 1.0, 68 / 46, 100 / 46)
"""Viscosity grades of ISO 3448 beside VG 46: the drag rate is proportional to the viscosity."""


def _of_diameter(there: Sequence[Candidate], diameter: float) -> list[Candidate]:
    return sorted((each for each in there if _diameter(each) == diameter), key=_cost)[:2]


def _usual_scatter(machine: Machine, grades: Sequence[float]) -> Iterator[Choice]:
    own = machine.whole("optimise").autobalancer
    if own is None:
        return
    if (eccentricity := own.race_eccentricity_mm) > 0:
        yield _scaled(ECCENTRICITY, eccentricity, (0.5, 1.0, 2.0, 3.0), 10.0)
    if (friction := own.rolling_friction_mm) > 0:
        yield _scaled(FRICTION, friction, (0.5, 1.0, 2.0), 1.0)
    oil = machine.whole("optimise").oil
    if oil is not None:
        if oil.grade is not None and "rolling_drag_per_s" not in own.model_fields_set:
            place = VISCOSITY_GRADES.index(oil.grade)
            yield Choice(GRADE, tuple({GRADE: grade} for grade in VISCOSITY_GRADES[max(place - 1, 0) : place + 3]))
    elif (drag := own.rolling_drag_per_s) > 0:
        yield _scaled(DRAG, drag, grades, 1e5)


def _sound(machine: Machine) -> list[Candidate]:
    """Autobalancers that fall short of nothing; all that fit if there is none."""
    with machine.located():
        case = read_case(machine.whole("optimise"))
        there = candidates(case, find_imbalance(case).value)
    if not there:
        raise InputError("no balls fit", place=Place(machine.file, key="autobalancer"), remedy="Run `abu size FILE`.")
    return [each for each in there if sound(case, each)] or there


def _scaled(key: str, value: float, factors: Sequence[float], most: float) -> Choice:
    """The value of the file and its multiples, to three digits."""
    values = [value if factor == 1 else min(float(f"{factor * value:.3g}"), most) for factor in factors]
    return Choice(key, tuple({key: each} for each in dict.fromkeys(values)))


def _cost(chosen: Candidate) -> float:
    return cost_of(SIZED, sized_values(chosen), {}, Place())


def _diameter(chosen: Candidate) -> float:
    return float(sized_values(chosen)[DIAMETER])


def _pair_of(chosen: Candidate) -> Assignment:
    values = sized_values(chosen)
    return {key: values[key] for key in (COUNT, DIAMETER)}


def sized_values(chosen: Candidate) -> dict[str, Any]:
    """Number, diameter [mm] and race radius [mm] of a sized autobalancer, as a file holds them."""
    diameter, radius = millimetres(chosen.ball_diameter), millimetres(chosen.race_radius)
    return {COUNT: chosen.ball_count, DIAMETER: diameter, RADIUS: radius}
