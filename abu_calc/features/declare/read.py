"""Reading of the recordings of a type test: a file that lists them, or recorded files alone.

Tables of a file that lists the recordings of a type test: runs, calibrator runs, what they have in common.
"""

import json
import os
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.document import Document, FileReading, document_from, parsed_overrides, validate
from abu_calc.inputs.reading.kinds import refuse_others
from abu_calc.inputs.reading.table import Many, Name, Table, entry, problem
from abu_calc.inputs.reading.text import shown_short
from abu_calc.inputs.recording import Recording
from abu_calc.inputs.recording_files import is_recording, read_recording
from abu_calc.inputs.sensitivity import ALLOWED, sensitivities

if TYPE_CHECKING:
    from abu_calc.inputs.reading.overrides import Override


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


@dataclass(frozen=True)
class Recordings(FileReading):
    """A file that lists recordings; `tables` are what stands in it."""

    __repr__ = FileReading.__repr__

    tables: RecordingsFile

    @property
    def title(self) -> str:
        """The machine's name."""
        return self.tables.type_test.name


@dataclass(frozen=True, eq=False)
class Run:
    """One recorded axis or several of one handle in one run."""

    operator: str
    number: int
    handle: str
    axis: str | None
    recording: Recording
    indices: tuple[int, ...]
    """Axes of the recording that belong to it."""
    place: Place


def read_recordings(source: str | os.PathLike[str], overrides: Sequence[str] = ()) -> Recordings:
    """Reads a file that lists recordings; raises InputError with file, line, key and remedy for what is wrong."""
    with document_from(source) as document:
        return recordings_from(document, parsed_overrides(overrides))


def recordings_from(document: Document, overrides: "Sequence[Override]" = ()) -> Recordings:
    """The recordings of a document that is open already; raises as `read_recordings` does."""
    refuse_others(document, "recordings")
    tables, reading = validate(document, overrides, RecordingsFile, lambda _: RecordingsFile)
    return Recordings(**vars(reading), tables=tables)


def of_files(files: Sequence[str], sensitivity: Sequence[str] = ()) -> Recordings:
    """Recorded files alone, each a run of one operator; or the one file that lists them.

    `sensitivity`: of recorded files alone, for all channels or as CHANNEL=VALUE.
    """
    listing = [file for file in files if not is_recording(file)]
    if len(files) == 1 and listing:
        if sensitivity:
            raise InputError(
                "a file that lists recordings gives the sensitivities itself", place=Place(key="sensitivity"),
                remedy="Write sensitivity = … into each [[recording]].",
            )  # fmt: skip
        return read_recordings(files[0])
    if listing:
        raise InputError(
            "a file that lists recordings stands alone", place=Place(key="recordings"), found=listing[0],
            remedy="Give it once, or CSV and WAV files alone.",
        )  # fmt: skip
    if not files:
        raise InputError("no recordings", place=Place(key="recordings"), remedy="Name CSV or WAV files.")
    given = f"sensitivity = {_toml(sensitivity)}\n" if sensitivity else ""
    text = "".join(f"[[recording]]\nfile = {json.dumps(file)}\n{given}" for file in files)
    return recordings_from(Document("", text, "", tomllib.loads(text)))


def _toml(sensitivity: Sequence[str]) -> str:
    """Sensitivities of a command line as an entry: one for all, or a table by channel."""
    pairs = [text.rpartition("=") for text in sensitivity]
    if len(pairs) == 1 and not pairs[0][1]:
        return json.dumps(pairs[0][2])
    return "{ " + ", ".join(f"{json.dumps(name.strip())} = {json.dumps(value)}" for name, _, value in pairs) + " }"


