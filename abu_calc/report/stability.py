"""Stability of the balanced state as a result and as a report."""

from collections.abc import Iterable, Sequence
from typing import Any

from abu_calc.checks import Check
from abu_calc.dynamics.balanced.stability import Boundary, Stability
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.common import check_blocks, default_blocks, facts, warning_blocks
from abu_calc.report.outcome import finite
from abu_calc.report.quantities import number, shown
from abu_calc.units import from_si, wrapped_deg

FORBIDDEN = (
    "A speed above the natural frequencies is necessary, not sufficient: balls of finite mass lose the balanced state "
    "well above them, and light damping opens further gaps. Nothing is said of how far a disturbance may go: a start "
    "far away may end elsewhere (`abu simulate`)."
)
ON_A_GRID = (
    "They were looked for on a grid of speeds, refined where the growth rate bends or comes near zero, at up to some "
    "five hundred speeds: a gap far narrower than a hundredth of its speed may be missed."
)
KEYS = ("growth_rate_per_s", "critical_damping_N_s_per_m", "resting_angles_deg")
BALANCED_TO_FIRST_ORDER = frozenset({"gravity"})
"""Effects that leave the balanced state as it is, to the first order."""


def stability_result(
    found: Stability, boundaries: Sequence[Boundary] | None, critical_damping: float | None
) -> dict[str, Any]:
    """What `abu stability` tells; `boundaries_rpm` is null where no range of speeds was asked for."""
    return {
        "speed_rpm": from_si(found.speed, "rpm"),
        "state": found.state,
        "stable": found.stable,
        "growth_rate_per_s": finite(found.growth_rate),
        "eigenvalues": _pairs(found.eigenvalues),
        "floquet_multipliers": _pairs(found.multipliers),
        "critical_damping_N_s_per_m": critical_damping,
        "resting_angles_deg": None if found.angles is None else [wrapped_deg(angle) for angle in found.angles],
        "effects_left_out": list(found.left_out),
        "boundaries_rpm": None if boundaries is None else boundaries_result(boundaries),
    }


def boundaries_result(boundaries: Sequence[Boundary]) -> list[dict[str, Any]]:
    """Speeds where stability changes."""
    return [{"speed_rpm": from_si(one.speed, "rpm"), "stable_above": one.stable_above} for one in boundaries]


def stability_warnings(found: Stability, races: Sequence[int]) -> list[str]:
    """What the reader must know of how it was found; `races`: how many balls each has."""
    told = [f"No eigenvalues: {found.reason}."] if found.reason else []
    if found.state is None and not found.reason:
        told.append("No eigenvalues: there is no balanced state at this speed.")
    if found.state == "race still":
        told.append(
            "The race is not in the plane of the imbalance: its balls hold the race itself still, the axis keeps "
            "moving elsewhere. That state is judged."
        )
    if found.state == "arm alone":
        why = "the balls cannot carry the imbalance" if any(races) else "there are no balls"
        told.append(f"Judged is the forced motion of the arm alone with its imbalance: {why}.")
    if found.multipliers is not None:
        told.append(
            "What is felt of the support changes as the rotor turns: Floquet multipliers of one revolution stand in "
            "place of eigenvalues."
        )
    if found.angles is not None and max(races, default=0) > 2:
        told.append(
            f"{max(races)} balls of a race can balance in many arrangements; judged is the one spread about the light "
            "side with even gaps between equal balls. The neutral motions from one arrangement to another do not count."
        )
    return [*told, *_left_out(found.left_out)]


def _left_out(names: Iterable[str]) -> list[str]:
    """Effects of the scene that are no part of the linear motion."""
    others = [name for name in names if name not in BALANCED_TO_FIRST_ORDER]
    return [f"Left out of the linear motion, at steady speed: {', '.join(others)}."] if others else []


def stability_blocks(
    title: str,
    result: dict[str, Any],
    speeds: str | None,
    checks: Sequence[Check],
    warnings: Iterable[str],
    defaults: Iterable[tuple[str, object]],
) -> tuple[Block, ...]:
    """The whole report."""
    word = {True: "STABLE", False: "NOT STABLE", None: "NOT JUDGED"}[result["stable"]]
    return (
        Heading(f"{title}: stability of the balanced state"),
        Paragraph(f"{word} at {shown('speed_rpm', result['speed_rpm'])}: {checks[0].message}.", checks[0].status),
        facts(result, *(key for key in KEYS if result[key] != [])),
        *_values("Eigenvalues, 1/s", result["eigenvalues"]),
        *_values("Floquet multipliers of one revolution", result["floquet_multipliers"]),
        *_boundaries(result, speeds),
        *check_blocks(checks),
        *warning_blocks(warnings),
        *default_blocks(defaults),
        Heading("Model"),
        Paragraph(FORBIDDEN),
    )


def _pairs(values: Iterable[complex] | None) -> list[list[float]] | None:
    return None if values is None else [[value.real, value.imag] for value in values]


def _values(title: str, values: Sequence[Sequence[float]] | None) -> list[Block]:
    """One row for a number and its conjugate."""
    if values is None:
        return []
    rows = tuple((number(re, 5), f"± {number(im, 5)}" if im else "") for re, im in values if im >= 0)
    return [Heading(title), Grid(("real part", "imaginary part"), rows, frozenset({0, 1}))]


def _boundaries(result: dict[str, Any], speeds: str | None) -> list[Block]:
    heading, boundaries = Heading("Speeds where stability changes"), result["boundaries_rpm"]
    if boundaries is None:
        return [heading, Paragraph("Not asked for: --speeds LOW:HIGH finds them.")]
    searched = [] if result["state"] == "balanced" and result["eigenvalues"] else [Paragraph(ON_A_GRID)]
    if not boundaries:
        return [heading, Paragraph(f"None from {speeds} rpm."), *searched]
    return [heading, boundaries_grid(boundaries), *searched]


def boundaries_grid(boundaries: Sequence[dict[str, Any]]) -> Grid:
    """A row for each boundary."""
    rows = tuple((number(one["speed_rpm"], 6), "stable" if one["stable_above"] else "not stable") for one in boundaries)
    return Grid(("rpm", "above it"), rows, frozenset({0}))
