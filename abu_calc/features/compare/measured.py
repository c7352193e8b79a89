"""Recorded starts beside the starts that a machine's file predicts: settling time, residual and level.

Both are read alike: the place of the axis in the frame of the rotor in windows of two revolutions, its distance from
where it comes to rest. The level is that of the once-per-revolution velocity at the end.

The report of recorded starts beside predicted ones.
"""

import math
from collections.abc import Sequence
from typing import Annotated, ClassVar, Final, NamedTuple, Self

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.features.identification.bank import (
    Array,
    Track,
    recorded,
    recorded_start,
    simulated_track,
    window_centres,
)
from abu_calc.features.identification.estimate import end_of
from abu_calc.features.identification.fit import without_balls
from abu_calc.features.identification.plan import point_of
from abu_calc.features.identification.study import as_long, known_scene, machine_subject
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.progress import Progress, counted, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import level_from_velocity
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Curve, Extras, Figure, Plot
from abu_calc.reporting.parts import notices, provenance_blocks
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.result import Result
from abu_calc.simulation.subject import Source

STARTS: Final = 24
"""Starts that are simulated with the values of the file."""
SETTLED: Final = 0.1
"""Share of the amplitude without balls below which the distance from the end counts as settled."""
BAND: Final = (0.05, 0.5, 0.95)
"""Shares of the simulated starts whose values are given."""


@record
class CourseNumbers(Record):
    """Numbers of one start."""

    settling_time: Annotated[float | None, Quantity("settling time from full speed", "t_s", 3, unit="s")]
    residual: Annotated[float, Quantity("residual displacement, 0–peak", "", 3, unit="um")]
    level_db: Annotated[float, Quantity("velocity level of the rotation", "L", 4)]

    @classmethod
    def of(cls, track: Track, centres: Array, scene: Scene, *, marked: bool = True) -> Self:
        """Numbers of a track [m] at the centres [s] of its windows."""
        end = abs(_end(track, marked=marked))
        limit = SETTLED * abs(without_balls(scene))
        above = np.flatnonzero(_away(track, marked=marked) > limit)
        settled = 0.0 if not len(above) else float(centres[above[-1]]) - scene.full_speed
        late = len(above) > 0 and above[-1] >= len(centres) - 2
        velocity = scene.speed * end / math.sqrt(2)
        return cls(
            settling_time=math.inf if late else settled, residual=end,
            level_db=level_from_velocity(max(velocity, 1e-12)),
        )  # fmt: skip


@record
class MeasuredCourse(Record):
    """One recorded start."""

    file: Annotated[str, Quantity("recording")]
    numbers: CourseNumbers
    distance: Annotated[tuple[float, ...], Quantity("distance from the end", "", 4, unit="um")]


@record
class PredictedCourse(Record):
    """Starts that are simulated with the values of a file: ends and median of a band of 90 %."""

    title: Annotated[str, Quantity("machine")]
    low: CourseNumbers
    median: CourseNumbers
    high: CourseNumbers
    starts: Annotated[int, Quantity("simulated starts")]
    distance: Annotated[tuple[float, ...], Quantity("median distance from the end", "", 4, unit="um")]


@record
class MeasuredCompareResult(Result):
    """Recorded starts beside predicted ones."""

    command: ClassVar[str] = "compare"

    model: SceneModel
    mark: Annotated[bool, Quantity("a mark was recorded")]
    times: Annotated[tuple[float, ...], Quantity("time from the switching-on", unit="s")]
    measured: tuple[MeasuredCourse, ...]
    predicted: tuple[PredictedCourse, ...]

    @property
    def status(self) -> "str":  # type: ignore[override]
        """Nothing is judged."""
        return "pass"


@checked
def compare_measured(
    machines: Sequence[Source], recordings: Sequence[str], *, progress: Progress = silent
) -> MeasuredCompareResult:
    """Recorded starts beside the starts that the files of machines predict, drag, friction and eccentricity included.

    Each recording begins when the machine is switched on. Raises InputError for files that cannot be used, and for
    machines whose speed or run-up time differ: their starts cannot be set side by side.
    """
    if not machines or not recordings:
        raise InputError("nothing to compare", place=Place(key="--measured"), remedy="Name a machine and a recording.")
    signals, subjects = [recorded(file) for file in recordings], [machine_subject(machine) for machine in machines]
    scenes = list[Scene]()
    for subject in subjects:
        with subject.located():
            scenes.append(as_long(known_scene(subject.scene, None), signals))
    first = scenes[0]
    if any(not math.isclose(s.speed, first.speed) or not math.isclose(s.full_speed, first.full_speed) for s in scenes):
        raise InputError(
            "machines of different speeds or run-up times", place=Place(key="MACHINE"),
            remedy="Compare each with the recordings alone.",
        )  # fmt: skip
    centres, marked = window_centres(first), all(signal.mark is not None for signal in signals)
    starts = [recorded_start(signal, first, centres) for signal in signals]
    predicted = [_predicted(subject.title, scene, CourseReading(centres, marked), progress)
                 for subject, scene in zip(subjects, scenes, strict=True)]  # fmt: skip
    return MeasuredCompareResult(
        title=subjects[0].title,
        provenance=subjects[0].provenance,
        warnings=tuple(dict.fromkeys(warning for subject in subjects for warning in subject.warnings)),
        model=SceneModel.of(first),
        mark=marked,
        times=tuple(centres.tolist()),
        measured=tuple(
            MeasuredCourse(file=start.file, numbers=CourseNumbers.of(start.track, centres, first, marked=marked),
                           distance=tuple(_away(start.track, marked=marked).tolist()))
            for start in starts
        ),
        predicted=tuple(predicted),
    )  # fmt: skip


