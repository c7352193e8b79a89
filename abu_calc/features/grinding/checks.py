"""Checks of `abu grinding`: limits for a machine at its workpiece, and closed form against simulation."""

import cmath
from dataclasses import replace
from typing import Annotated, ClassVar, Final

from abu_calc.dynamics.scene import Scene
from abu_calc.features.grinding.formulas import flutter_drag, loaded_stiffness
from abu_calc.features.grinding.outcomes import GrindingOutcomes
from abu_calc.features.grinding.simulation import WorkSimulation, only_contact, working
from abu_calc.features.grinding.steady_contact import SteadyWork, contact_presses, leaving
from abu_calc.features.grinding.work import Work
from abu_calc.foundation.checks import Check, Grade, coded, verdict
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.quiet import free_rates
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.sizing.advice import power_checks
from abu_calc.sizing.design import Design

AGREES: Final = 0.02
"""Permitted relative difference between closed form and simulation of the same contact.

The averages leave out that balls swing twice per turn, and the run may not have settled completely.
"""

LONG, LONGEST = 7.0, 6.0
"""Decay times of the slowest balls that a run to be compared lasts, and the most seconds."""

STAYS: Final = 3.0
"""Seconds at least for balls to stay where they were put: near a resonance axis and balls decay slower than either."""


@record
class Comparison(Record):
    """Difference between the simulation of the contact alone and the closed form, relative.

    Balls that do not get there from where they stand at idle were started where the closed form has them.
    """

    left_out: ClassVar[frozenset[str]] = frozenset({"failure"})

    axis: Annotated[float | None, Quantity("axis", "", 3)] = None
    reaction: Annotated[float | None, Quantity("variable force", "", 3)] = None
    imbalance: Annotated[float | None, Quantity("imbalance", "", 3)] = None
    failure: str | None = None
    """Why there is none."""
    from_idle: Annotated[bool, Quantity("balls get there from where they stand at idle")] = True

    @property
    def apart(self) -> float | None:
        """The largest."""
        return max((each for each in (self.axis, self.reaction, self.imbalance) if each is not None), default=None)


def work_checks(
    work: Work, remedy: str | None, compared: Comparison | None, loads: GrindingOutcomes | None = None
) -> tuple[Check, ...]:
    """Level, capacity, stability, contact kept, power, and how far the closed form can be trusted.

    `remedy`: what was tried and lowers the level; `loads`: the start cases of grinding.
    """
    return (
        _lowered(work, remedy) if loads is None else _lowered_in_all(_lowered(work, remedy), work, remedy, loads),
        _carried(work),
        _still(work),
        *_kept(work, remedy, loads),
        *power_checks(work.design.case),
        *_agrees(compared),
    )


def _lowered(work: Work, remedy: str | None) -> Check:
    before, after = work.levels.before, work.levels.after
    if work.lowered is None:
        sides = {"without": before, "with": after}
        missing = " and ".join(side for side, level in sides.items() if level is None)
        if not missing:
            why = "levels with and without the autobalancer differ by less than runs of chaotic bouncing do"
            return coded("ABU421", "not-done", why, after, before,
                remedy or "Keep the wheel on the workpiece: smaller runout, softer contact, larger normal force.",
            )  # fmt: skip
        usual = (
            'Set grinding.contact = "compliant" and its stiffness: a simulation then gives the level while bouncing.'
        )
        return coded("ABU421", "not-done", f"the level {missing} the autobalancer is not known", after, before,
            remedy or usual,
        )  # fmt: skip
    message = "level with the autobalancer, pressed after the balls settled, against the level without"
    if work.fitted.scatter or work.without.scatter:
        message += (
            f"; bouncing is chaotic, so levels are known to {max(work.fitted.scatter, work.without.scatter):.1f} dB"
        )
    if work.lowered and not work.always:
        hasty = "not known" if work.level_at_once is None else f"{work.level_at_once:.1f} dB"
        message += f". Pressed before: {hasty}{', and it stays so' if work.stays_loud else ''}"
    return coded("ABU421", verdict(work.lowered, work.always is True), message, after, before, remedy)


