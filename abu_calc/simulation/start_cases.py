"""Start cases of a machine: places of its balls, speed, temperature of the oil, side of the race eccentricity.

`members` lists those that a design is judged by. `scene_of_member` gives the scene of any one machine switched on.

Outcomes of the start cases of one design: the worst, and those to be confirmed because they decide checks.
"""

import math
import statistics
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import product
from operator import attrgetter
from typing import Any, Final, Literal

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.formulas.suspension import Springs
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, shown
from abu_calc.inputs.bearing_file import Limits
from abu_calc.inputs.duty import RunUp
from abu_calc.inputs.duty import Start as StartTable
from abu_calc.simulation.run_checks import SLIPPING, balances
from abu_calc.simulation.scene_of_design import Start, running_up, scene_of_design
from abu_calc.sizing.case import EQUAL_SPEEDS, Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.track import track
from abu_calc.sizing.vibration import LEVEL_ERROR

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


@dataclass(frozen=True)
class StartOutcome:
    """Outcome of one start case.

    `quiet_time`, `rest_time` and `settling_time` [s] from full speed on, None: never; `creeping`: balls still drift at
    the end; `residual`: axis amplitude [m]; `level` [dB] at the loudest place; `slip`: the largest mean speed of a ball
    against its race over the rotor's. Of several races the largest displacement counts, and `imbalance`, `allowed` and
    `moved` are those of the race that is farthest from balancing.
    """

    member: Member
    settling_time: float | None
    quiet_time: float | None
    rest_time: float | None
    creeping: bool
    residual: float
    level: float
    slip: float
    imbalance: float
    allowed: float
    work: int = 0
    confirmed: bool = False
    rise: float = 0.0
    """Possible further rise of the level [dB] if the run ended early."""
    ball_angles: tuple[float, ...] = ()
    """Angles of the balls in the rotor at the end [rad]."""
    duration: float = 0.0
    """Duration [s] of a run that went on longer than its scene, since the balls were not at rest by then; else 0."""
    velocity: float = 0.0
    """Rms velocity [m/s] of the axis at the end, at the race."""
    moved: float = math.inf
    """Imbalance [kg m] at the race without balls."""
    displacements: tuple[float, ...] = ()
    """Displacement 0–peak [m] of each place on a spindle with several races."""

    @property
    def hanging(self) -> bool:
        """True if balls stall: they keep turning more slowly than the rotor."""
        return self.slip > SLIPPING

    @property
    def balanced(self) -> bool:
        """True if the balls are at rest in their race and the imbalance left is allowed [kg m]."""
        return balances(self.imbalance, self.allowed, self.slip)

    @property
    def settling_time_or_inf(self) -> float:
        """Until it settled where it balances [s]; infinite if never."""
        return self.settling_time if self.settling_time is not None and self.balanced else math.inf

    @property
    def quiet_time_or_inf(self) -> float:
        """From when it is quiet [s]; infinite if never."""
        return math.inf if self.quiet_time is None else self.quiet_time

    @property
    def rest_time_or_inf(self) -> float:
        """From when the balls rest [s]; infinite if never."""
        return math.inf if self.rest_time is None else self.rest_time

    def in_time(self, limits: Limits) -> bool:
        """True if it is quiet in time, and at rest, if the file limits that."""
        rests = limits.rest_time_s is None or self.rest_time_or_inf <= limits.rest_time_s
        return self.quiet_time_or_inf <= limits.longest_quiet_time and rests

    def holds(self, limits: Limits, level: float) -> bool:
        """True if it balances, in time, and at most at a level [dB]."""
        return self.balanced and self.in_time(limits) and self.level <= level

    @property
    def loudest(self) -> float:
        """The level it might have risen to [dB]."""
        return self.level + self.rise

    @property
    def badness(self) -> tuple[bool, bool, float]:
        """Sorts the worst last."""
        return self.hanging, not self.balanced, self.level


@dataclass(frozen=True)
class Lost:
    """A start, of whatever kind, that gave no number to be trusted, and why; `work`: the evaluations it was allowed.

    `short`: whether more work would have given one, as far as is known.
    """

    member: Any
    reason: str
    work: int = 0
    short: bool = False


