"""Checks and warnings on readings, rig, roll and correction, each with the number behind it."""

import math
from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.features.balancing.case import RunReadings, record_warnings
from abu_calc.features.balancing.corrections import added, removed
from abu_calc.features.balancing.formulas import bar_bending_speed, influence
from abu_calc.features.balancing.methods import near_resonance
from abu_calc.features.balancing.runs import ONE_SPEED
from abu_calc.features.balancing.solution import BEYOND_ERRORS, Found, PlaneCorrection
from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.units import shown

CONDITION: Final = (10.0, 30.0)
"""Condition numbers: a warning from the first on, failed above the second."""
OFF_RESONANCE: Final = (0.3, 0.1)
"""Relative distance of the speed from a natural frequency: a warning below the first, failed below the second."""
RIGID: Final = (0.5, 0.7)
"""Speed over the roll's bending speed, likewise; an assumed bending speed warns from the second on."""
SURE: Final = (0.1, 0.5)
"""Vibration expected to be left, of that before."""
AGREE: Final = (BEYOND_ERRORS, 6.0)
"""Misfit of runs in standard deviations."""
FEW_PLANES: Final = 0.1
"""Vibration that the planes leave, of that before."""
TELLS: Final = (0.3, 0.05)
"""Least effect of a trial mass, as a share of the sensor's reading without it: to pass, and not to fail."""
LEFT: Final = (0.05, 0.25)
"""Imbalance that limits or stock leave, of that now: a warning from the first on, failed above the second."""


LIGHTER: Final = "Allow lighter weights or other places: masses that nearly cancel leave the errors of all of them."
"""Action if the masses of a correction have larger errors than the imbalance."""


def balance_checks(balancing: Found, taken: Sequence[RunReadings]) -> tuple[Check, ...]:
    """Checks that there are numbers for."""
    return (
        *_planes(balancing), *_natural_frequencies(balancing), *_rigid(balancing), *_sure(balancing),
        *_permitted(balancing), *_agree(balancing), *_trials(balancing), *_metal(balancing), *_convention(taken),
        *_coefficients(balancing), *_room(balancing), *_discrete(balancing), *_few_planes(balancing),
    )  # fmt: skip


def _planes(balancing: Found) -> Iterator[Check]:
    if balancing.case.planes == 1:
        return
    value = balancing.solution.condition
    yield coded("ABU1001", verdict(value <= CONDITION[1], value <= CONDITION[0]),
        "condition number: errors of readings may grow by this factor", value, CONDITION[0],
    )  # fmt: skip


def _natural_frequencies(balancing: Found) -> Iterator[Check]:
    nearest = near_resonance(balancing.case)
    if nearest is None:
        return
    value, omega = nearest
    by_data = balancing.solution.method == "rig data"
    grade = verdict(value >= OFF_RESONANCE[1] or not by_data, value >= OFF_RESONANCE[0])
    remedy = None
    if balancing.farther is not None and grade != "pass":
        speed, rest = balancing.farther
        remedy = (
            f"Measure at {shown(speed, 'rpm', '.0f')}: the remaining vibration falls from "
            f"{100 * balancing.rest_share:.1f} to {100 * rest:.1f} % (calculated with the same errors)."
        )
    yield coded("ABU1002", grade,
        f"relative distance of the speed from the natural frequency {shown(omega, 'hz', '.2f')}", value,
        OFF_RESONANCE[0], remedy,
    )  # fmt: skip


def _rigid(balancing: Found) -> Iterator[Check]:
    """A bending speed that is given can fail it; one that is assumed warns."""
    roll = balancing.case.roll
    speed = max(balancing.service_speed, *(run.speed for run in balancing.case.runs))
    if balancing.bending_speed is not None:
        value = speed / balancing.bending_speed
        grade = verdict(value <= RIGID[1], value <= RIGID[0])
        message, limit = f"the highest speed over the roll's bending speed, {_rpm(balancing.bending_speed)}", RIGID[0]
    elif roll is not None:
        bar = bar_bending_speed(roll.M3, roll.length)
        value, limit = speed / bar, RIGID[1]
        grade = verdict(True, value <= limit)
        message = f"the highest speed over that at which a solid steel bar of its mass and length bends, {_rpm(bar)}"
    else:
        return
    remedy = None
    if grade != "pass":
        remedy = (
            "Specify rotor.first_bending_speed_rpm." if balancing.bending_speed is None
            else "The roll bends: balance it in more planes, at more speeds (ISO 21940-12)."
        )  # fmt: skip
    yield coded("ABU1003", grade, message, value, limit, remedy)


