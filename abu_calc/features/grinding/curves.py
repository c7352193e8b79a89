"""Curves and bounds of a machine at work by steady contact: hodograph, speeds, separation, dry friction.

`shaken` simulates the residual displacement by dry friction, with and without shaking of the balls. That model has only
the balls, their friction and the shaking. An axial runout of a face wheel moves the machine along its spindle, so that
balls roll across their race. A runout in the plane moves the race along the balls' path. Source of the question:
Kladiev 1996.
"""

import cmath
import math
from contextlib import suppress
from dataclasses import replace
from typing import Annotated, Final, Literal, NamedTuple

import numpy as np

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import quickest_loop
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Sampling
from abu_calc.features.grinding.formulas import largest_factor, shaken_drag, shaking_threshold
from abu_calc.features.grinding.simulation import only_contact
from abu_calc.features.grinding.steady_contact import SteadyWork, bare, contact_of, contact_presses, fitted, runout_of
from abu_calc.features.grinding.verdict import AxisMotion
from abu_calc.features.grinding.work import Work
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import wrapped_deg
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design

TRIED: Final = 3.0
"""Times the threshold: the axial runout that is tried of a wheel that has none."""
SECONDS: Final = 1.0, 6.0
"""Seconds of a run that is shaken across the race, and of one shaken along it, in which balls creep."""
TOLERANCE: Final = 2e-4
MOST: Final = 750_000
"""Evaluations, of the loop that is compiled where it can be. Balls that shake less than they are held by start and stop
each turn, which takes the most.
"""
TURNS: Final = 5
"""Turns at the end over which the residual is averaged."""


class Shaken(NamedTuple):
    """Residual [m] of the balls' balance, unshaken and shaken by an amplitude [m], after `seconds`.

    `way`: across the race by an axial runout, which is `given` or only tried, or along it by runout in the
    plane. A residual is None if its run takes too long.
    """

    way: Literal["across", "along"]
    amplitude: float
    given: bool
    seconds: float
    unshaken: float | None
    shaken: float | None


def shaken(work: Work, progress: Progress = silent) -> Shaken | None:
    """Residuals of two runs from the same start, unshaken and shaken.

    None without friction, without a groove, or if no shaking applies. Balls of a face start together on the
    heavy side. Balls with a contact in the plane start where they balance at idle, if they balance and
    wheel and workpiece do not lose contact.
    """
    design = work.design
    if design.case.friction_arm == 0:
        return None
    progress("what shakes friction out")
    return _along(work) if contact_presses(design.case) else _across(design)


def _across(design: Design) -> Shaken | None:
    case, autobalancer, groove = design.case, design.autobalancer, design.track.groove_radius
    if groove is None or case.contact is None:
        return None
    radius, given = autobalancer.ball_diameter / 2, case.table.wheel.axial_runout
    amplitude = given or TRIED * shaking_threshold(case.friction_arm, autobalancer.pitch_radius, radius)
    full = scene_of_design(design, "grinding")
    scene = replace(full, effects=(DryRollingFrictionEffect(case.friction_arm, radius),))
    moved = replace(scene, effects=(TransverseMotionEffect(groove, radius, amplitude), *scene.effects))
    left = [_left(design, each, 0j, SECONDS[0]) for each in (scene, moved)]
    return Shaken("across", amplitude, given > 0, SECONDS[0], *left)


def _along(work: Work) -> Shaken | None:
    design, steady = work.design, work.fitted.steady
    if steady.balls is None or steady.balls.places != "balanced" or work.fitted.parts or not design.case.runout:
        return None
    axis, case = steady.axis or (0j, 0j), design.case
    friction = DryRollingFrictionEffect(case.friction_arm, design.autobalancer.ball_diameter / 2)
    left = []
    for runout in (0.0, case.runout):
        variant = replace(design, case=replace(case, runout=runout))
        scene = only_contact(scene_of_design(variant, "grinding", "bunched"))
        ends = steady.imbalance if runout else fitted(variant, 0j).imbalance
        left.append(_left(variant, replace(scene, effects=(*scene.effects, friction)), ends or 0j, SECONDS[1]))
    return Shaken("along", abs(axis[0] - 1j * axis[1]) / 2, True, SECONDS[1], *left)


