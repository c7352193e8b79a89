"""Figure of the displacement against speed in a run-up, with balls and without, simulated when it is asked for."""

from collections.abc import Iterator
from typing import Final

from abu_calc.dynamics.scene import Scene
from abu_calc.foundation.units import from_si
from abu_calc.reporting.charts.figure import Figure
from abu_calc.reporting.charts.run_up_chart import run_up_chart
from abu_calc.simulation.run_up_amplitude import Course, both_courses

ACCURACY: Final = 0.02
"""Accuracy of the two runs that are drawn."""


def amplitude_figure(scene: Scene, section: str, case: str = "") -> Iterator[Figure]:
    """The figure of a scene that runs up; none if neither run can be trusted. `case`: start case in words."""
    with_balls, bare = (_in_user_units(course) for course in both_courses(scene, ACCURACY))
    if not with_balls and not bare:
        return
    where = "at the race" if scene.races else "of the spindle"
    first = f"{case}: largest" if case else "Largest"
    missing = "" if with_balls or not scene.races else " No trustworthy run with balls."
    missing += "" if bare else " No trustworthy run without balls."
    caption = (
        f"{first} displacement {where} in each revolution against speed, with balls "
        "and without. Balls do not help below the natural frequencies. At full speed they settle: the curve falls "
        f"there.{missing}"
    )
    yield Figure("run-up-amplitude", section, run_up_chart(with_balls, bare, "without balls"), caption)


def _in_user_units(course: Course) -> list[tuple[float, float]]:
    return [(from_si(speed, "rpm"), from_si(amplitude, "um")) for speed, amplitude in course]
