"""Every quantity of every result says what it is."""

import importlib
import pkgutil
from collections.abc import Iterator
from typing import get_args

import abu_calc.studies
import pytest

from abu_calc.foundation.quantity import Record, hints, quantities
from abu_calc.simulation.result import Result

for found in pkgutil.iter_modules(abu_calc.studies.__path__, "abu_calc.studies."):
    importlib.import_module(found.name)


def kinds(parent: type[Record]) -> Iterator[type[Record]]:
    for kind in parent.__subclasses__():
        yield from (kind, *kinds(kind))


def held(hint: object) -> Iterator[object]:
    """All that a type is made of."""
    yield hint
    for inner in get_args(hint):
        yield from held(inner)


# What stands behind a result for those who check by hand is named by symbol and unit alone.
SHOWN = sorted({kind for kind in kinds(Record) if not kind.__name__.endswith("Model")} - {Result}, key=str)


@pytest.mark.parametrize("kind", SHOWN, ids=lambda kind: kind.__name__)
def test_every_quantity_has_a_label(kind):
    silent = [
        name
        for name in kind.entries()
        if name not in quantities(kind)
        and not any(isinstance(part, type) and issubclass(part, Record) for part in held(hints(kind)[name]))
    ]
    assert silent == []
    assert all(quantity.label for quantity in quantities(kind).values())


def test_the_seats_are_among_them():
    assert {"SeatResult", "Creep", "Clearance", "Requirements"} <= {kind.__name__ for kind in SHOWN}
