"""Viscous drag rate, rolling friction and race eccentricity of a machine from recorded starts, with intervals."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Annotated, ClassVar, Final, Self

import numpy as np

from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.features.identification.bank import WIDE, Box, bank_of, simulated_track
from abu_calc.features.identification.bench import BenchValues, bench_text, bench_values
from abu_calc.features.identification.estimate import (
    DECAY,
    Best,
    Features,
    Regression,
    TrackReading,
    end_of,
    inside,
    narrowed,
)
from abu_calc.features.identification.tracks import (
    RecordedStart,
    Signal,
    Track,
    recorded,
    recorded_start,
    window_centres,
)
from abu_calc.formulas.shaken_friction import friction_number
from abu_calc.foundation.checks import CHECK_CODES, Check, coded
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, to_si, wrapped_deg
from abu_calc.foundation.validity import Range
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.result import Result
from abu_calc.simulation.subject import Source, Subject, subject_of

ALIKE: Final = 0.8
"""Length of the shortest recording over that of the longest, at least."""
FEWEST: Final = 8
"""Starts, at least."""
MANY, FEW = 2048, 1024
"""Starts of the first bank, and of each narrower one."""
LEVERS: Final = (0.3, 1.4, 6.5, 30.0)
"""Lever arms [µm] between ranges that are tried each for itself."""
ROUNDS: Final = 5
"""Narrower banks, at most."""
SETS: Final = 40
"""Sets of starts that are simulated at the estimate, for intervals and goodness of fit."""
COVERED: Final = 0.95
LEAST_DROP, MOST_DROP = 1.92, 12.0
"""Drops of the logarithmic likelihood at the ends of an interval: χ² of one freedom, and where a calibration stops."""
SURE_UM: Final = 0.3
"""Half of the narrowest interval of the eccentricity [µm]: with a mark, machines of known values came out 0.16 µm off
in the median, more than their starts scatter."""
UNSURE_UM: Final = 8.0
"""Half of the interval of a component of the eccentricity [µm] above which none is given."""
TREND: Final = 0.01
"""Probability below which an order of the decays is no chance."""
NAMES: Final = ("drag rate", "lever arm", "eccentricity", "eccentricity")
"""Names of the unknowns."""
POOR: Final = 0.025
"""Share of simulated sets that fit worse, below which the fit is poor."""
OFF: Final = 4.0
"""Standard errors by which amplitudes at the start may differ."""
RUN_UP_OFF: Final = 0.15
"""Share by which a run-up may differ from the file's."""
RUN_UP: Final = Range("run-up time", 0, 1000, "s", key="run_up_s", open_low=True)
ANGLE: Final = Range("angle of the mark", -360, 360, "deg", key="mark_angle_deg")


@record
class IdentifiedValue(Record):
    """A value with its interval of 95 %."""

    value: Annotated[float, Quantity("value", "", 4)]
    low: Annotated[float, Quantity("low", "", 4)]
    high: Annotated[float, Quantity("high", "", 4)]


@record
class BenchRecord(Record):
    """Values of one ball in the standing race: drag rate at low slip, which is not that at speed, and lever arm."""

    rolling_drag_per_s: Annotated[IdentifiedValue, Quantity("viscous drag rate at low slip", "h₀", 4, "1/s")]
    rolling_friction_mm: Annotated[IdentifiedValue, Quantity("lever arm of rolling friction", "k_r", 4, "mm")]

    @classmethod
    def of(cls, film: BenchValues) -> Self:
        """Values with two standard errors to both sides."""
        drag, lever = (
            IdentifiedValue(value=value * unit, low=max(0.0, value - 2 * error) * unit, high=(value + 2 * error) * unit)
            for value, error, unit in ((film.drag, film.drag_error, 1.0), (film.lever, film.lever_error, 1e3))
        )
        return cls(rolling_drag_per_s=drag, rolling_friction_mm=lever)


