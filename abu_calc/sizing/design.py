"""The finished design: every step's frozen result, side by side."""

from typing import TYPE_CHECKING

from abu_calc.checks import Check
from abu_calc.frozen import dataclass
from abu_calc.sizing.balls import Candidate, Choice
from abu_calc.sizing.case import Case
from abu_calc.sizing.drawing import Advice
from abu_calc.sizing.frequency import FrequencyRegion
from abu_calc.sizing.imbalance import Imbalance
from abu_calc.sizing.track import Track
from abu_calc.sizing.vibration import Loaded, SpeedLevels, Vibration
from abu_calc.sizing.worst import WorstResidual

if TYPE_CHECKING:
    from abu_calc.fits.seats import BearingSeats
    from abu_calc.sizing.swing_arm import SwingArmBounds


@dataclass(frozen=True)
class Design:
    """Return value of `size`, in the order of the steps; SI inside."""

    case: Case
    frequency: FrequencyRegion
    imbalance: Imbalance
    choice: Choice
    track: Track
    runner_up_tracks: tuple[Track, ...]
    idle: Vibration
    worst: tuple[WorstResidual, ...]
    speed_levels: SpeedLevels | None
    loaded: Loaded | None
    seats: "tuple[BearingSeats, ...]"
    swing_arm: "SwingArmBounds | None"
    drawing: tuple[Advice, ...]
    checks: tuple[Check, ...]
    warnings: tuple[str, ...]

    @property
    def autobalancer(self) -> Candidate:
        """The chosen one."""
        return self.choice.best

    @property
    def system_mass(self) -> float:
        """Machine, wheel, autobalancer with its balls [kg]."""
        return self.case.body.mass + self.autobalancer.mass
