"""Tables of the runs of a file of readings: readings, trial masses, and the errors that they may have.

A run holds what was read, or the record it is taken from, and the trial masses that were on.

Units as an instrument shows them: "mil peak-peak", "mm/s rms", read to SI and 0–peak, and written back.
"""

import math
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs.reading.table import Name, Table, entry, problem

Quantity = Literal["displacement", "velocity", "acceleration"]

SIZES: Final[dict[str, tuple[Quantity, str, str]]] = {
    "µm": ("displacement", "um", "µm"),
    "um": ("displacement", "um", "µm"),
    "mm": ("displacement", "mm", "mm"),
    "mil": ("displacement", "mil", "mil"),
    "mm/s": ("velocity", "mm_per_s", "mm/s"),
    "ips": ("velocity", "ips", "ips"),
    "in/s": ("velocity", "ips", "ips"),
    "m/s²": ("acceleration", "m_per_s2", "m/s²"),
    "m/s2": ("acceleration", "m_per_s2", "m/s²"),
    "g": ("acceleration", "g_n", "g"),
}
"""Quantity, suffix of `foundation.units`, and form as printed, by the unit as people write it."""
DETECTORS: Final[dict[str, tuple[float, str]]] = {
    "0-peak": (1.0, "0-peak"),
    "peak": (1.0, "0-peak"),
    "peak-peak": (2.0, "peak-peak"),
    "rms": (math.sqrt(0.5), "rms"),
    **dict.fromkeys(("pk", "0-p", "0-pk"), (1.0, "0-peak")),
    **dict.fromkeys(("pp", "p-p", "pk-pk", "peak-to-peak"), (2.0, "peak-peak")),
}
"""Reading of a sine over its amplitude 0–peak, and the form as printed, by the detector."""
PLAIN: Final = {"displacement": "mm", "velocity": "mm/s", "acceleration": "m/s²"}
"""Units of a run that names its quantity alone; the amplitudes are 0–peak."""


@dataclass(frozen=True)
class Instrument:
    """Unit of the amplitudes of a run."""

    quantity: Quantity
    suffix: str
    shown: str
    """Unit as printed; of a run without `unit` the detector is left out: 0–peak."""
    factor: float = 1.0
    """Reading over amplitude 0–peak."""

    def amplitude(self, reading: float) -> float:
        """Amplitude 0–peak in SI of a reading.

        >>> round(1e6 * instrument_of("mil peak-peak").amplitude(2.0), 6)
        25.4
        """
        return to_si(reading / self.factor, self.suffix)

    def reading(self, amplitude: float) -> float:
        """Reading that the instrument shows of an amplitude 0–peak in SI."""
        return from_si(amplitude * self.factor, self.suffix)


def _plain(text: str) -> str:
    """A unit in the form in which it is looked up: one space, any dash, either micro sign."""
    for dash in "–—‐‑−":
        text = text.replace(dash, "-")
    return " ".join(text.replace("\u03bc", "µ").split())


def instrument_of(unit: str) -> Instrument | None:
    """Instrument of a unit as people write it; None for an unknown one.

    >>> instrument_of("mm/s rms").quantity, instrument_of("mil"), instrument_of("µm 0–peak").shown
    ('velocity', None, 'µm 0-peak')
    """
    size, _, detector = _plain(unit).partition(" ")
    detector = detector.lower()
    if size not in SIZES or detector not in DETECTORS:
        return None
    quantity, suffix, shown = SIZES[size]
    factor, name = DETECTORS[detector]
    return Instrument(quantity, suffix, f"{shown} {name}", factor)


def plain_instrument(quantity: Quantity) -> Instrument:
    """Instrument of a run that names its quantity alone.

    >>> plain_instrument("velocity").amplitude(2.0)
    0.002
    """
    unit = PLAIN[quantity]
    return Instrument(quantity, SIZES[unit][1], unit)


def known_units() -> tuple[str, ...]:
    """Units that are known, as printed, by quantity.

    >>> known_units()[:3]
    ('µm 0-peak', 'µm peak-peak', 'µm rms')
    """
    sizes = dict.fromkeys(shown for _, _, shown in SIZES.values())
    detectors = dict.fromkeys(name for _, name in DETECTORS.values())
    return tuple(f"{size} {detector}" for size in sizes for detector in detectors)


