"""Entries of a file that change it: as options, in words, and put into its tables and sized."""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Final, NamedTuple

from abu_calc.foundation.errors import AbuError, shell_word
from abu_calc.foundation.units import from_si
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.reading.overrides import apply, overrides_of
from abu_calc.sizing.balls import Candidate, choose_for_motor
from abu_calc.sizing.case import Case, read_case
from abu_calc.sizing.imbalance import find_imbalance

Entries = Mapping[str, object]
"""Values by key path: {"autobalancer.race_eccentricity_mm": 0.005}."""

PINS: Final = ("ball_count", "ball_diameter_mm", "race_radius_mm")
"""Keys of [autobalancer] that pin the choice of balls and race."""

CALCULATED: Final = "calculated"
SIMULATED: Final = "simulated"


class Followed(NamedTuple):
    """A case with replaced entries, as sizing reads it, its imbalance [kg m] and its autobalancer."""

    case: Case
    imbalance: float
    candidate: Candidate


def overrides(entries: Entries) -> tuple[str, ...]:
    """Entries as `--set` takes them.

    >>> overrides({"autobalancer.design": "light", "machine.speed_range_rpm": [2600.0, 9000.0]})
    ('autobalancer.design=light', 'machine.speed_range_rpm=[2600,9000]')
    """
    return tuple(f"{key}={plain(value)}" for key, value in entries.items())


def set_options(entries: Entries) -> str:
    """Entries as options of a command line.

    >>> set_options({"oil.grade": "VG 100", "oil.fill_ml": 1.0})
    '--set "oil.grade=VG 100" --set oil.fill_ml=1'
    """
    return " ".join(f"--set {shell_word(entry)}" for entry in overrides(entries))


def plain(value: object) -> str:
    """A value as `--set` takes it."""
    if isinstance(value, (list, tuple)):
        return f"[{','.join(map(plain, value))}]"
    if isinstance(value, bool):
        return f"{value}".lower()
    return f"{value:.10g}" if isinstance(value, float) else f"{value}"


def words(entries: Entries) -> str:
    """Entries as a sentence lists them, those of [autobalancer] without their table.

    >>> words({"autobalancer.race_eccentricity_mm": 0.005, "run_up.time_s": 0.5})
    'race_eccentricity_mm = 0.005 and run_up.time_s = 0.5'
    """
    parts = [f"{key.removeprefix('autobalancer.')} = {_quoted(value)}" for key, value in entries.items()]
    *first, last = parts
    return f"{', '.join(first)} and {last}" if first else last


def _quoted(value: object) -> str:
    return f'"{value}"' if isinstance(value, str) else plain(value).replace(",", ", ")


def pins(candidate: Candidate) -> dict[str, object]:
    """The entries that pin the choice of a candidate."""
    values = (
        candidate.ball_count,
        _millimetres(candidate.ball_diameter),
        _millimetres(candidate.race_radius),
    )
    return {f"autobalancer.{key}": value for key, value in zip(PINS, values, strict=True)}


def _millimetres(length: float) -> float:
    return float(f"{from_si(length, 'mm'):.10g}")


def with_entries(table: MachineFile, entries: Entries) -> MachineFile:
    """The tables of a file with entries replaced as `--set` does it; raises ValueError or AbuError if refused."""
    values = table.model_dump(exclude_unset=True)
    apply(values, overrides_of(entries), MachineFile)
    return MachineFile.model_validate(values)


def followed(case: Case, entries: Entries) -> Followed | None:
    """The case with entries replaced, sized by the search; None if the file refuses them, or no race fits."""
    try:
        other = read_case(with_entries(case.table, entries))
        imbalance = find_imbalance(other).value
        return Followed(other, imbalance, choose_for_motor(other, imbalance).best)
    except (AbuError, ValueError):
        return None


def speeds_from(case: Case, least: float) -> Iterator[dict[str, object]]:
    """Entries that raise the lowest working speed to `least` [rad/s]: the range alone, else the rated speed with it."""
    lowest_rpm = math.ceil(from_si(least, "rpm"))
    rated, (_, high) = case.table.machine.speed_rpm, case.table.machine.speeds_rpm
    whole: dict[str, object] = {"machine.speed_range_rpm": [lowest_rpm, max(high, lowest_rpm)]}
    yield whole if rated >= lowest_rpm else {"machine.speed_rpm": lowest_rpm, **whole}


def two_digits(value: float, rounded: Callable[[float], int]) -> float:
    """A number rounded to two digits, up or down.

    >>> two_digits(1234.0, math.ceil), two_digits(0.0567, math.floor)
    (1300.0, 0.056)
    """
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{rounded(value / unit) * unit:.6g}")
