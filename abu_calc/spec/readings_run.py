"""A run on the rig: what was read, or the record it is taken from, and the trial masses that were on."""

from typing import Annotated, ClassVar, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.spec.table import Table, problem
from abu_calc.spec.usual import usual

Quantity = Literal["displacement", "velocity", "acceleration"]
Plane = Literal["left", "right"]
MarkEdge = Literal["leading", "middle", "trailing"]


class Reading(Table):
    """What one sensor shows."""

    inline: ClassVar[bool] = True

    amplitude: float = Field(
        description="Amplitude at the speed of rotation, 0–peak, in the unit of quantity; {range}.",
        examples=[0.038109],
        ge=0,
        le=1e6,
    )
    phase_deg: float = Field(
        description="Phase [degrees], of A·cos(ωt − phase), t from the passage of the zero mark; {range}.",
        examples=[18.7489],
        ge=-360,
        le=360,
    )


class Trial(Table):
    """A known mass that was on in this run."""

    inline: ClassVar[bool] = True

    plane: Plane = Field(description="The correction plane it was in: left or right.", examples=["left"])
    mass_g: float = Field(
        description="Its mass [g]; {range}, negative: metal that was taken off.",
        examples=[10.0],
        ge=-1e6,
        le=1e6,
        json_schema_extra=usual(0.01, 5000),
    )
    angle_deg: float = Field(
        description="Where it was, from the zero mark AGAINST rotation [degrees]; {range}.",
        examples=[0.0],
        ge=-360,
        le=360,
    )
    radius_mm: float | None = Field(
        default=None,
        description="Radius it was at [mm]; {range}. Without it: the correction radius of its plane.",
        examples=[120.0],
        gt=0,
        le=1e5,
        json_schema_extra=usual(5, 5000),
    )

    @model_validator(mode="after")
    def _is_a_mass(self) -> Self:
        if self.mass_g == 0:
            raise problem("a trial mass of nothing", "mass_g", remedy="leave trial out, or give the mass")
        return self


def _listed(value: object) -> object:
    """A single table as a list of one."""
    return [value] if isinstance(value, dict) else value


class Run(Table):
    """A run on the rig at steady speed; several are averaged as vectors."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"speed_rpm", "left", "right"})

    speed_rpm: float | None = Field(
        default=None,
        description="Speed of rotation [rpm]; {range}. With file it may be left out: the marks tell it.",
        examples=[3000.0],
        gt=0,
        le=1e6,
        json_schema_extra=usual(60, 60000),
    )
    quantity: Quantity = Field(
        description="What the sensors read: displacement (mm), velocity (mm/s) or acceleration (m/s²), all 0–peak. It "
        "decides the side: an acceleration points opposite to the displacement.",
        examples=["displacement"],
    )
    left: Reading | None = Field(
        default=None,
        description="Left support, x = A·cos(ωt − phase), t from the passage of the zero mark at its sensor.",
    )
    right: Reading | None = Field(
        default=None, description="Right support, likewise.", examples=[{"amplitude": 0.031642, "phase_deg": 152.7485}]
    )
    file: str | None = Field(
        default=None,
        description="Instead of left and right: a recorded run, CSV with the columns time (s), left, right (in the "
        "unit of quantity) and mark (pulses, either polarity), beside this file.",
        examples=["run1.csv"],
        min_length=1,
    )
    mark_edge: MarkEdge | None = Field(
        default=None,
        description="With file: what of a pulse is the mark's passage: its leading edge, its middle or its trailing "
        "edge. Without it: the leading edge of a square pulse, the middle of a rounded one.",
        examples=["leading"],
    )
    sensor_to_mark_deg: float = Field(
        default=0.0,
        description="Place of the zero-mark sensor from the vibration sensors, in the sense of rotation [degrees]; "
        "{range}. Default: {default}, in line with them.",
        ge=-360,
        le=360,
    )
    trial: Annotated[
        tuple[Trial, ...],
        Field(strict=False, max_length=20),
        BeforeValidator(_listed, json_schema_input_type=Trial | Annotated[tuple[Trial, ...], Field(max_length=20)]),
    ] = Field(
        default=(),
        description="Known masses that were on, one table or a list of them: plane, mass_g, angle_deg. For influence "
        "coefficients.",
    )

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """A record takes the place of readings, and they of it."""
        if key == "file":
            return ("left", "right")
        return ("file", "mark_edge") if key in ("left", "right") else ()

    @model_validator(mode="after")
    def _read_or_recorded(self) -> Self:
        if self.file is None:
            for key in ("speed_rpm", "left", "right"):
                if getattr(self, key) is None:
                    example = "3000.0" if key == "speed_rpm" else "{ amplitude = …, phase_deg = … }"
                    raise problem("the key is missing", key, remedy=f"add {key} = {example}, or file, a recorded run")
            if self.mark_edge is not None:
                raise problem("mark_edge goes with file only", "mark_edge", remedy="leave mark_edge out")
        for key in ("left", "right"):
            if self.file is not None and getattr(self, key) is not None:
                raise problem("a run is read or recorded, not both", key, remedy=f"leave {key} out, or file")
        return self