class Errors(Table):
    """How far readings, masses put on and data of the rig may be off: one standard deviation each."""

    amplitude_percent: float = entry(1.0, ge=0, le=100, usual=(0.01, 20)).means(
        "Error of each amplitude [%]; {range}. A reading below a tenth of the largest at its speed has the errors of "
        "that tenth. Default: {default}, assumed."
    )
    phase_deg: float = entry(1.0, ge=0, le=90, usual=(0.01, 20)).means(
        "Error of each phase [degrees]; {range}. Default: {default}, assumed."
    )
    speed_percent: float = entry(0.1, ge=0, le=50, usual=(0.001, 10)).means(
        "Error of the speed [%]; {range}. Default: {default}, assumed."
    )
    support_mass_percent: float = entry(2.0, ge=0, le=100, usual=(0.01, 50)).means(
        "Error of the moving mass of each support [%]; {range}. Default: {default}, assumed."
    )
    stiffness_percent: float = entry(2.0, ge=0, le=100, usual=(0.01, 50)).means(
        "Error of each stiffness [%]; {range}. Default: {default}, assumed."
    )
    damping_ratio: float = entry(0.01, ge=0, le=0.5, usual=(0.0001, 0.2)).means(
        "Error of rig.damping_ratio; {range}. Default: {default}, assumed."
    )
    rotor_mass_percent: float = entry(0.5, ge=0, le=100, usual=(0.01, 50)).means(
        "Error of the roll's mass [%]; {range}. Default: {default}, assumed."
    )
    inertia_percent: float = entry(2.0, ge=0, le=100, usual=(0.01, 50)).means(
        "Error of the roll's inertia [%]; {range}. Default: {default}, assumed."
    )
    length_mm: float = entry(1.0, ge=0, le=1000, usual=(0.01, 100)).means(
        "Error of each of the four lengths [mm]; {range}. Default: {default}, assumed."
    )
    placed_mass_percent: float = entry(1.0, ge=0, le=100, usual=(0.01, 50)).means(
        "Error of each mass added or removed, trial or correction [%]; {range}. Default: {default}, assumed."
    )
    placed_angle_deg: float = entry(1.0, ge=0, le=90, usual=(0.01, 20)).means(
        "Error of the angle of each mass [degrees]; {range}. Default: {default}, assumed."
    )
    coefficient_percent: float = entry(2.0, ge=0, le=100, usual=(0.01, 50)).means(
        "Difference of a rotor's influence coefficients from those that were stored of its kind [%]; {range}. Default: "
        "{default}, assumed."
    )


Plane = Literal["left", "right"]
MarkEdge = Literal["leading", "middle", "trailing"]
Phase = Literal["lag", "lead"]


class Reading(Table):
    """Reading of one sensor."""

    inline: ClassVar[bool] = True

    name: Name | None = entry(None, example="fan end, horizontal", min_length=1, max_length=60).means(
        "Name of the sensor, in readings alone. Without it: its number, from 1."
    )
    amplitude: float = entry(ge=0, le=1e6, example=0.038109).means(
        "Amplitude at the speed of rotation, in the unit of the run; {range}."
    )
    phase_deg: float | None = entry(None, ge=-360, le=360, example=18.7489).means(
        "Phase [degrees], by the convention of the run, t from the passage of the zero mark; {range}. Without it in "
        "all runs: balancing without phase."
    )


class Trial(Table):
    """A known mass that was on in this run."""

    inline: ClassVar[bool] = True

    plane: Plane | None = entry(None, example="left").means(
        "The correction plane it was in: left or right. With [single_plane] it is left out."
    )
    mass_g: float = entry(ge=-1e6, le=1e6, usual=(0.01, 5000), example=10.0).means(
        "Its mass [g]; {range}, negative: metal that was taken off."
    )
    angle_deg: float = entry(ge=-360, le=360, example=0.0).means(
        "Angle from the zero mark, counted by rotor.angle_marks [degrees]; {range}."
    )
    radius_mm: float | None = entry(None, gt=0, le=1e5, usual=(5, 5000), example=120.0).means(
        "Radius it was at [mm]; {range}. Without it: the correction radius of its plane."
    )

    @model_validator(mode="after")
    def _is_a_mass(self) -> Self:
        if self.mass_g == 0:
            raise problem("a trial mass of nothing", "mass_g", remedy="leave trial out, or give the mass")
        return self


def listed(value: object) -> object:
    """A single table as a list of one."""
    return [value] if isinstance(value, dict) else value


