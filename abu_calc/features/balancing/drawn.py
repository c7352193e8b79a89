"""Planes in characters, as seen by one who stands before the rotor's end; the sketch of mark, sensors and angles.

The mark is on top, the correction on the circle.
"""

import math
from collections.abc import Iterable
from typing import Final

from abu_calc.features.balancing.case import RunReadings
from abu_calc.features.balancing.solution import PlaneCorrection
from abu_calc.features.balancing.study import BalanceResult

WIDTH: Final = 36
HEIGHT: Final = 13
ACROSS: Final = 11
DOWN: Final = 5
SIGNS: Final = {"remove": "-", "add": "+"}
LEGEND: Final = "- remove here, + add here, o heavy spot, 0 zero mark. Degrees count from the mark {marks} rotation."


def drawing(
    left: PlaneCorrection, right: PlaneCorrection, turns_from_left: str, angle_marks: str = "against rotation"
) -> list[str]:
    """Lines with both planes side by side, the left one seen from the left end, the right one from the right."""
    sense = sense_of(turns_from_left)
    pictures = [
        plane_picture("LEFT plane, from the left end", left, sense, angle_marks),
        plane_picture("RIGHT plane, from the right end", right, -sense, angle_marks),
    ]
    return [f"  {line:<{WIDTH}}  {other}".rstrip() for line, other in zip(*pictures, strict=True)]


def called(name: str) -> str:
    """A plane by its name."""
    return "plane" if name == "single" else f"{name} plane"


def sense_of(turns_from_left: str) -> int:
    """1 if the rotor turns counterclockwise to one at its left end: degrees against rotation then run clockwise."""
    return 1 if turns_from_left == "counterclockwise" else -1


def plane_picture(title: str, plane: PlaneCorrection, sense: int, angle_marks: str) -> list[str]:
    """`sense`: 1 where the rotor turns counterclockwise to the one who looks."""
    degrees_run = sense if angle_marks == "against rotation" else -sense
    cells = _circle(degrees_run, sense)
    for sign, place in _marks(plane):
        _put(cells, sign, place, degrees_run)
    _put(cells, "0", 0, degrees_run, 1.25)
    return [f"{title:^{WIDTH}}".rstrip(), *("".join(row).rstrip() for row in cells)]


def _circle(degrees_run: int, sense: int) -> list[list[str]]:
    """The circle of a plane with its degrees and the arrows of rotation."""
    cells = [[" "] * WIDTH for _ in range(HEIGHT)]
    for degrees in range(0, 360, 3):
        _put(cells, ".", degrees, degrees_run)
    for quarter in (90, 180, 270):
        _put(cells, f"{quarter}", quarter, degrees_run, 1.25)
    for row, arrow in ((-2, "<---" if sense > 0 else "--->"), (2, "--->" if sense > 0 else "<---")):
        _write(cells, arrow, WIDTH // 2, HEIGHT // 2 + row)
    return cells


def _marks(plane: PlaneCorrection) -> Iterable[tuple[str, float]]:
    heavy = [("o", plane.remove_at_deg)] if plane.mass_g else []
    return [*heavy, *((SIGNS[share.action], share.angle_deg) for share in plane.corrections)]


def sketch(result: BalanceResult) -> tuple[list[str], str]:
    """Lines with the rotor at the moment when the mark passes its sensor, and the legend with both angles.

    The circle shows the first plane from the left end, with places against rotation from the mark.
    """
    places = sketch_places(result)
    run = sense_of(result.turns_from_left)
    cells = _circle(run, run)
    for sign, degrees, out in places:
        _put(cells, sign, degrees, run, out)
    lines = ["".join(row).rstrip() for row in cells]
    return lines, " ".join(sketch_words(result))


def sketch_places(result: BalanceResult) -> list[tuple[str, float, float]]:
    """Letters of the sketch with their place against rotation [degrees] and their distance from the middle."""
    plane, sensor = result.planes[0][1], result.runs[0].sensors[0]
    places = [("0", 0.0, 1.0), ("M", 0.0, 1.25), ("V", result.sensor_to_mark_deg, 0.75)]
    if sensor.phase_deg is not None:
        places.append(("h", result.sensor_to_mark_deg + lag_of(result.runs[0], sensor.phase_deg), 1.0))
    return [*places, ("o", plane.angle_deg, 1.0)]


def lag_of(run: RunReadings, phase_deg: float) -> float:
    """A phase as it lags [degrees]."""
    return -phase_deg if run.phase == "lead" else phase_deg


def sketch_words(result: BalanceResult) -> list[str]:
    """Sentences below the sketch."""
    name, plane = result.planes[0]
    run, sensor = result.runs[0], result.runs[0].sensors[0]
    words = [
        f"The mark 0 passes its sensor M. The vibration sensor V is {result.sensor_to_mark_deg:.0f}° from M against "
        "rotation (sensor_to_mark_deg)."
    ]
    if sensor.phase_deg is not None:
        passes = f"passed V {sensor.phase_deg:.1f}° ago" if run.phase == "lead" else (
            f"passes V after {sensor.phase_deg:.1f}° of rotation"
        )  # fmt: skip
        words.append(
            f"The high spot h of the vibration {passes}: the phase of sensor {sensor.name} in run 1, {run.phase}."
        )
    words.append(f"The heavy spot o of the {called(name)} is {plane.angle_deg:.1f}° from 0 against rotation.")
    return words


def _put(cells: list[list[str]], text: str, degrees: float, sense: int, out: float = 1.0) -> None:
    """Text at an angle from the mark against rotation, its middle on the circle, or farther out."""
    angle = math.radians(degrees)
    column = WIDTH // 2 + round(ACROSS * out * math.sin(angle) * sense)
    _write(cells, text, column, HEIGHT // 2 - round(DOWN * out * math.cos(angle)))


def _write(cells: list[list[str]], text: str, middle: int, row: int) -> None:
    for offset, letter in enumerate(text):
        cells[row][middle - len(text) // 2 + offset] = letter
