"""Every quantity of every result says what it is."""

import importlib
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import pytest

import abu_calc
from abu_calc.foundation.quantity import Record, hints, quantities
from abu_calc.simulation.result import Result

PACKAGE = Path(abu_calc.__file__).parent
for file in PACKAGE.rglob("*.py"):
    if "(Record)" in file.read_text(encoding="utf-8") or "(Result)" in file.read_text(encoding="utf-8"):
        importlib.import_module(".".join(file.relative_to(PACKAGE.parent).with_suffix("").parts))


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