def _left(design: Design, scene: Scene, ends: complex, seconds: float) -> float | None:
    """Displacement [m] by what the balls leave beside the imbalance that they would end at."""
    turns = round(seconds / scene.revolution)
    scene = replace(scene, duration=turns * scene.revolution)
    equations = assemble(scene)
    # Friction that holds makes it look stiff; balls that start and stop each turn keep the steps short anyway.
    choice = quickest_loop(equations, TOLERANCE)
    last = np.asarray(scene.duration - scene.revolution / 16 * np.arange(16 * TURNS, -1, -1), dtype=np.float64)
    try:
        run = choice.integrate(equations, TOLERANCE, Sampling(last), MOST)
    except NotTrustworthyError:
        return None
    first = 2 * len(scene.support.names)
    total = scene.total_imbalance(run.at(last)[first : first + len(scene.ball_masses)])
    return abs(complex(total[:-1].mean()) - ends) / design.case.body.effective_mass(design.autobalancer.mass)


CURVE = 8
"""Steps of the curve over speeds."""
AROUND = 0.7, 1.1
"""Speed range as shares of the rated speed, for a file that gives no range."""


@record
class HodographPoint(Record):
    """Axis with the runout at another angle from the imbalance."""

    runout_angle: Annotated[float, Quantity("runout from the imbalance", "φ_ε", unit="deg")]
    without: AxisMotion
    fitted: AxisMotion


@record
class ResponsePoint(Record):
    """Axis and variable force at a speed."""

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    without: AxisMotion
    fitted: AxisMotion
    force_without: Annotated[float | None, Quantity("variable force without autobalancer", unit="N")]
    force_with: Annotated[float | None, Quantity("variable force with it", unit="N")]
    balls: Annotated[str | None, Quantity("balls", "", 4, "balanced, restless, short, gathered or turning")]


@record
class Reaction(Record):
    """Force of wheel and work, N₀ + amplitude·cos(Ωt + angle), as if they never parted."""

    mean: Annotated[float, Quantity("mean force", "N₀", unit="N")]
    amplitude: Annotated[float | None, Quantity("variable part", "|N_c|", unit="N")]
    angle_deg: Annotated[float | None, Quantity("its angle", "arg N_c")]
    hardest_at_deg: Annotated[float | None, Quantity("point of the wheel pressed hardest, from the imbalance")]
    separates: Annotated[bool, Quantity("wheel and work part")]
    largest_runout: Annotated[float | None, Quantity("largest runout without parting", "ε", unit="mm")]


@record
class FrictionBand(Record):
    """Dry friction of the balls, and whether work shakes it out."""

    typical: Annotated[float, Quantity("friction holds the axis off by, typically", unit="um")]
    worst: Annotated[float | None, Quantity("at the worst", unit="um")]
    threshold: Annotated[float, Quantity("shaken out by more than", "k_r·R_p/r", unit="um")]
    axial: Annotated[float, Quantity("shaking across the race, by axial runout", "a_s", unit="um")]
    axial_shakes: Annotated[bool, Quantity("axial runout shakes it out")]
    whirl: Annotated[float | None, Quantity("shaking along the race, by runout in the plane", "|X − iY|/2", unit="um")]
    whirl_shakes: Annotated[bool, Quantity("runout in the plane shakes it out")]
    creep: Annotated[float | None, Quantity("balls then creep to their places within", unit="s")]
    simulated_way: Annotated[str | None, Quantity("shaken in the simulation", "", 4, "across the race or along it")]
    simulated: Annotated[float | None, Quantity("by an amplitude of", unit="um")]
    simulated_given: Annotated[bool | None, Quantity("that of the file")]
    simulated_s: Annotated[float | None, Quantity("for")]
    unshaken: Annotated[float | None, Quantity("simulated: left without it", "", 3, unit="um")]
    shaken: Annotated[float | None, Quantity("simulated: left with it", "", 3, unit="um")]


def hodograph(design: Design, count: int = 24) -> tuple[HodographPoint, ...]:
    """Steady contact at `count` angles of the runout round a full turn."""
    return tuple(_at_angle(design, cmath.rect(design.case.runout, angle), angle)
                 for angle in (2 * math.pi * step / count for step in range(count)))  # fmt: skip


def _at_angle(design: Design, runout: complex, angle: float) -> HodographPoint:
    without, free = bare(design, runout).axis, fitted(design, runout, judged=False).axis
    return HodographPoint(runout_angle=angle, without=AxisMotion.of(without or (0j, 0j)), fitted=AxisMotion.of(free))