def _lowered_in_all(usual: Check, work: Work, remedy: str | None, loads: GrindingOutcomes) -> Check:
    """The check of the usual case, judged by every start case, as the idle machine is.

    A start case pressed after the balls settled fails it, one pressed at once warns. One without an answer leaves it
    open; so does one whose level is no further from the level without than chaotic runs scatter.
    """
    settled, early = loads.lowered("settled"), loads.lowered("at once")
    if usual.status == "fail" or (usual.status == "not-done" and settled is not False):
        return usual
    before, worst = (
        work.levels.before,
        max((outcome.level for outcome in loads.ensemble.pressed("settled")), default=None),
    )
    after = max((level for level in (work.levels.after, worst) if level is not None), default=None)
    if settled is False:
        louder, count = loads.louder("settled"), loads.count("settled")
        message = (
            f"not lower than without the autobalancer in {len(louder)} of {count} start cases pressed after the balls "
            f"settled; the loudest is {louder[-1].start.name}"
        )
        return coded("ABU421", "fail", message, after, before, remedy)
    if settled is None:
        missing = loads.ensemble.without_answer("settled")
        message = "start cases pressed after the balls settled differ from the level without by less than they scatter"
        if missing:
            message = f"{len(missing)} of {loads.count('settled')} start cases gave no result: {missing[0].reason}"
        return coded("ABU421", "not-done", message, after, before,
            remedy or "Permit a larger error (--accuracy), or raise the viscous drag rate.",
        )  # fmt: skip
    if early is True:
        return coded("ABU421", usual.status, usual.message, after, before, remedy)
    message = f"{usual.message}. {_early_starts(loads)}"
    return coded("ABU421", "warn", message, after, before, remedy)


def _early_starts(loads: GrindingOutcomes) -> str:
    """Text on the start cases pressed at once that do not lower the level."""
    louder, count = loads.louder("at once"), loads.count("at once")
    if louder:
        highest = max(outcome.level for outcome in louder)
        return f"Not lower in {len(louder)} of {count} start cases pressed before, up to {highest:.1f} dB"
    missing = loads.ensemble.without_answer("at once")
    if missing:
        return f"{len(missing)} of {count} start cases pressed before gave no result"
    return "Start cases pressed before differ from it by less than they scatter"


def _carried(work: Work) -> Check:
    balls, autobalancer = work.fitted.steady.balls, work.design.autobalancer
    needed = abs(balls.needed) if balls else 0.0
    enough = needed <= autobalancer.capacity
    return coded("ABU422", verdict(enough), "capacity, balls side by side, against the one required by this contact",
        autobalancer.capacity, needed,
        None if enough else "Specify larger balls, less runout, a better balanced wheel or a softer contact.",
    )  # fmt: skip


def flutter_limits(work: Work) -> tuple[float, float] | None:
    """Drag [1/s] below which light balls flutter where they stand, and in a cross; None where they do not balance."""
    balls, case, autobalancer = work.fitted.steady.balls, work.design.case, work.design.autobalancer
    if balls is None or balls.places not in ("balanced", "restless"):
        return None
    whirl = work.fitted.steady.contact.whirl_per_imbalance
    cross = loaded_stiffness(whirl, autobalancer.ball_mass, case.speed, autobalancer.ball_count, 0.0)
    return flutter_drag(balls.stiffness, case.inertia_factor), flutter_drag(cross, case.inertia_factor)


def _still(work: Work) -> Check:
    balls, drag = work.fitted.steady.balls, work.design.case.drag
    limits = flutter_limits(work)
    if balls is None or limits is None:
        short = balls is not None and balls.places == "short"
        status: Grade = "not-done" if short else "fail"
        why = "the capacity is below that required at the workpiece" if short else (
            "at this contact stiffness and speed balls go where they add to the imbalance")  # fmt: skip
        return coded("ABU423", status, why, drag)
    here, cross = limits
    if balls.places == "restless":
        why = "their motion in the race has no damping" if drag == 0 else (
               "cutting friction feeds their flutter below the limit of the viscous drag rate" if drag < here else
               "the machine on its contact has a natural frequency too near the speed for these balls")  # fmt: skip
        return coded("ABU423", "fail", f"balls do not stay where they balance: {why}", drag, here)
    loose = [line for line in _lines(work) if leaving(work.design.case, work.fitted.steady.contact,
                                                      work.design.autobalancer, line)]  # fmt: skip
    message = "small disturbances die out; viscous drag rate against flutter fed by cutting friction"
    if drag < cross:
        message += f". Balls in a cross, as with other wheels, require {cross:.3g} 1/s"
    elif loose:
        message += ". In another arrangement that balances they would not die out"
    return coded("ABU423", verdict(True, drag >= cross and not loose), message, drag, here)


def _lines(work: Work) -> tuple[float, ...]:
    """|Σe^{2iΘ}| of arrangements that more than two balls may take."""
    count = work.design.autobalancer.ball_count
    return () if count == 2 else tuple(count * step / 4 for step in range(5))


