"""The finished design: every step's frozen result, side by side; and one machine built to it.

A built machine has its own balls, race, wheel and hands, and keeps the choices of the design.

Step 1: whether balancing is possible at the speeds of the file, and their check against the motor's torque.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, Literal, TypeVar

from abu_calc.formulas.motor import working_speed
from abu_calc.formulas.suspension import dynamic_stiffness, natural_frequency
from abu_calc.foundation.checks import Bound, Check, Finding, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown, to_si
from abu_calc.foundation.validity import Range
from abu_calc.inputs.machine import MachineFile
from abu_calc.sizing.balls import AutobalancerChoice, Candidate, evaluate
from abu_calc.sizing.case import Case, read_case, working_speeds
from abu_calc.sizing.drawing_requirements import DrawingLine
from abu_calc.sizing.handles import BodyBands, HighestTotal
from abu_calc.sizing.imbalance import Imbalance, find_imbalance
from abu_calc.sizing.manufacture.construction import Construction
from abu_calc.sizing.manufacture.eccentricity import EccentricitySplit
from abu_calc.sizing.oil import with_oil
from abu_calc.sizing.places import VibrationLevels
from abu_calc.sizing.track import Track, track
from abu_calc.sizing.vibration import LevelsUnderLoad, SpeedLevels, WorstResidual, worst_residuals

if TYPE_CHECKING:
    from abu_calc.sizing.swing_arm import SwingArmBounds


Region = Literal["subcritical", "between", "supercritical"]

BALL_SHARE = Range(
    "mass of one ball over the effective mass at the wheel",
    0.0,
    0.5,
    open_low=True,
    remedy="Smaller balls, or a heavier machine.",
    key="autobalancer.ball_diameter_mm",
)


PLACES = 16
"""Parts of a speed range that are looked at."""


@dataclass(frozen=True)
class FrequencyRegion:
    """Region of the working speeds [rad/s].

    `least_speed` is the lower end of the zone that the rated speed needs.
    """

    speed: float
    natural_frequencies: tuple[float, float]
    region: Region
    balancing_possible: bool
    finite_mass_gap: float
    least_speed: float
    between_zone: tuple[float, float] | None
    check: Check


@formula(
    "Distance above the natural frequency that two lightly damped balls of finite mass need",
    "(Ω−ω)/Ω > (2m/(J·M))^(1/3)",
    "1",
    signs="n",
    where=(
        "A higher viscous drag rate narrows this gap. More than two balls, or two free axes, widen it up to "
        "(3nm/(J·M))^(1/3). No check uses it."
    ),
    checked=(BALL_SHARE,),
    assumed="two balls, one free axis, light damping of balls and support; an estimate if m/M is above 0.1",
    source="derived from the averaged motion of two opposite balls; confirmed by integration of the full equations",
    published="Kladiev 1996, (7), requires only Ω > ω, which is necessary but not sufficient",
)
def finite_mass_gap(ball_mass: float, mass: float, inertia_factor: float) -> float:
    """
    >>> round(finite_mass_gap(0.01673, 5.6, 1.0), 4)
    0.1815
    """
    BALL_SHARE.check(ball_mass / mass)
    return float((2 * ball_mass / (inertia_factor * mass)) ** (1 / 3))


@formula(
    "Speeds at which light balls balance",
    "1/(Ω²−ω₁²) + 1/(Ω²−ω₂²) > 0",
    "rad/s",
    signs="H_xx H_yy",
    where=(
        "On springs this holds for Ω > ω₂ and for ω₁ < Ω < √((ω₁²+ω₂²)/2). On any support, damping included, the "
        "condition is Re[H_xx + H_yy] < 0: the support moves against the imbalance."
    ),
    assumed="light balls; for balls of finite mass the eigenvalues decide (ABU103)",
    source="derived by averaging; the upper zone is Kladiev 1996, (7)",
    published="Kladiev 1996 gives only the upper zone",
)
def zones(frequencies: tuple[float, float]) -> tuple[tuple[float, float] | None, float]:
    """
    >>> zones((300.0, 700.0))[1], zones((300.0, 300.0))[0] is None
    (700.0, True)
    """
    low, high = sorted(frequencies)
    between = (low, ((low**2 + high**2) / 2) ** 0.5)
    return (between if low < high else None), high


def frequency_region(case: Case, ball_mass: float, added_mass: float) -> FrequencyRegion:
    """Region of the whole speed range, and whether light balls balance there.

    The mass of the autobalancer is added.
    """
    mass = case.body.effective_mass(added_mass)
    frequencies = (natural_frequency(case.suspension, 0, mass), natural_frequency(case.suspension, 1, mass))
    between, above = zones(frequencies)
    low, high = case.speed_range
    in_between = between is not None and between[0] < low and high < between[1]
    speeds = {low, case.speed, high, *(low + (high - low) * k / PLACES for k in range(1, PLACES))}
    possible = (low > above or in_between) and all(_recedes(case, speed, mass) for speed in speeds)
    region: Region = (
        "supercritical"
        if case.speed > max(frequencies)
        else "between"
        if case.speed > min(frequencies)
        else "subcritical"
    )
    least = between[0] if in_between and between else above
    gap = finite_mass_gap(ball_mass, mass, case.inertia_factor)
    check = _check(possible, in_between, low, least, above)
    return FrequencyRegion(case.speed, frequencies, region, possible, gap, least, between, check)


def _recedes(case: Case, speed: float, mass: float) -> bool:
    """True if the support moves against the imbalance on average: Re(1/D_x + 1/D_y) < 0.

    The condition holds for any linear support.
    """
    return sum((1 / dynamic_stiffness(case.suspension, axis, speed, mass)).real for axis in (0, 1)) < 0


def _check(possible: bool, in_between: bool, low: float, least: float, above: float) -> Check:
    action = None
    if possible:
        message = "The lowest speed is above the natural frequencies"
        if in_between:
            message = "All speeds lie between the two natural frequencies: light balls balance there, by a small margin"
        message += ". That is necessary, not sufficient: see ABU103"
    else:
        message = "At some speed of the range the support moves with the imbalance: the balls go to the heavy side"
        action = f"Keep all speeds above {shown(above, 'rpm', '.0f')}, or hold the machine more softly."
    return coded("ABU101", verdict(possible), message, low, least, action)


def motor_checks(case: Case) -> tuple[Check, ...]:
    """Checks of the motor: idling at a working speed of the file, turning under load.

    There is none without a motor.

    A missed working speed is a warning, not a failure: the speeds judged include the idle speed, see
    `Case.speed_range`.
    """
    if case.idle_speed is None:
        return ()
    (low, high), idle = (to_si(speed, "rpm") for speed in case.table.machine.speeds_rpm), case.idle_speed
    bound: Bound = "least" if idle < low else "most"
    limit = low if bound == "least" else high
    kept = case.speed_range == working_speeds(case.table)
    messages, action = ["The motor idles at a working speed of the file"], None
    if not kept:
        side = "above" if idle > limit else "below"
        messages = [
            f"The motor idles {100 * abs(idle / limit - 1):.1f} % {side} the working speeds of the file",
            "Idle levels, stresses and stability are judged at this speed, too",
        ]
    loaded = _speed_under_load(case)
    if loaded is not None:
        messages.append(f"The cutting torque slows it to {_rpm(loaded)}" if loaded else "The cutting torque stops it")
    if loaded == 0:
        action = "Specify a motor.stall_torque_N_m above the cutting torque, or reduce grinding.press_force_N."
    return (
        coded("ABU104", verdict(True, kept and loaded != 0), ". ".join(messages), idle, limit, action, bound=bound),
    )  # fmt: skip


def _speed_under_load(case: Case) -> float | None:
    """Speed [rad/s] at which the motor gives the cutting torque f·N·R_w; None without motor or [grinding]."""
    motor, contact = case.table.motor, case.contact
    if motor is None or contact is None:
        return None
    torque = contact.cutting_coefficient * contact.press_force * case.wheel_radius
    return working_speed(motor.stall_torque_N_m, motor.no_load_speed, torque)


def _rpm(speed: float) -> str:
    return shown(speed, "rpm", ".0f")


@dataclass(frozen=True)
class Design:
    """Return value of `size`, in the order of the steps; SI inside."""

    case: Case
    frequency: FrequencyRegion
    imbalance: Imbalance
    choice: AutobalancerChoice
    track: Track
    runner_up_tracks: tuple[Track, ...]
    idle: VibrationLevels
    worst: tuple[WorstResidual, ...]
    speed_levels: SpeedLevels | None
    highest_total: HighestTotal | None
    """None without a limit of a_hv, or if the balls cannot balance."""
    loaded: LevelsUnderLoad | None
    swing_arm: "SwingArmBounds | None"
    drawing: tuple[DrawingLine, ...]
    checks_before: tuple[Check, ...]
    level: Finding | None
    """The idle level as expected, which start cases judge, too; None if the design was built as one machine."""
    checks_behind: tuple[Check, ...]
    """Checks of sizing before and behind that of the level; those of the swing arm come last."""
    warnings: tuple[str, ...]
    bands: BodyBands | None
    """Bands of an estimated body; None: nothing is estimated, or the design was built as one machine."""
    eccentricity: EccentricitySplit
    """Parts of the eccentricity that the drawing permits."""
    construction: Construction
    """Parts to make, cover and seat of the ring, with their checks."""

    @property
    def autobalancer(self) -> Candidate:
        """The chosen one."""
        return self.choice.best

    @property
    def autobalancers(self) -> tuple[Candidate, ...]:
        """One race is a list of one."""
        return (self.autobalancer,)

    @property
    def imbalances(self) -> tuple[float, ...]:
        """Imbalance of each wheel [kg m]."""
        return (self.imbalance.value,)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Checks of sizing alone."""
        if self.level is None:
            return ()
        arm = () if self.swing_arm is None else self.swing_arm.checks
        return *self.checks_before, coded("ABU401", *self.level), *self.checks_behind, *arm

    @property
    def system_mass(self) -> float:
        """Machine, wheel, autobalancer with its balls [kg]."""
        return self.case.body.mass + self.autobalancer.mass


