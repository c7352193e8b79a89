"""Start cases of a machine: places of its balls, speed, temperature of the oil, side of the race eccentricity.

`members` lists those that a design is judged by. `scene_of_member` gives the scene of any one machine switched on.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final, Literal

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.formulas.suspension import Springs
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, shown
from abu_calc.inputs.duty import RunUp
from abu_calc.inputs.duty import Start as StartTable
from abu_calc.simulation.scene_of_design import Start, running_up, scene_of_design
from abu_calc.sizing.case import EQUAL_SPEEDS, Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.track import track

STARTS: tuple[Start, ...] = ("bunched", "behind", "spread", "standstill")

RUN_UP, SLOW = 1.0, 4.0
"""Run-up [s] of a file that names none, and one slow enough to catch balls at a resonance."""

OPPOSITE, ALIKE = math.pi, math.tau
"""Angles of the race's centre from the imbalance [rad].

Opposite it the race asks for the most capacity. On the same side balls settle latest, and friction leaves
the loudest arrangements. `ALIKE` is a whole turn, since equations without an angle would be made and
compiled once more.
"""


Axis = Literal["horizontal", "vertical"]

Kind = Literal["bunched", "spread", "standstill", "run-up"]
KINDS: Final[tuple[Kind, ...]] = ("bunched", "spread", "standstill", "run-up")
"""Starts that are drawn: balls at rest in the race, touching or evenly round it; not turning at all; a run-up."""


@dataclass(frozen=True)
class Variation:
    """How a machine may differ from its file: factors on values, and how it is held; None: as the file says."""

    race_eccentricity: float = 1.0
    imbalance: float = 1.0
    friction_arm: float = 1.0
    natural_frequency: float = 1.0
    spindle_axis: Axis | None = None
    ball_masses: tuple[float, ...] = ()
    """Factors on the masses of the balls; empty: all balls have the same mass."""


@dataclass(frozen=True)
class Member:
    """One start: where from, the drag h₀ [1/s], and the time [s] from standstill to full speed, 0 at full speed.

    `eccentricity`: where the centre of the race stands, from the imbalance [rad]; `speed`: the full one [rad/s] where
    it is not the rated one; `by_motor`: the motor's torque runs it up, to its idle speed.
    """

    start: Start
    drag: float
    run_up: float = 0.0
    eccentricity: float = OPPOSITE
    speed: float | None = None
    by_motor: bool = False
    angles: tuple[float, ...] = ()
    """Angles of the balls from the imbalance [rad], if they are `placed`."""
    lag: float = 0.0
    """Share of the full speed by which `placed` balls turn more slowly than the race: a restart before they stop."""
    on_arm: bool = False
    """True if the machine idles on its swing arm, off the workpiece."""
    varied: Variation = Variation()
    promised: bool = True
    """True if all that differs is within what file and drawing promise."""
    phases: tuple[float, ...] | None = None
    """Phases [rad] of the imbalances whose phase against the first one is unknown, on a spindle with two races."""
    turned: float = 0.0
    """Angle [rad] by which the balls are further round than `start` says."""

    @property
    def at_nominal(self) -> bool:
        """True if nothing differs from the file, neither oil nor speed."""
        return self.promised and self.speed is None and self.varied == Variation()

    @property
    def race_centre_deg(self) -> float:
        """Angle of the race's centre from the imbalance [deg], from 0 to 360."""
        return round(from_si(self.eccentricity, "deg"), 9) % 360

    @property
    def way(self) -> str:
        """Start case in words, without a speed."""
        if self.by_motor:
            return "run-up by the motor"
        if self.on_arm:
            return f"{self.start} on the arm"
        if self.lag:
            return f"restart, balls at {100 * (1 - self.lag):.0f} % of the speed"
        return f"run-up in {self.run_up:g} s" if self.run_up else str(self.start)

    @property
    def name(self) -> str:
        """Start case in words."""
        speed = "" if self.speed is None else f" ({shown(self.speed, 'rpm', '.6g')})"
        phases = ", ".join(shown(phase, "deg", ".0f") for phase in self.phases or ())
        return f"{self.way}{speed}{', phase ' * bool(phases)}{phases}"


def members(design: Design, doubtful: float = 0.0, shares: tuple[float, ...] | None = None) -> Iterator[Member]:
    """All start cases that are simulated, at these shares of the given viscous drag rate; None: at work, hot and cold.

    At the given rate itself the race is off to either side. Below the rate `doubtful` [1/s] balls might stall,
    so that a slow run-up is tried, too. The ends of a speed range are tried after the rated speed: at the
    lowest balls stall first and settle latest, at the highest they are loudest. A motor runs up to its idle
    speed alone.
    """
    case, usual = design.case, usual_run_up(design)
    starts: tuple[Start, ...] = STARTS if case.table.start is None else (*STARTS, "placed")
    ends = (end for end in dict.fromkeys(case.speed_range) if not math.isclose(end, case.speed))
    for speed in (None, *ends):
        for drag in dict.fromkeys(share * case.drag for share in shares or case.drag_shares):
            both = speed is None and drag == case.drag and case.race_eccentricity > 0
            for angle in (ALIKE, OPPOSITE) if both else (ALIKE,):
                given = drag == case.drag
                yield from (Member(start, drag, 0.0, angle, speed=speed, promised=given) for start in starts)
                if not usual.by_motor or speed is None:
                    yield replace(usual, drag=drag, eccentricity=angle, speed=usual.speed or speed, promised=given)
                if drag < doubtful and usual.run_up < SLOW:
                    yield Member("bunched", drag, SLOW, angle, speed=speed, promised=given)
    yield from members_on_arm(design)


