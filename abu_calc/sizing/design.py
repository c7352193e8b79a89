"""The finished design: every step's frozen result, side by side; and one machine built to it.

A built machine has its own balls, race, wheel and hands, and keeps the choices of the design.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from abu_calc.foundation.checks import Check, Finding, coded
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.machine import MachineFile
from abu_calc.sizing.balls import AutobalancerChoice, Candidate, evaluate
from abu_calc.sizing.case import Case, read_case
from abu_calc.sizing.drawing_requirements import DrawingLine
from abu_calc.sizing.handles import BodyBands, HighestTotal
from abu_calc.sizing.imbalance import Imbalance, find_imbalance
from abu_calc.sizing.manufacture.construction import Construction
from abu_calc.sizing.manufacture.eccentricity import EccentricitySplit
from abu_calc.sizing.oil import with_oil
from abu_calc.sizing.operating_speed import FrequencyRegion, frequency_region
from abu_calc.sizing.places import VibrationLevels
from abu_calc.sizing.track import Track, track
from abu_calc.sizing.vibration import LevelsUnderLoad, SpeedLevels, WorstResidual, worst_residuals

if TYPE_CHECKING:
    from abu_calc.sizing.swing_arm import SwingArmBounds


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