def _rpm(speed: float) -> str:
    return shown(speed, "rpm", ".0f")


def _sure(balancing: Found) -> Iterator[Check]:
    """Check of a correction; a rotor within its tolerance that needs none has no such check."""
    share = balancing.error_share
    if balancing.below:
        tolerance = balancing.tolerance
        if tolerance is None or any(
            2 * rest > permitted
            for rest, permitted in zip(balancing.rest_in_tolerance_planes, tolerance.permitted, strict=True)
        ):
            yield coded("ABU1004", "not-done",
                "the imbalance is below the errors of these runs: no correction can be trusted", share, SURE[0],
                "Leave the rotor as it is, or measure with smaller errors. Specify tolerance.balance_grade.",
            )  # fmt: skip
        return
    remedy = None
    if share >= 1:
        remedy = LIGHTER
    elif share > SURE[0] and balancing.rest_share < 1:
        remedy = (
            "Measure and correct once more after this correction: the vibration that errors leave falls from "
            f"{100 * share:.1f} to {100 * share * balancing.rest_share:.1f} % (calculated with the same errors)."
        )
    yield coded("ABU1004", verdict(share <= SURE[1], share <= SURE[0]),
        "vibration that errors of readings, rig and correction leave, rms, of that taken away", share, SURE[0], remedy,
    )  # fmt: skip


def _permitted(balancing: Found) -> Iterator[Check]:
    tolerance = balancing.tolerance
    if tolerance is None:
        return
    kind, few = tolerance.planes.removesuffix("s"), (balancing.planes_share or 0) > FEW_PLANES
    for name, rest, permitted in zip(
        balancing.planes, balancing.rest_in_tolerance_planes, tolerance.permitted, strict=True
    ):
        remedy = None
        if 2 * rest > permitted and balancing.below:
            remedy = "Measure with smaller errors: no correction can be trusted with these."
        elif 2 * rest > permitted and any(balancing.leftover):
            left = shown(sum(map(abs, balancing.leftover)), "g_mm", ".4g")
            remedy = f"Allow places and weights that leave less: limits and stock leave {left} (ABU1012)."
        elif 2 * rest > permitted and balancing.error_share >= 1:
            remedy = LIGHTER
        elif 2 * rest > permitted:
            falls = shown((rest, rest * min(balancing.rest_share, 1.0)), "g_mm", between=" to ")
            remedy = (
                "Measure and correct once more after this correction: the imbalance falls from "
                f"{falls} (calculated with the same errors)."
            )
        elif few:
            remedy = (
                "Correct in more planes: the vibration that remains (ABU1013) may be of imbalance elsewhere, which "
                "this number leaves out."
            )
        yield coded("ABU1005", verdict(rest <= permitted, 2 * rest <= permitted and not few),
            f"imbalance of the {kind} expected after the correction; PASS asks that twice that is permitted, too", rest,
            permitted, remedy, of=f"{name} plane" if name != "single" else "",
        )  # fmt: skip


def _agree(balancing: Found) -> Iterator[Check]:
    value = balancing.disagreement
    if value is None or balancing.solution.method == "stored coefficients":
        return
    remedy = None
    if value > AGREE[0]:
        remedy = "Repeat the runs. Check speeds, fastening and the data of the rig, and whether the roll bends."
    yield coded("ABU1006", verdict(value <= AGREE[1], value <= AGREE[0]),
        "largest misfit of a run, in standard deviations of the errors given", value, AGREE[0], remedy,
    )  # fmt: skip


def _trials(balancing: Found) -> Iterator[Check]:
    if balancing.solution.method not in ("trial masses", "runs without phase"):
        return
    value = min(
        _change(balancing, number, plane)
        for number in range(len(balancing.remainders))
        for plane in range(balancing.case.planes)
    )
    remedy = (
        None
        if value >= TELLS[0]
        else f"Use trial masses {max(2, math.ceil(TELLS[0] / value)) if value else 2} times as heavy."
    )
    yield coded("ABU1007", verdict(value >= TELLS[1], value >= TELLS[0]),
        "vector change of a reading by the weaker trial mass, of that reading without it", value, TELLS[0], remedy,
    )  # fmt: skip