@record
class StartCourse(Record):
    """One start: distance of the axis from its end over time, as measured."""

    file: Annotated[str, Quantity("recording")]
    end_um: Annotated[tuple[float, float], Quantity("end from the mark", "", 4)]
    distance_um: Annotated[tuple[float, ...], Quantity("distance from the end", "", 4)]
    predicted_um: Annotated[tuple[float, ...] | None, Quantity("simulated with the identified values", "", 4)]


@record
class IdentifyResult(Result):
    """Values that the recorded starts give; null where a check says why."""

    command: ClassVar[str] = "identify"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"assumed"}

    model: SceneModel
    rolling_drag_per_s: Annotated[IdentifiedValue | None, Quantity("viscous drag rate", "h₀", 4, "1/s")]
    rolling_friction_mm: Annotated[IdentifiedValue | None, Quantity("lever arm of rolling friction", "k_r", 4, "mm")]
    race_eccentricity_mm: Annotated[IdentifiedValue | None, Quantity("race eccentricity", "Δ", 4, "mm")]
    race_eccentricity_angle_deg: Annotated[IdentifiedValue | None, Quantity("its angle from the mark", "φ", 4, "deg")]
    starts: Annotated[int, Quantity("recorded starts")]
    mark: Annotated[bool, Quantity("a mark was recorded")]
    noise_um: Annotated[float, Quantity("noise of a recorded place", "σ", 3)]
    friction_number: Annotated[
        float | None, Quantity("friction over gravity", "Λ", 3, "below 1 gravity shakes friction out")
    ]
    residual_um: Annotated[float, Quantity("mean distance of the ends from the axis", "", 3)]
    fits_worse_share: Annotated[float | None, Quantity("simulated sets that fit worse", "", 2, percent=True)]
    run_up_s: Annotated[float, Quantity("run-up time", "", 3)]
    measured_run_up_s: Annotated[float | None, Quantity("run-up time by the mark", "", 3)]
    simulated_starts: Annotated[int, Quantity("starts simulated")]
    times_s: Annotated[tuple[float, ...], Quantity("time from the switching-on")]
    courses: tuple[StartCourse, ...]
    bench: BenchRecord | None
    toml: Annotated[str | None, Quantity("block for the file")]
    assumed: tuple[str, ...]
    """What the values rest on, in sentences."""


@dataclass(frozen=True, eq=False)
class Measured:
    """All recorded starts in the frame of the imbalance, without the background."""

    starts: tuple[RecordedStart, ...]
    tracks: tuple[Track, ...]
    reading: TrackReading
    background: complex | None

    @property
    def features(self) -> Features:
        """Features of every start."""
        return np.array([self.reading.features(track) for track in self.tracks])

    @property
    def end_error(self) -> float:
        """Standard error of a component of the mean end [µm]."""
        ends = np.array([end_of(track) for track in self.tracks]) * 1e6
        return float(np.sqrt(np.mean(np.abs(ends - ends.mean()) ** 2) / 2)) / math.sqrt(max(len(ends) - 1, 1))


