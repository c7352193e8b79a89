"""Warnings about a correction in two planes and about the way it was found."""

from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.formulas.two_planes import influence
from abu_calc.spec.readings import ReadingsFile
from abu_calc.studies.balance_case import Taken, record_warnings
from abu_calc.studies.balance_found import Found
from abu_calc.studies.balance_records import PlaneCorrection
from abu_calc.units import from_si

UNTOLD: Final = 45.0
"""Uncertainty of an angle [degrees] from which its direction is told to be unknown."""
RIG_DIFFERS: Final = 0.1
"""Relative difference of measured influence coefficients from those by the rig's data."""


def balance_warnings(
    file: ReadingsFile, taken: Sequence[Taken], balancing: Found, planes: Sequence[PlaneCorrection]
) -> Iterator[str]:
    """Each a sentence or two."""
    yield from _printed(balancing, planes)
    for taken_run in taken:
        yield from record_warnings(taken_run)
    yield from _directions(planes)
    yield from _within_grade(planes)
    if file.tolerance.balance_grade is not None and file.tolerance.service_speed_rpm is None:
        rpm = from_si(balancing.service_speed, "rpm")
        yield f"The grade is asked at the speed of the runs, {rpm:.0f} rpm: tolerance.service_speed_rpm is not given."
    yield from _rig_and_trials(balancing)
    if balancing.case.roll is None and balancing.bending_speed is None:
        yield "Whether the roll bends at these speeds is not known: rotor.first_bending_speed_rpm tells."


def _printed(balancing: Found, planes: Sequence[PlaneCorrection]) -> Iterator[str]:
    """Warning about the angles of the formula as published, if the readings are no displacements."""
    run = next((run for run in balancing.case.runs if not run.weights), None)
    masses, turns = [plane.printed_mass_g for plane in planes], [plane.printed_angle_deg for plane in planes]
    if run is None or run.quantity == "displacement" or None in masses or None in turns:
        return
    at = [
        (turn + (180 if mass < 0 else 0)) % 360
        for mass, turn in zip(masses, turns, strict=True)
        if mass and turn is not None
    ]
    if len(at) < len(planes):
        return
    off, times = ("on the wrong side", "Ω²") if run.quantity == "acceleration" else ("90° off", "Ω")
    name = "accelerations" if run.quantity == "acceleration" else "velocities"
    yield (
        "The formula as printed (Didukh 2010, (3)–(6)) takes readings for displacements: "
        f"with these {name} it would take metal off at {at[0]:.1f}° on the left and {at[1]:.1f}° on the right, {off}, "
        f"and {times} times too much. Here they are converted first."
    )


def _directions(planes: Sequence[PlaneCorrection]) -> Iterator[str]:
    for name, plane in zip(("left", "right"), planes, strict=True):
        if plane.mass_g and plane.angle_uncertainty_deg > UNTOLD:
            yield f"In the {name} plane errors are about as large as the imbalance: its angle is not known."


def _within_grade(planes: Sequence[PlaneCorrection]) -> Iterator[str]:
    if all(plane.permitted_g_mm is not None and plane.imbalance_g_mm <= plane.permitted_g_mm for plane in planes):
        yield "The roll is within its grade as it is: no correction is needed."


def _rig_and_trials(balancing: Found) -> Iterator[str]:
    roll = balancing.case.roll
    if roll is None:
        return
    if balancing.solution.method == "rig data":
        if any(run.weights for run in balancing.case.runs):
            yield (
                "The trial runs do not suffice for influence coefficients (one without and one in each plane, at one "
                "speed, with masses that tell): their masses are taken into account, and the rig's data used."
            )
        return
    measured, calculated = balancing.solution.influences[0], influence(roll, balancing.case.runs[0].speed)
    largest = max(abs(coefficient) for row in calculated for coefficient in row)
    off = max(abs(measured[i][k] - calculated[i][k]) for i in (0, 1) for k in (0, 1)) / largest
    if off > RIG_DIFFERS:
        yield (
            f"The influence coefficients measured differ by {100 * off:.0f} % from those by [rig] and [rotor], "
            "which are not used: look at their data, or at the trial masses and their angles."
        )
