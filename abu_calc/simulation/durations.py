"""Duration of a scene, within bounds of work: a machine's scene lasts until its slowest transient has died out."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from abu_calc.dynamics.race import Race, balls_of
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.support import Support
from abu_calc.formulas.slow_motion import shaken_drag
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.validity import Range
from abu_calc.sizing.design import Design
from abu_calc.sizing.track import track

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
