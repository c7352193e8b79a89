"""Ways in which one machine was switched on, to be looked at: run again when somebody asks, which few do."""

from functools import cached_property
from typing import Final

from abu_calc.analysis.outcomes import Ensemble
from abu_calc.analysis.starts import Again, levels_of, starts_again
from abu_calc.frozen import dataclass
from abu_calc.sizing.design import Design
from abu_calc.studies.rotor_view import RotorView

SAMPLES: Final = 250
"""Samples of each start case, so few that a page with all of them stays small."""


@dataclass(frozen=True)
class StartView:
    """One start as seen in the rotor. `why`: worst, typical or nothing; `settling_time_s`: None where it never does."""

    why: str
    start: str
    drag_per_s: float
    settling_time_s: float | None
    level_db: float
    balanced: bool
    view: RotorView


@dataclass(frozen=True)
class Starts:
    """Start cases of an ensemble; `of`: design, ensemble and accuracy, None if there is no ensemble."""

    of: tuple[Design, Ensemble, float] | None

    @property
    def drag_per_s(self) -> float | None:
        """The drag given."""
        return None if self.of is None else self.of[1].drag

    @cached_property
    def views(self) -> tuple[StartView, ...]:
        """The worst, a typical one, and each kind at the drag given: at most a dozen, run again at the first look."""
        if self.of is None:
            return ()
        design, ensemble, accuracy = self.of
        views = (_view(design, start) for start in starts_again(design, ensemble, accuracy))
        return tuple(view for view in views if view is not None)


def _view(design: Design, start: Again) -> StartView | None:
    view = RotorView.of(start.scene, start.trajectory, levels_of(design, start.scene), SAMPLES)
    if view is None:
        return None
    outcome = start.outcome
    return StartView(
        why=start.why,
        start=outcome.member.name,
        drag_per_s=outcome.member.drag,
        settling_time_s=outcome.settling if outcome.balanced else None,
        level_db=outcome.level,
        balanced=outcome.balanced,
        view=view,
    )
