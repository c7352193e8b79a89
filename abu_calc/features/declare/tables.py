"""Tables of a file that lists the recordings of a type test: runs, calibrator runs, what they have in common."""

from typing import Annotated, ClassVar, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.table import Many, Name, Table, entry, problem
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

    name: Name = entry("type test", example="grinder 7, prototype", min_length=1).means(
        "Name of the machine, as reports print it."
    )  # fmt: skip
    automatic_balancing: bool = entry(False).means(
        "true: the machine balances itself, so that its declared value is 1.3 times the measured one. Default: "
        "{default}."
    )


class RecordedFile(Table):
    """A recorded file and how it is read."""

    file: Name = entry(example="operator1-run1.csv", min_length=1).means(
        "CSV or WAV file: its whole path, or beside this file."
    )
    columns: Columns | None = entry(None, example=["ax_m_per_s2", "ay_m_per_s2", "az_m_per_s2"]).means(
        "Columns or channels of this handle, by name or number from 1. Without it: all columns that hold a motion."
    )
    sensitivity: Sensitivities | None = Field(default=None, description=SENSITIVITY, examples=["100 mV/g"])
    quantity: Literal["acceleration", "velocity", "displacement"] | None = entry(None, example="acceleration").means(
        "Quantity, if the file does not name it: acceleration, velocity or displacement."
    )
    scale: float | None = entry(None, gt=0, le=1e6, usual=(1e-6, 1e5), example=9.80665).means(
        "SI value (m/s², m/s, m) of one unit of the file; for WAV, of full scale; {range}."
    )
    full_scale_mV: float | None = entry(None, gt=0, le=1e6, usual=(1, 1e5), example=1000.0).means(
        "Voltage at full scale of a WAV file with sensitivities [mV]; {range}."
    )


class RecordedRun(RecordedFile):
    """One recorded run: one operator, one orientation of the test wheel; three axes of a handle."""

    operator: Text | int = entry("1", example="A").means("Operator, by name or number. Default: {default}.")
    run: Annotated[int, Field(ge=1, le=100_000)] | None = entry(None, example=1).means(
        "Number of the run. Without it: by the order in the file."
    )
    handle: Name | None = entry(None, example="front", min_length=1).means(
        "Handle. Without it: as the columns name it, such as front_ax_m_per_s2."
    )
    axis: Literal["x", "y", "z"] | None = entry(None, example="x").means(
        "Axis of a file with a single one; the axes of a run then stand in several files."
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

    acceleration_m_per_s2: float = entry(10.0, gt=0, le=1e4, usual=(1, 100)).means(
        "Acceleration of the calibrator, rms [m/s²]; {range}. Default: {default}."
    )


class RecordingsFile(Table):
    """Recordings of a type test."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"type_test"})

    type_test: RecordedTest = Field(default_factory=RecordedTest)
    recording: Many[RecordedRun] = entry(min_length=1, max_length=MOST_FILES).means(
        "Runs: [[recording]], one or more, up to 2000."
    )
    calibration: Many[Calibration] = entry((), max_length=100).means(
        "Runs on a calibrator: [[calibration]], up to 100."
    )
