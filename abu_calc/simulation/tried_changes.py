"""A change of the file with which every start case passes, as simulated, and the action that each check makes of it."""

from collections.abc import Callable, Mapping
from typing import Final

from abu_calc.foundation.checks import Action
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.moved import Moved
from abu_calc.simulation.ensemble_results import Ensemble, StartOutcome
from abu_calc.sizing.actions import SIMULATED, set_action
from abu_calc.sizing.balls import Candidate

IN_ALL_OILS: Final = " in hot or cold oil"
"""Words behind a quantity that is judged in hot and cold oil, too."""


@dataclass(frozen=True)
class TriedChange:
    """Entries with which all start cases at the given viscous drag rate pass, and the ensembles before and after.

    `after` None: none of the changes `without_success` makes them pass. `in_all_oils`: hot and cold oil are judged,
    too.
    """

    candidate: Candidate
    before: Ensemble
    entries: Mapping[str, object]
    after: Ensemble | None
    without_success: tuple[str, ...] = ()
    in_all_oils: bool = False

    def action(
        self, quantity: str, value: Callable[[StartOutcome], float], unit: str, limit: float | None = None
    ) -> Action:
        """The action, by the largest value of a quantity over the start cases that are judged."""
        return self._action(quantity, lambda ensemble: max(map(value, self._judged(ensemble)), default=0.0), unit,
                            limit)  # fmt: skip

    def counting(self, quantity: str, bad: Callable[[StartOutcome], bool], unit: str) -> Action:
        """The action, by the number of start cases that are judged."""
        return self._action(quantity, lambda ensemble: float(sum(map(bad, self._judged(ensemble)))), unit, 0.0)

    def _judged(self, ensemble: Ensemble) -> tuple[StartOutcome, ...]:
        return ensemble.outcomes if self.in_all_oils else ensemble.given

    def _action(self, quantity: str, value: Callable[[Ensemble], float], unit: str, limit: float | None) -> Action:
        if self.after is None:
            return Action(f"No change was found. Simulated without success: {'; '.join(self.without_success)}.")
        oils = IN_ALL_OILS if self.in_all_oils else ""
        moved = Moved(f"{quantity}{oils}", value(self.before), value(self.after), unit, limit)
        judged = "hot and cold oil included" if self.in_all_oils else "at the given drag rate"
        more = f"All {self.after.members} start cases, {judged}, then pass."
        return set_action(self.entries, self.candidate, moved, SIMULATED, more)
