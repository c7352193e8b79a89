"""Results of `abu identify`: values with intervals, every start, what they rest on; and a file with these values."""

import re
from collections.abc import Mapping
from typing import Annotated, ClassVar, Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.written_units import written_unit
from abu_calc.inputs.reading.document import open_document
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.result import Result


@record
class IdentifiedValue(Record):
    """A value with its interval of 95 %."""

    value: Annotated[float, Quantity("value", "", 4)]
    low: Annotated[float, Quantity("low", "", 4)]
    high: Annotated[float, Quantity("high", "", 4)]


@record
class ExpectedValues(Record):
    """Values of the file, each with the interval that the starts will give; null where they will give none."""

    rolling_drag_per_s: Annotated[IdentifiedValue | None, Quantity("viscous drag rate", "h₀", 4, "1/s")] = None
    rolling_friction_mm: Annotated[
        IdentifiedValue | None, Quantity("lever arm of rolling friction", "k_r", 4, "mm")
    ] = None
    race_eccentricity_mm: Annotated[IdentifiedValue | None, Quantity("race eccentricity", "Δ", 4, "mm")] = None
    race_eccentricity_angle_deg: Annotated[
        IdentifiedValue | None, Quantity("its angle from the mark", "φ", 4, "deg")
    ] = None


KEYS: Final = ("rolling_drag_per_s", "rolling_friction_mm", "race_eccentricity_mm")
"""Keys of [autobalancer] that are identified."""


def interval_lines(starts: int, known: Mapping[str, IdentifiedValue]) -> list[str]:
    """Lines of the table [identified]: intervals that hold the values as they are written."""
    ends = {
        key: (min(value.low, float(f"{value.value:.4g}")), max(value.high, float(f"{value.value:.4g}")))
        for key, value in known.items()
    }
    lines = [f"{key} = [{_outward(low, -1):.4g}, {_outward(high, 1):.4g}]" for key, (low, high) in ends.items()]
    return ["[identified]", f"starts = {starts}", *lines]


def _outward(value: float, way: int) -> float:
    """The next number with four digits that way; the lower end of an interval stays above zero."""
    rounded = float(f"{max(value, 1e-9):.4g}")
    return rounded if (rounded - value) * way >= 0 else float(f"{rounded * (1 + way * 2e-3):.4g}")


@record
class BenchRecord(Record):
    """Values of one ball in the standing race: drag rate at low slip, which is not that at speed, and lever arm."""

    rolling_drag_per_s: Annotated[IdentifiedValue, Quantity("viscous drag rate at low slip", "h₀", 4, "1/s")]
    rolling_friction_mm: Annotated[IdentifiedValue, Quantity("lever arm of rolling friction", "k_r", 4, "mm")]


@record
class StartCourse(Record):
    """One start: distance of the axis from its end over time, as measured."""

    file: Annotated[str, Quantity("recording")]
    end: Annotated[tuple[float, float], Quantity("end from the mark", unit="um")]
    distance: Annotated[tuple[float, ...], Quantity("distance from the end", unit="um")]
    predicted: Annotated[tuple[float, ...] | None, Quantity("simulated with the identified values", unit="um")]


@record
class IdentifyResult(Result):
    """Values that the recorded starts give; null where a check says why."""

    command: ClassVar[str] = "identify"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"assumed"}

    model: SceneModel
    rolling_drag_per_s: Annotated[IdentifiedValue | None, Quantity("viscous drag rate", "h₀", 4, "1/s")]
    rolling_friction_mm: Annotated[IdentifiedValue | None, Quantity("lever arm of rolling friction", "k_r", 4, "mm")]
    race_eccentricity_mm: Annotated[IdentifiedValue | None, Quantity("race eccentricity", "Δ", 4, "mm")]
    race_eccentricity_angle_deg: Annotated[IdentifiedValue | None, Quantity("its angle from the mark", "φ", 4, "deg")]
    starts: Annotated[int, Quantity("recorded starts")]
    mark: Annotated[bool, Quantity("a mark was recorded")]
    noise: Annotated[float, Quantity("noise of a recorded place", "σ", 3, unit="um")]
    friction_number: Annotated[
        float | None, Quantity("friction over gravity", "Λ", 3, "below 1 gravity shakes friction out")
    ]
    residual: Annotated[float, Quantity("mean distance of ends from the axis", "", 3, unit="um")]
    fits_worse_share: Annotated[float | None, Quantity("simulated sets that fit worse", "", 2, percent=True)]
    run_up_s: Annotated[float, Quantity("run-up time", "", 3)]
    measured_run_up_s: Annotated[float | None, Quantity("run-up time by the mark", "", 3)]
    simulated_starts: Annotated[int, Quantity("starts simulated")]
    times_s: Annotated[tuple[float, ...], Quantity("time from the switching-on")]
    courses: tuple[StartCourse, ...]
    bench: BenchRecord | None
    toml: Annotated[str | None, Quantity("block for the file")]
    assumed: tuple[str, ...]
    """What the values rest on, in sentences."""


NUMBER: Final = r"[-+]?[\d_.]+(?:[eE][-+]?\d+)?"
SCENE_KEYS: Final = {"rolling_friction_mm": "lever_arm_mm", "race_eccentricity_mm": "magnitude_mm"}
"""Keys of a scene file that have other names than those of a machine file."""


def identified_text(source: str, result: IdentifyResult) -> str:
    """The file's text with the values that are known. Raises InputError if none is, or if a key has no place."""
    document = open_document(source)
    scene = "scene" in document.content
    values = {key: value.value for key in KEYS if (value := getattr(result, key)) is not None}
    if not values:
        raise InputError(
            "no value was identified, so there is nothing to write", place=Place(source),
            remedy="Follow the actions of the checks, or leave --write out.",
        )  # fmt: skip
    text = document.text
    for key, value in values.items():
        name = SCENE_KEYS.get(key, key) if scene else key
        text, count = re.subn(rf"(?m)^([^#\n]*\b{name}\s*=\s*){NUMBER}", rf"\g<1>{value:.4g}", text)
        if not count and (unit := written_unit(name)):  # the value stands there with its unit
            pattern = rf"(?m)^([^#\n]*\b){unit.stem}\s*=\s*(?:\"[^\"\n]*\"|'[^'\n]*')"
            text, count = re.subn(pattern, rf"\g<1>{name} = {value:.4g}", text)
        if not count and scene:
            raise InputError(
                "the scene has no place for a value",
                place=Place(source, key=name),
                remedy="Add the key, or its effect.",
            )
        if not count:
            text, count = re.subn(r"(?m)^(\[autobalancer\][^\n]*)$", rf"\g<1>\n{name} = {value:.4g}", text, count=1)
        if not count:
            text = f"{text.rstrip()}\n\n[autobalancer]\n{name} = {value:.4g}\n"
    if not scene:
        text = _with_intervals(text, interval_lines(result.starts, {key: getattr(result, key) for key in values}))
    angle = result.race_eccentricity_angle_deg
    if scene and angle is not None:
        pattern = rf"(?m)^(\s*race_eccentricity\s*=\s*\{{[^}}\n]*angle_deg\s*=\s*){NUMBER}"
        text = re.sub(pattern, rf"\g<1>{angle.value:.1f}", text)
    return text


def _with_intervals(text: str, lines: list[str]) -> str:
    """The text with the table [identified] anew, in the place of an earlier one."""
    kept = re.sub(r"(?ms)^\[identified\][^\n]*\n.*?(?=^\[|\Z)", "", text)
    return f"{kept.rstrip()}\n\n{chr(10).join(lines)}\n"
