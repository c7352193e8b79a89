"""Expected values of a file against its recomputed result, at the paths by which JSON names them."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, Final

from abu_calc.studies.quantity import Quantity, Record, as_plain, record

DEFAULT_TOLERANCE: Final = 1e-3
"""Relative; tight enough to see a changed formula, loose enough for another platform's rounding."""

SIMULATED_TOLERANCE: Final = 0.02
"""Relative tolerance of simulated values.

It allows the accuracy of 0.01 asked for by default on either side, whatever the integrator.
"""

WORTH_KEEPING: Final = (
    "status",
    "imbalance_g_mm",
    "required_capacity_g_mm",
    "autobalancer.ball_count",
    "autobalancer.ball_diameter_mm",
    "autobalancer.race_radius_mm",
    "autobalancer.capacity_g_mm",
    "autobalancer.mass_g",
    "accuracy_budget.residual_um",
    "vibration.level_before_db",
    "vibration.level_after_db",
    "simulation.0.settling_time_s",
    "swing_arm.contact_stiffness_limit_N_per_m",
    "swing_arm.damping_limit_N_s_per_m",
    "left.mass_g",
    "left.angle_deg",
    "right.mass_g",
    "right.angle_deg",
)
"""Values that `--update` writes into a file without expected values.

Bearing seats have their fits and interferences instead.
"""

SEAT_KEYS: Final = ("fit", "interference_um.0", "interference_um.1", "recommended_fit")


@record
class ComparedValue(Record):
    """One expected value and what came out."""

    path: Annotated[str, Quantity("path in the result")]
    expected: Annotated[Any, Quantity("expected")]
    found: Annotated[Any, Quantity("found")]
    tolerance: Annotated[float, Quantity("allowed deviation", "", 1, "relative")]
    deviation: Annotated[float | None, Quantity("deviation", "", 3, "relative, where both are numbers")]
    passed: Annotated[bool, Quantity("passed")]


def compare(
    expected: Mapping[str, Any], tolerances: Mapping[str, float], entries: Mapping[str, object]
) -> tuple[ComparedValue, ...]:
    """Every expected value against the result at its path; a path that is not there has failed."""
    return tuple(
        _compared(path, value, tolerances.get(path), value_at(entries, path)) for path, value in expected.items()
    )


def _compared(path: str, value: Any, tolerance: float | None, actual: Any) -> ComparedValue:
    usual = SIMULATED_TOLERANCE if path.startswith("simulation.") else DEFAULT_TOLERANCE
    allowed = usual if tolerance is None else tolerance
    if isinstance(value, list) and isinstance(actual, list) and len(value) == len(actual):
        pairs = [_deviation(a, b) for a, b in zip(value, actual, strict=True)]
        deviation = None if None in pairs else max((each for each in pairs if each is not None), default=0.0)
    else:
        deviation = _deviation(value, actual)
    passed = value == actual if deviation is None else deviation <= allowed
    return ComparedValue(path=path, expected=value, found=actual, tolerance=allowed, deviation=deviation, passed=passed)


def current(paths: tuple[str, ...], entries: Mapping[str, object]) -> dict[str, Any]:
    """The values a file should expect: those at its own paths, or a choice when it has none."""
    if not paths:
        seats = range(len(value_at(entries, "fits") or ()))
        paths = (*WORTH_KEEPING, *(f"fits.{index}.{key}" for index in seats for key in SEAT_KEYS))
    values = {path: value_at(entries, path) for path in paths}
    return {path: _rounded(value) for path, value in values.items() if value is not None}


def value_at(entries: Mapping[str, object], path: str) -> Any:
    """Value at a path in entries of a result, as JSON has it; None if there is none.

    Paths are `autobalancer.ball_count` or `fits.0.fit`, for example.
    """
    value: object = entries
    for part in path.split("."):
        if isinstance(value, Record) and part in value.entries():
            value = getattr(value, part)
        elif isinstance(value, tuple) and part.isdigit() and int(part) < len(value):
            value = value[int(part)]
        elif isinstance(value, Mapping) and part in value:
            value = value[part]
        else:
            return None
    return as_plain(value)


def _deviation(expected: Any, actual: Any) -> float | None:
    if isinstance(expected, bool) or isinstance(actual, bool):
        return None
    if not isinstance(expected, (int, float)) or not isinstance(actual, (int, float)):
        return None
    return math.fabs(actual - expected) / max(math.fabs(expected), 1e-12)


def _rounded(value: Any) -> Any:
    """Six digits: more than any tolerance needs, few enough to read."""
    if isinstance(value, (list, tuple)):
        return [_rounded(each) for each in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value
