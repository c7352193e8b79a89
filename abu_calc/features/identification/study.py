"""Viscous drag rate, rolling friction and race eccentricity of a machine from recorded starts, with intervals."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.features.identification.bank import (
    RecordedStart,
    Signal,
    recorded,
    recorded_start,
    simulated_track,
    window_centres,
)
from abu_calc.features.identification.bench import bench_text, bench_values
from abu_calc.features.identification.estimate import (
    Best,
    TrackReading,
    end_of,
)
from abu_calc.features.identification.fit import (
    FEWEST,
    Estimate,
    Measured,
    checks_of,
    estimated,
    friction_number_at,
    horizontal,
    identified_values,
    without_balls,
)
from abu_calc.features.identification.results import (
    KEYS,
    BenchRecord,
    ExpectedValues,
    IdentifyResult,
    StartCourse,
    interval_lines,
)
from abu_calc.foundation.checks import CHECK_CODES
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.units import shown, to_si
from abu_calc.foundation.validity import Range
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.subject import Source, Subject, subject_of

SIZES: Final = (0.003, 10.0)
"""Largest displacement over the amplitude without balls, at least and at most. Balls that settle within the run-up
leave a small one."""
ALIKE: Final = 0.8
"""Length of the shortest recording over that of the longest, at least."""
RUN_UP: Final = Range("run-up time", 0, 1000, "s", key="run_up_s", open_low=True)
ANGLE: Final = Range("angle of the mark", -360, 360, "deg", key="mark_angle_deg")


@checked
def identify(
    source: Source,
    recordings: Sequence[str],
    *,
    without: str | None = None,
    bench: str | None = None,
    mark_angle_deg: float = 0.0,
    run_up_s: float | None = None,
    progress: Progress = silent,
) -> IdentifyResult:
    """Values of drag, friction and eccentricity from recordings of starts, each from standstill until the balls rest.

    `without`: a recording with the balls taken out, which separates a synchronous background from the eccentricity.
    `bench`: film of a ball let go in the standing race. `mark_angle_deg`: angle of the mark from the imbalance, in the
    direction of rotation. `run_up_s`: instead of the file's. Raises InputError for files that cannot be used; what
    cannot be given is None, and a check says why.
    Method: simulated starts, regression of their features, Student likelihood, parametric bootstrap.
    """
    if run_up_s is not None:
        RUN_UP.check(run_up_s)
    mark_angle = to_si(ANGLE.check(mark_angle_deg), "deg")
    if not recordings:
        raise InputError("no recordings", place=Place(key="RECORDING"), remedy="Name the CSV files of the starts.")
    subject, starts = machine_subject(source), [recorded(file) for file in recordings]
    clipped = tuple(f"{start.file} is clipped: its amplitudes read too low." for start in starts if start.clipped)
    subject = replace(subject, warnings=(*subject.warnings, *clipped))
    with subject.located():
        scene = as_long(known_scene(subject.scene, run_up_s), starts)
    film = None if bench is None else bench_values(bench, scene)
    measured = _measured(scene, starts, without, mark_angle)
    _refuse_twins(starts)
    estimate = estimated(scene, measured, progress) if len(recordings) >= FEWEST else None
    return _result(subject, scene, measured, estimate, mark_angle, film)


def machine_subject(source: Source) -> Subject:
    """The subject of a scene, or of a machine that runs up or idles."""
    from abu_calc.inputs.read_machine import Machine

    if not isinstance(source, Machine):
        return subject_of(source, command="identify")
    return subject_of(source, "idle" if source.whole("identify").run_up is None else "run-up", command="identify")


def known_scene(scene: Scene, run_up: float | None) -> Scene:
    """The scene with the imbalance at angle 0. Raises InputError for what it must have."""
    if len(scene.races) != 1 or len(scene.races[0].ball_masses) < 2:
        raise InputError(
            "starts are identified with one race and its balls",
            place=Place(key="scene.race"),
            found=f"{len(scene.races)} races",
            remedy="Give one race with two balls or more.",
        )
    if not scene.races[0].ball_radius:
        raise InputError(
            "the size of the balls is not known",
            place=Place(key="scene.race[0].ball_radius_mm"),
            remedy="Add ball_radius_mm.",
        )
    if not scene.imbalance:
        raise InputError(
            "there is no imbalance to balance",
            place=Place(key="scene.imbalance_g_mm"),
            remedy="Give the imbalance of the wheel or of a known mass that was added.",
        )
    if run_up is not None:
        kept = tuple(effect for effect in scene.effects if effect.name != "run_up")
        scene = replace(scene, effects=(*kept, RunUpEffect(run_up)))
    elif scene.full_speed == 0:
        raise InputError(
            "the run-up is not known",
            remedy="Give --run-up S, or add it to the file: [run_up] time_s in a machine, "
            "[scene.effects] run_up = { time_s = … } in a scene.",
        )
    return replace(scene, imbalance_angle=0.0)


def as_long(scene: Scene, starts: Sequence[Signal]) -> Scene:
    """The scene as long as the shortest recording."""
    first = min(starts, key=lambda start: start.duration)
    shortest, longest = first.duration, max(start.duration for start in starts)
    if shortest < ALIKE * longest:
        raise InputError(
            "a recording is too short beside the others",
            place=Place(first.file),
            found=f"{shortest:.3g} s",
            allowed=f"at least {ALIKE * longest:.3g} s",
            remedy="Record each start until the balls have come to rest, or leave this one out.",
        )
    return replace(scene, duration=min(shortest, 60.0))


def _refuse_twins(signals: Sequence[Signal]) -> None:
    """Refuse a start that is given twice: its noise would count as agreement."""
    seen: dict[bytes, str] = {}
    for signal in signals:
        samples = signal.motion.tobytes()
        if samples in seen:
            raise InputError(
                "the same start is given twice",
                place=Place(signal.file),
                found=f"the samples of {seen[samples]}",
                remedy="Give each recording once.",
            )
        seen[samples] = signal.file


def _refuse_other_sizes(starts: Sequence[RecordedStart], amplitude: float) -> None:
    """Refuse motions far larger or smaller than the machine's: their unit or machine is another."""
    low, high = SIZES
    for start in starts:
        ratio = float(np.median(np.sort(np.abs(start.track))[-5:])) / amplitude
        if not low < ratio < high:
            raise InputError(
                "the motion is not that of the machine of the file",
                place=Place(start.file),
                found=f"{ratio:.3g} times the amplitude without balls",
                allowed=f"{low:g} … {high:g} times",
                remedy="Check the unit of the column, its sensitivity, and imbalance and mass of the file.",
            )


