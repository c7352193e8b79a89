"""Two times of a run: from when the machine is quiet, and from when its balls rest.

Quiet: the level of vibration stays at or below the one that is asked for. Rest: the imbalance in the rotor stays near
that of the end. Both count from full speed, and neither exists where the last crossing lies in the last 5 % of a run.

Duration of a scene, within bounds of work: a machine's scene lasts until its slowest transient has died out.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.rotor import Race, balls_of
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.support import Support
from abu_calc.formulas.slow_motion import shaken_drag
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.sizing.design import Design
from abu_calc.sizing.track import track

Array = NDArray[np.float64]

PER_TURN = 16
"""Samples of a revolution, over the whole run: what ripples with the speed may have its crest anywhere."""

LAST = 0.95
"""Share of a run by which it must have become quiet or come to rest."""

GRAZE = 0.01
"""Relative change of a threshold within which a crossing counts as uncertain: 0.09 dB of a velocity."""


GRAZED = 0.1
"""Relative width of a range of times from which it is told: below, the crossing is steep."""


@dataclass(frozen=True)
class TimeRange:
    """A time [s] from full speed, None: never; and the same if the threshold were higher and lower by `GRAZE`."""

    time: float | None
    earliest: float | None
    latest: float | None

    def grazed(self, least: float) -> tuple[float | None, float | None] | None:
        """Both ends, where they differ by more than a tenth of the time and `least` [s]; else None."""
        low, high = (np.inf if each is None else each for each in (self.earliest, self.latest))
        if low == high or high - low <= max(GRAZED * low, least):
            return None
        return self.earliest, self.latest

    def apart(self, other: "TimeRange", least: float) -> float:
        """Difference relative to the other time, but at least to `least` [s].

        0 where each lies in the range of the other: the threshold is grazed, and the answer is a range. Infinite where
        only one exists.
        """
        if self._holds(other.time) and other._holds(self.time):
            return 0.0
        if self.time is None or other.time is None:
            return 0.0 if self.time is other.time else np.inf
        return abs(self.time - other.time) / max(other.time, least)

    def _holds(self, time: float | None) -> bool:
        low, middle, high = (np.inf if each is None else each for each in (self.earliest, time, self.latest))
        return bool(low <= middle <= high)


def range_of(times: Array, values: Array, limit: float, began: float) -> TimeRange:
    """From when on values stay at or below a limit, in a run that is at full speed from `began` [s] on."""

    def at(threshold: float, smooth: bool) -> float | None:
        """The same for one threshold."""
        time = last_crossing(times, values, threshold, smooth)
        return None if time is None else max(time - began, 0.0)

    time, earliest, latest = at(limit, True), at((1 + GRAZE) * limit, False), at((1 - GRAZE) * limit, False)
    if time is None:
        return TimeRange(None, earliest, latest)
    # All three may lie between the same samples.
    return TimeRange(time, time if earliest is None else min(earliest, time),
                     None if latest is None else max(latest, time))  # fmt: skip


def last_crossing(t: NDArray[Any], values: Array, limit: float, smooth: bool = True) -> float | None:
    """The earliest time [s] of a run after which values stay below the limit; None if after 95 % of the run.

    Between two samples it is read from the quintic through the six about them; `smooth` False: from a line.
    """
    above = np.flatnonzero(values > limit)
    if not len(above):
        return 0.0
    last = int(above[-1])
    if last == len(t) - 1:
        return None
    time = _crossing(t, values, limit, last) if smooth else _on_line(t, values, limit, last)
    return time if time <= LAST * t[-1] else None


def _crossing(t: Array, values: Array, limit: float, last: int) -> float:
    """Time at which values fall to the limit, after the sample `last`, the last one above it."""
    near, low, high = slice(max(last - 2, 0), last + 4), float(t[last]), float(t[last + 1])
    curve = np.linalg.solve(np.vander((t[near] - low) / (high - low)), values[near] - limit)
    inside = [root.real for root in np.roots(curve).tolist() if root.imag == 0 and 0 <= root.real <= 1]
    # Rounding may move a root that is a sample itself out of the interval.
    return low + (high - low) * max(inside, default=1.0)


def _on_line(t: Array, values: Array, limit: float, last: int) -> float:
    """The same by the line between the two samples."""
    share = (values[last] - limit) / (values[last] - values[last + 1])
    return float(t[last] + share * (t[last + 1] - t[last]))


def turn_velocities(velocities: Array) -> Array:
    """Rms velocity [m/s] of the turn that ends at each sample, of the larger axis, [axis, sample] at `PER_TURN`.

    The mean of the turn is taken off, and its trend: the change since the same place a turn before. So neither a rotor
    that turns steadily nor one whose suspension still swings out seems to do anything else. The first turn is none yet
    and has the value of the first whole one.
    """
    if velocities.shape[1] <= PER_TURN:
        return np.full(velocities.shape[1], np.sqrt(velocities.var(axis=1).max()))
    slope = (velocities[:, PER_TURN:] - velocities[:, :-PER_TURN]) / PER_TURN
    turns = np.lib.stride_tricks.sliding_window_view(velocities, PER_TURN, axis=1)[:, 1:]
    place = np.arange(PER_TURN) - (PER_TURN - 1) / 2
    squares = turns.var(axis=-1) - 2 * slope * (turns @ place) / PER_TURN + slope**2 * (place**2).mean()
    whole = np.sqrt(np.maximum(squares, 0.0).max(axis=0))
    return np.concatenate([np.full(PER_TURN, whole[0]), whole])


DECAY_TIMES = 7.0
LONGEST_REVOLUTIONS = 400.0
LEAST_REVOLUTIONS = 40.0
MOST_CYCLES = 4000.0
"""Most cycles of the speed or of the support, whichever is faster: a few seconds of work."""
MOST_VALUES = 4e6
"""Revolutions times states: what fits into memory, and some minutes of work."""


def settling_duration(design: Design, support: Support, race: Race, ball_rate: float) -> float:
    """Seven decay times [s] of whatever dies out last at full speed, the balls, at their rate [1/s], or the support.

    At least 40 revolutions; at most 400, or three times the settling time permitted.
    """
    case = design.case
    revolution = 2 * math.pi / case.speed
    sway, fastest = free_rates(support, race, case.speed)
    wanted = max(DECAY_TIMES / rate if rate > 0 else math.inf for rate in (ball_rate, sway))
    longest = max(LONGEST_REVOLUTIONS * revolution, 3 * case.table.limits.longest_quiet_time)
    cap = max(MOST_CYCLES * 2 * math.pi / max(case.speed, fastest), 2 * revolution)
    return min(max(wanted, LEAST_REVOLUTIONS * revolution), longest, cap)


def slowest_rate(design: Design, rate_at: Callable[[float], float]) -> float:
    """Slowest rate [1/s] at which balls come to rest; `rate_at` gives it at a viscous drag rate h₀ [1/s].

    On a horizontal spindle dry friction brakes balls that gravity shakes, as more drag would: then they creep.
    """
    case, autobalancer = design.case, design.autobalancer
    rate = rate_at(case.drag)
    if case.table.machine.spindle_axis != "horizontal":
        return rate
    added = shaken_drag(
        case.friction_arm, autobalancer.ball_diameter / 2, autobalancer.pitch_radius, case.speed, case.inertia_factor
    )
    return min(rate, rate_at(case.drag + added)) if added else rate


def slowest_in_hand(design: Design) -> float:
    """`slowest_rate` of a machine on its springs or in hands."""

    def rate_at(drag: float) -> float:
        """Slowest decay rate of the balls [1/s] at a viscous drag rate [1/s]."""
        if drag == design.case.drag:
            return design.track.decay_rates[0][1]
        case, held = replace(design.case, drag=drag), design.frequency.natural_frequencies
        return track(case, design.autobalancer, held).decay_rates[0][1]

    return slowest_rate(design, rate_at)


def free_rates(support: Support, race: Race, speed: float) -> tuple[float, float]:
    """Slowest decay rate and largest rate [1/s] of a support's free motion, with the balls' mass in the race."""
    values = np.linalg.eigvals(support.small_motion(speed).carrying(balls_of([race])).motion)
    return -float(values.real.max()), float(np.abs(values).max())


def lasting(scene: Scene, duration: float | None, key: str) -> Scene:
    """The scene with another duration [s], if one is given, and not longer than can be integrated.

    At least one revolution, and a run-up or run-down to its end; at most 4e6 revolutions times states. Raises
    RangeError with `key` as its place.
    """
    wanted = scene.duration if duration is None else duration
    longest = MOST_VALUES / scene.state_count * scene.revolution
    least = max((scene.revolution, *(effect.least_duration for effect in scene.effects)))
    remedy = "one revolution and the run-up at least; at most what this version can integrate"
    try:
        Range("duration", least, longest, "s", remedy=remedy).check(wanted)
    except InputError as error:
        raise error.at(Place(key=key)) from None
    return replace(scene, duration=wanted)