class Run(Table):
    """A run on the rig at steady speed; several are averaged as vectors."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"speed_rpm", "quantity", "phase", "left", "right"})

    speed_rpm: float | None = entry(None, gt=0, le=1e6, usual=(60, 60000), example=3000.0).means(
        "Speed of rotation [rpm]; {range}. With file it may be left out: the marks tell it."
    )
    quantity: Quantity | None = entry(None, example="displacement").means(
        "Quantity that the sensors read: displacement (mm), velocity (mm/s) or acceleration (m/s²), all 0–peak. The "
        "quantity decides the side: an acceleration points opposite to the displacement."
    )
    unit: str | None = entry(None, example="µm peak-peak", max_length=40).means(
        "In place of quantity, the unit as the instrument shows it: µm, mil, mm, mm/s, ips, m/s² or g, then 0-peak, "
        "peak-peak or rms."
    )
    phase: Phase | None = entry(None, example="lag").means(
        "Convention of the phases. lag: A·cos(ωt − phase), lead: A·cos(ωt + phase). Without it: lag, with a warning."
    )
    left: Reading | None = entry(None, example={"amplitude": 0.038109, "phase_deg": 18.7489}).means(
        "Sensor at the left support."
    )
    right: Reading | None = entry(None, example={"amplitude": 0.031642, "phase_deg": 152.7485}).means(
        "Sensor at the right support."
    )
    readings: Annotated[
        tuple[Reading, ...],
        Field(strict=False, max_length=40),
        BeforeValidator(listed, json_schema_input_type=Reading | Annotated[tuple[Reading, ...], Field(max_length=40)]),
    ] = entry((), example=[{"amplitude": 0.038109, "phase_deg": 18.7489}]).means(
        "In place of left and right: the readings of any number of sensors, one table or a list of them. All runs list "
        "the same sensors."
    )
    file: str | None = entry(None, example="run1.csv", min_length=1).means(
        "A recorded run in place of left and right: a CSV file beside this one. Its columns are time (s), left, right "
        "(in the unit of quantity) and mark (pulses, either polarity)."
    )
    mark_edge: MarkEdge | None = entry(None, example="leading").means(
        "With file: what of a pulse is the mark's passage: its leading edge, its middle or its trailing edge. Without "
        "it: the leading edge of a square pulse, the middle of a rounded one."
    )
    sensor_to_mark_deg: float = entry(0.0, ge=-360, le=360).means(
        "Place of the zero-mark sensor from the vibration sensors, in the sense of rotation [degrees]; {range}. "
        "Default: {default}, in line with them."
    )
    trial: Annotated[
        tuple[Trial, ...],
        Field(strict=False, max_length=20),
        BeforeValidator(listed, json_schema_input_type=Trial | Annotated[tuple[Trial, ...], Field(max_length=20)]),
    ] = entry(()).means(
        "Known masses that were on in this run alone, one table or a list of them: plane, mass_g, angle_deg. For "
        "influence coefficients."
    )

    @property
    def instrument(self) -> Instrument:
        """Unit of the amplitudes."""
        shown = None if self.unit is None else instrument_of(self.unit)
        return shown or plain_instrument(self.quantity or "displacement")

    @property
    def sensors(self) -> tuple[tuple[str, Reading], ...]:
        """Readings by the names of their sensors."""
        sides = tuple((side, reading) for side, reading in (("left", self.left), ("right", self.right)) if reading)
        return sides or tuple((reading.name or str(k), reading) for k, reading in enumerate(self.readings, 1))

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """A record takes the place of readings, and they of it."""
        if key == "file":
            return ("left", "right", "readings", "phase")
        return {
            "left": ("file", "mark_edge", "readings"),
            "right": ("file", "mark_edge", "readings"),
            "readings": ("file", "mark_edge", "left", "right"),
            "unit": ("quantity",),
            "quantity": ("unit",),
        }.get(key, ())

    @model_validator(mode="after")
    def _has_a_unit(self) -> Self:
        if self.unit is None:
            if self.quantity is None:
                raise problem("the key is missing", "quantity", remedy='add quantity = "displacement", or unit = "…"')
            return self
        shown = instrument_of(self.unit)
        if shown is None:
            raise problem(
                "the unit is not known", "unit", found=self.unit, allowed=", ".join(known_units()),
                remedy="name the unit and the kind of amplitude, such as \"mil peak-peak\"",
            )  # fmt: skip
        if self.quantity is not None and self.quantity != shown.quantity:
            raise problem(
                "unit and quantity contradict each other", "quantity", found=self.quantity, allowed=shown.quantity,
                remedy="leave quantity out",
            )  # fmt: skip
        if self.file is not None and shown.factor != 1:
            raise problem(
                "a recorded run holds the signal itself, no rms and no peak-peak", "unit", found=self.unit,
                allowed="a unit with 0-peak", remedy="write the unit of the signal with 0-peak",
            )  # fmt: skip
        return self

    @model_validator(mode="after")
    def _read_or_recorded(self) -> Self:
        given = [key for key in ("left", "right", "readings") if getattr(self, key)]
        if self.file is None:
            if self.speed_rpm is None:
                raise problem(
                    "the key is missing", "speed_rpm", remedy="add speed_rpm = 3000.0, or file, a recorded run"
                )
            if not given:
                raise problem("the key is missing", "left", remedy=f"add left = {EXAMPLE}, or file, a recorded run")
            if self.mark_edge is not None:
                raise problem("mark_edge goes with file only", "mark_edge", remedy="leave mark_edge out")
        elif given:
            raise problem("a run is read or recorded, not both", given[0], remedy=f"leave {given[0]} out, or file")
        elif self.phase is not None:
            raise problem(
                "phase goes with readings only", "phase", remedy="leave phase out: records have no convention"
            )
        if "readings" in given and len(given) > 1:
            raise problem("readings list all sensors", given[0], remedy=f"leave {given[0]} out, or readings")
        names = [name for name, _ in self.sensors]
        if len(set(names)) < len(names):
            raise problem("two sensors have one name", "readings", remedy="give each sensor its own name")
        return self


EXAMPLE = "{ amplitude = …, phase_deg = … }"
