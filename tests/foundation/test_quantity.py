"""Every quantity of every result says what it is."""

import importlib
import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, ClassVar, NamedTuple, get_args

import pytest

import abu_calc
from abu_calc.foundation.quantity import Quantity, Record, hints, quantities, record
from abu_calc.simulation.result import Result
from tests.rows import for_each

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


@for_each(SHOWN)
def test_every_quantity_has_a_label(kind):
    silent = [
        name
        for name in kind.entries()
        if name not in quantities(kind)
        and not any(isinstance(part, type) and issubclass(part, Record) for part in held(hints(kind)[name]))
    ]
    assert silent == []
    assert all(quantity.label for quantity in quantities(kind).values())
    entries = {name: None for name in quantities(kind) if name in kind.entries()}
    assert list(entries) == [name for name in kind.entries() if name in entries]  # in SI or not: in their order


def test_the_seats_are_among_them():
    assert {"SeatResult", "Creep", "Clearance", "Requirements"} <= {kind.__name__ for kind in SHOWN}


@record
class Inner(Record):
    force_kN: float


@record
class Outer(Record):
    decimals: ClassVar[Mapping[str, int]] = {"um": 6}

    gap_um: tuple[float, float]
    drag_per_s: float | None
    parts: tuple[Inner, ...]
    wall_s: float
    note: str = "none"


class Limits(NamedTuple):
    lower: float
    upper: float


class Force(NamedTuple):
    force: float


class Design(NamedTuple):
    gap: Limits
    drag: float
    parts: tuple[Force, ...]
    wall_s: float


DESIGN = Design(Limits(-3.3e-6, 1.1e-6), math.inf, (Force(1500.0), Force(-20.0)), 0.25)


def test_a_record_is_read_in_the_units_of_its_fields():
    expected = Outer(
        gap_um=(-3.3, 1.1), drag_per_s=None, parts=(Inner(force_kN=1.5), Inner(force_kN=-0.02)), wall_s=0.25
    )
    assert Outer.read(DESIGN) == expected
    assert Outer.read(DESIGN, drag_per_s=2.0, note="given").drag_per_s == 2.0


@pytest.mark.parametrize(
    ("sources", "given", "message"),
    [
        ((Force(1.0),), {}, r"Outer\.gap_um: its attribute is missing in Force"),
        ((DESIGN, DESIGN), {}, r"Outer\.gap_um: its attribute is ambiguous in Design, Design"),
        ((DESIGN,), {"gap_mm": 1.0}, "Outer has no fields gap_mm"),
    ],
)
def test_a_record_that_cannot_be_read_says_why(sources, given, message):
    with pytest.raises(TypeError, match=message):
        Outer.read(*sources, **given)


def test_a_unit_that_is_not_known_is_refused() -> None:
    """Otherwise the number would stand there in SI under the name of another unit."""

    @record
    class Weight(Record):
        mass: Annotated[float, Quantity("mass", "M", unit="stone")]

    with pytest.raises(TypeError, match="no conversion of stone"):
        _ = Weight(mass=5.6).to_dict()
