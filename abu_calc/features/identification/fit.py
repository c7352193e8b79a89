"""The fit: recorded starts in the frame of the imbalance, banks about the likeliest point, intervals, values.

Checks of recorded starts and their fit: what could be given, and what is not as the file says.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Final

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.features.identification.bank import (
    WIDE,
    Box,
    Points,
    RecordedStart,
    Track,
    bank_of,
    simulated_track,
)
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
from abu_calc.features.identification.results import ExpectedValues, IdentifiedValue
from abu_calc.formulas.friction_band import friction_number
from abu_calc.foundation.checks import Check, coded
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, within
from abu_calc.foundation.units import from_si, wrapped_deg

MANY, FEW = 2048, 1024
"""Starts of the first bank and of the last one, and of each between."""
WIDE_DEGREE: Final = 4
"""Degree of the polynomials over the wide box."""
LEVERS: Final = (0.3, 1.4, 6.5, 30.0)
"""Lever arms [µm] between ranges that are tried each for itself."""
ROUNDS: Final = 5
"""Narrower banks, at most."""
SETS: Final = 40
"""Sets of starts that are simulated at the estimate, for the goodness of fit, and as many in the last box. Both tell
how far the likelihood falls to the truth, for the intervals."""
ODD: Final = 2.0
"""Squared distance of a start, over that of the farthest of 400 simulated ones, above which it is unlike them."""
ROUGH, ROOM, LEAST_BOX = 8.0, 0.25, 0.4
"""The last box: where the likelihood has fallen by less than the first, with a share of room, no less than a share of
the box before."""
COVERED: Final = 0.95
LEAST_DROP, MOST_DROP = 2.6, 20.0
"""Drops of the logarithmic likelihood at the ends of an interval, at least and at most: t²/2 of ten starts is 2.56."""
HELD, LEAST_HELD_DROP = 0.7, 6.0
"""Friction number above which some balls of a horizontal spindle stay where friction holds them, and the least drop
then: their ends are scattered as no Student distribution is.
"""
SURE_UM: Final = 0.3
"""Half of the narrowest interval of the eccentricity [µm]: with a mark, machines of known values came out 0.16 µm off
in the median, more than their starts scatter."""
UNSURE_UM: Final = 8.0
"""Half of the interval of a component of the eccentricity [µm] above which none is given."""
VAGUE: Final = 4.0
"""Factor between a drag rate and an end of its interval, or a lever arm and its upper end, above which none is given:
known machines with such intervals came out off by up to a factor of two. An arm may well be next to none.
"""
NAMES: Final = ("drag rate", "lever arm", "eccentricity", "eccentricity")
"""Names of the unknowns."""


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
    def end(self) -> complex | None:
        """Mean end [µm]; None without a mark."""
        return complex(np.mean([end_of(track) for track in self.tracks])) * 1e6 if self.reading.marked else None

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
    odd_start: int | None = None
    """Number of a start, from 0, that is unlike all those simulated at the estimate."""

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

    @property
    def vague(self) -> tuple[str, ...]:
        """Names of drag rate and lever arm whose intervals say little: an arm is vague, too, if the drag rate is."""
        drag, lever = (float(value) for value in self.best.point[:2])
        (low, high), (_, upper) = self.intervals[:2]
        if max(high - drag, drag - low) > math.log(VAGUE):
            return NAMES[:2]
        return NAMES[1:2] if upper - lever > math.log(VAGUE) else ()


def without_balls(scene: Scene) -> complex:
    """Place of the axis in the rotor's frame [m] without balls, as a sensor along x tells it."""
    moved = scene.support.small_motion(scene.speed).receptance(scene.speed)
    return complex(moved[0, 0] * scene.imbalance * scene.speed**2)


def horizontal(scene: Scene) -> bool:
    """True if the spindle is horizontal: gravity acts in the plane of the race."""
    return scene.effect("gravity") is not None


def friction_number_at(scene: Scene, point: Points) -> float:
    """Λ = k_r R_p Ω²/(r g) of a point; 0 on a vertical spindle, whose ends tell the friction by their scatter."""
    race = scene.races[0]
    lever = math.exp(point[1]) * 1e-6
    return friction_number(lever, race.pitch_radius, race.ball_radius, scene.speed) if horizontal(scene) else 0.0


