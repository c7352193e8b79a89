"""Instrument readings of the idle machine in a file: keys of [wheel] and of [measured_after] alike."""

from typing import Annotated, Any, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.frozen import dataclass
from abu_calc.spec.table import Name, Table, boxed, problem, whole
from abu_calc.spec.usual import usual

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
    """What the instrument showed: `key` holds the values, in the unit of the key."""

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
    """What was measured with the autobalancer, idle: printed beside what is predicted, with the difference."""

    measured_level_db: Levels = measured_field("measured_level_db", "with the autobalancer")
    measured_velocity_mm_per_s: Velocities = measured_field("measured_velocity_mm_per_s", "with the autobalancer")
    measured_displacement_um: Displacements = measured_field("measured_displacement_um", "with the autobalancer")
    measured_acceleration_m_per_s2: Accelerations = measured_field(
        "measured_acceleration_m_per_s2", "with the autobalancer"
    )
    measured_weighting: Weighting | None = Field(default=None, description=WEIGHTING_WORDS, examples=["none"])
    measured_axes: Axes | None = Field(default=None, description=AXES_WORDS, examples=[1])
    measured_at: Name | None = Field(
        default=None,
        description="Name of the handle where it was measured. Without it: the wheel plane.",
        examples=["front"],
        min_length=1,
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