@dataclass(frozen=True, eq=False)
class Estimate:
    """The likeliest point, ends of its intervals, and the share of simulated sets that fit worse."""

    best: Best
    box: Box
    intervals: tuple[tuple[float, float], ...]
    end_error: float
    fits_worse: float
    amplitude_off: float
    """Difference of the amplitudes at the start from those simulated, in standard errors."""
    amplitude_ratio: float
    simulated: int

    @property
    def offset_error(self) -> float:
        """Half of the widest interval of a component of the eccentricity [µm]; infinite without a mark.

        The interval is no narrower than two standard errors of the mean end: a likelihood may trust its prior.
        """
        halves = [(high - low) / 2 for low, high in self.intervals[2:]]
        return max(SURE_UM, 2 * self.end_error, *halves) if halves else math.inf

    @property
    def offset_allowed(self) -> float:
        """Largest `offset_error` [µm] with which an eccentricity is given: one that may be none has no direction."""
        return min(UNSURE_UM, math.hypot(*self.best.point[2:]))

    def at_the_edge(self, *, marked: bool) -> tuple[str, ...]:
        """Names of the values at the edge of what was simulated."""
        wide, narrow = WIDE.place(self.best.point), self.box.place(self.best.point)
        places = zip(NAMES if marked else NAMES[:2], wide, narrow, strict=False)
        return tuple(dict.fromkeys(name for name, *both in places if not all(0.01 < place < 0.99 for place in both)))


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
    ANGLE.check(mark_angle_deg)
    if not recordings:
        raise InputError("no recordings", place=Place(key="RECORDING"), remedy="Name the CSV files of the starts.")
    subject, starts = machine_subject(source), [recorded(file) for file in recordings]
    with subject.located():
        scene = _as_long(known_scene(subject.scene, run_up_s), starts)
    film = None if bench is None else bench_values(bench, scene)
    measured = _measured(scene, starts, without, mark_angle_deg)
    estimate = estimated(scene, measured, progress) if len(recordings) >= FEWEST else None
    return _result(subject, scene, measured, estimate, mark_angle_deg, film)


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
            place=Place(key="scene.effects.run_up"),
            remedy="Add the run-up time to the file, or give --run-up S.",
        )
    return replace(scene, imbalance_angle=0.0)


def _as_long(scene: Scene, starts: Sequence[Signal]) -> Scene:
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


def _measured(scene: Scene, signals: Sequence[Signal], without: str | None, mark_angle: float) -> Measured:
    centres = window_centres(scene)
    marked = all(signal.mark is not None for signal in signals)
    without_mark = next((signal.file for signal in signals if signal.mark is None), "")
    if not marked and any(signal.mark is not None for signal in signals):
        raise InputError(
            "some recordings have a mark and some have none",
            place=Place(without_mark),
            remedy="Record all starts with the mark.",
        )
    starts = [recorded_start(signal, scene, centres) for signal in signals]
    turn = np.exp(1j * to_si(mark_angle, "deg"))
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


def without_balls(scene: Scene) -> complex:
    """Place of the axis in the rotor's frame [m] without balls, as a sensor along x tells it."""
    moved = scene.support.small_motion(scene.speed).receptance(scene.speed)
    return complex(moved[0, 0] * scene.imbalance * scene.speed**2)


def _horizontal(scene: Scene) -> bool:
    return scene.effect("gravity") is not None


def estimated(scene: Scene, measured: Measured, progress: Progress) -> Estimate:
    """The likeliest values, their intervals, and how well simulated sets fit."""
    features, centres, box = measured.features, measured.reading.centres, WIDE
    regression = Regression(bank_of(scene, box, MANY, centres, within(progress, "wide")), measured.reading)
    best, simulated = _begun(scene, measured, regression, progress), MANY + (len(LEVERS) - 1) * FEW // 2
    parts = (0, 1, 2, 3) if measured.reading.marked else (0, 1)
    for _ in range(ROUNDS):
        box = narrowed(best, measured.end_error)
        regression = Regression(bank_of(scene, box, FEW, centres, within(progress, "narrow")), measured.reading)
        best, simulated = regression.best(features), simulated + FEW
        if inside(best, box, parts):
            break
    progress("intervals")
    sets = list(_sets(scene, measured, best))
    fits = [regression.best(each, begin=best.point) for each in sets]
    drops = [_drop(regression, each, fit, best, parts) for each, fit in zip(sets, fits, strict=True)]
    intervals = [
        regression.interval(features, best, part, float(np.clip(np.quantile(column, COVERED), LEAST_DROP, MOST_DROP)))
        for part, column in zip(parts, np.array(drops).T, strict=True)
    ]
    means, deviations = regression.distribution(best.point)
    amplitudes = (features[:, -1] - means[0, -1]) / deviations[0, -1]
    return Estimate(
        best,
        box,
        tuple(intervals),
        measured.end_error,
        float(np.mean([fit.value < best.value for fit in fits])),
        float(np.mean(amplitudes)) * math.sqrt(len(features)),
        float(np.mean(features[:, -1]) / means[0, -1]),
        simulated + SETS * len(features),
    )


