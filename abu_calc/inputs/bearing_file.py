"""A file for bearing seats alone, and the tables it shares with a whole machine's."""

import sys
from typing import Annotated, Final, Protocol, Self

from pydantic import AfterValidator, Field, WithJsonSchema, model_validator

from abu_calc.inputs.reading.table import Many, Name, Table, entry, problem
from abu_calc.inputs.reading.text import BARE_KEY, is_number, shown_short
from abu_calc.inputs.rolling_bearing import MOST_BEARINGS, Bearing

NAME = "Name of the machine, as reports print it."

TOLERANCE = "tolerance"


MOST_EXPECTED: Final = 1000
LONGEST_PATH: Final = 200
MOST_DIGITS: Final = 6
"""Most digits of a place in a list."""


def _checked_expectations(expected: dict[str, object]) -> dict[str, object]:
    if len(expected) > MOST_EXPECTED:
        raise problem("too many expected values", found=str(len(expected)), allowed=f"at most {MOST_EXPECTED}")
    for path, value in expected.items():
        if path == TOLERANCE and isinstance(value, dict):
            _check_tolerances(value, expected)
            continue
        _check_path(path)
        if isinstance(value, dict):
            raise problem(EXPECTED_KINDS, path, found="a table", remedy=f'put the whole path in quotes: "{path}.…" = …')
        for each in value if isinstance(value, list) else [value]:
            _check_value(path, each)
    return expected


def _check_path(path: str) -> None:
    """Refuse what can be no path in a result: keys of plain letters, places in lists, points between them."""
    parts = path.split(".")
    plain = all(BARE_KEY.fullmatch(part) for part in parts)
    if not plain or len(path) > LONGEST_PATH or any(part.isdigit() and len(part) > MOST_DIGITS for part in parts):
        raise problem(
            "not a path in a result",
            path,
            allowed="keys and places in lists with points between them",
            remedy='such as "autobalancer.ball_count" or "fits.0.fit"',
        )


def _check_value(path: str, value: object) -> None:
    """Refuse what no result holds: dates and times, tables, numbers that are not finite or beyond all floats."""
    if not isinstance(value, (int, float, str, list)):
        raise problem(EXPECTED_KINDS, path, found=shown_short(value))
    if isinstance(value, list):
        for each in value:
            _check_value(path, each)
    elif (
        isinstance(value, (int, float))
        and not isinstance(value, bool)
        and not (is_number(value) and abs(value) <= sys.float_info.max)
    ):
        raise problem("a finite number is expected", path, found=shown_short(value))


EXPECTED_KINDS: Final = "an expected value is a number, text, true, false or a list of them"


def _check_tolerances(tolerances: dict[str, object], expected: dict[str, object]) -> None:
    for path, value in tolerances.items():
        if not is_number(value) or not isinstance(value, (int, float)) or value < 0:
            raise problem(
                "a tolerance is a relative difference", TOLERANCE, path, found=shown_short(value), allowed="at least 0"
            )
        if path == TOLERANCE or path not in expected:
            raise problem(
                "this tolerance has no expected value",
                TOLERANCE,
                path,
                remedy=f'add "{path}" = … to [expected], or remove the tolerance',
            )


_SCALARS = [{"type": kind} for kind in ("number", "string", "boolean", "array")]
Expected = Annotated[
    dict[str, object],
    AfterValidator(_checked_expectations),
    WithJsonSchema(
        {
            "type": "object",
            "properties": {
                TOLERANCE: {
                    "anyOf": [{"type": "object", "additionalProperties": {"type": "number", "minimum": 0}}, *_SCALARS],
                    "description": "Relative tolerance per path of [expected].",
                }
            },
            "additionalProperties": {"anyOf": _SCALARS},
        }
    ),
]

EXPECTED = (
    'What `abu verify FILE` holds the file to: "quoted.path.in.result" = value; relative tolerances per path stand in '
    "[expected.tolerance]."
)


class MachineName(Table):
    """The machine, of which a file for bearing seats alone needs the name only."""

    name: Name = Field(description=NAME, examples=["fleshing roll"], min_length=1)


class Limits(Table):
    """Limits of the finished machine."""

    vibration_level_db: float = entry(109.0, ge=0, le=200, usual=(85, 130)).means(
        "Highest permitted velocity level [dB re 5e-8 m/s]; {range}. Default: {default}, the limit of GOST 17770-86 "
        "above 16 Hz."
    )
    a_hv_m_per_s2: float | None = entry(None, gt=0, le=1000, usual=(0.5, 30), example=2.5).means(
        "Highest permitted vector total a_hv of the weighted accelerations, at the highest handle, with the "
        "autobalancer, idle [m/s²]; {range}. When given, it is checked."
    )
    quiet_time_s: float = entry(1.0, gt=0, le=3600, usual=(0.05, 30)).means(
        "Longest permitted quiet time [s]: from full speed until the machine stays as quiet as it must be; {range}. "
        "Default: {default}, as measured on hand grinders (Kladiev 1996: under 1 s)."
    )
    settling_time_s: float | None = entry(None, gt=0, le=3600, usual=(0.05, 30), example=1.0).means(
        "Another name of quiet_time_s [s]; {range}."
    )
    rest_time_s: float | None = entry(None, gt=0, le=3600, usual=(0.05, 30), example=2.0).means(
        "Longest permitted rest time [s]: from full speed until the balls keep their places; {range}. When given, it "
        "is checked."
    )

    @property
    def longest_quiet_time(self) -> float:
        """Longest permitted quiet time [s], by whichever of its names."""
        return self.quiet_time_s if self.settling_time_s is None else self.settling_time_s

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """One name takes the place of the other."""
        return tuple(name for name in QUIET_TIMES if key in QUIET_TIMES and name != key)

    def unused(self) -> frozenset[str]:
        """The default, where the other name has a value."""
        return frozenset() if self.settling_time_s is None else frozenset({"quiet_time_s"})

    @model_validator(mode="after")
    def _one_name(self) -> Self:
        if self.model_fields_set.issuperset(QUIET_TIMES):
            raise problem(
                "two names of one limit",
                "settling_time_s",
                found="both quiet_time_s and settling_time_s",
                allowed="one of them",
                remedy="keep quiet_time_s",
            )
        return self


QUIET_TIMES: Final = ("quiet_time_s", "settling_time_s")


class BearingFile(Table):
    """Bearings alone, for `abu check-fit`."""

    machine: MachineName
    bearing: Many[Bearing] = entry(min_length=1, max_length=MOST_BEARINGS).means(
        "Bearings and their seats: [[bearing]], one or more, up to 100."
    )
    limits: Limits = Field(default_factory=Limits)
    expected: Expected = Field(default_factory=dict, description=EXPECTED)


class HasExpectations(Protocol):
    """A file that `abu verify` can hold to results."""

    @property
    def expected(self) -> dict[str, object]:
        """[expected] as it is written."""


def expected_values(file: HasExpectations) -> dict[str, object]:
    """Values that `abu verify` compares: path in the result → value."""
    return {path: value for path, value in file.expected.items() if not isinstance(value, dict)}


def expected_tolerances(file: HasExpectations) -> dict[str, float]:
    """Path in the result → relative tolerance, where one is given."""
    given = file.expected.get(TOLERANCE)
    return dict(given) if isinstance(given, dict) else {}
