"""Wear of a wheel at its work by Archard's law: what is worn off a point goes with the force on it.

s is the depth worn off on average, the same round the wheel's life whatever moves. The surface's centre moves by
dE/ds = −H/N₀ (H the pressure of `under_load.Steady`), and what is taken off one side is missing there: dU₀/ds = m_w
dE/ds, m_w the wheel's mass as a disc of one density. Without separation H is linear in E, so that both are exponentials
of s. However hard the wheel bounces, |H| ≤ 2N₀: the runout changes by at most twice the depth worn off.
Source: Archard 1953 (wear in proportion to force and way); the rest is derived. Printed: Kladiev 1996 takes the wheel
to be centred at a rigid contact, where it is driven off.
"""

import cmath
import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from abu_calc.analysis.under_load import Steady
from abu_calc.formulas.contact import SteadyContact
from abu_calc.formulas.grinding import runout_rate
from abu_calc.frozen import dataclass

SMALLEST = 1e-9
"""Depth [m] at which the search for events begins."""
STEPS = 60
"""Per decade of depth."""
LARGEST_POWER = 600.0
"""Largest exponent of e that stays short of infinity."""
SETTLED = 0.01
"""Share of the first variable force that is left when a wheel has worn to where nothing drives it on."""
NOTHING = 1e-9
"""Share of the normal force below which a variable force consists of rounding errors."""
MOST = 50.0
"""The largest exponent of wear against force that is looked for."""


@dataclass(frozen=True)
class Stage:
    """The wheel after a depth [m] of wear: runout E [m], its own imbalance U₀ [kg m], pressure H [N]."""

    depth: float
    runout: complex
    imbalance: complex
    pressure: complex


@dataclass(frozen=True)
class Wear:
    """Wear of a wheel from now on: rate of its runout now, dε/ds, and the first event.

    `centres`: True if the runout shrinks. `event`: "halved", "limit" (of the level), "parted" (wheel and
    workpiece lose contact), "settled", "worn out", or None if the balls do not balance and the course is
    not known; `stages` up to there.
    """

    pressure: complex
    rate: float
    centres: bool
    event: str | None
    stages: tuple[Stage, ...]

    @property
    def depth(self) -> float | None:
        """Depth of wear at the event [m]."""
        return self.stages[-1].depth if self.stages else None


@dataclass(frozen=True)
class Law:
    """dE/ds = −(α E + β), in a machine pressed by N₀ [N]; `per_runout` m_w [kg]."""

    press: float
    start: Stage
    slope: complex
    offset: complex
    per_runout: float

    def at(self, depth: float) -> Stage:
        """The wheel after a depth [m]."""
        alpha, beta = self.slope, self.offset
        moved = -self.start.pressure / self.press * _grown(-alpha * depth) * depth
        runout = self.start.runout + moved
        pressure = self.press * (alpha * runout + beta)
        return Stage(depth, runout, self.start.imbalance + self.per_runout * moved, pressure)


def _grown(exponent: complex) -> complex:
    """(e^z − 1)/z."""
    return 1 + exponent / 2 if abs(exponent) < 1e-7 else (cmath.exp(exponent) - 1) / exponent


def worn(steady: Steady, press: float, wheel_mass: float, usable: float, permitted: float = math.inf) -> Wear:
    """Wear from a steady motion on, as long as wheel and workpiece stay together; `usable` depth [m].

    `permitted`: largest spindle displacement [m]; a machine that exceeds it from the beginning is not held
    to it.
    """
    pressure, runout = steady.pressure or 0j, steady.runout
    towards = (pressure * runout.conjugate()).real
    rate = runout_rate(pressure, runout, press)
    law = _law(steady, press, wheel_mass)
    if law is None:
        parted = steady.imbalance is not None and abs(pressure) > press
        if not parted:
            return Wear(pressure, rate, towards > 0, None, ())
        return Wear(pressure, rate, towards > 0, "parted", (Stage(0.0, runout, steady.own, pressure),))
    centres = towards > 0 if runout else steady.balls is not None and law.slope.real > 0
    event, depth = _first_event(law, steady, permitted, press, usable)
    stages = tuple(law.at(depth * share / 8) for share in range(9))
    return Wear(pressure, rate, centres, event, stages)


