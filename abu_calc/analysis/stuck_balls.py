"""Starts of a design at whose end dry friction holds every ball at rest in its race."""

from abu_calc.analysis.ensemble import TIGHTER, first_tolerance, run_of_start
from abu_calc.dynamics.switching.sticking import AT_REST
from abu_calc.errors import NotTrustworthyError
from abu_calc.frozen import dataclass
from abu_calc.scenes.members import Member, members
from abu_calc.sizing.design import Design


@dataclass(frozen=True)
class StuckBalls:
    """Number of start cases simulated at the given drag rate, and of those that end balanced and stuck.

    In the latter all balls balance and are held by friction.
    """

    starts: int
    held: int

    @property
    def proves(self) -> bool:
        """True if friction held the balls in every start case."""
        return 0 < self.starts == self.held

    @property
    def words(self) -> str:
        """The proof, or why there is none."""
        if not self.starts:
            return "no dry friction is given that could hold the balls"
        proof = "dry friction holds all balls at rest" if self.proves else "dry friction holds the balls"
        return f"{proof} in {self.held} of {self.starts} simulated starts"


def stuck_balls(design: Design, doubtful: float, accuracy: float = 0.01) -> StuckBalls:
    """Simulate every start at the drag given to its end, and count those whose balls stick and balance.

    A ball sticks when its mean speed in the last twentieth of the run is below 1e-9 of the rotor's: a disturbance that
    friction can carry then moves nothing. Runs that give no trustworthy number count as not held. `doubtful` [1/s]: see
    `members`. Range: one speed; a disturbance beyond what friction carries may still free the balls.
    """
    if not design.case.friction_arm:
        return StuckBalls(0, 0)
    starts = list(members(design, doubtful, (1.0,)))
    return StuckBalls(len(starts), sum(_sticks(design, member, accuracy) for member in starts))


def _sticks(design: Design, member: Member, accuracy: float) -> bool:
    try:
        run = run_of_start(design, member, accuracy, TIGHTER * first_tolerance(design))
    except NotTrustworthyError:
        return False
    return run.outcome.balanced and run.outcome.slip <= AT_REST
