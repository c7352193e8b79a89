"""Measured levels as rows: of the presets of a factory's machines, or of machine files that others wrote.

The comment behind a value of such a file says where the value is from: published, assumed, or fitted to a result.

Prediction where sensors are: at the handles, along any axis, by the rigid body that is estimated of a machine.

The plane model has no motion along the spindle. A rigid body has: its handles move along z, too.
"""

import math
import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Annotated, Any, Final, Literal

from abu_calc.features.design.study import SizeResult
from abu_calc.formulas.body_motion import BodyMotion, HandsOnHandles
from abu_calc.formulas.rigid_body import Layout, PlacedBody, Vector, estimated_body
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.measured import MeasuredOctave
from abu_calc.inputs.read_machine import Machine, read
from abu_calc.standards.tables import toml_table
from abu_calc.standards.vibration import hand

Span = tuple[float, float]
LEAST: Final = 1e-9
"""Ratio that stands for no motion."""
SLOW: Final = 100 * math.pi
"""Below this speed [rad/s], 3000 rpm, the hands change the levels at handles; above it the body is free."""


@dataclass(frozen=True)
class HandleGeometry:
    """Lengths [m] by their names L and H, and the places of the handles from the centre of mass [m]; assumed."""

    lengths: dict[str, float]
    handles: dict[str, Vector]

    @classmethod
    def of(cls, row: dict[str, Any]) -> "HandleGeometry | None":
        """The geometry of an entry of `factory_machines`; None if it has none."""
        lengths = {name: row[key] / 1000 for name, key in (("L", "length_mm"), ("H", "height_mm")) if key in row}
        handles = {name: (x / 1000, y / 1000, z / 1000) for name, (x, y, z) in row.get("handles", {}).items()}
        return cls(lengths, handles) if lengths and handles else None


@dataclass(frozen=True)
class AtHandles:
    """Levels at the handles against those of the plane model [dB]: bands of the estimate, over all handles.

    `carried`: along x, y and z, the level at a handle minus that of the race. `lowered`: how much more an imbalance
    that is given, not measured, is lowered than a point mass shows.
    """

    carried: dict[str, Span]
    lowered: Span


def at_handles(table: MachineFile, design: SizeResult, geometry: HandleGeometry) -> AtHandles:
    """Motion of the handles per motion of the race, of the estimated body (theory of the rigid body in space).

    The balls leave the race a displacement, whatever the body is; a load at the race that causes it moves the handles.
    """
    speed, mass = table.machine.speed, design.system_mass_kg
    polar = table.wheel.mass_kg * table.wheel.diameter**2 / 8
    layout: Layout = table.machine.layout
    estimate = estimated_body(layout, mass, geometry.lengths, polar)
    places = tuple(geometry.handles.values())
    hands = HandsOnHandles(places, (hand("x"), hand("y"), hand("z"))) if speed < SLOW else None

    def ratio(place: Vector, index: int) -> Callable[[PlacedBody], float]:
        def level(placed: PlacedBody) -> float:
            motion = BodyMotion(placed.body, speed, hands)
            race = abs(motion.forward(placed.wheel, placed.wheel)) / 2
            moved = abs(motion.response(place, placed.wheel)[index]) / race
            return 20 * math.log10(max(moved, LEAST))

        return level

    def lighter(placed: PlacedBody) -> float:
        return 20 * math.log10(mass / BodyMotion(placed.body, speed, hands).effective_mass(placed.wheel))

    carried = {
        axis: _span([estimate.band(ratio(place, index)) for place in places]) for index, axis in enumerate("xyz")
    }
    return AtHandles(carried, estimate.band(lighter))


def _span(bands: Iterable[Span]) -> Span:
    """Lowest and highest of bands."""
    lows, highs = zip(*bands, strict=True)
    return min(lows), max(highs)


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