def loaded(source: Recordings, entry: RecordedFile, place: Place) -> Recording:
    """The recording of an entry; an error of the entry's own keys names its place in the list."""
    path = str(Path(source.file).absolute().parent / entry.file) if source.file else entry.file
    columns = tuple(map(str, entry.columns or ()))
    try:
        return read_recording(
            path, entry.quantity, entry.scale, columns, sensitivity=_sensitivity(entry, columns),
            full_scale_mV=entry.full_scale_mV, keep_clipped=True,
        )  # fmt: skip
    except InputError as error:
        error.remedy = error.remedy and remedy_in_list(error.remedy)
        if error.place.file is None:
            raise error.at(place) from None
        raise


KEYS: Final = {"channels": "columns", "handle": "handle", "scale": "scale", "quantity": "quantity"}
"""Keys of a [[recording]] by the options of `abu levels` that do the same."""


def remedy_in_list(text: str) -> str:
    """Text on options of `abu levels` as one on the keys of a [[recording]].

    >>> remedy_in_list("A sensor that is not connected? Leave the channel out: --channels (Python: channels=).")
    'A sensor that is not connected? Specify columns in [[recording]]: `abu init --recordings FILE` writes such a list.'
    """
    kept = [sentence for sentence in re.split(r"(?<=[.?]) ", text) if "--" not in sentence]
    keys = [key for option, key in KEYS.items() if f"--{option}" in text]
    if not keys:
        return text
    return " ".join(
        [*kept, f"Specify {' or '.join(keys)} in [[recording]]: `abu init --recordings FILE` writes such a list."]
    )


def remark_in_list(text: str) -> str:
    """Remark on options of `abu levels` as one on the keys of a [[recording]].

    >>> remark_in_list("ax names no unit and is taken in m/s²; --scale says otherwise.")
    'ax names no unit and is taken in m/s²; scale in [[recording]] says otherwise.'
    """
    text = re.sub(r"say --quantity (\w+)", r'specify quantity = "\1" in [[recording]]', text)
    return re.sub(r"--(channels|handle|scale|quantity)\b", lambda found: f"{KEYS[found[1]]} in [[recording]]", text)


def _sensitivity(entry: RecordedFile, columns: Sequence[str]) -> float | str | dict[str, float | str] | None:
    """Sensitivities by channel where there is a list of them."""
    given = entry.sensitivity
    if isinstance(given, tuple):
        names = columns or [str(k) for k in range(1, len(given) + 1)]
        if len(names) != len(given):
            raise InputError(
                "as many sensitivities as columns are expected", place=Place(key="sensitivity"), found=f"{len(given)}",
                allowed=f"{len(names)}",
            )  # fmt: skip
        return dict(zip(names, given, strict=True))
    return dict(given) if isinstance(given, Mapping) else given


def runs_of(source: Recordings) -> Iterator[Run]:
    """Every run of the list, a file with several handles as one for each of them."""
    counts: dict[tuple[str, str], int] = {}
    for index, listed in enumerate(source.tables.recording):
        place = Place(source.file or None, key=f"recording[{index}]")
        recording = loaded(source, listed, place)
        operator = str(listed.operator)
        for name, indices in _handles(listed, recording, place).items():
            counts[operator, name] = counts.get((operator, name), 0) + 1
            number = counts[operator, name] if listed.run is None else listed.run
            if listed.axis is not None and len(indices) > 1:
                raise InputError(
                    "axis is for a file with one axis", place=place, found=", ".join(recording.names),
                    remedy="Leave axis out, or list one column.",
                )  # fmt: skip
            yield Run(operator, number, name, listed.axis, recording, indices, place)


def _handles(entry: RecordedRun, recording: Recording, place: Place) -> dict[str, tuple[int, ...]]:
    """Axes of each handle of a file; the entry's handle if the columns name none, or if it is one of theirs."""
    placed = recording.axes_by_handle
    if entry.handle is None:
        return {name or "handle": indices for name, indices in placed.items()}
    if len(placed) == 1:
        return {entry.handle: next(iter(placed.values()))}
    if entry.handle not in placed:
        raise InputError(
            "the columns name other handles", place=place, found=entry.handle, allowed=", ".join(placed),
            remedy="List its columns, or leave handle out to take all of them.",
        )  # fmt: skip
    return {entry.handle: placed[entry.handle]}
