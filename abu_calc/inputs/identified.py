"""Table of identified values: intervals that `abu identify` found for entries of [autobalancer]."""

from collections.abc import Iterator
from typing import Annotated, Final, Self

from pydantic import Field, model_validator

from abu_calc.inputs.reading.table import Table, entry, problem

Interval = Annotated[tuple[float, ...], Field(strict=False, min_length=2, max_length=2)]

NAMES: Final = {
    "rolling_drag_per_s": ("viscous drag rate", "1/s"),
    "rolling_friction_mm": ("lever arm", "mm"),
    "race_eccentricity_mm": ("race eccentricity", "mm"),
}
"""Identified entries of [autobalancer], their names and units."""


class Identified(Table):
    """Intervals of 95 % of entries of [autobalancer], as `abu identify` writes them."""

    starts: int | None = entry(None, ge=1, le=10_000, usual=(8, 1000), example=10).means(
        "Recorded starts behind the values; {range}."
    )
    rolling_drag_per_s: Interval | None = entry(None, example=[11.0, 14.0]).means(
        "Interval of autobalancer.rolling_drag_per_s [1/s]: [low, high]."
    )
    rolling_friction_mm: Interval | None = entry(None, example=[0.001, 0.003]).means(
        "Interval of autobalancer.rolling_friction_mm [mm]: [low, high]."
    )
    race_eccentricity_mm: Interval | None = entry(None, example=[0.008, 0.012]).means(
        "Interval of autobalancer.race_eccentricity_mm [mm]: [low, high]."
    )

    def intervals(self) -> dict[str, tuple[float, float]]:
        """Intervals by the entry of [autobalancer]."""
        given = {key: getattr(self, key) for key in NAMES}
        return {key: (value[0], value[1]) for key, value in given.items() if value is not None}

    @model_validator(mode="after")
    def _ascend(self) -> Self:
        for key, (low, high) in self.intervals().items():
            if not 0 < low <= high:
                raise problem(
                    "not an interval", key, found=f"[{low:g}, {high:g}]", allowed="[low, high], above 0 and ascending"
                )
        return self

    def in_force(self, values: object) -> dict[str, tuple[float, float]]:
        """Intervals that hold the value in force; one that was changed since is identified no more."""
        return {key: ends for key, ends in self.intervals().items() if ends[0] <= getattr(values, key) <= ends[1]}


def identified_note(identified: Identified | None, values: object) -> Iterator[str]:
    """Which values are identified, in a sentence; nothing if none is."""
    known = {} if identified is None else identified.in_force(values)
    if identified is None or not known:
        return
    told = (
        f"{NAMES[key][0]} {getattr(values, key):.4g} {NAMES[key][1]} ({low:.3g} … {high:.3g})"
        for key, (low, high) in known.items()
    )
    starts = "" if identified.starts is None else f" from {identified.starts} recorded starts"
    yield f"Identified values{starts} are used, with intervals of 95 %: {', '.join(told)}."
