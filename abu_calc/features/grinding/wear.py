"""Wear of the wheel of a machine at its workpiece by Archard's law: wear at a point goes with the force on it.

s is the mean depth worn off, the same over the wheel's life whatever moves. The surface's centre moves by
dE/ds = −H/N₀ (H the pressure of `steady_contact.SteadyWork`), and the mass worn off one side is missing there:
dU₀/ds = m_w dE/ds, m_w the wheel's mass as a disc of one density. Without separation H is linear in E, so that both are
exponentials of s. However hard the wheel bounces, |H| ≤ 2N₀: the runout changes by at most twice the depth worn off.

Source: Archard 1953 (wear in proportion to force and distance); the rest is derived. As published, Kladiev 1996 takes
the wheel to be centred at a rigid contact, where it is driven off centre.

`wear_course`, `rigid_course`, `bouncing_course` and `claim` give the results, in user units.
"""

import cmath
import math
from collections.abc import Callable, Iterator
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.grinding.formulas import runout_rate
from abu_calc.features.grinding.simulation import harmonic_force
from abu_calc.features.grinding.steady_contact import SteadyWork, contact_presses, runout_of
from abu_calc.features.grinding.work import Side, Work
from abu_calc.formulas.tilting_contact import SteadyContact
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import wrapped_deg
from abu_calc.sizing.budget import permitted_displacement
from abu_calc.sizing.design import Design

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
class WearState:
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
    stages: tuple[WearState, ...]

    @property
    def depth(self) -> float | None:
        """Depth of wear at the event [m]."""
        return self.stages[-1].depth if self.stages else None


@dataclass(frozen=True)
class Law:
    """dE/ds = −(α E + β), in a machine pressed by N₀ [N]; `per_runout` m_w [kg]."""

    press: float
    start: WearState
    slope: complex
    offset: complex
    per_runout: float

    def at(self, depth: float) -> WearState:
        """The wheel after a depth [m]."""
        alpha, beta = self.slope, self.offset
        moved = -self.start.pressure / self.press * _grown(-alpha * depth) * depth
        runout = self.start.runout + moved
        pressure = self.press * (alpha * runout + beta)
        return WearState(depth, runout, self.start.imbalance + self.per_runout * moved, pressure)


def _grown(exponent: complex) -> complex:
    """(e^z − 1)/z."""
    return 1 + exponent / 2 if abs(exponent) < 1e-7 else (cmath.exp(exponent) - 1) / exponent


def worn(steady: SteadyWork, press: float, wheel_mass: float, usable: float, permitted: float = math.inf) -> Wear:
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
        return Wear(pressure, rate, towards > 0, "parted", (WearState(0.0, runout, steady.own, pressure),))
    centres = towards > 0 if runout else steady.balls is not None and law.slope.real > 0
    event, depth = _first_event(law, steady, permitted, press, usable)
    stages = tuple(law.at(depth * share / 8) for share in range(9))
    return Wear(pressure, rate, centres, event, stages)


def _law(steady: SteadyWork, press: float, wheel_mass: float) -> Law | None:
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
        return Law(press, WearState(0.0, runout, steady.own, slope * runout * press), slope, 0j, wheel_mass)
    slope = _pressure(contact, complex(wheel_mass), 1.0) / press
    offset = _pressure(contact, steady.imbalance - wheel_mass * runout, 0j) / press
    start = WearState(0.0, runout, steady.imbalance, (slope * runout + offset) * press)
    return Law(press, start, slope, offset, wheel_mass)


def _pressure(contact: SteadyContact, imbalance: complex, runout: complex) -> complex:
    return -1j * contact.normal_force(imbalance, runout)


def _moved(steady: SteadyWork, stage: WearState) -> float:
    """The larger amplitude of the axis [m]."""
    contact, free = steady.contact, steady.balls is not None
    total = contact.balancing_imbalance(stage.runout) if free else stage.imbalance
    return max(map(abs, contact.axis(total, stage.runout)))