def _change(balancing: Found, number: int, plane: int) -> float:
    """Largest change of a reading at a speed by the trial mass of a plane, over what the same sensor reads without it.

    A sensor that reads little counts from a tenth of the largest reading on.
    """
    case, first = balancing.case, balancing.case.speed_groups[number][0]
    on = max(abs(case.runs[index].placed[plane]) for index in case.speed_groups[number])
    return max(
        (on * abs(row[plane]) / size
         for row, now in zip(balancing.solution.influences[first], balancing.remainders[number].now, strict=True)
         if (size := max(float(abs(now)), case.least(first)))),
        default=0.0,
    )  # fmt: skip


def _metal(balancing: Found) -> Iterator[Check]:
    limit = balancing.making.removable
    if limit is None:
        return
    value = max(map(removed, balancing.shares))
    yield coded("ABU1008", verdict(value <= limit * (1 + 1e-9)), "mass to remove in a plane", value, limit,
        None if value <= limit else "Specify more places, so that mass can be added opposite.",
    )  # fmt: skip


def _room(balancing: Found) -> Iterator[Check]:
    limit = balancing.making.addable
    if limit is None:
        return
    value = max(map(added, balancing.shares))
    yield coded("ABU1011", verdict(value <= limit * (1 + 1e-9)), "mass to add in a plane", value, limit,
        None if value <= limit else "Use a larger correction radius, or remove metal at the heavy spot.",
    )  # fmt: skip


def _discrete(balancing: Found) -> Iterator[Check]:
    """Check of masses that are limited or in stock."""
    making = balancing.making
    depth = making.drill is not None and making.drill.limited
    if balancing.below or not (making.stock or making.per_place is not None or depth):
        return
    value = max(
        (abs(left) / abs(Q) for left, Q in zip(balancing.leftover, balancing.target, strict=True) if Q), default=0.0
    )
    yield coded("ABU1012", verdict(value <= LEFT[1], value <= LEFT[0]),
        "imbalance that limits of mass, places or stock leave, of that to correct", value, LEFT[0],
        None if value <= LEFT[0] else "Allow more places, more mass at each place, or lighter weights.",
    )  # fmt: skip


def _convention(taken: Sequence[RunReadings]) -> Iterator[Check]:
    """Check that every run with phases names their convention."""
    read = [run for run in taken if run.record is None and run.phase]
    if not read:
        return
    silent = sum(run.convention is None for run in read)
    names = sorted({run.phase or "lag" for run in read})
    if silent:
        message = f"runs that do not name the convention of their phases; lag is assumed, A·cos(ωt − phase): {silent}"
    else:
        message = f"phases {' in some runs and '.join(names)}{' in others' if len(names) > 1 else ''}, as the runs say"
    yield coded("ABU1009", verdict(True, not silent and len(names) == 1), message,
        remedy='Add phase = "lag" or phase = "lead" to each run, as the manual of the instrument says.'
        if silent or len(names) > 1 else None,
    )  # fmt: skip


def _few_planes(balancing: Found) -> Iterator[Check]:
    """Check of the vibration that more planes would take away."""
    share = balancing.planes_share
    if share is None:
        return
    planes = "one plane" if balancing.case.planes == 1 else "two planes"
    best = f"This is the best that {planes} can do: no other correction there leaves less vibration in all. "
    yield coded("ABU1013", verdict(True, share <= FEW_PLANES),
        f"vibration that {planes} cannot take away, rms, of that now", share, FEW_PLANES,
        f"{'' if any(balancing.leftover) else best}To reduce it further, correct in more planes." if share > FEW_PLANES
        else None,
    )  # fmt: skip


def _coefficients(balancing: Found) -> Iterator[Check]:
    """Check that stored coefficients fit the runs.

    Runs tell it with unlike masses at one speed, or at several speeds if the planes suffice.
    """
    if balancing.solution.method != "stored coefficients":
        return
    case, value = balancing.case, balancing.disagreement
    unlike = any(len({case.runs[index].placed for index in group}) > 1 for group in case.speed_groups)
    if value is None or not (unlike or (len(case.speed_groups) > 1 and not balancing.planes_share)):
        yield coded("ABU1010", "warn", "these runs cannot show whether the stored coefficients still fit",
            remedy="After the correction run again. Add that run with the correction as its trial.",
        )  # fmt: skip
        return
    yield coded("ABU1010", verdict(value <= AGREE[1], value <= AGREE[0]),
        "largest misfit of a run with the stored coefficients, in standard deviations", value, AGREE[0],
        None if value <= AGREE[0] else "Make trial runs and store the coefficients anew. The machine has changed.",
    )  # fmt: skip


