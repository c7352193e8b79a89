"""Early stopping of a run: the balls are at rest and balance, and the residual imbalance no longer changes."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import Final

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import reference_imbalance
from abu_calc.dynamics.trajectory import Array, Samples, Sampling, Until, merged
from abu_calc.foundation.frozen import dataclass
from abu_calc.simulation.quiet import PER_TURN
from abu_calc.simulation.response import (
    Course,
    Response,
    amplitude_window,
    evaluate,
    needed_times,
    settling_times,
    with_creep,
)

LOOKS: Final = (0.1875, 0.25, 0.375, 0.5, 0.7)
"""Shares of the time at full speed after which a run may end."""

SEEN: Final = 0.25
"""Share of the time at full speed so far, counted back from its end, that is examined."""

CREEP: Final = 0.05
"""Permitted further change of the residual imbalance, as a share of the reference imbalance.

The change is extrapolated at its recent pace.
"""

ALIKE: Final = 0.02
"""Relative difference of the settling times that what is left may still make."""

RESTING: Final = 0.01
"""Share of the imbalance, or of what it is small against: with a larger way left, a run has not come to rest."""

RISE, FALL = 0.3, 0.1
"""Permitted rise and fall [dB] of the level from the first to the second half of the examined time."""


@dataclass(frozen=True)
class Early:
    """Early stopping of a run of a scene that is at full speed from a time [s] on.

    `decided(response, creep, rise)`: True if a response can be judged although the residual imbalance may
    change by `creep` [kg m] and the level may rise [dB], both at their recent pace. Its settling time is
    the latest possible one.
    """

    scene: Scene
    at_speed: float
    decided: Callable[[Response, float, float], bool]

    @cached_property
    def looks(self) -> tuple[float, ...]:
        """Times [s], those of settling."""
        times, length = settling_times(self.scene), self.scene.duration - self.at_speed
        near = np.searchsorted(times, [self.at_speed + share * length for share in LOOKS])
        return tuple(float(times[k]) for k in dict.fromkeys(near.tolist()) if times[k] >= self.scene.revolution)

    def sampling(self) -> Sampling:
        """Sampling with all times that a run needs to end early."""
        windows = [amplitude_window(replace(self.scene, duration=duration)).times for duration in self.looks]
        return Sampling(merged(needed_times(self.scene), *windows), until=Until(self.looks, self.enough))

    def response(self, samples: Samples, creep: float = 0.0) -> Response:
        """Response of a run that may have ended early; its residual imbalance may yet fall by `creep` [kg m]."""
        end = float(samples.t[-1])
        if end not in self._responses:
            self._responses[end] = evaluate(replace(self.scene, duration=end), samples, self._course_until(samples))
        response = self._responses[end]
        if creep == 0:
            return response
        if (end, creep) not in self._creeping:
            self._creeping[end, creep] = with_creep(response, self.scene, self._course_until(samples), creep)
        return self._creeping[end, creep]

    def _course_until(self, samples: Samples) -> Course:
        """Residual history up to the end of these samples; those that were read before are not read again."""
        read = self._read[-1]
        if len(samples.t) > read:
            self._course(Samples(samples.t[read:], samples.y[:, read:]))
            self._read.append(len(samples.t))
        return self._course.until(float(samples.t[-1]))

    @cached_property
    def _course(self) -> Course:
        return Course(self.scene)

    @cached_property
    def _read(self) -> list[int]:
        """Numbers of samples that were read."""
        return [0]

    @cached_property
    def _responses(self) -> dict[float, Response]:
        """Responses of the run up to each time at which it might end."""
        return {}

    @cached_property
    def _creeping(self) -> dict[tuple[float, float], Response]:
        """The same for each creep that was asked for."""
        return {}

    def enough(self, samples: Samples) -> bool:
        """True if no further motion will change the judged results."""
        creep, rise = self.moving(samples)
        if creep > CREEP * reference_imbalance(self.scene) or not -FALL <= rise <= RISE:
            return False
        latest, earliest = self.response(samples, creep), self.response(samples, -creep)
        if not self._same_times(earliest, latest):
            return False
        return self.decided(latest, creep, self.rising(samples))

    def _same_times(self, earliest: Response, latest: Response) -> bool:
        """True if the times of two responses agree, and the balls no longer creep."""
        return (
            not latest.creeping
            and self._alike(earliest.settling_time, latest.settling_time)
            and self._alike(earliest.rest_time, latest.rest_time)
        )

    def _alike(self, earliest: float | None, latest: float | None) -> bool:
        """True if two settling times [s] agree, or both are None."""
        if earliest is None or latest is None:
            return earliest is latest
        return latest - earliest <= max(ALIKE * latest, self.scene.revolution)

    def rising(self, samples: Samples) -> float:
        """Possible rise of the level [dB] until the end of the run; 0 if it has ended."""
        end = float(samples.t[-1])
        if end == self.scene.duration:
            return 0.0
        return 2 * (self.scene.duration - end) / (SEEN * (end - self.at_speed)) * max(self.moving(samples)[1], 0.0)

    def moving(self, samples: Samples) -> tuple[float, float]:
        """Possible further change of the residual imbalance [kg m] and recent rise of the level [dB].

        Both are infinite at first.
        """
        end = float(samples.t[-1])
        if end not in self._moves:
            self._moves[end] = self._moving(samples, end)
        return self._moves[end]

    @cached_property
    def _moves(self) -> dict[float, tuple[float, float]]:
        """Change and rise found at each time at which the run might end."""
        return {}

    def goes_on(self, samples: Samples) -> bool:
        """True if a run that did not end early ended before what is left came to rest."""
        end = float(samples.t[-1])
        if end < self.scene.duration:
            return False
        moved = movement(self._left(samples.at(self._late(end))), 1.0)
        return moved > RESTING * reference_imbalance(self.scene)

    def _late(self, end: float) -> Array:
        """Times [s] that are looked at where a run ends."""
        times = settling_times(self.scene)
        return times[(times >= end - SEEN * (end - self.at_speed)) & (times <= end)]

    def _moving(self, samples: Samples, end: float) -> tuple[float, float]:
        times, seen = self._late(end), SEEN * (end - self.at_speed)
        if len(times) < 4 * PER_TURN:
            return math.inf, math.inf
        states = samples.at(times)
        speed = _over_turns((self.scene.axis_velocity(states) ** 2).sum(axis=0))
        ahead = (self.scene.duration - end) / seen
        half = len(speed) // 2
        before, after = float(speed[:half].mean()), float(speed[half:].mean())
        rise = 10 * math.log10(after / before) if before > 0 and after > 0 else 0.0
        return movement(self._left(states), ahead), rise

    def _left(self, states: Array) -> np.ndarray:
        first = 2 * len(self.scene.support.names)
        return self.scene.total_imbalance(states[first : first + len(self.scene.ball_masses)])


def movement(left: np.ndarray, ahead: float) -> float:
    """How far an imbalance [kg m] may yet move, turn by turn, in `ahead` times as long as it was seen."""
    turns = _over_turns(left)
    return ahead * float(np.abs(turns - turns[-1]).max())


def _over_turns(values: np.ndarray) -> np.ndarray:
    """Means over one turn each."""
    return np.convolve(values, np.full(PER_TURN, 1 / PER_TURN), "valid")