def _law(steady: Steady, press: float, wheel_mass: float) -> Law | None:
    """Law of wear: H depends on E, without balls on the wheel's imbalance too.

    With balls it holds if they balance. None otherwise.
    """
    contact, runout = steady.contact, steady.runout
    if steady.imbalance is None or contact.pressing == 0:
        return None
    if steady.balls is not None:
        if steady.balls.places != "balanced":
            return None
        slope = _pressure(contact, contact.balancing_imbalance(1.0), 1.0) / press
        return Law(press, Stage(0.0, runout, steady.own, slope * runout * press), slope, 0j, wheel_mass)
    slope = _pressure(contact, complex(wheel_mass), 1.0) / press
    offset = _pressure(contact, steady.imbalance - wheel_mass * runout, 0j) / press
    start = Stage(0.0, runout, steady.imbalance, (slope * runout + offset) * press)
    return Law(press, start, slope, offset, wheel_mass)


def _pressure(contact: SteadyContact, imbalance: complex, runout: complex) -> complex:
    return -1j * contact.normal_force(imbalance, runout)


def _moved(steady: Steady, stage: Stage) -> float:
    """The larger amplitude of the axis [m]."""
    contact, free = steady.contact, steady.balls is not None
    total = contact.balancing_imbalance(stage.runout) if free else stage.imbalance
    return max(map(abs, contact.axis(total, stage.runout)))


def _first_event(law: Law, steady: Steady, permitted: float, press: float, usable: float) -> tuple[str, float]:
    """Name of the first event, and the depth at which it comes [m]."""
    runout = abs(steady.runout)
    if abs(law.start.pressure) > press:
        return "parted", 0.0
    last = min(usable, LARGEST_POWER / abs(law.slope)) if law.slope else usable
    if abs(law.start.pressure) <= NOTHING * press:
        return "worn out", last
    tests: dict[str, Callable[[Stage], bool]] = {
        "parted": lambda stage: abs(stage.pressure) > press,
        "limit": lambda stage: _moved(steady, stage) > permitted,
        "halved": lambda stage: abs(stage.runout) <= runout / 2 and runout > 0,
        "settled": lambda stage: abs(stage.pressure) <= SETTLED * abs(law.start.pressure),
    }
    if _moved(steady, law.start) > permitted:
        del tests["limit"]
    before = 0.0
    for depth in _depths(last):
        for name, test in tests.items():
            if test(law.at(depth)):
                return name, _bisected(law, test, before, depth)
        before = depth
    return "worn out", last


def _depths(last: float) -> Iterator[float]:
    """Ever larger ones, up to the last."""
    count = max(math.ceil(math.log10(max(last / SMALLEST, 1.0)) * STEPS), 1)
    yield from (SMALLEST * (last / SMALLEST) ** (step / count) for step in range(count + 1))


def _bisected(law: Law, test: Callable[[Stage], bool], before: float, after: float) -> float:
    for _ in range(60):
        middle = (before + after) / 2
        before, after = (before, middle) if test(law.at(middle)) else (middle, after)
    return after


def needed_exponent(without: NDArray[np.float64], fitted: NDArray[np.float64], ratio: float) -> float | None:
    """The p for which wear in proportion to force^p is `ratio` times as large without as with the autobalancer.

    Forces [N] at equal steps over whole turns, of the same mean. None up to p = 50.
    """

    def times(exponent: float) -> float:
        largest = max(float(without.max()), float(fitted.max()))
        low, high = (float(np.mean((force / largest) ** exponent)) for force in (fitted, without))
        return high / low if low > 0 else math.inf

    if len(without) == 0 or len(fitted) == 0 or times(MOST) < ratio:
        return None
    low, high = 1.0, MOST
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (low, middle) if times(middle) >= ratio else (middle, high)
    return high