@dataclass(frozen=True)
class Ensemble:
    """All starts of one design; `drag` [1/s]: the one given, which decides what fails."""

    drag: float
    outcomes: tuple[StartOutcome, ...]
    lost: tuple[Lost, ...]
    temperatures: tuple[float, float, float] | None = None
    """Of the oil [°C] at work, hot and cold; None: the drag rates are given, not those of an oil."""

    @property
    def members(self) -> int:
        """Number of start cases."""
        return len(self.outcomes) + len(self.lost)

    @property
    def work(self) -> int:
        """Work of all of them."""
        return sum(outcome.work for outcome in self.outcomes) + sum(lost.work for lost in self.lost)

    @property
    def given(self) -> tuple[StartOutcome, ...]:
        """Outcomes at the given drag rate."""
        return tuple(outcome for outcome in self.outcomes if outcome.member.drag == self.drag)

    @property
    def rated(self) -> tuple[StartOutcome, ...]:
        """Outcomes at the rated speed."""
        return tuple(outcome for outcome in self.outcomes if outcome.member.speed is None)

    @property
    def balanced(self) -> int:
        """Number of start cases that balance."""
        return sum(outcome.balanced for outcome in self.outcomes)

    @property
    def hanging(self) -> tuple[StartOutcome, ...]:
        """Outcomes in which balls stall."""
        return tuple(outcome for outcome in self.outcomes if outcome.hanging)

    @property
    def worst(self) -> StartOutcome | None:
        """Worst outcome: stalled ranks before not balanced, and not balanced before loud."""
        return max(self.outcomes, key=lambda outcome: outcome.badness, default=None)

    def typical(self, values: Iterable[float]) -> float | None:
        """Median of the values; None if most are infinite."""
        middle = statistics.median(list(values) or [math.inf])
        return middle if math.isfinite(middle) else None


SLACK: Final = LEVEL_ERROR
"""A difference in level [dB] that decides nothing."""

Order = tuple[Callable[[StartOutcome], Any], float, bool]
"""Criterion that ranks start cases, its insignificant difference, and whether early end is allowed.

The criterion ends in a number; a smaller difference of that number decides nothing. The last item
applies to the confirming run: the level is that at the very end, the settling time is known earlier.
"""

ORDERS: tuple[Order, ...] = (
    (attrgetter("badness"), SLACK, False),
    (lambda outcome: (outcome.level,), SLACK, False),
    (lambda outcome: (outcome.quiet_time_or_inf,), 0.0, True),
)


def deciding(results: Sequence[StartOutcome | Lost], drag: float) -> dict[int, bool]:
    """Outcomes to confirm: the worst ones that are neither confirmed nor as bad as a confirmed one.

    The worst are found at the given drag rate and among all. Outcomes that might have become the loudest
    are included. The value tells whether the confirming run may end early.
    """
    done = [(k, outcome) for k, outcome in enumerate(results) if isinstance(outcome, StartOutcome)]
    groups = [group for group in (done, [(k, outcome) for k, outcome in done if outcome.member.drag == drag]) if group]
    undecided: dict[int, bool] = {}
    for group in groups:
        most = max(outcome.level for _, outcome in group)
        # Half of it: what is near would be asked for next, by itself.
        undecided.update((k, False) for k, outcome in group if outcome.loudest > most + SLACK / 2)
    for (order, slack, early_end), group in product(ORDERS, groups):
        k, worst = max(group, key=lambda pair: order(pair[1]))
        *kind, value = order(worst)
        confirmed = [order(outcome) for _, outcome in group if outcome.confirmed]
        if not any([*same] == kind and (near == value or near >= value - slack) for *same, near in confirmed):
            undecided.setdefault(k, early_end)
    return undecided


def worse(loose: StartOutcome | Lost, tight: StartOutcome | Lost) -> StartOutcome | Lost:
    """The tighter of two runs of a start; where they end differently the worse: less than any error decides there."""
    if isinstance(loose, Lost) or isinstance(tight, Lost):
        return tight if isinstance(tight, Lost) else loose
    if (loose.hanging, loose.balanced) == (tight.hanging, tight.balanced):
        return replace(tight, confirmed=True)
    return replace(max(loose, tight, key=lambda outcome: outcome.badness), confirmed=True)