UNTOLD: Final = 45.0
"""Uncertainty of an angle [degrees] from which its direction is told to be unknown."""
RIG_DIFFERS: Final = 0.1
"""Relative difference of measured influence coefficients from those by the rig's data."""


def balance_warnings(
    file: ReadingsFile, taken: Sequence[RunReadings], balancing: Found, planes: Sequence[PlaneCorrection]
) -> Iterator[str]:
    """Each a sentence or two."""
    yield from _printed(balancing, planes)
    for taken_run in taken:
        yield from record_warnings(taken_run)
    yield from _units(taken)
    quantities = sorted({run.quantity for run in balancing.case.runs})
    if len(quantities) > 1 and balancing.case.overdetermined:
        yield f"The runs are in {' and '.join(quantities)}: the sum of the squares of all velocities is minimised."
    yield from _directions(balancing, planes)
    yield from _within_grade(balancing)
    if file.tolerance.balance_grade is not None and file.tolerance.service_speed_rpm is None:
        rpm = _rpm(balancing.service_speed)
        yield f"tolerance.service_speed_rpm is not given: the grade is judged at the speed of the runs, {rpm}."
    yield from _rig_and_trials(balancing)
    if balancing.case.roll is None and balancing.bending_speed is None:
        yield "It is not known whether the roll bends at these speeds. Specify rotor.first_bending_speed_rpm."


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
        "The formula as published (Didukh 2010, (3)–(6)) takes readings for displacements. "
        f"With these {name} it would remove metal at {at[0]:.1f}° left and {at[1]:.1f}° right, {off}, and {times} "
        "times too much. This result converts them first."
    )


def _units(taken: Sequence[RunReadings]) -> Iterator[str]:
    """Warning about runs of one speed in different units: perhaps one unit is wrong."""
    speeds = {run.unit: run.speed for run in taken if run.unit}
    for unit, speed in list(speeds.items())[1:]:
        other = next(iter(speeds))
        if abs(speed / speeds[other] - 1) <= ONE_SPEED:
            yield f"Runs at one speed are in {other} and in {unit}. If one unit is wrong, the correction is wrong."
            return


def _directions(balancing: Found, planes: Sequence[PlaneCorrection]) -> Iterator[str]:
    for name, plane in zip(balancing.planes, planes, strict=True):
        if plane.mass_g and plane.angle_uncertainty_deg > UNTOLD:
            yield f"In the {name} plane the errors are about as large as the imbalance: its angle is not known."


def _within_grade(balancing: Found) -> Iterator[str]:
    tolerance = balancing.tolerance
    if tolerance is None or (balancing.planes_share or 0) > FEW_PLANES:
        return
    now = tolerance.transformed(balancing.solution.imbalance)
    if all(abs(value) <= limit for value, limit in zip(now, tolerance.permitted, strict=True)):
        yield "The rotor is already within its balance grade: no correction is needed."


def _rig_and_trials(balancing: Found) -> Iterator[str]:
    roll = balancing.case.roll
    if roll is None or balancing.solution.method not in ("rig data", "trial masses"):
        return
    if balancing.solution.method == "rig data":
        if any(run.weights for run in balancing.case.runs):
            yield (
                "The trial runs do not suffice for influence coefficients: these need one run without and one in each "
                "plane, at one speed, with masses that change the readings. The rig's data are used instead."
            )
        return
    if len(balancing.solution.influences[0]) != 2:
        return
    measured, calculated = balancing.solution.influences[0], influence(roll, balancing.case.runs[0].speed)
    largest = max(abs(coefficient) for row in calculated for coefficient in row)
    off = max(abs(measured[i][k] - calculated[i][k]) for i in (0, 1) for k in (0, 1)) / largest
    if off > RIG_DIFFERS:
        yield (
            f"The measured influence coefficients, which are used, differ by {100 * off:.0f} % from those by [rig] and "
            "[rotor]. Check the data of the rig, or the trial masses and their angles."
        )
