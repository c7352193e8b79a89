"""File of influence coefficients: written from trial runs, used for the next rotor of the kind.

    [coefficients]
    rotor = "fan"
    planes = ["left", "right"]
    sensors = ["left", "right"]
    [[coefficients.at]]
    speed_rpm = 1500.0
    influence_um_per_g_mm = [[[0.1, -0.2], …], …]       rows: sensors, columns: planes; real and imaginary part
    standard_error_um_per_g_mm = [[0.001, …], …]

A coefficient is the displacement of a sensor per imbalance of a plane, both as complex numbers of formulas.py: phases
lag, angles count against rotation, sensor_to_mark_deg is taken into account.
"""

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Final, Self

from pydantic import Field, model_validator

from abu_calc.features.balancing.errors import ErrorContribution, size
from abu_calc.features.balancing.methods import Solution
from abu_calc.features.balancing.runs import Balancing, Coefficients
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.inputs.reading.table import LEAST, Many, Name, Table, entry, problem

if TYPE_CHECKING:
    from abu_calc.inputs.reading.document import Document

_Number = Annotated[float, Field(ge=-1e12, le=1e12)]
_Error = Annotated[float, Field(ge=0, le=1e12)]
_Complex = Annotated[tuple[_Number, _Number], Field(strict=False)]
_Row = Annotated[tuple[_Complex, ...], Field(strict=False, min_length=1, max_length=2)]
_ErrorRow = Annotated[tuple[_Error, ...], Field(strict=False, min_length=1, max_length=2)]
_Names = Annotated[tuple[Name, ...], Field(strict=False, min_length=1, max_length=40)]


class AtSpeed(Table):
    """Influence coefficients at one speed."""

    speed_rpm: float = Field(description="Speed [rpm]; {range}.", gt=0, le=1e6)
    influence_um_per_g_mm: Many[_Row] = entry(min_length=1, max_length=40).means(
        "Displacement per imbalance, real and imaginary part; rows: sensors, columns: planes."
    )
    standard_error_um_per_g_mm: Annotated[tuple[_ErrorRow, ...], Field(strict=False, min_length=1, max_length=40)] = (
        Field(description="Standard error of each.")
    )


class CoefficientsTable(Table):
    """Influence coefficients of a kind of rotor."""

    rotor: Name = Field(default="roll", description="Name of the rotor that was run with trial masses.")
    planes: _Names = Field(description="Names of the correction planes.")
    sensors: _Names = Field(description="Names of the sensors.")
    at: Many[AtSpeed] = entry(min_length=1, max_length=100).means("Coefficients at each speed.")

    @model_validator(mode="after")
    def _has_all_rows(self) -> Self:
        for index, own in enumerate(self.at):
            for key, rows in (
                ("influence_um_per_g_mm", own.influence_um_per_g_mm),
                ("standard_error_um_per_g_mm", own.standard_error_um_per_g_mm),
            ):
                if len(rows) != len(self.sensors) or any(len(row) != len(self.planes) for row in rows):
                    raise problem(
                        "not one number for each sensor and plane", "at", index, key,
                        allowed=f"{len(self.sensors)} rows of {len(self.planes)}", remedy="save the coefficients anew",
                    )  # fmt: skip
        return self


class CoefficientsFile(Table):
    """A file of influence coefficients."""

    coefficients: CoefficientsTable


@dataclass(frozen=True)
class Stored:
    """Influence coefficients of a file, and what they are of."""

    file: str
    sha256: str
    rotor: str
    planes: tuple[str, ...]
    sensors: tuple[str, ...]
    values: Coefficients

    def refuse_others(self, planes: Sequence[str], sensors: Sequence[str]) -> None:
        """Raise InputError for a file of readings with other planes or sensors."""
        for what, own, found in (("planes", self.planes, planes), ("sensors", self.sensors, sensors)):
            if tuple(own) != tuple(found):
                raise InputError(
                    f"the readings have other {what} than the stored coefficients",
                    place=Place(self.file, key=f"coefficients.{what}"), found=", ".join(found), allowed=", ".join(own),
                    remedy="use the coefficients of this rig, or make trial runs",
                )  # fmt: skip


def read_coefficients(source: str | os.PathLike[str]) -> Stored:
    """Coefficients of a file. Raises InputError with file, line and key."""
    from abu_calc.inputs.reading.document import named, open_document

    return coefficients_from(open_document(named(source)))


def coefficients_from(document: "Document") -> Stored:
    """Coefficients of a document that is open already; raises as `read_coefficients` does."""
    from abu_calc.inputs.reading.document import validate

    if "coefficients" not in document.content:
        raise InputError(
            "this file holds no influence coefficients", place=Place(document.file),
            remedy="`abu balance READINGS --save-coefficients FILE` writes one from trial runs",
        )  # fmt: skip
    tables, reading = validate(document, (), CoefficientsFile, lambda _: CoefficientsFile)
    own = tables.coefficients
    values = Coefficients(
        tuple(at.speed for at in own.at),
        tuple(tuple(tuple(complex(*value) for value in row) for row in at.influence_um_per_g_mm) for at in own.at),
        tuple(at.standard_error_um_per_g_mm for at in own.at),
    )
    return Stored(reading.file, reading.sha256, own.rotor, own.planes, own.sensors, values)


def coefficients_of(case: Balancing, solution: Solution, by: Sequence[ErrorContribution]) -> Coefficients:
    """Coefficients of trial runs at each speed, with their standard errors."""
    firsts = [group[0] for group in case.speed_groups]
    errors = tuple(
        tuple(
            tuple(
                size(change.influences[first][i][k] for change in by) / 2**0.5
                for k in range(len(row))
            )
            for i, row in enumerate(solution.influences[first])
        )
        for first in firsts
    )  # fmt: skip
    return Coefficients(
        tuple(case.runs[first].speed for first in firsts), tuple(solution.influences[first] for first in firsts), errors
    )


def coefficients_text(rotor: str, planes: Sequence[str], sensors: Sequence[str], values: Coefficients) -> str:
    """Text of a file of coefficients; it reads back to the same numbers."""
    import tomli_w

    at = [
        {
            "speed_rpm": float(f"{from_si(speed, 'rpm'):.12g}"),
            "influence_um_per_g_mm": [[[_told(value.real), _told(value.imag)] for value in row] for row in matrix],
            "standard_error_um_per_g_mm": [[_told(error) for error in row] for row in errors],
        }
        for speed, matrix, errors in zip(values.speeds, values.matrices, values.errors, strict=True)
    ]
    table = {"rotor": rotor, "planes": list(planes), "sensors": list(sensors), "at": at}
    return HEAD + tomli_w.dumps({"coefficients": table})


def _told(value: float) -> float:
    """A number, or zero for one that files are not read with."""
    return value if abs(value) >= LEAST else 0.0


HEAD: Final = """\
# Influence coefficients, written by `abu balance READINGS --save-coefficients FILE`.
# Use them for the next rotor of the kind: abu balance READINGS --coefficients FILE
# Rows are sensors, columns are planes; real and imaginary part of displacement per imbalance.
# Phases lag, angles count against rotation.
"""
