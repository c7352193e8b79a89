"""The table of a level that was measured in an octave, for `abu factory`: machine files hold any number of them."""

from collections.abc import Iterator
from typing import Annotated, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.inputs.reading.table import Name, Table, entry, problem
from abu_calc.standards.vibration import octaves

MOST_MEASURED: Final = 200
LEVELS: Final = ("level_db", "level_without_db", "lowered_db")
"""Keys that hold a lowest and a highest value."""
_Level = Annotated[float, Field(ge=0, le=200)]
_Change = Annotated[float, Field(ge=-60, le=100)]
_PAIR: Final = Field(strict=False, min_length=2, max_length=2)
_Levels = Annotated[tuple[_Level, ...], _PAIR] | None
_Changes = Annotated[tuple[_Change, ...], _PAIR] | None


class MeasuredOctave(Table):
    """A level measured in one octave at one place along one axis. `abu factory` compares it with the prediction."""

    place: Name = entry(example="handle", min_length=1).means(
        "Place of the sensor: the name of a [[machine.handle]], or the place in words."
    )
    axis: Literal["x", "y", "z"] = entry(example="y").means(
        "Axis of the sensor: x along the work, y normal to it, z along the spindle."
    )
    state: Literal["idle", "loaded", "not said"] = entry(example="idle").means(
        'State of the machine: idle, loaded, or "not said" if the source does not give it.'
    )
    octave_hz: float = entry(gt=0, le=1000, usual=(16, 500), example=125.0).means(
        "Nominal centre of the octave [Hz]: 8, 16, 31.5, 63, 125, 250, 500 or 1000, {usual}."
    )
    level_db: _Levels = entry(None, usual=(60, 140), example=[102.0, 103.0]).means(
        "Lowest and highest velocity level with the autobalancer [dB re 5e-8 m/s]; {range}."
    )
    level_without_db: _Levels = entry(None, usual=(60, 140), example=[108.0, 111.0]).means(
        "Lowest and highest velocity level without the autobalancer [dB re 5e-8 m/s]; {range}."
    )
    lowered_db: _Changes = entry(None, usual=(0.5, 40), example=[6.0, 10.0]).means(
        "Least and most by which the autobalancer lowers the level [dB]; {range}; below zero: it rises."
    )
    source: Name = entry(example="own measurement", min_length=1).means(
        "Source of the measurement: author and year, standard, or own measurement with its date."
    )
    remark: Name | None = entry(None, example="The operator changed.", min_length=1).means(
        "Remark on the measurement, printed below the table."
    )

    @property
    def spans(self) -> Iterator[tuple[str, tuple[float, float]]]:
        """Keys of the levels that are given, with lowest and highest value."""
        for key in LEVELS:
            if (span := getattr(self, key)) is not None:
                yield key, (span[0], span[1])

    @model_validator(mode="after")
    def _known_octave(self) -> Self:
        nominal = [band.nominal for band in octaves()]
        if self.octave_hz not in nominal:
            nearest = min(nominal, key=lambda centre: abs(centre - self.octave_hz))
            raise problem(
                "not the nominal centre of an octave",
                "octave_hz",
                found=f"{self.octave_hz:g} Hz",
                allowed=", ".join(f"{centre:g}" for centre in nominal),
                remedy=f"write octave_hz = {nearest:g}",
            )
        return self

    @model_validator(mode="after")
    def _levels_ascend(self) -> Self:
        for key, (low, high) in self.spans:
            if low > high:
                raise problem(
                    "lowest value first", key, found=f"[{low:g}, {high:g}]", remedy=f"write {key} = [{high:g}, {low:g}]"
                )
        return self

    @model_validator(mode="after")
    def _something_is_told(self) -> Self:
        if not any(True for _ in self.spans) and self.remark is None:
            raise problem(
                "a measurement needs a level or a remark",
                found="none",
                allowed="one or more of " + ", ".join(LEVELS),
                remedy="add level_db = [lowest, highest], or a remark on a peak without a number",
            )
        return self