def members_on_arm(design: Design) -> Iterator[Member]:
    """Start cases at full speed on a swing arm that its pivot holds, off the workpiece; none without such an arm."""
    arm = design.case.table.swing_arm
    if arm is not None and arm.joint_stiffness_N_per_m:
        for angle in (ALIKE, OPPOSITE) if design.case.race_eccentricity > 0 else (ALIKE,):
            yield from (Member(start, design.case.drag, 0.0, angle, on_arm=True) for start in STARTS)


def usual_run_up(design: Design) -> Member:
    """The run-up of the file: by its motor to the idle speed, or guided to the rated speed; 1 s if it gives neither."""
    case, given = design.case, design.case.table.run_up
    if case.idle_speed is not None:
        return Member("bunched", case.drag, running_up(design), speed=idle_speed(case), by_motor=True)
    return Member("bunched", case.drag, given.time_s if given else RUN_UP)


def idle_speed(case: Case) -> float | None:
    """The speed [rad/s] at which the motor idles; None without a motor, or if it is the rated speed."""
    idle = case.idle_speed
    return None if idle is None or math.isclose(idle, case.speed, rel_tol=EQUAL_SPEEDS) else idle


def scene_of_member(design: Design, member: Member) -> Scene:
    """The idle scene of a machine started so, with every effect its file has data for."""
    which = "swing-arm-idle" if member.on_arm else "run-up" if member.run_up else "idle"
    scene = _scene(design, member, which)
    if member.varied.imbalance == 1:
        return scene
    # Quiet, at rest and balanced are judged by the imbalance of the file, however little there is.
    return replace(scene, imbalance=member.varied.imbalance * scene.imbalance, largest_imbalance=scene.imbalance)


def grinding_scene_of_member(design: Design, member: Member) -> Scene:
    """The scene of grinding with balls that start so, at full speed, with every effect its file has data for."""
    return _scene(design, member, "grinding")


def _scene(design: Design, member: Member, which: str) -> Scene:
    scene = scene_of_design(_with(design, member), which, member.start, member.eccentricity)
    return turned(scene, member.turned, masses=member.varied.ball_masses)


def _with(design: Design, member: Member) -> Design:
    """The design with the drag, the speed and the run-up of a member."""
    case, given = design.case, design.case.table.run_up
    table = case.table
    if member.angles:
        angles = tuple(round(from_si(angle, "deg"), 6) % 360 for angle in member.angles)
        speeds = (ball_speed_rpm(design, member),) * len(angles) if member.lag else None
        table = table.model_copy(update={"start": StartTable(angles_deg=angles, speeds_rpm=speeds)})
    if member.run_up:
        run_up = (given or RunUp()).model_copy(update={"time_s": member.run_up})
        table = table.model_copy(update={"run_up": run_up, "motor": table.motor if member.by_motor else None})
    idle, varied = case.idle_speed if member.by_motor else None, member.varied
    if varied.spindle_axis is not None:
        machine = table.machine.model_copy(update={"spindle_axis": varied.spindle_axis})
        table = table.model_copy(update={"machine": machine})
    suspension = case.suspension
    if isinstance(suspension, Springs) and varied.natural_frequency != 1:
        stiffness = tuple(varied.natural_frequency**2 * each for each in suspension.stiffness)
        # The damping ratio stays.
        damping = tuple(varied.natural_frequency * each for each in suspension.damping)
        suspension = Springs(stiffness, damping)  # type: ignore[arg-type]
    case = replace(
        case, drag=member.drag, speed=member.speed or case.speed, idle_speed=idle, table=table, suspension=suspension,
        race_eccentricity=varied.race_eccentricity * case.race_eccentricity,
        friction_arm=varied.friction_arm * case.friction_arm,
    )  # fmt: skip
    return replace(design, case=case, track=track(case, design.autobalancer, design.frequency.natural_frequencies))


def ball_speed_rpm(design: Design, member: Member) -> float:
    """Speed of the balls against the race at a restart [rpm], of a digit less than is computed with."""
    return round(from_si(-member.lag * (member.speed or design.case.speed), "rpm"), 6)


def turned(scene: Scene, angle: float, drag_ratio: float = 1.0, masses: tuple[float, ...] = ()) -> Scene:
    """A scene whose balls start further round by an angle [rad], in oil of another drag.

    `masses`: factors on the masses of the balls of each race; empty: the masses stay.
    """
    races = tuple(
        replace(
            race,
            start_angles=tuple(
                math.remainder(each + angle, 2 * math.pi) if angle else each for each in race.start_angles
            ),
            drag=race.drag * drag_ratio,
            ball_masses=tuple(np.multiply(race.ball_masses, masses or 1.0).tolist()),
        )
        for race in scene.races
    )
    return replace(scene, races=races)