def _kept(work: Work, remedy: str | None, loads: GrindingOutcomes | None) -> tuple[Check, ...]:
    """Never failed: wheels bounce, and are judged by their level."""
    contact, force = work.design.case.contact, work.fitted.steady.reaction
    if contact is None or contact.contact == "face":
        return ()
    amplitude, press = None if force is None else abs(force), contact.press_force
    parts = work.fitted.parts
    message = "variable part of the normal force against its mean, with the autobalancer"
    if parts:
        apart = work.fitted.run.apart if work.fitted.run and contact.contact == "compliant" else None
        message += ". Wheel and workpiece lose contact" + (f" {100 * apart:.0f} % of the time" if apart else "")
    elif work.at_once.parts:
        message += ". They keep bouncing if pressed before the balls have settled"
    elif work.without.parts:
        message += ". Without it they lose contact"
    bouncing = [] if loads is None else [outcome for outcome in loads.ensemble.outcomes if outcome.parts]
    if loads is not None and bouncing:
        message += f". They bounce in {len(bouncing)} of {loads.ensemble.count} start cases"
    warned = parts or work.at_once.parts or bool(bouncing)
    return (coded("ABU424", "warn" if warned else "pass", message, amplitude, press,
                  remedy if warned else None),)  # fmt: skip


def _agrees(compared: Comparison | None) -> tuple[Check, ...]:
    if compared is None:
        return ()
    if compared.apart is None:
        return (coded("ABU425", "not-done", f"no simulation is valid: {compared.failure}", None, AGREES,
                      "Set the drag rate nearer to its optimum, or permit a larger error (--accuracy)."),)  # fmt: skip
    near = compared.apart <= AGREES
    remedy = (
        None
        if near
        else "Raise the damping of the suspension, or set another drag rate: a motion of the run lasts too long."
    )
    message = "simulated contact, ideal race, against the closed form"
    if not compared.from_idle:
        message += "; the balls start at their places, since from those at idle they do not arrive in time"
    return (coded("ABU425", verdict(True, near and compared.from_idle), message, compared.apart, AGREES, remedy),)


def agreement(work: Work, accuracy: float, progress: Progress = silent) -> Comparison | None:
    """Closed form against the simulation of the same contact, ideal race and balls, from where the balls stand at idle.

    Balls that do not get to their places from there, or not within what is simulated, are started at them: they must
    stay. None where wheel and work part or balls do not balance: the closed form does not speak of these. A face leaves
    balls where they stand.
    """
    steady = work.fitted.steady
    if (
        not contact_presses(work.design.case)
        or work.fitted.parts
        or steady.balls is None
        or steady.balls.places != "balanced"
        or steady.axis is None
    ):
        return None
    scene = only_contact(scene_of_design(work.design, "grinding", "settled"))
    sway, _ = free_rates(scene.support, scene.races[0], scene.speed)
    slowest = min(loaded_rate(work.design, each) for each in (steady.balls.stiffness, steady.balls.worst))
    if min(slowest, sway) * LONGEST >= LONG:
        comparison = _compared(work, _lasting(scene, min(slowest, sway)), accuracy, progress)
        if comparison.apart is not None and comparison.apart <= AGREES:
            return comparison
    placed = tuple(replace(race, start_angles=steady.balls.angles) for race in scene.races)
    there = _compared(work, _lasting(replace(scene, races=placed), min(sway, LONG / STAYS)), accuracy, progress)
    return replace(there, from_idle=False)


def _lasting(scene: Scene, rate: float) -> Scene:
    """Until what dies out at a rate [1/s] is gone, within bounds."""
    longer = min(LONG / rate if rate > 0 else LONGEST, LONGEST)
    return replace(scene, name="grinding, contact alone", duration=max(scene.duration, longer))


def _compared(work: Work, scene: Scene, accuracy: float, progress: Progress) -> Comparison:
    try:
        run = working(scene, accuracy, progress)
    except NotTrustworthyError as error:
        return Comparison(failure=str(error).splitlines()[0])
    return compared(work.fitted.steady, run, work.design.autobalancer.static_moment)


def loaded_rate(design: Design, stiffness: tuple[complex, complex]) -> float:
    """Slowest decay rate of the balls under load [1/s]; below zero where they flutter or go away."""
    drag, inertia = design.case.drag, design.case.inertia_factor
    return min((drag - abs(cmath.sqrt(drag**2 - 4 * inertia * k).real)) / (2 * inertia) for k in stiffness)


def compared(steady: SteadyWork, run: WorkSimulation, moment: float) -> Comparison:
    """Differences relative to the larger of what is compared and what the imbalance that the balls carry would cause.

    `moment` Σ m·R_p [kg m].
    """
    axis, total = steady.axis or (0j, 0j), steady.imbalance or 0j
    carried = max(abs(total - steady.own), 0.01 * moment)
    force = carried * steady.contact.speed**2
    off = max(abs(simulated - calculated) for simulated, calculated in zip(run.axis, axis, strict=True))
    usual = max(*map(abs, axis), force / min(map(abs, steady.contact.dynamic_stiffness)))
    reaction = steady.reaction or 0j
    pressed = abs(run.reaction - reaction) / max(abs(reaction), force) if len(run.force) else None
    return Comparison(axis=off / usual, reaction=pressed, imbalance=abs(run.imbalance - total) / carried)
