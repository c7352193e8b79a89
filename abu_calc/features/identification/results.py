"""Results of `abu identify`: values with intervals, every start, and what they rest on."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Final, Self

from abu_calc.features.identification.bench import BenchValues
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.result import Result


@record
class IdentifiedValue(Record):
    """A value with its interval of 95 %."""

    value: Annotated[float, Quantity("value", "", 4)]
    low: Annotated[float, Quantity("low", "", 4)]
    high: Annotated[float, Quantity("high", "", 4)]


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

    @classmethod
    def of(cls, film: BenchValues) -> Self:
        """Values with two standard errors to both sides."""
        drag, lever = (
            IdentifiedValue(value=value * unit, low=max(0.0, value - 2 * error) * unit, high=(value + 2 * error) * unit)
            for value, error, unit in ((film.drag, film.drag_error, 1.0), (film.lever, film.lever_error, 1e3))
        )
        return cls(rolling_drag_per_s=drag, rolling_friction_mm=lever)


@record
class StartCourse(Record):
    """One start: distance of the axis from its end over time, as measured."""

    file: Annotated[str, Quantity("recording")]
    end_um: Annotated[tuple[float, float], Quantity("end from the mark", "", 4)]
    distance_um: Annotated[tuple[float, ...], Quantity("distance from the end", "", 4)]
    predicted_um: Annotated[tuple[float, ...] | None, Quantity("simulated with the identified values", "", 4)]


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
    noise_um: Annotated[float, Quantity("noise of a recorded place", "σ", 3)]
    friction_number: Annotated[
        float | None, Quantity("friction over gravity", "Λ", 3, "below 1 gravity shakes friction out")
    ]
    residual_um: Annotated[float, Quantity("mean distance of ends from the axis", "", 3)]
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
