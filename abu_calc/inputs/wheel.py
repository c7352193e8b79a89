"""The table of the wheel, with the sources of its imbalance and instrument readings of the idle machine.

Instrument readings are keys of [wheel] and of [measured_after] alike.
"""

import re
from typing import Annotated, Any, ClassVar, Final, Literal, Self, get_args

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import to_si
from abu_calc.inputs.reading.table import Name, Table, boxed, entry, problem, usual, whole
from abu_calc.standards.vibration import grade_named

Weighting = Literal["none", "Wh"]

QUANTITIES: Final = (
    *("measured_level_db", "measured_velocity_mm_per_s", "measured_displacement_um"),
    "measured_acceleration_m_per_s2",
)
"""Keys of which one holds what was measured."""
MOST_VALUES: Final = 1000
"""Measured one after another."""
COMPANIONS: Final = ("measured_at", "measured_weighting", "measured_axes")
"""Keys that say how and where."""

_Level = Annotated[float, Field(ge=0, le=200)]
_Velocity = Annotated[float, Field(gt=0, le=1e5)]
_Displacement = Annotated[float, Field(gt=0, le=1e6)]
_Acceleration = Annotated[float, Field(gt=0, le=1e6)]


_VALUES: Final = Field(strict=False, min_length=1, max_length=MOST_VALUES)


def _one_or_many(kind: Any) -> BeforeValidator:
    """One number stands for a list of one."""
    return BeforeValidator(
        boxed, json_schema_input_type=kind | Annotated[tuple[kind, ...], Field(min_length=1, max_length=MOST_VALUES)]
    )


@dataclass(frozen=True)
class Shown:
    """Reading of an instrument: `key` holds the values, in the unit of the key."""

    key: str
    values: tuple[float, ...]
    weighting: Weighting
    axes: int
    at: str | None


def measured_field(key: str, state: str) -> Any:
    """The field of a key of this kind; `state`: of which machine, in words."""
    examples, width, quantity = _QUANTITY_WORDS[key]
    return Field(
        default=None,
        description=f"{quantity}, {state}: one number, or a list that is averaged in velocity {{range}}.".replace(
            "{range}", f"{_UNIT[key]}; {{range}}"
        ),
        examples=examples,
        json_schema_extra=usual(*width),
    )


_UNIT: Final = dict(zip(QUANTITIES, ("[dB re 5e-8 m/s]", "[mm/s]", "[µm]", "[m/s²]"), strict=True))
_QUANTITY_WORDS: Final[dict[str, tuple[list[Any], tuple[float, float], str]]] = {
    "measured_level_db": ([111.0], (85, 135), "Velocity level measured"),
    "measured_velocity_mm_per_s": ([17.7], (0.5, 300), "Velocity rms as the instrument shows it"),
    "measured_displacement_um": ([29.2], (0.5, 3000), "Displacement rms as the instrument shows it"),
    "measured_acceleration_m_per_s2": ([10.8], (0.3, 500), "Acceleration rms as the instrument shows it"),
}


class Measured(Table):
    """Rules that the keys share, in whichever table they stand."""

    @property
    def shown(self) -> Shown | None:
        """Measured quantity; None if nothing was measured."""
        for key in QUANTITIES:
            values = getattr(self, key, None)
            if values is not None:
                at, weighting, axes = (getattr(self, name, None) for name in COMPANIONS)
                return Shown(key, values, weighting or "none", axes or 1, at)
        return None

    @model_validator(mode="after")
    def _companions_go_with_a_value(self) -> Self:
        given = [key for key in QUANTITIES if getattr(self, key, None) is not None]
        for name in COMPANIONS:
            if getattr(self, name, None) is not None and not given:
                raise problem(
                    f"{name} goes with a measured value only",
                    name,
                    allowed=f"beside one of {', '.join(QUANTITIES)}",
                    remedy=f"leave {name} out, or give what was measured",
                )
        if getattr(self, "measured_weighting", None) == "Wh" and given and given[0] != "measured_acceleration_m_per_s2":
            raise problem(
                'measured_weighting = "Wh" goes with an acceleration only',
                "measured_weighting",
                found=given[0],
                remedy="leave measured_weighting out: W_h of ISO 5349-1 weights accelerations",
            )
        return self


