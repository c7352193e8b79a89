"""What a verdict covers: how a machine may differ from its file, within what that promises or as is usual.

Promised are the race's eccentricity from none to the value of the file, at any angle, the imbalance from that of a new
wheel to the value, and any position of a machine that is turned in use. Usual are hot and cold oil, other friction and
suspension, speeds, run-ups, and restarts while balls still turn. Values follow a low-discrepancy sequence, so that few
starts cover much.

The oil's part of a design: drag rate cold, at work and hot, its band, and what other oils would give.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import count, cycle, product
from typing import Annotated, Any, Final, Self

from abu_calc.formulas.oil import GRADES, SLIPS, OilState
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import in_file
from abu_calc.inputs.autobalancer import oil_name
from abu_calc.inputs.machine import MachineFile
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.simulation.scene_of_design import Start
from abu_calc.simulation.start_cases import ALIKE, OPPOSITE, Axis, Member, Variation, usual_run_up
from abu_calc.sizing.design import Design
from abu_calc.sizing.oil import FACTOR, drag_source

NEW_WHEEL: Final = 0.1
"""Imbalance of a new wheel, as a share of the worst."""
SOFTLY_HELD: Final = 8.0
"""Natural frequency [Hz] above which a machine is not taken for one that is held in the hands."""

SIDES: Final[tuple[Start, ...]] = ("behind", "bunched")
TRUER: Final = (0.1, 0.3, 0.5, 0.75)
"""Starts and shares of the race's eccentricity at which designs break most."""
FEW: Final = 4
"""Balls at most of which such designs break."""

PRIMES: Final[tuple[int, ...]] = (2, 3, 5, 7, 11, 13, 17, 19)
OF_PROMISED, OF_USUAL = slice(3), slice(3, 8)
"""Axes of the sequence for what is promised, and for what is usual."""

Factors = tuple[float, float]
FRICTION: Final[Factors] = (0.3, 2.0)
NATURAL_FREQUENCY: Final[Factors] = (0.7, 1.3)
SPEED: Final[Factors] = (0.95, 1.05)
RUN_UPS: Final[Factors] = (0.3, 3.0)
"""Usual factors on values of a file, and run-ups [s]; engineering practice (unverified)."""


@record
class BandRow(Record):
    """A value of the file that start cases vary, in the unit of its key; promised by the file, or usual."""

    key: Annotated[str, Quantity("key")]
    low: Annotated[float, Quantity("lowest", "", 4)]
    high: Annotated[float, Quantity("highest", "", 4)]
    promised: Annotated[bool, Quantity("promised")]


def turned_in_use(design: Design) -> bool:
    """True if the spindle may be horizontal and vertical."""
    return len(axes_in_use(design)) > 1


def axes_in_use(design: Any) -> tuple[Axis | None, ...]:
    """Directions of the spindle in use, None that of the file: both by machine.held, else of machines in the hands.

    `design`: of one race or of two, which are not held in the hands.
    """
    table = design.case.table
    given, held = table.machine.spindle_axis, table.machine.held
    soft = isinstance(table, MachineFile) and max(table.suspension.frequencies or (0.0,)) <= SOFTLY_HELD
    in_hands = soft and table.swing_arm is None
    if held == "as-given" or (held is None and not in_hands):
        return (None,)
    return (None, "vertical" if given == "horizontal" else "horizontal")


def measured(design: Design) -> bool:
    """True if the imbalance is found from a measured value: that is no maximum."""
    wheel = design.case.table.wheel
    return wheel.imbalance_g_mm is None and wheel.balance_grade is None


def identified(design: Design, name: str, usual: Factors) -> Factors:
    """Interval of a value of [autobalancer] that was identified, as factors on it; else the usual ones."""
    table = design.case.table
    if table.identified is None:
        return usual
    known, value = table.identified.in_force(table.autobalancer), getattr(table.autobalancer, name)
    return (known[name][0] / value, known[name][1] / value) if name in known and value else usual


def friction_factors(design: Design) -> Factors:
    """Factors on the friction arm."""
    return identified(design, "rolling_friction_mm", FRICTION)