def estimated(scene: Scene, measured: Measured, progress: Progress) -> Estimate:
    """The likeliest values, their intervals, and how well simulated sets fit."""
    features = measured.features
    parts = (0, 1, 2, 3) if measured.reading.marked else (0, 1)
    regression, best, simulated = _narrowed_fit(scene, measured, parts, progress)
    progress("intervals")
    sets = tuple(_sets(scene, measured, [best.point] * SETS))
    if not sets:
        raise NotTrustworthyError(
            "starts cannot be simulated at the estimate\n  See `abu simulate FILE` for the reason."
        )
    fits = [regression.best(each, begin=best.point) for _, each in sets]
    drops = [_drop(regression, each, regression.best(each, begin=truth), truth, parts)
             for truth, each in (*sets, *_sets(scene, measured, _within(regression.box)))]  # fmt: skip
    least = LEAST_HELD_DROP if friction_number_at(scene, best.point) > HELD else LEAST_DROP
    intervals = [
        regression.interval(features, best, part, float(np.clip(np.quantile(column, COVERED), least, MOST_DROP)))
        for part, column in zip(parts, np.array(drops).T, strict=True)
    ]
    means, deviations = regression.distribution(best.point)
    amplitudes = (features[:, -1] - means[0, -1]) / deviations[0, -1]
    return Estimate(
        best,
        regression.box,
        tuple(intervals),
        measured.end_error,
        float(np.mean([fit.value < best.value for fit in fits])),
        float(np.mean(amplitudes)) * math.sqrt(len(features)),
        float(np.mean(features[:, -1]) / means[0, -1]),
        simulated + 2 * SETS * len(features),
        _odd_start(regression, best, np.concatenate([each for _, each in sets]), features),
    )


def _odd_start(regression: Regression, best: Best, usual: Features, features: Features) -> int | None:
    """The start farthest from the estimate, if it is much farther than the farthest simulated one."""
    recorded = regression.distances(best.point, features)
    farthest = regression.distances(best.point, usual).max()
    return int(np.argmax(recorded)) if recorded.max() > ODD * farthest else None


def _narrowed_fit(
    scene: Scene, measured: Measured, parts: Sequence[int], progress: Progress
) -> tuple[Regression, Best, int]:
    """Boxes about the likeliest point until it lies inside, then a last one as large as its likelihood asks for.

    Gives the last regression, its likeliest point, and how many starts were simulated.
    """
    features, centres = measured.features, measured.reading.centres
    bank = bank_of(scene, WIDE, MANY, centres, within(progress, "wide"))
    best = _begun(scene, measured, Regression(bank, measured.reading, WIDE_DEGREE), progress)
    simulated = MANY + (len(LEVERS) - 1) * FEW // 2
    for _ in range(ROUNDS):
        box = narrowed(best, measured.end_error, measured.end)
        regression = Regression(bank_of(scene, box, FEW, centres, within(progress, "narrow")), measured.reading)
        best, simulated = regression.best(features), simulated + FEW
        if inside(best, box):
            break
    for _ in range(ROUNDS):
        box = _likely(regression, features, best, parts)
        regression = Regression(bank_of(scene, box, MANY, centres, within(progress, "last")), measured.reading)
        best, simulated = regression.best(features), simulated + MANY
        if inside(best, box):
            break
    return regression, best, simulated


def _likely(regression: Regression, features: Features, best: Best, parts: Sequence[int]) -> Box:
    """The part of a box in which the likelihood has not fallen by `ROUGH`, with some room."""
    box = regression.box
    low, high, width = box.low.copy(), box.high.copy(), box.high - box.low
    for part in parts:
        ends = np.clip(regression.interval(features, best, part, ROUGH), box.low[part], box.high[part])
        room = max(ROOM * (ends[1] - ends[0]), (LEAST_BOX * width[part] - (ends[1] - ends[0])) / 2)
        low[part], high[part] = ends[0] - room, ends[1] + room
    low[2:], high[2:] = np.maximum(low[2:], box.low[2:]), np.minimum(high[2:], box.high[2:])
    return Box(low, high)