def _begun(scene: Scene, measured: Measured, wide: Regression, progress: Progress) -> Best:
    """The best of several ranges of the lever arm, each judged by a bank of its own: the wide regression is rough."""
    features, ends = measured.features, list[Best]()
    for number, (low, high) in enumerate(pairwise(LEVERS)):
        part = Box(WIDE.low.copy(), WIDE.high.copy())
        part.low[1], part.high[1] = math.log(low), math.log(high)
        box = narrowed(wide.best(features, part=part), measured.end_error)
        share = within(progress, f"range {number + 1} of {len(LEVERS) - 1}")
        regression = Regression(bank_of(scene, box, FEW // 2, measured.reading.centres, share), measured.reading)
        ends.append(regression.best(features))
    return max(ends, key=lambda best: best.value)


def _sets(scene: Scene, measured: Measured, best: Best) -> Iterator[Features]:
    """Features of whole sets of starts, simulated at the estimate."""
    count, reading = len(measured.tracks), measured.reading
    for number in range(SETS):
        seeds = range(10_000 + number * count, 10_000 + (number + 1) * count)
        tracks = [simulated_track(scene, best.point, reading.centres, seed) for seed in seeds]
        kept = np.array([track for track in tracks if track is not None])
        if len(kept) == count:
            yield np.array([reading.features(track) for track in reading.noisy(kept, number)])


def _drop(regression: Regression, features: Features, fit: Best, truth: Best, parts: Sequence[int]) -> list[float]:
    """Fall of the profile from its best to the truth, for each unknown."""
    return [fit.value - regression.best(features, (part, float(truth.point[part])), fit.point).value for part in parts]


def _result(
    subject: Subject,
    scene: Scene,
    measured: Measured,
    estimate: Estimate | None,
    mark_angle: float,
    film: BenchValues | None,
) -> IdentifyResult:
    checks = tuple(
        check if check.status == "pass" or check.remedy else check.with_action(CHECK_CODES[check.code].action)
        for check in _checks(scene, measured, estimate)
    )
    marked = measured.reading.marked
    edge = () if estimate is None else estimate.at_the_edge(marked=marked)
    drag, friction, eccentricity, angle = (
        (None,) * 4 if estimate is None else identified_values(measured, estimate, mark_angle)
    )
    ends_um = [end_of(start.track) * 1e6 for start in measured.starts]
    run_ups = [start.run_up for start in measured.starts if start.run_up is not None]
    predicted = None if estimate is None or edge else _predicted(scene, measured, estimate.best)
    return IdentifyResult.read(
        subject,
        checks=checks,
        warnings=subject.warnings,
        model=SceneModel.of(scene),
        rolling_drag_per_s=drag,
        rolling_friction_mm=friction,
        race_eccentricity_mm=eccentricity,
        race_eccentricity_angle_deg=angle,
        starts=len(measured.starts),
        mark=marked,
        noise_um=measured.reading.noise * 1e6,
        friction_number=None if friction is None else _friction_number(scene, friction.value * 1e-3),
        residual_um=float(np.mean(np.abs(ends_um))),
        fits_worse_share=None if estimate is None else estimate.fits_worse,
        run_up_s=scene.full_speed,
        measured_run_up_s=float(np.median(run_ups)) if run_ups else None,
        simulated_starts=0 if estimate is None else estimate.simulated,
        times_s=tuple(map(float, measured.reading.centres)),
        courses=tuple(
            StartCourse(
                file=start.file,
                end_um=(float(end.real), float(end.imag)),
                distance_um=tuple(float(d) * 1e6 for d in np.abs(track - end_of(track))),
                predicted_um=predicted,
            )
            for start, track, end in zip(measured.starts, measured.tracks, ends_um, strict=True)
        ),
        toml=_toml(drag, friction, eccentricity, angle),
        bench=None if film is None else BenchRecord.of(film),
        assumed=(*_assumed(scene, measured), *(() if film is None else (bench_text(film),))),
    )


Values = tuple[IdentifiedValue | None, IdentifiedValue | None, IdentifiedValue | None, IdentifiedValue | None]
"""Drag rate [1/s], lever arm [mm], eccentricity [mm] and its angle [deg]."""


def identified_values(measured: Measured, estimate: Estimate, mark_angle: float) -> Values:
    """The values that are known."""
    marked = measured.reading.marked
    edge = estimate.at_the_edge(marked=marked)
    ends = [np.exp(interval) for interval in estimate.intervals[:2]]
    drag, friction = (
        IdentifiedValue(value=float(value) * unit, low=float(low) * unit, high=float(high) * unit)
        for value, (low, high), unit in zip(np.exp(estimate.best.point[:2]), ends, (1.0, 1e-3), strict=True)
    )
    known = marked and NAMES[2] not in edge and estimate.offset_error <= estimate.offset_allowed
    eccentricity, angle = _offset(estimate, measured.reading.phase_error, mark_angle) if known else (None, None)
    return None if NAMES[0] in edge else drag, None if NAMES[1] in edge else friction, eccentricity, angle


def _offset(estimate: Estimate, phase_error: float, mark_angle: float) -> tuple[IdentifiedValue, IdentifiedValue]:
    """Magnitude [mm] and angle from the mark [deg], with intervals from those of the components and of the mark."""
    x, y = (float(value) for value in estimate.best.point[2:])
    size, half = math.hypot(x, y), estimate.offset_error
    spread = from_si(math.asin(min(1.0, half / size)) + phase_error, "deg")
    length = IdentifiedValue(value=size * 1e-3, low=(size - half) * 1e-3, high=(size + half) * 1e-3)
    angle = wrapped_deg(math.atan2(y, x) - to_si(mark_angle, "deg"))
    return length, IdentifiedValue(value=angle, low=angle - spread, high=angle + spread)


def _friction_number(scene: Scene, lever: float) -> float | None:
    """Λ = k_r R_p Ω²/(r g); None on a vertical spindle."""
    race = scene.races[0]
    if not _horizontal(scene):
        return None
    return friction_number(lever, race.pitch_radius, race.ball_radius, scene.speed)


def _predicted(scene: Scene, measured: Measured, best: Best) -> tuple[float, ...] | None:
    """Median distance from the end [µm] of starts simulated with the identified values."""
    tracks = [simulated_track(scene, best.point, measured.reading.centres, 5_000 + k) for k in range(15)]
    kept = [np.abs(track - end_of(track)) for track in tracks if track is not None]
    return tuple(float(d) * 1e6 for d in np.median(kept, axis=0)) if kept else None


def _checks(scene: Scene, measured: Measured, estimate: Estimate | None) -> Iterator[Check]:
    count, marked = len(measured.starts), measured.reading.marked
    if estimate is None:
        yield coded("ABU1101", "not-done", f"{count} starts were recorded", count, FEWEST, "", bound="least")
        return
    yield coded("ABU1101", "pass", f"{count} starts were recorded", count, FEWEST, "", bound="least")
    edge = estimate.at_the_edge(marked=marked)
    yield coded(
        "ABU1102",
        "not-done" if edge else "pass",
        f"At the edge of the range: {', '.join(edge)}" if edge else "All values lie inside",
    )
    mean = complex(np.mean([end_of(track) for track in measured.tracks])) * 1e6
    yield from _of_the_ends(mean, measured.end_error, estimate, marked=marked)
    yield _trend(measured)
    off = abs(estimate.amplitude_off) > OFF and abs(estimate.amplitude_ratio - 1) > 0.05
    ratio = estimate.amplitude_ratio
    yield coded(
        "ABU1105",
        "warn" if off else "pass",
        f"The amplitude at the start is {ratio:.2f} times that simulated"
        + (f"; an imbalance {ratio:.2f} times as large, or a mass {1 / ratio:.2f} times, would fit" if off else ""),
    )
    yield coded(
        "ABU1107",
        "warn" if estimate.fits_worse < POOR else "pass",
        f"{estimate.fits_worse:.0%} of {SETS} simulated sets fit worse",
    )
    yield _run_up_check(scene, measured)


def _of_the_ends(mean: complex, error: float, estimate: Estimate, *, marked: bool) -> Iterator[Check]:
    if not marked:
        yield coded("ABU1103", "not-done", "There is no mark, so that ends have no direction", requested=False)
        yield coded("ABU1106", "not-done", "There is no mark", requested=False)
        return
    known = estimate.offset_error <= estimate.offset_allowed
    offset = complex(*estimate.best.point[2:])
    if known:
        apart = abs(offset + mean)
        allowed = 3 * error + estimate.offset_error + 1.0
        yield coded(
            "ABU1103",
            "pass" if apart <= allowed else "warn",
            "Distance of the mean end from the place opposite the eccentricity",
            apart,
            allowed,
            "µm",
        )
    else:
        yield coded("ABU1103", "not-done", "No eccentricity is known")
    yield coded(
        "ABU1106",
        "pass" if known else "not-done",
        "Half of the interval of the eccentricity",
        estimate.offset_error,
        estimate.offset_allowed,
        "µm",
    )


def _trend(measured: Measured) -> Check:
    from scipy.stats import spearmanr

    decays = measured.features[:, DECAY]
    rank, chance = spearmanr(np.arange(len(decays)), decays)
    trend = bool(chance < TREND)
    way = "longer" if rank > 0 else "shorter"
    return coded(
        "ABU1104",
        "warn" if trend else "pass",
        f"The decays get {way} from start to start (rank correlation {rank:.2f})"
        if trend
        else f"Rank correlation of decay and order {rank:.2f}",
    )


def _run_up_check(scene: Scene, measured: Measured) -> Check:
    times = [start.run_up for start in measured.starts if start.run_up is not None]
    if not times:
        return coded("ABU1108", "not-done", "The recordings have no mark during the run-up", requested=False)
    time, given = float(np.median(times)), scene.full_speed
    off = abs(time / given - 1) > RUN_UP_OFF
    return coded(
        "ABU1108",
        "warn" if off else "pass",
        f"By the mark the run-up takes {time:.3g} s, by the file {given:.3g} s",
        remedy=f"Repeat with the measured time: --run-up {time:.3g}." if off else None,
    )


def _toml(*values: IdentifiedValue | None) -> str | None:
    """Lines to paste under [autobalancer] of a machine file."""
    keys = ("rolling_drag_per_s", "rolling_friction_mm", "race_eccentricity_mm")
    lines = [
        f"{key} = {value.value:.4g}  # measured: {value.low:.3g} … {value.high:.3g}, 95 %"
        for key, value in zip(keys, values, strict=False)
        if value is not None
    ]
    return "\n".join(("[autobalancer]", *lines)) if lines else None


def _assumed(scene: Scene, measured: Measured) -> Iterator[str]:
    """What the values rest on."""
    yield (
        f"Speed {from_si(scene.speed, 'rpm'):.0f} rpm, run-up {scene.full_speed:.3g} s, imbalance "
        f"{from_si(scene.imbalance, 'g_mm'):.4g} g·mm, masses and springs are those of the file."
    )
    yield "A wrong run-up time or imbalance moves the values: half the run-up may double the drag rate."
    if measured.background is None:
        yield "No recording without balls is given: a synchronous background counts as eccentricity (--without)."
    else:
        yield f"The synchronous background, {abs(measured.background) * 1e6:.2f} µm, is taken off."
    if _horizontal(scene):
        yield "The spindle is horizontal: the balls lie at the bottom when the machine is switched on."
    else:
        yield "The spindle is vertical: the balls lie anywhere when the machine is switched on."