def response(design: Design) -> tuple[ResponsePoint, ...]:
    """Steady contact over the speed range, or about the rated speed if the file gives no range."""
    case, runout = design.case, runout_of(design.case)
    low, high = case.speed_range
    if low == high:
        low, high = (share * case.speed for share in AROUND)
    steps = [low + (high - low) * step / CURVE for step in range(CURVE + 1)]
    others = [speed for speed in steps if not math.isclose(speed, case.speed)]
    return tuple(_at_speed(design, runout, speed) for speed in sorted([*others, case.speed]))


def _at_speed(design: Design, runout: complex, speed: float) -> ResponsePoint:
    """None where balls come to no rest, or at a resonance that nothing damps."""
    without = free = None
    with suppress(InputError, ZeroDivisionError):
        without, free = bare(design, runout, speed=speed), fitted(design, runout, speed=speed)
    force = [None if each is None or each.reaction is None else abs(each.reaction) for each in (without, free)]
    return ResponsePoint(
        speed=speed,
        without=AxisMotion.of(without.axis if without else None),
        fitted=AxisMotion.of(free.axis if free else None),
        force_without=force[0],
        force_with=force[1],
        balls=free.balls.places if free and free.balls else None,
    )


def loaded_resonance(design: Design) -> float | None:
    """Natural frequency [rad/s] of the machine without autobalancer on its contact, normal to the work.

    None where the contact is rigid or that of a face. Of springs exactly, of hands by their stiffness at the rated
    speed.
    """
    contact = design.case.contact
    if contact is None or contact.contact != "compliant":
        return None
    mass = design.case.body.effective_mass()
    held = contact_of(design.case, 0.0).dynamic_stiffness[1].real + mass * design.case.speed**2
    return math.sqrt(max(held + contact.contact_stiffness, 0.0) / mass)


def largest_runout(case: Case, steady: SteadyWork) -> float | None:
    """The largest runout [m] at the file's angle at which wheel and work stay together; None where any or none does."""
    contact, direction = steady.contact, cmath.rect(1.0, case.table.wheel.runout_angle)
    if steady.imbalance is None or case.contact is None or contact.pressing == 0:
        return None
    press = case.contact.press_force
    if steady.balls is not None:
        if steady.balls.places != "balanced":
            return None
        slope = contact.normal_force(contact.balancing_imbalance(direction), direction)
        return largest_factor(slope, 0j, press)
    return largest_factor(contact.normal_force(0j, direction), contact.normal_force(steady.imbalance, 0j), press)


def reaction(case: Case, steady: SteadyWork) -> Reaction:
    """Force of wheel and workpiece in a steady motion."""
    force, press = steady.reaction, case.contact.press_force if case.contact else 0.0
    return Reaction(
        mean=press,
        amplitude=None if force is None else abs(force),
        angle_deg=wrapped_deg(cmath.phase(force)) if force else None,
        hardest_at_deg=wrapped_deg(cmath.phase(-1j * force)) if force else None,
        separates=bool(force) and case.contact is not None and abs(force or 0j) > press,
        largest_runout=largest_runout(case, steady),
    )


def friction(work: Work, run: Shaken | None) -> FrictionBand:
    """Imbalance that dry friction holds, and the motions that release it on the workpiece; `run` as simulated."""
    design = work.design
    case, autobalancer, steady = design.case, design.autobalancer, work.fitted.steady
    threshold = shaking_threshold(case.friction_arm, autobalancer.pitch_radius, autobalancer.ball_diameter / 2)
    face = case.contact is not None and case.contact.contact == "face"
    axial = case.table.wheel.axial_runout if face and design.track.groove_radius else 0.0
    axis = steady.axis
    whirl = None if axis is None else abs(axis[0] - 1j * axis[1]) / 2
    creep = None
    if whirl and whirl > threshold > 0 and steady.balls is not None and steady.balls.places == "balanced":
        drag = case.drag + shaken_drag(threshold, whirl, case.speed, case.inertia_factor)
        stiffness = [k.real for k in steady.balls.stiffness if k.real > 0]
        creep = drag / min(stiffness) if stiffness else None
    worst = max((budget.rolling_friction for budget in design.worst if budget.speed == case.speed), default=math.nan)
    way, amplitude, given, seconds, unshaken, left = run or (None,) * 6
    return FrictionBand(
        typical=autobalancer.budget.rolling_friction,
        worst=worst,
        threshold=threshold,
        axial=axial,
        axial_shakes=axial > threshold > 0,
        whirl=whirl,
        whirl_shakes=creep is not None,
        creep=creep,
        simulated_way=way,
        simulated=amplitude,
        simulated_given=given,
        simulated_s=seconds,
        unshaken=unshaken,
        shaken=left,
    )