def _begun(scene: Scene, measured: Measured, wide: Regression, progress: Progress) -> Best:
    """The best of several ranges of the lever arm, each judged by a bank of its own: the wide regression is rough."""
    features, ends = measured.features, list[Best]()
    for number, (low, high) in enumerate(pairwise(LEVERS)):
        part = Box(WIDE.low.copy(), WIDE.high.copy())
        part.low[1], part.high[1] = math.log(low), math.log(high)
        box = narrowed(wide.best(features, part=part), measured.end_error, measured.end)
        share = within(progress, f"range {number + 1} of {len(LEVERS) - 1}")
        regression = Regression(bank_of(scene, box, FEW // 2, measured.reading.centres, share), measured.reading)
        ends.append(regression.best(features))
    return max(ends, key=lambda best: best.value)


def _within(box: Box) -> Points:
    """Points all over a box but for its edge: an interval must hold wherever there the truth lies."""
    shares = np.random.default_rng(7).uniform(0.1, 0.9, (SETS, len(box.low)))
    return np.asarray(box.low + (box.high - box.low) * shares)


def _sets(scene: Scene, measured: Measured, points: Iterable[Points]) -> Iterator[tuple[Points, Features]]:
    """Each point, and the features of a whole set of starts simulated there."""
    count, reading = len(measured.tracks), measured.reading
    for number, point in enumerate(points):
        seeds = range(10_000 + number * count, 10_000 + (number + 1) * count)
        tracks = [simulated_track(scene, point, reading.centres, seed) for seed in seeds]
        kept = np.array([track for track in tracks if track is not None])
        if len(kept) == count:
            yield point, np.array([reading.features(track) for track in reading.noisy(kept, number)])


def _drop(regression: Regression, features: Features, fit: Best, truth: Points, parts: Sequence[int]) -> list[float]:
    """Fall of the profile from its best to the truth, for each unknown."""
    return [fit.value - regression.best(features, (part, float(truth[part])), fit.point).value for part in parts]


def identified_values(measured: Measured, estimate: Estimate, mark_angle: float) -> ExpectedValues:
    """The values that are known."""
    marked = measured.reading.marked
    edge = estimate.at_the_edge(marked=marked)
    unknown = {*edge, *estimate.vague}
    ends = [np.exp(interval) for interval in estimate.intervals[:2]]
    drag, friction = (
        IdentifiedValue(value=float(value) * unit, low=float(low) * unit, high=float(high) * unit)
        for value, (low, high), unit in zip(np.exp(estimate.best.point[:2]), ends, (1.0, 1e-3), strict=True)
    )
    known = marked and NAMES[2] not in edge and estimate.offset_error <= estimate.offset_allowed
    eccentricity, angle = _offset(estimate, measured.reading.phase_error, mark_angle) if known else (None, None)
    return ExpectedValues(
        rolling_drag_per_s=None if NAMES[0] in unknown else drag,
        rolling_friction_mm=None if NAMES[1] in unknown else friction,
        race_eccentricity_mm=eccentricity,
        race_eccentricity_angle_deg=angle,
    )


def _offset(estimate: Estimate, phase_error: float, mark_angle: float) -> tuple[IdentifiedValue, IdentifiedValue]:
    """Magnitude [mm] and angle from the mark [deg], with intervals from those of the components and of the mark."""
    x, y = (float(value) for value in estimate.best.point[2:])
    size, half = math.hypot(x, y), estimate.offset_error
    spread = from_si(math.asin(min(1.0, half / size)) + phase_error, "deg")
    length = IdentifiedValue(value=size * 1e-3, low=(size - half) * 1e-3, high=(size + half) * 1e-3)
    angle = wrapped_deg(math.atan2(y, x) - mark_angle)
    return length, IdentifiedValue(value=angle, low=angle - spread, high=angle + spread)


FEWEST: Final = 8
"""Starts, at least."""
TREND: Final = 0.01
"""Probability below which an order of the decays is no chance."""
POOR: Final = 0.025
"""Share of simulated sets that fit worse, below which the fit is poor."""
OFF: Final = 4.0
"""Standard errors by which amplitudes at the start may differ."""
RUN_UP_OFF: Final = 0.15
"""Share by which a run-up may differ from the file's."""


def checks_of(scene: Scene, measured: Measured, estimate: Estimate | None) -> Iterator[Check]:
    """Checks of recorded starts; without an estimate there are too few of them."""
    count, marked = len(measured.starts), measured.reading.marked
    if estimate is None:
        yield coded("ABU1101", "not-done", f"{count} starts were recorded", count, FEWEST)
        return
    yield coded("ABU1101", "pass", f"{count} starts were recorded", count, FEWEST)
    edge = estimate.at_the_edge(marked=marked)
    yield coded("ABU1102", "not-done" if edge else "pass",
        f"At the edge of the range: {', '.join(edge)}" if edge else "All values lie inside",
    )  # fmt: skip
    yield _intervals(estimate)
    mean = complex(np.mean([end_of(track) for track in measured.tracks])) * 1e6
    yield from _of_the_ends(mean, measured.end_error, estimate, marked=marked)
    yield _trend(measured)
    off = abs(estimate.amplitude_off) > OFF and abs(estimate.amplitude_ratio - 1) > 0.05
    ratio = estimate.amplitude_ratio
    yield coded("ABU1105", "warn" if off else "pass", f"The amplitude at the start is {ratio:.2f} times that simulated"
        + (f"; an imbalance {ratio:.2f} times as large, or a mass {1 / ratio:.2f} times, would fit" if off else ""),
    )  # fmt: skip
    yield coded("ABU1107", "warn" if estimate.fits_worse < POOR else "pass",
        f"{estimate.fits_worse:.0%} of {SETS} simulated sets fit worse",
    )  # fmt: skip
    yield _run_up_check(scene, measured)
    odd = estimate.odd_start
    yield coded("ABU1109", "pass" if odd is None else "warn", "All starts lie where simulated ones lie"
        if odd is None
        else f"{measured.starts[odd].file} is unlike the starts simulated with the identified values",
    )  # fmt: skip


def _intervals(estimate: Estimate) -> Check:
    vague = " and ".join(estimate.vague)
    if vague:
        return coded("ABU1110", "not-done", f"Intervals reach farther than a factor of {VAGUE:g}: {vague}")
    return coded("ABU1110", "pass", f"Intervals of drag rate and lever arm are within a factor of {VAGUE:g}")


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
        yield coded("ABU1103", "pass" if apart <= allowed else "warn",
            "Distance of the mean end from the place opposite the eccentricity",
            apart, allowed, unit="µm",
        )  # fmt: skip
    else:
        yield coded("ABU1103", "not-done", "No eccentricity is known")
    yield coded("ABU1106", "pass" if known else "not-done", "Half of the interval of the eccentricity",
        estimate.offset_error, estimate.offset_allowed, unit="µm",
    )  # fmt: skip


def _trend(measured: Measured) -> Check:
    from scipy.stats import spearmanr

    decays = measured.features[:, DECAY]
    rank, chance = spearmanr(np.arange(len(decays)), decays) if np.ptp(decays) else (0.0, 1.0)
    trend = bool(chance < TREND)
    way = "longer" if rank > 0 else "shorter"
    return coded("ABU1104", "warn" if trend else "pass",
        f"The decays get {way} from start to start (rank correlation {rank:.2f})" if trend
        else f"Rank correlation of decay and order {rank:.2f}",
    )  # fmt: skip


def _run_up_check(scene: Scene, measured: Measured) -> Check:
    times = [start.run_up for start in measured.starts if start.run_up is not None]
    if not times:
        return coded("ABU1108", "not-done", "The recordings have no mark during the run-up", requested=False)
    time, given = float(np.median(times)), scene.full_speed
    off = abs(time / given - 1) > RUN_UP_OFF
    return coded("ABU1108", "warn" if off else "pass",
        f"By the mark the run-up takes {time:.3g} s, by the file {given:.3g} s",
        remedy=f"If the recordings begin at the switching-on, repeat with the measured time: --run-up {time:.3g}."
        if off else None,
    )  # fmt: skip
