"""Scenes of a design: idle, at work, running up, on springs, in hands or on a swing arm; how loud they may be.

Parts that few files ask for (swing arm, motor, balls across their race) are imported on demand.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Final, Literal

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene, parted_angles, placed
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.planar import in_hands, planar
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport, cutting_arm, idle_arm
from abu_calc.formulas.slow_motion import ball_stiffness, decay_rate
from abu_calc.formulas.suspension import Hands, Springs, resonance_factor
from abu_calc.formulas.swing_arm import pressed_angle
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.units import velocity_from_level
from abu_calc.foundation.validity import Range
from abu_calc.inputs.duty import Motor as MotorTable
from abu_calc.inputs.duty import SwingArm as SwingArmTable
from abu_calc.simulation.quiet import settling_duration, slowest_in_hand, slowest_rate
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.handles import total_of
from abu_calc.sizing.places import level_at_loudest, settled_levels

if TYPE_CHECKING:
    from abu_calc.dynamics.effects.motor import MotorEffect


def arm_of_design(design: Design, table: SwingArmTable, *, cutting: bool) -> SwingArmSupport:
    """The swing arm with the machine and the autobalancer, without balls."""
    case, autobalancer = design.case, design.autobalancer
    arm = table.arm(case.wheel_radius, autobalancer.mass - autobalancer.balls_mass)
    if not cutting:
        return idle_arm(arm)
    angle = pressed_angle(arm)
    if angle is None or angle < arm.touch_angle:
        why = "does not stand" if angle is None else "does not reach the work"
        raise NotTrustworthyError(
            f"the swing arm {why} while cutting\n  turn the contact angle nearer to 90°, or press with a larger moment"
        )
    return cutting_arm(arm)


def ball_rate_on_arm(design: Design, arm: SwingArmSupport, drag: float) -> float:
    """Slowest decay rate of the balls' slow motion [1/s] on an arm, at a viscous drag rate [1/s].

    There the rotor moves along one axis alone, so that half the stiffness of the slow motion is left.
    """
    case, candidate = design.case, design.autobalancer
    mass = arm.felt_mass + candidate.balls_mass
    natural = math.sqrt(max(arm.stiffness, 0.0) / mass)
    kappa = ball_stiffness(candidate.ball_mass, mass, case.speed, (natural, natural)) / 2
    return decay_rate((kappa,) * candidate.ball_count, candidate.budget.resting_angles, drag, case.inertia_factor)


AHEAD = math.radians(20)
"""The bunch starts this far ahead of the imbalance: on the heavy side, and not in unstable equilibrium."""

Start = Literal["bunched", "behind", "spread", "standstill", "settled", "placed"]

STARTS: Final[dict[Start, str]] = {
    "bunched": "balls at rest in the race, neighbours touching, their middle 20° ahead of the imbalance",
    "behind": "balls at rest in the race, neighbours touching, their middle 20° behind the imbalance",
    "spread": "balls at rest in the race, evenly round it, the first 20° ahead of the imbalance",
    "standstill": "balls not turning at all, neighbours touching, their middle 20° ahead of the imbalance",
    "settled": "balls at rest in the race, evenly fanned where they balance at idle",
    "placed": "balls where start.angles_deg of the file has them, at start.speeds_rpm, or at rest in the race",
}

SCENES: Final[dict[str, str | None]] = {
    "idle": None,
    "grinding": "grinding",
    "run-up": "run_up",
    "swing-arm-idle": "swing_arm",
    "swing-arm-cutting": "swing_arm",
}
"""The scenes of a machine, and the table of its file that each needs."""

RESTITUTION = 0.5
"""Coefficient of restitution of steel balls with oil between them; assumed."""

WORST = math.pi
"""Angle of the race's centre from the imbalance [rad] at which it asks for M Δ more of the balls.