def _first_event(law: Law, steady: SteadyWork, permitted: float, press: float, usable: float) -> tuple[str, float]:
    """Name of the first event, and the depth at which it comes [m]."""
    runout = abs(steady.runout)
    if abs(law.start.pressure) > press:
        return "parted", 0.0
    last = min(usable, LARGEST_POWER / abs(law.slope)) if law.slope else usable
    if abs(law.start.pressure) <= NOTHING * press:
        return "worn out", last
    tests: dict[str, Callable[[WearState], bool]] = {
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


def _bisected(law: Law, test: Callable[[WearState], bool], before: float, after: float) -> float:
    for _ in range(60):
        middle = (before + after) / 2
        before, after = (before, middle) if test(law.at(middle)) else (middle, after)
    return after


def needed_exponent(without: NDArray[np.float64], fitted: NDArray[np.float64], ratio: float) -> float | None:
    """The p for which wear in proportion to force^p is `ratio` times as large without as with the autobalancer.

    Forces [N] at equal steps over whole turns, of the same mean; one that pulls wears nothing. None up to p = 50.
    """
    without, fitted = np.maximum(without, 0.0), np.maximum(fitted, 0.0)

    def times(exponent: float) -> float:
        """Ratio of the means of force^p, without over with; forces over the largest, so that none overflows."""
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


USABLE = 0.2
"""Share of the wheel's radius taken as the depth that may be worn off, if the file gives none."""


@record
class WearStage(Record):
    """The wheel after some wear."""

    depth: Annotated[float, Quantity("worn off", unit="um")]
    time: Annotated[float | None, Quantity("after", unit="min")]
    runout: Annotated[float, Quantity("runout", "ε", unit="mm")]
    runout_angle_deg: Annotated[float, Quantity("runout from the first imbalance", "φ₀")]
    imbalance: Annotated[float, Quantity("imbalance of the wheel", "m₀e", unit="g_mm")]
    variable_force: Annotated[float, Quantity("variable force", "|F_H|", unit="N")]


@record
class WearCourse(Record):
    """Wear of the wheel: the rate of its runout is below zero if wear centres it."""

    centres: Annotated[bool, Quantity("wear centres the wheel")]
    runout_rate: Annotated[
        float, Quantity("change of the runout per depth worn off", "dε/ds", 4, "as if wheel and work never parted")
    ]
    pressure_amplitude: Annotated[float, Quantity("variable force round the wheel", "|F_H|", unit="N")]
    hardest_at_deg: Annotated[float | None, Quantity("pressed hardest, from the high spot")]
    ends: Annotated[str | None, Quantity("what comes first", "", 4, "halved, limit, parted, settled or worn out")]
    depth: Annotated[float | None, Quantity("worn off until then", unit="um")]
    time: Annotated[float | None, Quantity("until then", unit="min")]
    stages: tuple[WearStage, ...]


@record
class Claim(Record):
    """Lives of a wheel without and with the autobalancer, as measured; the prediction, and what the rest would take."""

    life_without_min: Annotated[float, Quantity("life without, as measured")]
    life_with_min: Annotated[float, Quantity("life with, as measured")]
    predicted_life_with_min: Annotated[float, Quantity("life with, predicted", "", 3, "from the life without")]
    ratio_by_archard: Annotated[float, Quantity("ratio of lives if wear goes with the force")]
    needed_exponent: Annotated[float | None, Quantity("power of the force that wear would go with")]
    needed_press_N: Annotated[float, Quantity("mean force that would do it, by the same law")]


def press_of(design: Design) -> float:
    """The press force [N]; without end where nothing presses."""
    return design.case.contact.press_force if design.case.contact else math.inf


def wear_course(work: Work, steady: SteadyWork) -> WearCourse | None:
    """Wear by the steady force round the wheel, as if wheel and workpiece never lost contact.

    None if there is no such force.
    """
    design = work.design
    if not contact_presses(design.case) or steady.imbalance is None:
        return None
    mass = 0.0 if steady.balls is None else design.autobalancer.mass
    allowed, rest = permitted_displacement(design.case, mass, design.case.speed), work.rest if mass else 0.0
    permitted = math.sqrt(max(allowed**2 - rest**2, 0.0))
    return _course(design, worn(steady, press_of(design), design.case.table.wheel.mass_kg, _usable(design), permitted))


def rigid_course(work: Work, moving: Callable[..., SteadyWork]) -> WearCourse | None:
    """The same at a contact that does not give, where it moves as `steady_contact.fitted` or `bare` says."""
    design = work.design
    return (
        wear_course(work, moving(design, runout_of(design.case), rigid=True)) if contact_presses(design.case) else None
    )


def bouncing_course(design: Design, side: Side) -> WearCourse | None:
    """The rate of a wheel that parts from its work, by the simulated force."""
    contact = design.case.contact
    if side.run is None or not side.parts or contact is None or contact.contact != "compliant":
        return None
    pressure, runout = side.run.pressure, runout_of(design.case)
    centres = (pressure * runout.conjugate()).real > 0
    return _course(design, Wear(pressure, runout_rate(pressure, runout, contact.press_force), centres, None, ()))


def claim(work: Work) -> Claim | None:
    """Prediction beside the measured lives; None if the file does not give both, or nothing grinds.

    Archard's law: wear follows the mean force, which the operator sets, so that both lives are equal at any contact.
    """
    wheel, press = work.design.case.table.wheel, press_of(work.design)
    before, after = wheel.life_min, wheel.life_with_autobalancer_min
    if before is None or after is None or math.isinf(press):
        return None
    forces = [
        side.run.force if side.parts and side.run is not None else harmonic_force(press, side.steady.pressure or 0j)
        for side in (work.without, work.fitted)
    ]
    return Claim(
        life_without_min=before,
        life_with_min=after,
        predicted_life_with_min=before,
        ratio_by_archard=1.0,
        needed_exponent=needed_exponent(forces[0], forces[1], after / before),
        needed_press_N=press * before / after,
    )


def _usable(design: Design) -> float:
    given = design.case.table.wheel.usable_wear
    return USABLE * design.case.wheel_radius if given is None else float(given)


def _course(design: Design, wear: Wear) -> WearCourse:
    """Times by the measured life of the wheel."""
    wheel = design.case.table.wheel
    pace = None
    if wheel.life_min and wheel.usable_wear_mm:
        pace = wheel.life / wheel.usable_wear
    away = cmath.phase(wear.pressure) - cmath.phase(runout_of(design.case))
    stages = tuple(
        WearStage(
            depth=stage.depth,
            time=None if pace is None else pace * stage.depth,
            runout=abs(stage.runout),
            runout_angle_deg=wrapped_deg(cmath.phase(stage.runout)),
            imbalance=abs(stage.imbalance),
            variable_force=abs(stage.pressure),
        )
        for stage in wear.stages
    )
    return WearCourse(
        centres=wear.centres,
        runout_rate=wear.rate,
        pressure_amplitude=abs(wear.pressure),
        hardest_at_deg=wrapped_deg(away) if wear.pressure else None,
        ends=wear.event,
        depth=wear.depth,
        time=stages[-1].time if stages else None,
        stages=stages,
    )
