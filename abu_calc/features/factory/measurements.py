"""Measured levels as rows: of the presets of a factory's machines, or of machine files that others wrote.

The comment behind a value of such a file says where the value is from: published, assumed, or fitted to a result.
"""

import re
from collections.abc import Iterable
from dataclasses import replace
from typing import Annotated, Any, Final, Literal

from abu_calc.features.factory.at_handles import HandleGeometry
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.measured import MeasuredOctave
from abu_calc.inputs.read_machine import Machine, read
from abu_calc.standards.tables import toml_table

Span = tuple[float, float]


@dataclass(frozen=True)
class MeasuredMachine:
    """A machine with its name in tables, what was measured of it, and the assumed places of its handles; None: none."""

    name: str
    short: str
    machine: Machine
    measured: tuple[MeasuredOctave, ...]
    geometry: HandleGeometry | None
    devices: tuple[tuple[int, float, str, float], ...] = ()
    """Devices that were built: balls, their diameter [mm], the state for which they were enough, mass [%]."""


def factory_machines() -> tuple[MeasuredMachine, ...]:
    """The machines that Kladiev 1996 measured, in the order of the table."""
    return tuple(
        replace(
            _measured(row["preset"], row["short"], read(row["preset"]), HandleGeometry.of(row)),
            devices=tuple(row.get("devices", ())),
        )
        for row in toml_table("factory_machines")["machine"]
    )


def machines_of(sources: Iterable[Machine]) -> tuple[MeasuredMachine, ...]:
    """Machine files that hold [[measured]]; refused without it."""
    known = {row["preset"]: row for row in toml_table("factory_machines")["machine"]}
    machines = []
    for machine in sources:
        name = machine.file or machine.title
        row = known.get(name)
        short = row["short"] if row else name.replace("\\", "/").rpartition("/")[2].removesuffix(".toml")
        machines.append(_measured(name, short, machine, HandleGeometry.of(row) if row else None))
    return tuple(machines)


def soft_race() -> dict[str, Any]:
    """IV-2014 and Sh-2203 of the same act, of which only the outcome and a soft race are known: names, an assumed
    machine, friction arms [mm], what is published.
    """
    row: dict[str, Any] = toml_table("factory_machines")["soft_race"]
    return row


def factory_source() -> tuple[str, str]:
    """The source, and what it says of backgrounds."""
    table = toml_table("factory_machines")
    return table["source"], table["background"]


def _measured(name: str, short: str, machine: Machine, geometry: HandleGeometry | None) -> MeasuredMachine:
    table = machine.whole("factory")
    if not table.measured:
        raise InputError(
            "nothing measured in this file", place=Place(machine.file, key="measured"),
            remedy="Add a table [[measured]] for each level; `abu init FILE` writes one with every key.",
        )  # fmt: skip
    return MeasuredMachine(name, short, machine, table.measured, geometry)


Status = Literal["published", "assumed", "fitted"]
TABLE: Final = re.compile(r"\[{1,2}([\w.]+)\]{1,2}\s*(#.*)?")
VALUE: Final = re.compile(r"(\w+)\s*=\s*(.*?)\s+#\s*(published|assumed|fitted): (.+)")
ENTRY: Final = re.compile(r"(\w+)\s*=")
OUTSIDE: Final = ("measured", "expected")
"""Tables whose values are no assumptions of the model."""


@record
class ValueSource(Record):
    """One value of a machine file and its origin; a fitted one was chosen to reach a published result."""

    key: Annotated[str, Quantity("key")]
    status: Annotated[str | None, Quantity("origin", "", 4, "published, assumed or fitted; null: not said")]
    why: Annotated[str, Quantity("why")]


def value_sources(text: str) -> tuple[ValueSource, ...]:
    """Origin of every value of a machine file, in the order of the file.

    A comment behind the value begins with "published:", "assumed:" or "fitted:".

    >>> [value] = value_sources('[wheel]\\nrunout_mm = 0.09  # fitted: so that the load needs four balls')
    >>> value.key, value.status, value.why
    ('wheel.runout_mm', 'fitted', 'so that the load needs four balls')
    """
    values, table = [], ""
    for line in map(str.strip, text.splitlines()):
        if heading := TABLE.fullmatch(line):
            table = heading[1]
        elif table.split(".")[0] not in OUTSIDE and (entry := ENTRY.match(line)):
            origin = VALUE.fullmatch(line)
            values.append(
                ValueSource(key=f"{table}.{entry[1]}", status=origin and origin[3], why=origin[4] if origin else "")
            )
    return tuple(values)


def degrees_of_freedom(sources: tuple[ValueSource, ...]) -> int | None:
    """Number of fitted values; None if the file does not say the origin of every value."""
    if not sources or any(source.status is None for source in sources):
        return None
    return sum(source.status == "fitted" for source in sources)