Sizing takes the same angle.
"""

QUIET: Final = frozenset({"idle", "run-up", "swing-arm-idle"})
"""Scenes that the limits of a file are for, and that are followed until their balls are at rest, as far as that
matters.
"""

LAGS = 3.0
"""Times J/h₀, in which balls that stand still take up the speed of the race, that a run is longer for them."""

TIME_CONSTANTS = 5.0
"""Time constants after which the speed of a motor is within 1 % of its idle speed."""


def scene_of_design(design: Design, which: str = "idle", start: Start = "bunched", race_centre: float = WORST) -> Scene:
    """One scene of a machine, with every effect its file has data for.

    `idle`: at full speed, the axis at rest at its place, the balls as in `STARTS`, the mass that which is felt in
    the race plane, without balls. `grinding`: pressed to the work, from where the cutting force holds it, unless the
    contact is that of a face, which does not press in the plane. `run-up`: from rest; a motor brings it to its idle
    speed. `swing-arm-…`: on the arm, at rest where it stands. Always with ball contact, dry rolling friction and the
    race's eccentricity, its centre at an angle [rad] from the imbalance; on a horizontal spindle with gravity; a face
    wheel at work with transverse motion, where its axial runout drives it. Left out: the motor at full speed, where it
    would change the speed. It lasts seven decay times of what dies out last, within bounds, and longer for balls that
    have to take up the speed. An idle scene has the pause of its file.
    Raises InputError for a table that is missing, NotTrustworthyError for an arm that does not stand at the work.
    """
    _refuse_what_is_missing(design, which)
    if which == "run-up" and design.case.idle_speed is not None:
        design = replace(design, case=replace(design.case, speed=design.case.idle_speed))
    case, table = design.case, design.case.table
    effects = tuple(_effects(design, which, race_centre))
    felt = abs(design.autobalancer.requirement.plane_ratio)
    support: Support = _held(design)
    if table.swing_arm and which.startswith("swing-arm"):
        from abu_calc.dynamics.effects.lift_off import lift_off
        from abu_calc.simulation.scene_of_file import in_order

        support = arm = arm_of_design(design, table.swing_arm, cutting=which.endswith("cutting"))
        felt, ball_rate = 1.0, slowest_rate(design, partial(ball_rate_on_arm, design, arm))
        if which.endswith("cutting"):
            joint, touch = table.swing_arm.joint_stiffness_N_per_m, table.swing_arm.touch_angle
            effects = in_order((*effects, *lift_off(arm, joint, touch)))
    else:
        ball_rate = slowest_in_hand(design)
    race = _race(design, start, turning=which != "run-up")
    settling = settling_duration(design, support, race, ball_rate)
    scene = Scene(
        name=which,
        support=support,
        speed=case.speed,
        imbalance=design.imbalance.value * felt,
        imbalance_angle=0.0,
        races=(race,),
        duration=settling,
        start_position=support.resting_position(_pulled(design, which)),
        start_velocity=(0.0,) * len(support.names),
        effects=effects,
    )
    stands = which in ("idle", "swing-arm-idle") and start == "standstill"
    longer = _taking_up(design) if which == "run-up" or stands else 0.0
    scene = replace(scene, duration=settling + scene.full_speed + longer)
    if which in QUIET:
        scene = replace(scene, quiet_velocity=quiet_velocity(design, scene))
    return scene if which == "run-up" else placed(scene)


def _taking_up(design: Design) -> float:
    """Time [s] in which balls that stand still take up the speed of the race: at most the settling time permitted."""
    case = design.case
    longest = case.table.limits.longest_quiet_time
    return min(LAGS * case.inertia_factor / case.drag, longest) if case.drag else longest


def grinding_without(design: Design) -> Scene:
    """The machine at work without its autobalancer: the contact alone; one with a face idles."""
    case, contact = design.case, _contact(design)
    support = _support(case, case.body.effective_mass())
    race = Race(1.0, (), 0.0, 1.0, (), ())
    scene = Scene(
        name="grinding, without autobalancer",
        support=support,
        speed=case.speed,
        imbalance=design.imbalance.value,
        imbalance_angle=0.0,
        races=(),
        duration=settling_duration(design, support, race, math.inf),
        start_position=support.resting_position(_pulled(design, "grinding")),
        start_velocity=(0.0,) * len(support.names),
        effects=() if contact is None else (contact,),
    )
    return placed(scene)


def idle_scene(design: Design, start: Start = "bunched") -> Scene:
    """The machine idling at full speed, without any effect."""
    return replace(scene_of_design(design, "idle", start), effects=())


def _refuse_what_is_missing(design: Design, which: str) -> None:
    if which not in SCENES:
        raise InputError("there is no such scene of a machine", found=which, allowed=", ".join(SCENES))
    needed = SCENES[which]
    if needed and getattr(design.case.table, needed) is None:
        raise InputError(
            f"the scene {which} needs the table [{needed}]",
            place=Place(key=needed),
            found="none in the file",
            remedy=f"Add [{needed}]; `abu init FILE` writes a file that shows it.",
        )


def _held(design: Design) -> Support:
    """The machine on its springs or in hands, as a point mass: that which is felt in the race plane, without balls."""
    case, autobalancer = design.case, design.autobalancer
    balls = autobalancer.balls_mass
    felt = case.body.effective_mass(autobalancer.mass, case.race_place)
    Range("effective mass in the race plane", balls, unit="kg", open_low=True, key="autobalancer.ball_count",
          remedy="Fewer or smaller balls.").check(felt)  # fmt: skip
    return _support(case, felt - balls)


def _support(case: Case, mass: float) -> Support:
    """A point mass on the suspension."""
    suspension = case.suspension
    if isinstance(suspension, Hands):
        return in_hands(mass, suspension.axes)
    if isinstance(suspension, Springs):
        return planar(mass, suspension.stiffness, suspension.damping)
    raise InputError("no support is known for this suspension", place=Place(key="suspension.model"))


def _pulled(design: Design, which: str) -> tuple[float, float]:
    """The constant force [N] on a machine that grinds, which its support holds."""
    contact = _contact(design) if which == "grinding" else None
    return (0.0, 0.0) if contact is None else (contact.drag * contact.press_force, 0.0)


def _race(design: Design, start: Start, *, turning: bool) -> Race:
    """The race with its balls; a rotor that does not turn yet has them at rest, however they start."""
    case, autobalancer = design.case, design.autobalancer
    back = -case.speed if start == "standstill" and turning else 0.0
    speeds = (back,) * autobalancer.ball_count
    if start == "placed" and turning and case.table.start is not None and case.table.start.speeds_rpm is not None:
        speeds = case.table.start.speeds
    return Race(
        pitch_radius=autobalancer.pitch_radius,
        ball_masses=(autobalancer.ball_mass,) * autobalancer.ball_count,
        drag=case.drag,
        inertia_factor=case.inertia_factor,
        start_angles=_start_angles(design, start),
        start_speeds=speeds,
        ball_radius=autobalancer.ball_diameter / 2,
    )


def _start_angles(design: Design, start: Start) -> tuple[float, ...]:
    count = design.autobalancer.ball_count
    if start == "spread":
        return tuple(AHEAD + k * 2 * math.pi / count for k in range(count))
    if start == "settled":
        return tuple(math.pi + angle for angle in design.autobalancer.budget.resting_angles)
    beta = design.autobalancer.half_angle
    if start == "placed":
        return parted_angles(_angles_of_file(design), 2 * beta)
    middle = -AHEAD if start == "behind" else AHEAD
    return tuple(middle + (2 * k - count + 1) * beta for k in range(count))


def _angles_of_file(design: Design) -> tuple[float, ...]:
    """Angles of the file, as many as there are balls [rad]. Raises InputError."""
    table, count = design.case.table.start, design.autobalancer.ball_count
    if table is None:
        raise InputError(
            "the file does not say where the balls start", place=Place(key="start"), found="no table [start]",
            remedy="Add start.angles_deg, or ask for another --start.",
        )  # fmt: skip
    if len(table.angles_deg) != count:
        raise InputError(
            "an angle for each ball", place=Place(key="start.angles_deg"), found=f"{len(table.angles_deg)} angles",
            allowed=f"{count}, as many as the design has balls",
        )  # fmt: skip
    angles: tuple[float, ...] = table.angles
    return angles


def _effects(design: Design, which: str, race_centre: float) -> Iterator[Effect]:
    """All effects that the file has data for, in the order of the registry."""
    case, table, radius = design.case, design.case.table, design.autobalancer.ball_diameter / 2
    if which == "run-up" and table.run_up:
        yield guided(design, table.run_up.time_s) if table.motor is None else RunUpEffect(running_up(design))
        if table.motor:
            yield _motor(table.motor)
    if which == "idle" and (pace := guided(design, 0.0)).at_speed:
        yield pace
    yield RaceEccentricityEffect(case.race_eccentricity, race_centre)
    yield from _across(design) if which == "grinding" else ()
    if table.machine.spindle_axis == "horizontal":
        yield GravityEffect()
    contact = _contact(design) if which == "grinding" else None
    if contact:
        yield contact
    yield BallContactEffect(radius, RESTITUTION)
    yield DryRollingFrictionEffect(case.friction_arm, radius)


def _across(design: Design) -> Iterator[Effect]:
    """Balls across their race, which a face wheel at work drives by its axial runout; rollers do not go there."""
    case, groove = design.case, design.track.groove_radius
    runout = case.table.wheel.axial_runout
    if runout and groove and case.contact is not None and case.contact.contact == "face":
        from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect

        yield TransverseMotionEffect(groove, design.autobalancer.ball_diameter / 2, runout)


def _contact(design: Design) -> GrindingContactEffect | None:
    """Wheel and work, in the plane of the race; None for a face, which does not press in the plane."""
    case, wheel, contact = design.case, design.case.table.wheel, design.case.contact
    if contact is None or contact.contact == "face":
        return None
    rim = {"runout": case.runout, "runout_angle": wheel.runout_angle, "wheel_radius": wheel.diameter / 2}
    return replace(GrindingContactEffect.of(contact), **rim)


def guided(design: Design, up: float) -> RunUpEffect:
    """Course of the speed from rest to full speed in a time [s]; 0: at full speed from the start.

    The temporary speed reduction that the file asks for follows.
    """
    given, speed = design.case.table.run_up, design.case.speed
    if given is None or given.pause_speed_rpm is None:
        return RunUpEffect(up)
    low = given.pause_speed
    fall = (1 - low / speed) * given.run_down_s
    return RunUpEffect(up, low=low, fall=fall, pause=given.pause_s, rise=given.pause_rise_s)


def running_up(design: Design) -> float:
    """Time [s] from rest to full speed for good; that of a motor is five of its time constants J Ω₀/M.

    A motor takes its own time, whatever [run_up] gives.
    """
    table = design.case.table
    if table.motor is None:
        return guided(design, table.run_up.time_s if table.run_up else 0.0).at_speed
    motor = _motor(table.motor)
    return TIME_CONSTANTS * motor.inertia * motor.no_load_speed / motor.stall_torque


def _motor(table: MotorTable) -> "MotorEffect":
    from abu_calc.dynamics.effects.motor import MotorEffect

    return MotorEffect.of(table)


def level_without(design: Design) -> float:
    """Level [dB] at the loudest limited place of the machine without an autobalancer, idle at its speed."""
    case, mass = design.case, design.case.body.effective_mass()
    whirl = design.imbalance.value / mass * resonance_factor(case.suspension, case.speed, mass)
    without = settled_levels(case, whirl, None, design.imbalance.value, 0.0).worst.before
    return math.inf if without is None else without


def quiet_velocity(design: Design, scene: Scene) -> float:
    """Rms velocity [m/s] of the axis at the race up to which the machine is quiet, idle at its speed.

    That has min(limit, level without an autobalancer at the imbalance of the file) at the loudest place: under a high
    limit, too, the balls must make the machine less loud than it was. On an arm its motion without balls counts.
    """
    limit = design.case.level_limit
    if scene.name.startswith("swing-arm"):
        without = unbalanced_amplitude(scene) * scene.speed / math.sqrt(2)
        return min(velocity_of_level(design, limit), without)
    return velocity_of_level(design, min(limit, level_without(design)))


def velocity_of_level(design: Design, wanted: float) -> float:
    """Rms velocity [m/s] of the axis at the race with that level [dB] at the loudest place, or with the limit of a_hv;
    0 if it is louder at rest.

    Found by bisection of its logarithm: the level rises with the velocity, whatever place is loudest.
    """
    case = design.case
    most = case.table.limits.a_hv_m_per_s2

    def louder(velocity: float) -> bool:
        """Whether a velocity has more than the level wanted, or than the acceleration permitted at the handles."""
        moved = math.sqrt(2) * velocity / case.speed
        if level_at_loudest(case, design.autobalancer, moved) > wanted:
            return True
        return most is not None and total_of(case, design.imbalance.value, design.autobalancer, moved) > most

    low, high = -30.0, math.log(1e3 * velocity_from_level(wanted))
    if louder(math.exp(low)):
        return 0.0
    for _ in range(32):  # to 1e-8
        middle = (low + high) / 2
        low, high = (low, middle) if louder(math.exp(middle)) else (middle, high)
    return math.exp(low)
