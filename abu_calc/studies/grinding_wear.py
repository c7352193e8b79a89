"""Wear of the wheel of a machine at its workpiece, in user units."""

import cmath
import math
from collections.abc import Callable
from typing import Annotated, Self

from abu_calc.analysis.grinding import Side, Work
from abu_calc.analysis.under_load import Steady, contact_presses, runout_of
from abu_calc.analysis.wear import Stage, Wear, needed_exponent, worn
from abu_calc.analysis.working import harmonic_force
from abu_calc.formulas.grinding import runout_rate
from abu_calc.sizing.budget import permitted_displacement
from abu_calc.sizing.design import Design
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.units import from_si, to_si, wrapped_deg

USABLE = 0.2
"""Share of the wheel's radius taken as the depth that may be worn off, if the file gives none."""
CLAIMED = 32.0, 48.0
"""Minutes a wheel lasts without and with the autobalancer of the MSh-230, Kladiev 1996."""


@record
class WearStage(Record):
    """The wheel after some wear."""

    depth_um: Annotated[float, Quantity("worn off")]
    time_min: Annotated[float | None, Quantity("after")]
    runout_mm: Annotated[float, Quantity("runout", "ε")]
    runout_angle_deg: Annotated[float, Quantity("runout from the first imbalance", "φ₀")]
    imbalance_g_mm: Annotated[float, Quantity("imbalance of the wheel", "m₀e")]
    variable_force_N: Annotated[float, Quantity("variable force", "|F_H|")]

    @classmethod
    def of(cls, stage: Stage, pace: float | None) -> Self:
        """Record of a stage; `pace` in minutes per metre."""
        return cls(
            depth_um=from_si(stage.depth, "um"),
            time_min=None if pace is None else pace * stage.depth,
            runout_mm=from_si(abs(stage.runout), "mm"),
            runout_angle_deg=wrapped_deg(cmath.phase(stage.runout)),
            imbalance_g_mm=from_si(abs(stage.imbalance), "g_mm"),
            variable_force_N=abs(stage.pressure),
        )


@record
class WearCourse(Record):
    """Wear of the wheel: the rate of its runout is below zero if wear centres it."""

    centres: Annotated[bool, Quantity("wear centres the wheel")]
    runout_rate: Annotated[
        float, Quantity("change of the runout per depth worn off", "dε/ds", 4, "as if wheel and work never parted")
    ]
    pressure_amplitude_N: Annotated[float, Quantity("variable force round the wheel", "|F_H|")]
    hardest_at_deg: Annotated[float | None, Quantity("pressed hardest, from the high spot")]
    ends: Annotated[str | None, Quantity("what comes first", "", 4, "halved, limit, parted, settled or worn out")]
    depth_um: Annotated[float | None, Quantity("worn off until then")]
    time_min: Annotated[float | None, Quantity("until then")]
    stages: tuple[WearStage, ...]

    @classmethod
    def of(cls, wear: Wear, runout: complex, pace: float | None) -> Self:
        """`pace` in minutes per metre of depth."""
        away = cmath.phase(wear.pressure) - cmath.phase(runout)
        return cls(
            centres=wear.centres,
            runout_rate=wear.rate,
            pressure_amplitude_N=abs(wear.pressure),
            hardest_at_deg=wrapped_deg(away) if wear.pressure else None,
            ends=wear.event,
            depth_um=None if wear.depth is None else from_si(wear.depth, "um"),
            time_min=None if wear.depth is None or pace is None else pace * wear.depth,
            stages=tuple(WearStage.of(stage, pace) for stage in wear.stages),
        )


@record
class Claim(Record):
    """The source's claim that a wheel lives 48 minutes with an autobalancer and 32 without, and what it would take."""

    life_without_min: Annotated[float, Quantity("life without, as printed")]
    life_with_min: Annotated[float, Quantity("life with, as printed")]
    ratio_by_archard: Annotated[float, Quantity("ratio of lives if wear goes with the force")]
    needed_exponent: Annotated[float | None, Quantity("power of the force that wear would go with")]
    needed_press_N: Annotated[float, Quantity("mean force that would do it, by the same law")]


def press_of(design: Design) -> float:
    """The press force [N]; without end where nothing presses."""
    return design.case.contact.press_force if design.case.contact else math.inf


def wear_course(work: Work, steady: Steady) -> WearCourse | None:
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


def rigid_course(work: Work, moving: Callable[..., Steady]) -> WearCourse | None:
    """The same at a contact that does not give, where it moves as `under_load.fitted` or `bare` says."""
    design = work.design
    return (
        wear_course(work, moving(design, runout_of(design.case), rigid=True)) if contact_presses(design.case) else None
    )


def bouncing_course(design: Design, side: Side) -> WearCourse | None:
    """The rate of a wheel that parts from its work, by the simulated force."""
    contact = design.case.contact
    if side.run is None or not side.parts or contact is None or contact.kind != "compliant":
        return None
    pressure, runout = side.run.pressure, runout_of(design.case)
    centres = (pressure * runout.conjugate()).real > 0
    return _course(design, Wear(pressure, runout_rate(pressure, runout, contact.press_force), centres, None, ()))


def claim(work: Work) -> Claim | None:
    """Conditions under which the wheel would last as much longer as the source claims."""
    if not contact_presses(work.design.case):
        return None
    press, (before, after) = press_of(work.design), CLAIMED
    forces = [
        side.run.force if side.parts and side.run is not None else harmonic_force(press, side.steady.pressure or 0j)
        for side in (work.without, work.fitted)
    ]
    return Claim(
        life_without_min=before,
        life_with_min=after,
        ratio_by_archard=1.0,
        needed_exponent=needed_exponent(forces[0], forces[1], after / before),
        needed_press_N=press * before / after,
    )


def _usable(design: Design) -> float:
    given = design.case.table.wheel.usable_wear_mm
    return USABLE * design.case.wheel_radius if given is None else to_si(given, "mm")


def _course(design: Design, wear: Wear) -> WearCourse:
    wheel = design.case.table.wheel
    pace = wheel.life_min / to_si(wheel.usable_wear_mm, "mm") if wheel.life_min and wheel.usable_wear_mm else None
    return WearCourse.of(wear, runout_of(design.case), pace)