def _measured(scene: Scene, signals: Sequence[Signal], without: str | None, mark_angle: float) -> Measured:
    centres = window_centres(scene, min(signals, key=lambda signal: signal.duration).file)
    marked = all(signal.mark is not None for signal in signals)
    without_mark = next((signal.file for signal in signals if signal.mark is None), "")
    if not marked and any(signal.mark is not None for signal in signals):
        raise InputError(
            "some recordings have a mark and some have none",
            place=Place(without_mark),
            remedy="Record all starts with the mark.",
        )
    starts = [recorded_start(signal, scene, centres) for signal in signals]
    _refuse_other_sizes(starts, abs(without_balls(scene)))
    turn = np.exp(1j * mark_angle)
    tracks = [np.asarray(start.track * turn) for start in starts]
    background = None
    if without is not None:
        empty = recorded(without)
        if not marked or empty.mark is None:
            raise InputError(
                "the background has a direction",
                place=Place(without, key="mark"),
                remedy="Record it, and the starts, with a mark.",
            )
        alone = recorded_start(empty, scene, centres)
        background = end_of(np.asarray(alone.track * turn)) - without_balls(scene)
        tracks = [np.asarray(track - background) for track in tracks]
    noise = float(np.median([start.noise for start in starts]))
    late = float(np.median([start.phase_error for start in starts]))
    reading = TrackReading(centres, scene.full_speed, abs(without_balls(scene)), noise, marked, late)
    return Measured(tuple(starts), tuple(tracks), reading, background)


