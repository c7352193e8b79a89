"""What to record before anyone goes to the rig: starts, rate, length, and the accuracy that they will give.

The starts of this very machine are simulated with the values of its file, noise added, and identified like recordings.
"""

import math
from dataclasses import replace
from typing import Annotated, ClassVar, Final

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.features.identification.bank import WIDE, RecordedStart, simulated_track, window_centres
from abu_calc.features.identification.estimate import TrackReading
from abu_calc.features.identification.fit import Measured, estimated, identified_values, without_balls
from abu_calc.features.identification.results import ExpectedValues
from abu_calc.features.identification.study import known_scene, machine_subject
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.foundation.units import to_si
from abu_calc.foundation.validity import Range
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.result import Result
from abu_calc.simulation.subject import Source

RUNS: Final = 10
"""Starts that are proposed."""
PER_REVOLUTION: Final = 20
"""Samples in a revolution that are proposed."""
NOISE: Final = Range("noise of a recorded place", 0.01, 100, "um", key="noise_um")
RUN_COUNT: Final = Range("starts", 8, 100, "", key="runs")


@record
class MeasurePlanResult(Result):
    """What to record, and what it will tell."""

    command: ClassVar[str] = "measure-plan"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"run_up_s"}

    model: SceneModel
    runs: Annotated[int, Quantity("starts to record")]
    rate_hz: Annotated[float, Quantity("sampling rate, at least")]
    length_s: Annotated[float, Quantity("length of a recording", "", 3)]
    noise_um: Annotated[float, Quantity("noise assumed", "σ", 3)]
    largest_velocity: Annotated[float, Quantity("largest velocity without balls", "v", 3, unit="mm_per_s")]
    trial_mass: Annotated[float, Quantity("imbalance of the trial mass", "", 3, unit="g_mm")]
    expected: ExpectedValues
    run_up_s: Annotated[float | None, Quantity("run-up time in place of the file's")] = None

    @property
    def status(self) -> "str":  # type: ignore[override]
        """A plan has nothing to judge."""
        return "pass"


@checked
def measure_plan(
    source: Source, *, runs: int = RUNS, noise_um: float = 0.3, run_up_s: float | None = None,
    progress: Progress = silent,
) -> MeasurePlanResult:  # fmt: skip
    """Starts to record of a machine or a scene, and the accuracy expected from simulated recordings of it.

    `noise_um`: of a component of the place, over two revolutions. Raises InputError.
    """
    NOISE.check(noise_um)
    RUN_COUNT.check(float(runs))
    subject = machine_subject(source)
    with subject.located():
        scene = known_scene(subject.scene, run_up_s)
        point = point_of(scene)
    scene = replace(scene, duration=_length(scene))
    centres = window_centres(scene)
    reading = TrackReading(centres, scene.full_speed, abs(without_balls(scene)), to_si(noise_um, "um"), marked=True)
    tracks = [simulated_track(scene, point, centres, 77_000 + k) for k in range(runs)]
    lost = [k for k, track in enumerate(tracks) if track is None]
    if lost:
        raise InputError(f"{len(lost)} of {runs} starts cannot be simulated", remedy="Check the file by abu simulate.")
    noisy = reading.noisy(np.array(tracks), 1)
    starts = tuple(RecordedStart("", track, scene.speed, scene.full_speed, 0.0) for track in noisy)
    measured = Measured(starts, tuple(noisy), reading, None)
    return MeasurePlanResult.read(
        subject,
        model=SceneModel.of(scene),
        runs=runs,
        rate_hz=float(f"{math.ceil(PER_REVOLUTION * scene.speed / 2 / math.pi / 100) * 100:g}"),
        length_s=scene.duration,
        noise_um=noise_um,
        run_up_s=run_up_s,
        largest_velocity=reading.amplitude * scene.speed,
        trial_mass=scene.imbalance / 2,
        expected=identified_values(measured, estimated(scene, measured, progress), 0.0),
    )


def point_of(scene: Scene) -> np.ndarray:
    """The file's drag, lever arm and eccentricity as a point of the box. Raises InputError outside of it."""
    friction, offset = scene.effect("dry_rolling_friction"), scene.effect("race_eccentricity")
    lever = 2e-6 if friction is None else friction.lever_arm  # type: ignore[attr-defined]
    place = 10e-6 if offset is None else offset.offset
    drag = scene.races[0].drag
    point = np.array([math.log(max(drag, 1e-9)), math.log(max(lever * 1e6, 1e-9)), place.real * 1e6, place.imag * 1e6])
    inside = (WIDE.low < point) & (point < WIDE.high)
    if not inside.all():
        names = ("rolling_drag_per_s", "rolling_friction_mm", "race_eccentricity_mm", "race_eccentricity_mm")
        raise InputError(
            "outside the range that recorded starts can tell", place=Place(key=names[int(np.argmin(inside))]),
            allowed="2 … 100 1/s, 0.0003 … 0.03 mm, up to 0.03 mm", remedy="Change the value.",
        )  # fmt: skip
    return point


def _length(scene: Scene) -> float:
    """Length of a recording [s]: the run-up, and forty times the time of the drag, at least two seconds more."""
    return round(scene.full_speed + min(max(2.0, 40 / max(scene.races[0].drag, 1.0)), 20.0), 1)