WEIGHTING_WORDS: Final = (
    "With an acceleration: how it is weighted by frequency, none, or Wh (ISO 5349-1, as data sheets give it). "
    "Without it: none."
)
AXES_WORDS: Final = (
    "How many axes what was measured stands for: 1, or 3 for the vector sum of three, as the total a_hv of data "
    "sheets. A spinning imbalance moves two axes alike, so one takes 1/√2 of a sum. Without it: 1."
)
Axes = Annotated[Literal[1, 3], BeforeValidator(whole)]
Levels = Annotated[tuple[_Level, ...], _VALUES, _one_or_many(_Level)] | None
Velocities = Annotated[tuple[_Velocity, ...], _VALUES, _one_or_many(_Velocity)] | None
Displacements = (
    Annotated[
        tuple[_Displacement, ...],
        _VALUES,
        _one_or_many(_Displacement),
    ]
    | None
)
Accelerations = (
    Annotated[
        tuple[_Acceleration, ...],
        _VALUES,
        _one_or_many(_Acceleration),
    ]
    | None
)


class MeasuredAfter(Measured):
    """Levels measured with the autobalancer, idle. The report compares them with the prediction."""

    measured_level_db: Levels = measured_field("measured_level_db", "with the autobalancer")
    measured_velocity_mm_per_s: Velocities = measured_field("measured_velocity_mm_per_s", "with the autobalancer")
    measured_displacement_um: Displacements = measured_field("measured_displacement_um", "with the autobalancer")
    measured_acceleration_m_per_s2: Accelerations = measured_field(
        "measured_acceleration_m_per_s2", "with the autobalancer"
    )
    measured_weighting: Weighting | None = Field(default=None, description=WEIGHTING_WORDS, examples=["none"])
    measured_axes: Axes | None = Field(default=None, description=AXES_WORDS, examples=[1])
    measured_at: Name | None = entry(None, example="front", min_length=1).means(
        "Name of the handle where it was measured. Without it: the wheel plane."
    )

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """One quantity takes the place of the others."""
        return displaced_quantities(key)

    @model_validator(mode="after")
    def _one_value(self) -> Self:
        given = [key for key in QUANTITIES if getattr(self, key) is not None]
        if len(given) != 1:
            raise problem(
                "exactly one measured value is needed",
                *given[1:2],
                found=" and ".join(given) or "none",
                allowed="one of " + ", ".join(QUANTITIES),
                remedy="keep one of them" if given else "add one, or leave the table out",
            )
        return self


def displaced_quantities(key: str) -> tuple[str, ...]:
    """Keys that one measured quantity replaces: the other quantities, and a weighting of accelerations."""
    if key not in QUANTITIES:
        return ()
    others = tuple(other for other in QUANTITIES if other != key)
    return others if key == "measured_acceleration_m_per_s2" else (*others, "measured_weighting")


_Grade = Literal["G4000", "G1600", "G630", "G250", "G100", "G40", "G16", "G6.3", "G2.5", "G1", "G0.4"]
_WRITTEN: Final = rf"^[Gg]\s*({'|'.join(re.escape(grade[1:]) for grade in get_args(_Grade))})$"
BalanceGrade = Annotated[
    _Grade,
    BeforeValidator(
        lambda grade: grade_named(grade) if isinstance(grade, str) else grade,
        json_schema_input_type=_Grade | Annotated[str, Field(pattern=_WRITTEN)],
    ),
]
"""The grades of ISO 21940-11:2016, table 1; people also write "G 6.3" and "g6.3"."""

SOURCES: Final = ("imbalance_g_mm", "balance_grade", *QUANTITIES)
BARE: Final = "idle, without autobalancer, instead of imbalance_g_mm"
"""The state of the machine that the wheel's imbalance is found from."""
RUNOUTS: Final = ("runout_mm", "runout_tir_mm")