def _result(
    subject: Subject,
    scene: Scene,
    measured: Measured,
    estimate: Estimate | None,
    mark_angle: float,
    film: BenchRecord | None,
) -> IdentifyResult:
    checks = tuple(
        check if check.status == "pass" or check.remedy else check.with_action(CHECK_CODES[check.code].action)
        for check in checks_of(scene, measured, estimate)
    )
    marked = measured.reading.marked
    edge = () if estimate is None else estimate.at_the_edge(marked=marked)
    values = ExpectedValues() if estimate is None else identified_values(measured, estimate, mark_angle)
    ends = [end_of(start.track) for start in measured.starts]
    run_ups = [start.run_up for start in measured.starts if start.run_up is not None]
    predicted = None if estimate is None or edge else _predicted(scene, measured, estimate.best)
    return IdentifyResult.read(
        subject,
        values,
        checks=checks,
        model=SceneModel.of(scene),
        starts=len(measured.starts),
        mark=marked,
        noise=measured.reading.noise,
        friction_number=None
        if estimate is None or values.rolling_friction_mm is None
        else friction_number_at(scene, estimate.best.point) or None,
        residual=float(np.mean(np.abs(ends))),
        fits_worse_share=None if estimate is None else estimate.fits_worse,
        run_up_s=scene.full_speed,
        measured_run_up_s=float(np.median(run_ups)) if run_ups else None,
        simulated_starts=0 if estimate is None else estimate.simulated,
        times_s=tuple(map(float, measured.reading.centres)),
        courses=tuple(
            StartCourse(
                file=start.file,
                end=(end.real, end.imag),
                distance=tuple(map(float, np.abs(track - end_of(track)))),
                predicted=predicted,
            )
            for start, track, end in zip(measured.starts, measured.tracks, ends, strict=True)
        ),
        toml=_toml(len(measured.starts), values),
        bench=film,
        assumed=(*_assumed(scene, measured), *(() if film is None else (bench_text(film),))),
    )


def _predicted(scene: Scene, measured: Measured, best: Best) -> tuple[float, ...] | None:
    """Median distance from the end [m] of starts simulated with the identified values."""
    tracks = [simulated_track(scene, best.point, measured.reading.centres, 5_000 + k) for k in range(15)]
    kept = [np.abs(track - end_of(track)) for track in tracks if track is not None]
    return tuple(map(float, np.median(kept, axis=0))) if kept else None


def _toml(starts: int, values: ExpectedValues) -> str | None:
    """Lines to paste into a machine file: values of [autobalancer], and their intervals."""
    known = {key: value for key in KEYS if (value := getattr(values, key)) is not None}
    if not known:
        return None
    lines = [f"{key} = {value.value:.4g}" for key, value in known.items()]
    return "\n".join(("[autobalancer]", *lines, *interval_lines(starts, known)))


def _assumed(scene: Scene, measured: Measured) -> Iterator[str]:
    """What the values rest on."""
    yield (
        f"Speed {shown(scene.speed, 'rpm', '.0f')}, run-up {scene.full_speed:.3g} s, imbalance "
        f"{shown(scene.imbalance, 'g_mm', '.4g')}, masses and springs are those of the file."
    )
    yield "A wrong run-up time or imbalance moves the values: half the run-up may double the drag rate."
    if not measured.reading.marked:
        yield (
            "Without a mark the magnitudes alone count: no eccentricity is given, and drag rate and lever arm are "
            "known less well."
        )
    if measured.background is None:
        yield "No recording without balls is given: a synchronous background counts as eccentricity (--without)."
    else:
        yield f"The synchronous background, {abs(measured.background) * 1e6:.2f} µm, is taken off."
    if horizontal(scene):
        yield "The spindle is horizontal: the balls lie at the bottom when the machine is switched on."
    else:
        yield "The spindle is vertical: the balls lie anywhere when the machine is switched on."