def band(design: Any) -> tuple[BandRow, ...]:
    """All values that vary, promised ones first. `design`: of any number of races."""
    case, abu, usual = design.case, design.case.autobalancer, dict[str, Factors]()
    promised = {f"{race}.race_eccentricity_mm": (0.0, abu.race_eccentricity_mm) for race in case.race_keys}
    for wheel, imbalance in zip(case.wheel_keys, design.imbalances, strict=True):
        key, new = in_file(f"{wheel}.imbalance_g_mm", imbalance)
        promised[key] = _times((NEW_WHEEL, 1.0), new)
    for race, drag in zip(case.race_keys, case.drags, strict=True):
        oils = [share * drag for share in case.drag_shares]
        usual[f"{race}.rolling_drag_per_s"] = min(oils), max(oils)
        usual[f"{race}.rolling_friction_mm"] = _times(friction_factors(design), abu.rolling_friction_mm)
    key, speed = in_file(SPEED_KEY, case.speed)
    usual |= _usual_of_one(design) if len(case.drags) == 1 else {key: _times(SPEED, speed)}
    rows = [(key, ends, True) for key, ends in promised.items()] + [(key, ends, False) for key, ends in usual.items()]
    return tuple(BandRow(key=key, low=low, high=high, promised=kept) for key, (low, high), kept in rows)


SPEED_KEY: Final = "machine.speed_rpm"


def _usual_of_one(design: Design) -> dict[str, Factors]:
    """What start cases of one race vary further."""
    usual, table, abu = dict[str, Factors](), design.case.table, design.case.autobalancer
    if not usual_run_up(design).by_motor:  # a motor runs up in its own time, to its own speed
        speed = table.machine.speed_rpm
        usual = {SPEED_KEY: _times(SPEED, speed), "run_up.time_s": RUN_UPS, "start.speeds_rpm": (-speed, 0.0)}
    if (most := identified(design, "race_eccentricity_mm", (1.0, 1.0))[1]) > 1:
        usual["autobalancer.race_eccentricity_mm"] = 0.0, most * abu.race_eccentricity_mm
    if measured(design):
        key, imbalance = in_file("wheel.imbalance_g_mm", design.imbalance.value)
        usual[key] = _times((1.0, abu.capacity_margin), imbalance)
    if (given := table.suspension.frequencies) is not None:
        usual["suspension.natural_frequencies_hz"] = (
            NATURAL_FREQUENCY[0] * min(given),
            NATURAL_FREQUENCY[1] * max(given),
        )
    return usual


def _times(factors: Factors, value: float) -> Factors:
    return factors[0] * value, factors[1] * value


def sequence(axes: slice) -> Iterator[tuple[float, ...]]:
    """Points of the unit cube without gaps or lumps: ½ + k·√p mod 1, k = 1, 2 …, for a prime p on each axis.

    Source: Niederreiter 1978, Quasi-Monte Carlo methods and pseudo-random numbers; the steps are Richtmyer's.

    >>> [round(x, 3) for x in next(sequence(slice(2)))]
    [0.914, 0.232]
    """
    steps = [math.sqrt(prime) for prime in PRIMES[axes]]
    for k in count(1):
        yield tuple((0.5 + k * step) % 1.0 for step in steps)


def promised(design: Design, starts: Iterable[Member]) -> Iterator[Member]:
    """Starts of machines within the promised band, in every position in turn."""
    points = zip(starts, cycle(axes_in_use(design)), sequence(OF_PROMISED), strict=False)
    for start, axis, (eccentricity, imbalance, side) in points:
        # A third of them has all the imbalance.
        share = min(NEW_WHEEL + (1 - NEW_WHEEL) * 1.5 * imbalance, 1.0)
        varied = Variation(eccentricity, share, spindle_axis=axis)
        yield replace(start, varied=varied, eccentricity=math.tau * (1 - side))


