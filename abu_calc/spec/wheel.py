"""The wheel, and where its imbalance is known from."""

from typing import ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.spec.measured import (
    AXES_WORDS,
    COMPANIONS,
    QUANTITIES,
    WEIGHTING_WORDS,
    Accelerations,
    Axes,
    Displacements,
    Levels,
    Measured,
    Velocities,
    Weighting,
    displaced_quantities,
    measured_field,
)
from abu_calc.spec.table import Name, problem
from abu_calc.spec.usual import usual

BalanceGrade = Literal["G4000", "G1600", "G630", "G250", "G100", "G40", "G16", "G6.3", "G2.5", "G1", "G0.4"]
"""The grades of ISO 21940-11:2016, table 1."""

SOURCES: Final = ("imbalance_g_mm", "balance_grade", *QUANTITIES)
BARE: Final = "idle, without autobalancer, instead of imbalance_g_mm"
"""The state of the machine that the wheel's imbalance is found from."""
RUNOUTS: Final = ("runout_mm", "runout_tir_mm")


class Wheel(Measured):
    """The wheel, its runout, and exactly one source of its imbalance."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"imbalance_g_mm"})

    mass_kg: float = Field(
        description="Mass of the wheel with its flanges [kg]; {range}, hand grinders 0.05 … 2.",
        examples=[0.6],
        ge=0.0001,
        le=5000,
        json_schema_extra=usual(0.005, 50),
    )
    diameter_mm: float = Field(
        description="Outer diameter of the wheel [mm]; {range}, hand grinders 50 … 230.",
        examples=[150.0],
        ge=1,
        le=5000,
        json_schema_extra=usual(20, 600),
    )
    runout_mm: float = Field(
        default=0.0,
        description="Eccentricity of the wheel's outer surface, half of what a dial gauge shows [mm]; {range}, "
        "mounted wheels 0.02 … 0.2. Default: {default}, a true wheel. Or give runout_tir_mm.",
        ge=0,
        le=10,
        json_schema_extra=usual(0.001, 1),
    )
    runout_tir_mm: float | None = Field(
        default=None,
        description="Total indicated runout of the outer surface, as the dial gauge shows it: twice runout_mm, and "
        "instead of it [mm]; {range}.",
        examples=[0.08],
        ge=0,
        le=20,
        json_schema_extra=usual(0.002, 2),
    )
    runout_angle_deg: float = Field(
        default=0.0,
        description="Where the high spot stands, from the imbalance in the sense of rotation [degrees]; {range}. "
        "Sizing takes the worst angle whatever stands here. Default: {default}, at the imbalance.",
        ge=-360,
        le=360,
    )
    axial_runout_mm: float = Field(
        default=0.0,
        description="Axial runout of the wheel's face, half of what a dial gauge shows [mm]; {range}, mounted wheels "
        "0.02 … 0.2. Under load a face wheel moves the machine by it along the spindle, once per turn, and the balls "
        "across their race. Default: {default}.",
        ge=0,
        le=10,
        json_schema_extra=usual(0.001, 1),
    )
    usable_wear_mm: float | None = Field(
        default=None,
        description="How much of the wheel's radius may be worn off [mm]; {range}. No default: wear is then told in "
        "depths, not in minutes.",
        examples=[10.0],
        gt=0,
        le=2000,
        json_schema_extra=usual(0.5, 200),
    )
    life_min: float | None = Field(
        default=None,
        description="Grinding time in which usable_wear_mm is worn off [minutes]; {range}. No default.",
        examples=[32.0],
        gt=0,
        le=1e6,
        json_schema_extra=usual(1, 10000),
    )
    imbalance_g_mm: float | None = Field(
        default=None,
        description="Imbalance of the wheel [g·mm]; {range}, hand grinders 20 … 1000. One source is needed: "
        "this, balance_grade or a measured_ value.",
        examples=[150.0],
        ge=0,
        le=1e9,
        json_schema_extra=usual(2, 5e4),
    )
    balance_grade: BalanceGrade | None = Field(
        default=None,
        description="Balance quality grade by ISO 21940-11, of the wheel's mass at the rated speed: G4000, G1600, "
        "G630, G250, G100, G40, G16, G6.3, G2.5, G1 or G0.4. Instead of imbalance_g_mm.",
        examples=["G16"],
    )
    measured_level_db: Levels = measured_field("measured_level_db", BARE)
    measured_velocity_mm_per_s: Velocities = measured_field("measured_velocity_mm_per_s", BARE)
    measured_displacement_um: Displacements = measured_field("measured_displacement_um", BARE)
    measured_acceleration_m_per_s2: Accelerations = measured_field("measured_acceleration_m_per_s2", BARE)
    measured_weighting: Weighting | None = Field(default=None, description=WEIGHTING_WORDS, examples=["none"])
    measured_axes: Axes | None = Field(default=None, description=AXES_WORDS, examples=[1])
    measured_at: Name | None = Field(
        default=None,
        description="With a measured_ value: name of the handle where it was measured. Without it: the wheel plane.",
        examples=["front"],
        min_length=1,
    )

    @property
    def runout(self) -> float:
        """Eccentricity of the outer surface [mm], from either key."""
        return self.runout_mm if self.runout_tir_mm is None else self.runout_tir_mm / 2

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
                "runout_mm and runout_tir_mm say the same thing twice",
                "runout_tir_mm",
                remedy="keep one: runout_tir_mm (dial gauge) is twice runout_mm (eccentricity)",
            )
        return self
