"""Tables of a file that lists the recordings of a type test: runs, calibrator runs, what they have in common."""

from typing import Annotated, ClassVar, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.table import Name, Table, problem, usual
from abu_calc.inputs.reading.text import shown_short
from abu_calc.inputs.sensitivity import ALLOWED, sensitivities

MOST_FILES = 2000
Text = Annotated[str, Field(min_length=1, max_length=200)]
SensitivityValue = float | Text
Columns = Annotated[tuple[Text | int, ...], Field(strict=False, min_length=1, max_length=3)]


def _readable(given: object) -> object:
    """Sensitivities that can be read; raises the error about the others."""
    values = list(given.values()) if isinstance(given, dict) else given if isinstance(given, (list, tuple)) else [given]
    try:
        if values and all(isinstance(value, (int, float, str)) and not isinstance(value, bool) for value in values):
            sensitivities({str(number): value for number, value in enumerate(values)})
            return given
    except InputError:
        pass
    raise problem("not a sensitivity", found=shown_short(given), allowed=ALLOWED)


Sensitivities = Annotated[
    SensitivityValue
    | Annotated[tuple[SensitivityValue, ...], Field(strict=False, min_length=1, max_length=3)]
    | dict[Text, SensitivityValue],
    BeforeValidator(_readable),
]
SENSITIVITY = (
    "Sensitivity of sensors that were recorded in V or mV: mV per m/s², or a text with its unit such as "
    '"100 mV/g"; for all channels, a list in the order of the columns, or a table by channel.'
)


class RecordedTest(Table):
    """What all runs of the type test have in common."""

    __test__: ClassVar[bool] = False

    name: Name = Field(
        default="type test", description="Name of the machine, as reports print it.", examples=["grinder 7, prototype"],
        min_length=1,
    )  # fmt: skip
    automatic_balancing: bool = Field(
        default=False,
        description="true: the machine balances itself, so that its declared value is 1.3 times the measured one. "
        "Default: {default}.",
    )


class RecordedFile(Table):
    """A recorded file and how it is read."""

    file: Name = Field(
        description="CSV or WAV file: its whole path, or beside this file.",
        examples=["operator1-run1.csv"],
        min_length=1,
    )
    columns: Columns | None = Field(
        default=None,
        description="Columns or channels of this handle, by name or number from 1. Without it: all columns that hold a "
        "motion.",
        examples=[["ax_m_per_s2", "ay_m_per_s2", "az_m_per_s2"]],
    )
    sensitivity: Sensitivities | None = Field(default=None, description=SENSITIVITY, examples=["100 mV/g"])
    quantity: Literal["acceleration", "velocity", "displacement"] | None = Field(
        default=None,
        description="Quantity, if the file does not name it: acceleration, velocity or displacement.",
        examples=["acceleration"],
    )
    scale: float | None = Field(
        default=None,
        description="SI value (m/s², m/s, m) of one unit of the file; for WAV, of full scale; {range}.",
        examples=[9.80665],
        gt=0,
        le=1e6,
        json_schema_extra=usual(1e-6, 1e5),
    )
    full_scale_mV: float | None = Field(
        default=None,
        description="Voltage at full scale of a WAV file with sensitivities [mV]; {range}.",
        examples=[1000.0],
        gt=0,
        le=1e6,
        json_schema_extra=usual(1, 1e5),
    )


class RecordedRun(RecordedFile):
    """One recorded run: one operator, one orientation of the test wheel; three axes of a handle."""

    operator: Text | int = Field(
        default="1", description="Operator, by name or number. Default: {default}.", examples=["A"]
    )
    run: Annotated[int, Field(ge=1, le=100_000)] | None = Field(
        default=None, description="Number of the run. Without it: by the order in the file.", examples=[1]
    )
    handle: Name | None = Field(
        default=None,
        description="Handle. Without it: as the columns name it, such as front_ax_m_per_s2.",
        examples=["front"],
        min_length=1,
    )
    axis: Literal["x", "y", "z"] | None = Field(
        default=None,
        description="Axis of a file with a single one; the axes of a run then stand in several files.",
        examples=["x"],
    )

    @model_validator(mode="after")
    def _axis_goes_with_one_column(self) -> Self:
        if self.axis is not None and self.columns is not None and len(self.columns) > 1:
            raise problem(
                "axis is for a file with one axis", "axis", found=f"{len(self.columns)} columns",
                remedy="leave axis out, or list one column",
            )  # fmt: skip
        if self.axis is not None and self.run is None:
            raise problem("axis needs the number of its run", "axis", remedy="add run")
        return self


class Calibration(RecordedFile):
    """A recording of the calibrator, for the sensitivity of its channels."""

    acceleration_m_per_s2: float = Field(
        default=10.0,
        description="Acceleration of the calibrator, rms [m/s²]; {range}. Default: {default}.",
        gt=0,
        le=1e4,
        json_schema_extra=usual(1, 100),
    )


class RecordingsFile(Table):
    """Recordings of a type test."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"type_test"})

    type_test: RecordedTest = Field(default_factory=RecordedTest)
    recording: Annotated[tuple[RecordedRun, ...], Field(strict=False, min_length=1, max_length=MOST_FILES)] = Field(
        description="Runs: [[recording]], one or more, up to 2000."
    )
    calibration: Annotated[tuple[Calibration, ...], Field(strict=False, max_length=100)] = Field(
        default=(), description="Runs on a calibrator: [[calibration]], up to 100."
    )
