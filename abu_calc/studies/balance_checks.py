"""What is asked of readings, rig and roll before a correction is trusted, each with the number that says so."""

from collections.abc import Iterator
from typing import Final

from abu_calc.analysis.splitting import removed
from abu_calc.analysis.two_planes import near_resonance
from abu_calc.checks import Check, coded, verdict
from abu_calc.formulas.two_planes import bar_bending_speed, condition_number
from abu_calc.studies.balance_found import Found
from abu_calc.units import from_si

CONDITION: Final = (10.0, 30.0)
"""Condition numbers: a warning from the first on, failed above the second."""
OFF_RESONANCE: Final = (0.3, 0.1)
"""Relative distance of the speed from a natural frequency: a warning below the first, failed below the second."""
RIGID: Final = (0.5, 0.7)
"""Speed over the roll's bending speed, likewise; an assumed bending speed warns from the second on."""
SURE: Final = (0.1, 0.5)
"""Vibration expected to be left, of that before."""
AGREE: Final = (3.0, 6.0)
"""Misfit of runs in standard deviations."""
TELLS: Final = (0.3, 0.05)
"""What a trial mass moves at least, of the largest reading."""


def balance_checks(found: Found) -> tuple[Check, ...]:
    """Those that there are numbers for."""
    return (
        _planes(found), *_natural_frequencies(found), *_rigid(found), _sure(found), *_permitted(found), *_agree(found),
        *_trials(found), *_metal(found),
    )  # fmt: skip


def _planes(found: Found) -> Check:
    value = max(map(condition_number, found.solution.influences))
    return coded(
        "ABU1001", verdict(value <= CONDITION[1], value <= CONDITION[0]),
        "errors of readings may grow by this factor, the condition number", value, CONDITION[0],
    )  # fmt: skip


def _natural_frequencies(found: Found) -> Iterator[Check]:
    nearest = near_resonance(found.case)
    if nearest is None:
        return
    value, one = nearest
    by_data = found.solution.method == "rig data"
    grade = verdict(value >= OFF_RESONANCE[1] or not by_data, value >= OFF_RESONANCE[0])
    remedy = None
    if found.farther is not None and grade != "pass":
        speed, rest = found.farther
        remedy = (
            f"At {from_si(speed, 'rpm'):.0f} rpm the same errors would leave {100 * rest:.1f} % instead of "
            f"{100 * found.rest_share:.1f} %."
        )
    yield coded(
        "ABU1002", grade, f"the speed's distance from the natural frequency of {from_si(one, 'hz'):.2f} Hz, relative",
        value, OFF_RESONANCE[0], remedy=remedy, bound="least",
    )  # fmt: skip


def _rigid(found: Found) -> Iterator[Check]:
    """A bending speed that is given can fail it; one that is assumed warns."""
    roll = found.case.roll
    speed = max(found.service_speed, *(run.speed for run in found.case.runs))
    if found.bending_speed is not None:
        value = speed / found.bending_speed
        grade = verdict(value <= RIGID[1], value <= RIGID[0])
        told, limit = f"the highest speed over the roll's bending speed, {_rpm(found.bending_speed)}", RIGID[0]
    elif roll is not None:
        bar = bar_bending_speed(roll.M3, roll.length)
        value, limit = speed / bar, RIGID[1]
        grade = verdict(True, value <= limit)
        told = f"the highest speed over that at which a solid steel bar of its mass and length bends, {_rpm(bar)}"
    else:
        return
    remedy = None
    if grade != "pass":
        remedy = (
            "rotor.first_bending_speed_rpm tells better." if found.bending_speed is None
            else "A flexible roll takes more planes, at more speeds (ISO 21940-12)."
        )  # fmt: skip
    yield coded("ABU1003", grade, told, value, limit, remedy=remedy)


def _rpm(speed: float) -> str:
    return f"{from_si(speed, 'rpm'):.0f} rpm"


def _sure(found: Found) -> Check:
    share = found.rest_share
    remedy = None
    if share > SURE[0]:
        remedy = f"A second run after the correction: the same errors would leave {100 * share**2:.1f} %."
    return coded(
        "ABU1004", verdict(share <= SURE[1], share <= SURE[0]),
        "what errors of readings, rig and correction leave of it, rms", 100 * share, 100 * SURE[0], "%", remedy,
    )  # fmt: skip


def _permitted(found: Found) -> Iterator[Check]:
    for name, (rest, permitted) in zip(("left plane", "right plane"), found.rest, strict=True):
        if permitted is None:
            continue
        remedy = None
        if 2 * rest > permitted:
            after = from_si(rest * found.rest_share, "g_mm")
            remedy = f"A second run after the correction: the same errors would leave {after:.3g} g·mm."
        yield coded(
            "ABU1005", verdict(rest <= permitted, 2 * rest <= permitted),
            "imbalance expected after the correction; twice that must be permitted, too",
            from_si(rest, "g_mm"), from_si(permitted, "g_mm"), "g·mm", remedy, of=name,
        )  # fmt: skip


def _agree(found: Found) -> Iterator[Check]:
    value = found.disagreement
    if value is None:
        return
    remedy = None
    if value > AGREE[0]:
        remedy = "Look for what changed between the runs; or the roll bends, or data of the rig are wrong."
    yield coded(
        "ABU1006", verdict(value <= AGREE[1], value <= AGREE[0]),
        "largest misfit of a run, in standard deviations by the errors given", value, AGREE[0], None, remedy,
    )  # fmt: skip


def _trials(found: Found) -> Iterator[Check]:
    if found.solution.method != "trial masses":
        return
    matrix = found.solution.influences[0]
    largest = max(abs(one) for run in found.case.runs for one in run.motion)
    on = [max(abs(run.placed[k]) for run in found.case.runs) for k in (0, 1)]
    value = min(on[k] * max(abs(row[k]) for row in matrix) / largest for k in (0, 1)) if largest else 0.0
    remedy = (
        None if value >= TELLS[0] else f"Trial masses {max(2, round(TELLS[0] / value)) if value else 2} times as heavy."
    )
    yield coded(
        "ABU1007", verdict(value >= TELLS[1], value >= TELLS[0]),
        "what the weaker trial mass moves, of the largest reading", value, TELLS[0], None, remedy, "least",
    )  # fmt: skip


def _metal(found: Found) -> Iterator[Check]:
    if found.removable is None:
        return
    value = max(map(removed, found.shares))
    yield coded(
        "ABU1008", verdict(value <= found.removable * (1 + 1e-9)), "mass to take off in a plane",
        from_si(value, "g"), from_si(found.removable, "g"), "g",
        None if value <= found.removable else "More places, so that mass can be put on opposite.",
    )  # fmt: skip
