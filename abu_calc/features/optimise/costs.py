"""Cost of a candidate in relative units: 1 is about the housing of a hand grinder with its race.

The default costs are assumptions, each with its reason; [costs] of a file replaces them key by key. The cost of
accuracy rises with the reciprocal of the tolerance (Chase & Greenwood 1988, Manuf. Rev. 1(1), 49).
"""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import Annotated, Any, Final, NamedTuple

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.reading.plain import plain_number
from abu_calc.inputs.reading.text import shown_short

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