def corners(design: Design) -> Iterator[Member]:
    """Starts of a horizontal spindle with a truer race, from either side of the imbalance.

    There friction holds one of four balls on the heavy side for long (own trial: 8 of 9 machines that broke).
    """
    given = design.case.table.machine.spindle_axis
    if design.autobalancer.ball_count > FEW or (given != "horizontal" and not turned_in_use(design)):
        return
    axis: Axis | None = None if given == "horizontal" else "horizontal"
    for start, share, side in product(SIDES, TRUER, (ALIKE, OPPOSITE)):
        yield Member(start, design.case.drag, 0.0, side, varied=Variation(share, spindle_axis=axis))


def usual(design: Design, starts: Iterable[Member]) -> Iterator[Member]:
    """Starts of machines within the usual band and the promised one; every third in a run-up, every third a restart.

    Where the imbalance is measured, wheels as bad as that have all that the margin of the capacity allows for.
    """
    case, file_run_up = design.case, usual_run_up(design)
    low, high = min(case.drag_shares), max(case.drag_shares)
    frictions, eccentric = friction_factors(design), identified(design, "race_eccentricity_mm", (1.0, 1.0))[1]
    for k, (start, (drag, friction, frequency, speed, run_up)) in enumerate(
        zip(promised(design, starts), sequence(OF_USUAL), strict=False)
    ):
        worse = case.autobalancer.capacity_margin if measured(design) and start.varied.imbalance == 1 else 1.0
        varied = replace(
            start.varied,
            race_eccentricity=eccentric * start.varied.race_eccentricity,
            imbalance=worse * start.varied.imbalance,
            friction_arm=between(frictions, friction),
            natural_frequency=between(NATURAL_FREQUENCY, frequency),
        )
        changed = replace(start, varied=varied, drag=case.drag * between((low, high), drag), promised=False)
        if not file_run_up.by_motor:
            changed = replace(changed, speed=(start.speed or case.speed) * between(SPEED, speed))
            if k % 3 == 0:
                changed = replace(changed, run_up=between(RUN_UPS, run_up))
            elif k % 3 == 1 and start.angles:
                changed = replace(changed, lag=run_up)
        yield changed


def worse_wheels(design: Design, starts: Iterable[Member]) -> Iterator[Member]:
    """Starts of the usual band with more friction than the file's and a wheel as bad as the margin of the capacity
    allows, if the imbalance was measured: that is no maximum.

    There machines break most (own trial: 50 of 68 runs): the balls have little way to spare, and friction stops them.
    """
    if not measured(design):
        return
    worse, most = design.case.autobalancer.capacity_margin, friction_factors(design)[1]
    for start, (_, friction, *_) in zip(usual(design, starts), sequence(OF_USUAL), strict=False):
        varied = replace(start.varied, imbalance=worse, friction_arm=between((1.0, most), friction))
        yield replace(start, varied=varied)


def between(ends: Factors, place: float) -> float:
    """Value at a place from 0 to 1 between two positive ends, by its logarithm."""
    return float(ends[0] * (ends[1] / ends[0]) ** place)


@record
class OilAtTemperature(Record):
    """The oil at one temperature, and the drag rate of a ball in it."""

    state: Annotated[str, Quantity("state of the oil")]
    temperature_C: Annotated[float, Quantity("temperature", "T_o", 3, "°C")]
    viscosity_mm2_per_s: Annotated[float, Quantity("kinematic viscosity", "ν_o", 3)]
    rolling_drag_per_s: Annotated[float, Quantity("viscous drag rate at the slip of the file", "h₀", 3)]
    low_per_s: Annotated[float, Quantity("low end of its band", "", 3)]
    high_per_s: Annotated[float, Quantity("high end of its band", "", 3)]
    by_slip_per_s: Annotated[tuple[float, ...], Quantity("drag rate at 0.02, 0.5 and 5 m/s", "", 3)]

    @classmethod
    def of(cls, name: str, oil: OilState) -> Self:
        """Record of a state."""
        return cls(
            state=name, temperature_C=oil.temperature, viscosity_mm2_per_s=oil.viscosity, rolling_drag_per_s=oil.drag,
            low_per_s=oil.drag / FACTOR, high_per_s=oil.drag * FACTOR, by_slip_per_s=oil.by_slip,
        )  # fmt: skip