def _end(track: Track, *, marked: bool) -> complex:
    """Place of rest; without a mark its magnitude, since the phase drifts."""
    return end_of(track if marked else np.abs(track).astype(complex))


def _away(track: Track, *, marked: bool) -> Array:
    """Distances from the place of rest [m]; without a mark differences of the magnitudes."""
    end = _end(track, marked=marked)
    return np.abs(track - end) if marked else np.abs(np.abs(track) - abs(end))


class CourseReading(NamedTuple):
    """How tracks are read: centres of the windows [s], whether there is a mark."""

    centres: Array
    marked: bool


def _predicted(title: str, scene: Scene, reading: CourseReading, progress: Progress) -> PredictedCourse:
    """Starts of a scene from random places of the balls, with its own drag, friction and eccentricity."""
    point, report, tracks = point_of(scene), counted(progress, "{} of {} starts", STARTS), list[Track]()
    for start in range(STARTS):
        track = simulated_track(scene, point, reading.centres, 31_000 + start)
        tracks += [] if track is None else [track]
        report(start + 1)
    if len(tracks) < STARTS // 2:
        raise NotTrustworthyError(f"{STARTS - len(tracks)} of {STARTS} starts cannot be simulated")
    numbers = [CourseNumbers.of(track, reading.centres, scene, marked=reading.marked) for track in tracks]
    times = np.array([each.settling_time for each in numbers], dtype=float)
    ends = [
        CourseNumbers(
            settling_time=float(np.quantile(times, share, method="nearest")),
            residual=float(np.quantile([each.residual for each in numbers], share)),
            level_db=float(np.quantile([each.level_db for each in numbers], share)),
        )
        for share in BAND
    ]
    middle = np.median([_away(track, marked=reading.marked) for track in tracks], axis=0)
    return PredictedCourse(
        title=title, low=ends[0], median=ends[1], high=ends[2], starts=len(tracks),
        distance=tuple(middle.tolist()),
    )  # fmt: skip


CAPTION = (
    "Distance of the axis from where it comes to rest, in the frame of the rotor: recorded starts, and the median of "
    "starts simulated with the values of the file. Starts differ by where the balls lie."
)


def measured_blocks(result: MeasuredCompareResult) -> tuple[Block, ...]:
    """Numbers of every recorded start, and the band of the predicted ones."""
    measured = tuple((course.file, *_cells(course.numbers)) for course in result.measured)
    predicted = tuple(
        (f"{course.title}, {name}", *_cells(numbers))
        for course in result.predicted
        for name, numbers in (("5 %", course.low), ("median", course.median), ("95 %", course.high))
    )
    header = ("start", "settling, s", "residual, µm", "level, dB")
    mark = "" if result.mark else " Without a mark distances are those of magnitudes."
    return (
        Heading(f"{result.title}: recorded starts beside predicted ones"),
        Heading("Measured", "measured"),
        Grid(header, measured, frozenset({1, 2, 3})),
        Heading("Predicted with the values of the file", "predicted"),
        Grid(header, predicted, frozenset({1, 2, 3})),
        Paragraph(
            "The settling time counts from full speed until the axis stays within a tenth of the amplitude without "
            f"balls from its end. Residual and level are those of the rotation at the end.{mark}"
        ),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def _cells(numbers: CourseNumbers) -> tuple[str, str, str]:
    time = numbers.settling_time_s
    return "never" if time is None else number(time, 3), number(numbers.residual_um, 3), f"{numbers.level_db:.1f}"


def measured_extras(result: MeasuredCompareResult) -> Extras:
    """The figure of all courses."""
    times = result.times_s
    curves = [
        Curve(tuple(zip(times, course.distance_um, strict=True)), "" if k else "measured")
        for k, course in enumerate(result.measured)
    ]
    curves += [
        Curve(tuple(zip(times, course.distance_um, strict=True)), f"{course.title}, predicted median", 2 + k)
        for k, course in enumerate(result.predicted)
    ]
    across = Axis("time from the switching-on [s]", 0.0, times[-1])
    up = Axis.around("distance from the end [µm]", [0.0, *(y for curve in curves for _, y in curve.points)])
    summary = f"Distance of the axis from its end in {len(result.measured)} recorded starts, and as predicted"
    plot = Plot("Measured and predicted starts", summary, across, up, curves)
    return Extras((Figure("courses", "measured", plot, CAPTION),))