class Wheel(Measured):
    """The wheel, its runout, and exactly one source of its imbalance."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"imbalance_g_mm"})

    mass_kg: float = entry(ge=0.0001, le=5000, usual=(0.005, 50), example=0.6).means(
        "Mass of the wheel with its flanges [kg]; {range}, hand grinders 0.05 … 2."
    )
    diameter_mm: float = entry(ge=1, le=5000, usual=(20, 600), example=150.0).means(
        "Outer diameter of the wheel [mm]; {range}, hand grinders 50 … 230."
    )
    runout_mm: float = entry(0.0, ge=0, le=10, usual=(0.001, 1)).means(
        "Eccentricity of the wheel's outer surface, half of what a dial gauge shows [mm]; {range}, mounted wheels 0.02 "
        "… 0.2. Default: {default}, a true wheel. Or give runout_tir_mm."
    )
    runout_tir_mm: float | None = entry(None, ge=0, le=20, usual=(0.002, 2), example=0.08).means(
        "Total indicated runout of the outer surface, as the dial gauge shows it: twice runout_mm, and instead of it "
        "[mm]; {range}."
    )
    runout_angle_deg: float = entry(0.0, ge=-360, le=360).means(
        "Angle of the high spot from the imbalance in the sense of rotation [degrees]; {range}. Sizing takes the worst "
        "angle whatever stands here. Default: {default}, at the imbalance."
    )
    axial_runout_mm: float = entry(0.0, ge=0, le=10, usual=(0.001, 1)).means(
        "Axial runout of the wheel's face, half of what a dial gauge shows [mm]; {range}, mounted wheels 0.02 … 0.2. "
        "Under load a face wheel moves the machine by it along the spindle, once per turn, and the balls across their "
        "race. Default: {default}."
    )
    usable_wear_mm: float | None = entry(None, gt=0, le=2000, usual=(0.5, 200), example=10.0).means(
        "Wear of the wheel's radius that is allowed [mm]; {range}. No default: wear is then told in depths, not in "
        "minutes."
    )
    life_min: float | None = entry(None, gt=0, le=1e6, usual=(1, 10000), example=32.0).means(
        "Grinding time in which usable_wear_mm is worn off [minutes]; {range}. No default."
    )
    life_with_autobalancer_min: float | None = entry(None, gt=0, le=1e6, usual=(1, 10000), example=48.0).means(
        "Life of the wheel that was measured with an autobalancer [minutes], beside life_min without one; {range}. "
        "`abu grinding` compares it with the prediction. No default."
    )
    imbalance_g_mm: float | None = entry(None, ge=0, le=1e9, usual=(2, 1.2e5), example=150.0).means(
        "Imbalance of the wheel [g·mm]; {range}, hand grinders 20 … 1000. One source is needed: this, balance_grade or "
        "a measured_ value."
    )
    balance_grade: BalanceGrade | None = entry(None, example="G16").means(
        "Balance quality grade by ISO 21940-11, of the wheel's mass at the rated speed: G4000, G1600, G630, G250, "
        "G100, G40, G16, G6.3, G2.5, G1 or G0.4. Instead of imbalance_g_mm. It describes balanced rotors; abrasive "
        "wheels are far worse."
    )
    measured_level_db: Levels = measured_field("measured_level_db", BARE)
    measured_velocity_mm_per_s: Velocities = measured_field("measured_velocity_mm_per_s", BARE)
    measured_displacement_um: Displacements = measured_field("measured_displacement_um", BARE)
    measured_acceleration_m_per_s2: Accelerations = measured_field("measured_acceleration_m_per_s2", BARE)
    measured_weighting: Weighting | None = Field(default=None, description=WEIGHTING_WORDS, examples=["none"])
    measured_axes: Axes | None = Field(default=None, description=AXES_WORDS, examples=[1])
    measured_at: Name | None = entry(None, example="front", min_length=1).means(
        "With a measured_ value: name of the handle where it was measured. Without it: the wheel plane."
    )

    @property
    def runout(self) -> float:
        """Eccentricity of the outer surface [m], from either key."""
        return to_si(self.runout_mm if self.runout_tir_mm is None else self.runout_tir_mm / 2, "mm")

    @property
    def grade(self) -> float | None:
        """The balance grade as a number [mm/s], G 6.3 → 6.3."""
        return None if self.balance_grade is None else float(self.balance_grade[1:])

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """One source of the imbalance takes the place of the others, one runout that of the other."""
        if key in QUANTITIES:
            return ("imbalance_g_mm", "balance_grade", *displaced_quantities(key))
        if key in SOURCES:
            return (*(source for source in SOURCES if source != key), *COMPANIONS)
        return tuple(other for other in RUNOUTS if other != key) if key in RUNOUTS else ()

    def unused(self) -> frozenset[str]:
        """The default of runout_mm, when the runout is given as the gauge shows it."""
        return frozenset() if self.runout_tir_mm is None else frozenset({"runout_mm"})

    @model_validator(mode="after")
    def _one_source_of_imbalance(self) -> Self:
        given = [key for key in SOURCES if getattr(self, key) is not None]
        if len(given) != 1:
            raise problem(
                "exactly one source of the imbalance is needed",
                *given[1:2],
                found=" and ".join(given) or "none",
                allowed="one of " + ", ".join(SOURCES),
                remedy="keep one of them" if given else "add imbalance_g_mm, the imbalance in g·mm",
            )
        return self

    @model_validator(mode="after")
    def _one_runout(self) -> Self:
        if "runout_mm" in self.model_fields_set and self.runout_tir_mm is not None:
            raise problem(
                "runout_mm and runout_tir_mm both give the runout",
                "runout_tir_mm",
                remedy="keep one: runout_tir_mm (dial gauge) is twice runout_mm (eccentricity)",
            )
        return self