@record
class OilFill(Record):
    """Drag rates with another fill, in oils of ISO VG 10, 22, 46, 100, 220 and 460, at the temperature of work."""

    fill_ml: Annotated[float, Quantity("fill", "V_o", 3)]
    by_grade_per_s: Annotated[tuple[float, ...], Quantity("viscous drag rate", "h₀", 3)]


@record
class OilRecord(Record):
    """Oil of the file, and the drag rate that follows from it."""

    oil: Annotated[str, Quantity("oil")]
    fill_ml: Annotated[float, Quantity("fill", "V_o", 3)]
    depth: Annotated[float, Quantity("depth of the ring of oil", "δ_o", 3, unit="mm")]
    wetted_share: Annotated[float, Quantity("depth over the diameter of a ball", "", 2, percent=True)]
    slip_m_per_s: Annotated[float, Quantity("slip for which the rate is taken", "", 3)]
    uncertainty_factor: Annotated[float, Quantity("factor by which the rate is uncertain", "", 2)]
    overridden: Annotated[bool, Quantity("the file gives rolling_drag_per_s, which overrides the oil")]
    source: Annotated[str, Quantity("source of the drag rate")]
    temperatures: tuple[OilAtTemperature, ...]
    fills: tuple[OilFill, ...]

    @classmethod
    def of(cls, design: Design) -> Self | None:
        """Record of a design; None without [oil]."""
        drag, table = design.case.oil, design.case.table.oil
        if drag is None or table is None:
            return None
        states = (("cold", drag.cold), ("at work", drag.working), ("hot", drag.hot))
        return cls(
            oil=oil_name(table), fill_ml=table.fill_ml, depth=drag.depth,
            wetted_share=drag.wetted_share, slip_m_per_s=table.slip_m_per_s, uncertainty_factor=FACTOR,
            overridden=drag.overridden, source=drag_source(design.case),
            temperatures=tuple(OilAtTemperature.of(name, state) for name, state in states),
            fills=tuple(OilFill(fill_ml=fill * 1e6, by_grade_per_s=rates) for fill, rates in drag.by_fill),
        )  # fmt: skip


METHOD: Final = (
    "Viscosity follows the line of Ubbelohde and Walther through the values at 40 °C and 100 °C. Rotation lays the oil "
    "into an even ring. A ball in it has the drag that Jan and Chen (1997) measured on balls that roll along a wall. "
    "Its coefficients are quoted, not verified in the paper. How much of that drag is left in a shallow ring is "
    "reasoned: no source covers a partly wetted ball."
)


def oil_blocks(oil: OilRecord | None, optimum: float | None) -> Iterator[Block]:
    """The drag rate by the oil, and that of other grades; nothing without [oil]."""
    if oil is None:
        return
    yield Heading("Oil", "oil")
    yield Paragraph(oil.source)
    rows = tuple(
        (
            each.state,
            f"{each.temperature_C:g}",
            number(each.viscosity_mm2_per_s, 3),
            number(each.rolling_drag_per_s, 3),
            f"{number(each.low_per_s, 2)} … {number(each.high_per_s, 2)}",
            *(number(rate, 2) for rate in each.by_slip_per_s),
        )
        for each in oil.temperatures
    )
    slips = (f"{slip:g} m/s" for slip in SLIPS)
    yield Grid(("oil", "°C", "mm²/s", "drag, 1/s", "band", *slips), rows, frozenset(range(1, 8)))
    yield Paragraph(f"Drag rates by grade and fill at {oil.temperatures[1].temperature_C:g} °C, in 1/s:")
    fills = tuple(
        (f"{number(each.fill_ml, 2)} ml", *(number(rate, 2) for rate in each.by_grade_per_s)) for each in oil.fills
    )
    yield Grid(("fill", *(f"VG {grade}" for grade in GRADES)), fills, frozenset(range(1, len(GRADES) + 1)))
    if optimum is not None:
        yield Paragraph(f"Small disturbances die out fastest at {number(optimum, 3)} 1/s; friction asks for less.")
    yield Paragraph(METHOD)
