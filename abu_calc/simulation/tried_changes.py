"""A change of the file with which every start case passes, as simulated, and the action that each check makes of it."""

from collections.abc import Callable, Mapping

from abu_calc.foundation.checks import Action
from abu_calc.foundation.frozen import dataclass
from abu_calc.simulation.ensemble_results import Ensemble, StartOutcome
from abu_calc.sizing.actions import SIMULATED, Moved, set_action
from abu_calc.sizing.balls import Candidate


@dataclass(frozen=True)
class TriedChange:
    """Entries with which all start cases at the given viscous drag rate pass, and the ensembles before and after.

    `after` None: none of the changes `without_success` makes them pass.
    """

    candidate: Candidate
    before: Ensemble
    entries: Mapping[str, object]
    after: Ensemble | None
    without_success: tuple[str, ...] = ()

    def action(
        self, quantity: str, value: Callable[[StartOutcome], float], unit: str, limit: float | None = None
    ) -> Action:
        """The action, by the largest value of a quantity over the start cases at the given viscous drag rate."""
        return self._action(quantity, lambda ensemble: max(map(value, ensemble.given), default=0.0), unit, limit)

    def counting(self, quantity: str, bad: Callable[[StartOutcome], bool], unit: str) -> Action:
        """The action, by the number of start cases at the given viscous drag rate."""
        return self._action(quantity, lambda ensemble: float(sum(map(bad, ensemble.given))), unit, 0.0)

    def _action(self, quantity: str, value: Callable[[Ensemble], float], unit: str, limit: float | None) -> Action:
        if self.after is None:
            return Action(f"No change was found. Simulated without success: {'; '.join(self.without_success)}.")
        moved = Moved(quantity, value(self.before), value(self.after), unit, limit)
        more = f"All {self.after.members} start cases at the given drag rate then pass."
        return set_action(self.entries, self.candidate, moved, SIMULATED, more)