@dataclass(frozen=True)
class RaceDesign:
    """Balls, race and its parts with their own checks: what is known of a race without its machine's vibration."""

    case: Case
    autobalancer: Candidate
    track: Track
    eccentricity: EccentricitySplit
    construction: Construction
    checks: tuple[Check, ...]


Race = TypeVar("Race", bound=RaceDesign)


def built_race(design: Race, machine: MachineFile) -> Race:
    """The race as it came out in one machine, whose file may pin the balls and the race that were made."""
    case, chosen = read_case(machine), design.autobalancer
    made = _made(case, find_imbalance(case).value, chosen)
    case = with_oil(case, made)
    race = track(case, made, frequency_region(case, made.ball_mass, made.mass).natural_frequencies)
    return replace(design, case=case, autobalancer=made, track=race, checks=())


def _made(case: Case, imbalance: float, chosen: Candidate) -> Candidate:
    """The autobalancer with the balls and the race that a file pins, else with those of the choice."""
    own = case.autobalancer
    return evaluate(
        case,
        imbalance,
        chosen.ball_count if own.ball_count is None else own.ball_count,
        chosen.ball_diameter if own.ball_diameter_mm is None else own.ball_diameter,
        chosen.race_radius if own.race_radius_mm is None else own.race_radius,
    )


def built(design: Design, machine: MachineFile) -> Design:
    """The design as it came out in one machine, whose file may pin the balls and the race that were made.

    What judges a design (checks, runners-up, advice, levels over the speed range) is left out, and the worst
    arrangement of balls, too, which takes longer than all the rest: see `with_worst`.
    """
    case = read_case(machine)
    imbalance = find_imbalance(case)
    made = _made(case, imbalance.value, design.autobalancer)
    case = with_oil(case, made)
    frequency = frequency_region(case, made.ball_mass, made.mass)
    return replace(
        design, case=case, frequency=frequency, imbalance=imbalance, choice=replace(design.choice, best=made),
        track=track(case, made, frequency.natural_frequencies), runner_up_tracks=(), worst=(), speed_levels=None,
        highest_total=None, loaded=None, swing_arm=None, drawing=(), checks_before=(), level=None,
        checks_behind=(), warnings=(), bands=None,
    )  # fmt: skip


def with_worst(design: Design) -> Design:
    """The same with the arrangements at which friction holds the axis farthest off."""
    return replace(design, worst=worst_residuals(design.case, design.imbalance.value, design.autobalancer))
