"""Curves and bounds of a machine at work by steady contact: hodograph, speeds, separation, dry friction.

`shaken` simulates the residual displacement by dry friction, with and without shaking of the balls. That model has only
the balls, their friction and the shaking. An axial runout of a face wheel moves the machine along its spindle, so that
balls roll across their race. A runout in the plane moves the race along the balls' path. Source of the question:
Kladiev 1996.
"""

import cmath
import math
from dataclasses import replace
from typing import Final, Literal

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
from abu_calc.features.grinding.work import Work
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.units import to_si
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


@dataclass(frozen=True)
class Shaken:
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
    radius, given = autobalancer.ball_diameter / 2, to_si(case.table.wheel.axial_runout_mm, "mm")
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


@dataclass(frozen=True)
class AtAngle:
    """Phasors X, Y [m] without and with the autobalancer, the runout at an angle [rad] from the imbalance."""

    angle: float
    without: tuple[complex, complex]
    fitted: tuple[complex, complex] | None


@dataclass(frozen=True)
class SpeedResponse:
    """Amplitude [m] and variable force [N] without and with the autobalancer at a speed [rad/s], by steady contact.

    None where balls come to no rest, or at a resonance that nothing damps.
    """

    speed: float
    without: SteadyWork | None
    fitted: SteadyWork | None


@dataclass(frozen=True)
class Friction:
    """Dry friction of the balls: typical and worst displacement that it holds at idle, and what shakes it out [m].

    `axial`, `whirl`: amplitudes that shake across and along the race; `creep`: time constant [s] of balls that the
    whirl shakes, None where it does not.
    """

    typical: float
    worst: float
    threshold: float
    axial: float
    whirl: float | None
    creep: float | None


def hodograph(design: Design, count: int = 24) -> tuple[AtAngle, ...]:
    """Steady contact at `count` angles of the runout round a full turn."""
    return tuple(_at_angle(design, cmath.rect(design.case.runout, angle), angle)
                 for angle in (2 * math.pi * step / count for step in range(count)))  # fmt: skip


def _at_angle(design: Design, runout: complex, angle: float) -> AtAngle:
    without = bare(design, runout).axis
    return AtAngle(angle, without or (0j, 0j), fitted(design, runout, judged=False).axis)


def response(design: Design) -> tuple[SpeedResponse, ...]:
    """Steady contact over the speed range, or about the rated speed if the file gives no range."""
    case, runout = design.case, runout_of(design.case)
    low, high = case.speed_range
    if low == high:
        low, high = (share * case.speed for share in AROUND)
    steps = [low + (high - low) * step / CURVE for step in range(CURVE + 1)]
    others = [speed for speed in steps if not math.isclose(speed, case.speed)]
    return tuple(_at_speed(design, runout, speed) for speed in sorted([*others, case.speed]))


def _at_speed(design: Design, runout: complex, speed: float) -> SpeedResponse:
    try:
        return SpeedResponse(speed, bare(design, runout, speed=speed), fitted(design, runout, speed=speed))
    except (InputError, ZeroDivisionError):
        return SpeedResponse(speed, None, None)


def loaded_resonance(design: Design) -> float | None:
    """Natural frequency [rad/s] of the machine without autobalancer on its contact, normal to the work.

    None where the contact is rigid or that of a face. Of springs exactly, of hands by their stiffness at the rated
    speed.
    """
    contact = design.case.contact
    if contact is None or contact.kind != "compliant":
        return None
    mass = design.case.body.effective_mass()
    held = contact_of(design.case, 0.0).dynamic_stiffness[1].real + mass * design.case.speed**2
    return math.sqrt(max(held + contact.stiffness, 0.0) / mass)


def largest_runout(case: Case, steady: SteadyWork) -> float | None:
    """The largest runout [m] at the file's angle at which wheel and work stay together; None where any or none does."""
    contact, direction = steady.contact, cmath.rect(1.0, to_si(case.table.wheel.runout_angle_deg, "deg"))
    if steady.imbalance is None or case.contact is None or contact.pressing == 0:
        return None
    press = case.contact.press_force
    if steady.balls is not None:
        if steady.balls.places != "balanced":
            return None
        slope = contact.normal_force(contact.balancing_imbalance(direction), direction)
        return largest_factor(slope, 0j, press)
    return largest_factor(contact.normal_force(0j, direction), contact.normal_force(steady.imbalance, 0j), press)


def friction(work: Work) -> Friction:
    """Imbalance that dry friction holds, and the motions that release it on the workpiece."""
    design = work.design
    case, autobalancer, steady = design.case, design.autobalancer, work.fitted.steady
    threshold = shaking_threshold(case.friction_arm, autobalancer.pitch_radius, autobalancer.ball_diameter / 2)
    face = case.contact is not None and case.contact.kind == "face"
    axial = to_si(case.table.wheel.axial_runout_mm, "mm") if face and design.track.groove_radius else 0.0
    axis = steady.axis
    whirl = None if axis is None else abs(axis[0] - 1j * axis[1]) / 2
    creep = None
    if whirl and whirl > threshold > 0 and steady.balls is not None and steady.balls.places == "balanced":
        drag = case.drag + shaken_drag(threshold, whirl, case.speed, case.inertia_factor)
        stiffness = [k.real for k in steady.balls.stiffness if k.real > 0]
        creep = drag / min(stiffness) if stiffness else None
    worst = max((budget.rolling_friction for budget in design.worst if budget.speed == case.speed), default=math.nan)
    return Friction(autobalancer.budget.rolling_friction, worst, threshold, axial, whirl, creep)
