"""Stability of the balanced state as a result and as a report."""

from collections.abc import Iterable, Sequence
from typing import Any

from abu_calc.checks import Check
from abu_calc.dynamics.stability import Boundary, Stability
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


def stability_result(found: Stability, boundaries: Sequence[Boundary] | None) -> dict[str, Any]:
    """What `abu stability` tells; `boundaries_rpm` is null where no range of speeds was asked for."""
    return {
        "speed_rpm": from_si(found.speed, "rpm"),
        "stable": found.stable,
        "growth_rate_per_s": finite(found.growth_rate),
        "eigenvalues": _pairs(found.eigenvalues),
        "floquet_multipliers": _pairs(found.multipliers),
        "resting_angles_deg": None if found.angles is None else [wrapped_deg(angle) for angle in found.angles],
        "boundaries_rpm": None
        if boundaries is None
        else [{"speed_rpm": from_si(one.speed, "rpm"), "stable_above": one.stable_above} for one in boundaries],
    }


def stability_warnings(found: Stability) -> list[str]:
    """What the reader must know of how it was found."""
    if found.angles is None:
        return ["No eigenvalues: there is no balanced state at any speed."]
    told = []
    if found.multipliers is not None:
        told.append(
            "The support differs along x and y: Floquet multipliers of one revolution stand in place of eigenvalues."
        )
    if len(found.angles) > 2:
        told.append(
            f"{len(found.angles)} balls can balance in many arrangements; judged is the one spread about the light "
            "side with even gaps between equal balls. The neutral motions from one arrangement to another do not count."
        )
    return told


def stability_blocks(
    title: str,
    result: dict[str, Any],
    speeds: str | None,
    checks: Sequence[Check],
    warnings: Iterable[str],
    defaults: Iterable[tuple[str, object]],
) -> tuple[Block, ...]:
    """The whole report."""
    word = "STABLE" if result["stable"] else "NOT STABLE"
    return (
        Heading(f"{title}: stability of the balanced state"),
        Paragraph(f"{word} at {shown('speed_rpm', result['speed_rpm'])}: {checks[0].message}.", checks[0].status),
        facts(result, "growth_rate_per_s", "resting_angles_deg"),
        *_values("Eigenvalues, 1/s", result["eigenvalues"]),
        *_values("Floquet multipliers of one revolution", result["floquet_multipliers"]),
        *_boundaries(result["boundaries_rpm"], speeds),
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


def _boundaries(boundaries: Sequence[dict[str, Any]] | None, speeds: str | None) -> list[Block]:
    heading = Heading("Speeds where stability changes")
    if boundaries is None:
        return [heading, Paragraph("Not asked for: --speeds LOW:HIGH finds them.")]
    if not boundaries:
        return [heading, Paragraph(f"None from {speeds} rpm.")]
    rows = tuple((number(one["speed_rpm"], 6), "stable" if one["stable_above"] else "not stable") for one in boundaries)
    return [heading, Grid(("rpm", "above it"), rows, frozenset({0}))]
