"""The tables [optimise] and [costs] of a file: what `abu optimise` may choose, and what each choice costs."""

from collections.abc import Iterator
from typing import Annotated, Final, Literal

from pydantic import AfterValidator, BeforeValidator, WithJsonSchema

from abu_calc.foundation.errors import InputError, Place
from abu_calc.inputs.reading.plain import found_as, plain_number
from abu_calc.inputs.reading.suggestions import nearest
from abu_calc.inputs.reading.table import Many, Table, all_tables, entry, problem
from abu_calc.inputs.reading.text import key_path
from abu_calc.inputs.reading.values_with_units import canonical_path, convert_entry
from abu_calc.inputs.variation import Vary, path_of

PARTS: Final = ("balls", "race", "housing", "oil")
"""Parts that machines of a family can share."""
Part = Literal["balls", "race", "housing", "oil"]
COST: Final = "a cost is a number of at least 0 for each unit of the value, or a list of [value, cost]"
MOST_COST: Final = 1e9


class Optimise(Table):
    """The cheapest design of a series, for `abu optimise`: values to choose from, and the wanted share."""

    choose: Vary | None = entry(None, example=["autobalancer.race_eccentricity_mm=choice(0.005, 0.010, 0.020)"]).means(
        "Values to choose from. Each is KEY=choice(A, B, …); KEY is one of this file. Or a table by key. Without it "
        "`abu optimise` takes balls, race, eccentricity, friction and viscous drag rate."
    )
    share: float = entry(0.95, ge=0.5, le=0.9999).means(
        "Share of machines built that must meet the limits; {range}. Default: {default}."
    )
    share_parts: Many[Part] | None = entry(None, example=["balls", "race"]).means(
        "Parts that several machines share: balls, race, housing, oil. Default: balls and race."
    )
    seed: int = entry(0, ge=0, le=2**31 - 2).means("Seed of the random numbers; {range}. Default: {default}.")


def _flat(costs: object) -> object:
    """Costs by key path; [costs.autobalancer] with ball_count in it says the same as "autobalancer.ball_count"."""
    if not isinstance(costs, dict):
        return costs
    return dict(_entries(costs))


def _entries(costs: dict[str, object], above: str = "") -> Iterator[tuple[str, object]]:
    for key, cost in costs.items():
        path = f"{above}.{key}" if above else str(key)
        if isinstance(cost, dict):
            yield from _entries(cost, path)
        else:
            yield path, cost


def _checked(costs: dict[str, object]) -> dict[str, object]:
    for key, cost in costs.items():
        pairs = cost if isinstance(cost, list) else [[None, cost]]
        if not pairs:
            raise problem(COST, key, found="an empty list")
        for pair in pairs:
            number = plain_number(pair[1]) if isinstance(pair, list) and len(pair) == 2 else None
            if number is None or not 0 <= number <= MOST_COST:
                raise problem(COST, key, found=found_as(pair if isinstance(cost, list) else cost))
        values = [pair[0] for pair in pairs if isinstance(pair, list)]
        if len({repr(value) for value in values}) < len(values):
            raise problem("a value has two costs", key, found=found_as(cost))
    return costs


def own_cost(written: str, cost: object, model: type[Table]) -> tuple[str, object]:
    """A key of [costs] and its cost, with the file's own key and values in its unit."""
    listed = cost if isinstance(cost, list) else []
    try:
        path = path_of(written)
        own = canonical_path(path, model)
        pairs = [[convert_entry(path, value, model, lambda _: Place())[1], each] for value, each in listed]
    except InputError as error:
        raise problem(error.message, "costs", written, found=error.found, allowed=error.allowed) from None
    if own is None:
        near = nearest(
            written, [key_path((*above, key)) for above, table in all_tables(model) for key in table.model_fields]
        )
        raise problem("no key of a machine", "costs", written, remedy=f'the nearest is "{near}"' if near else None)
    if own != path and not listed:
        remedy = f'write "{key_path(own)}", or a list of [value with unit, cost]'
        raise problem("a cost for each unit, and the key names no unit", "costs", written, remedy=remedy)
    return (written if own == path else key_path(own)), pairs or cost


COSTS: Final = (
    "Cost of each choice of `abu optimise`, in units of your own, by key path: a number for each unit of the value, or "
    "a list of [value, cost]; between listed numbers the cost is interpolated. Keys without an entry keep the default."
)
Costs = Annotated[
    dict[str, object],
    AfterValidator(_checked),
    BeforeValidator(_flat),
    WithJsonSchema({"type": "object"}),
]
